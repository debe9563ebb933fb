//! Failures to write a file: messages with a remedy, and which failures may pass.

use std::io::{self, ErrorKind};
use std::path::Path;
use std::thread;
use std::time::Duration;

/// An error with the path that could not be written, and a remedy.
pub fn explain(path: &Path, error: &io::Error) -> io::Error {
    let folder = folder_of(path).display();
    let remedy = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            format!("free some space for {folder} and make the same call again")
        }
        ErrorKind::ReadOnlyFilesystem => format!("{folder} is read-only: name another folder"),
        ErrorKind::PermissionDenied => {
            format!("make {folder} writable for you or name another folder")
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            format!("{folder} must be an existing folder")
        }
        ErrorKind::IsADirectory | ErrorKind::DirectoryNotEmpty => {
            "a folder has the file's name: move it away".to_owned()
        }
        ErrorKind::AlreadyExists => "move it away".to_owned(),
        ErrorKind::FileTooLarge => "raise the limit on file sizes (ulimit -f)".to_owned(),
        ErrorKind::InvalidFilename => "the name must be a shorter or plainer one".to_owned(),
        _ => format!("see that the disk of {folder} works"),
    };
    io::Error::new(
        error.kind(),
        format!("cannot write {}: {error}; {remedy}", path.display()),
    )
}

/// Whether the disk, the quota or the limit on file sizes is exhausted: retrying is useless before
/// somebody makes room.
pub(crate) fn is_full(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge
    )
}

/// Calls `act` a second time, after a pause, if it failed for a reason that may be temporary.
pub(crate) fn twice(mut act: impl FnMut() -> io::Result<()>) -> io::Result<()> {
    const PAUSE: Duration = Duration::from_millis(200);
    act().or_else(|error| {
        if is_full(&error) {
            return Err(error);
        }
        thread::sleep(PAUSE);
        act()
    })
}

/// The folder that contains a path.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_is_done_twice_unless_there_is_no_room() {
        for (kind, times) in [
            (ErrorKind::TimedOut, 2),
            (ErrorKind::StorageFull, 1),
            (ErrorKind::FileTooLarge, 1),
        ] {
            let mut done = 0;
            let failing = twice(|| {
                done += 1;
                Err(kind.into())
            });
            assert_eq!((failing.is_err(), done), (true, times), "{kind}");
        }
        let mut done = 0;
        let passing = twice(|| {
            done += 1;
            if done == 1 {
                Err(ErrorKind::TimedOut.into())
            } else {
                Ok(())
            }
        });
        assert_eq!((passing.is_ok(), done), (true, 2));
    }
}
