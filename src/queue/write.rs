//! Files that are either whole or not there, however the run ends.
//!
//! A temporary file in the same folder is written, flushed to the disk and renamed over the
//! target, then the folder is flushed. What a killed run can leave behind is a file whose name
//! ends in `.tmp`, never a torn picture.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

/// Writes `bytes` to `path` so that a reader sees the old file or the new one, nothing between,
/// even after a power failure. The file gets the permissions of any newly created one.
///
/// # Errors
/// Of the kind that the system reported, with the path and what to do about it. Unless it is
/// the last step that failed, the flushing of the folder, an old file is then still there as
/// it was. No temporary file is left.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace(path, bytes).map_err(|error| explain(path, &error))
}

/// Whether files can be made in a folder, found out by making one.
///
/// # Errors
/// As [`write_atomically`].
pub(super) fn check_writable(folder: &Path, stem: &str) -> io::Result<()> {
    let path = folder.join(stem);
    create_beside(&path)
        .and_then(|(file, temporary)| {
            drop(file);
            remove_if_there(&temporary)
        })
        .map_err(|error| explain(&path, &error))
}

/// Removes a file, which another process may take for a leftover and remove first.
fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Whether there is no room: of no use to try again before somebody has made some.
pub(super) fn is_full(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge
    )
}

/// Does once more what failed for a reason that may pass.
pub(super) fn twice(mut act: impl FnMut() -> io::Result<()>) -> io::Result<()> {
    const PAUSE: Duration = Duration::from_millis(200);
    act().or_else(|error| {
        if is_full(&error) {
            return Err(error);
        }
        thread::sleep(PAUSE);
        act()
    })
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (mut file, temporary) = create_beside(path)?;
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    drop(file);
    if let Err(error) = written.and_then(|()| fs::rename(&temporary, path)) {
        // The first error is the one to report.
        let _ = fs::remove_file(&temporary);
        return Err(error);
    }
    sync_folder(folder_of(path))
}

/// A new file in the folder of `path`, under a name that nobody else has: another machine may
/// be writing there, and a process killed earlier may have left its own.
fn create_beside(path: &Path) -> io::Result<(File, PathBuf)> {
    static SERIAL: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().ok_or(ErrorKind::InvalidFilename)?;
    loop {
        let serial = SERIAL.fetch_add(1, Ordering::Relaxed);
        let mut unique = name.to_owned();
        unique.push(format!(".{}-{serial}.tmp", process::id()));
        let temporary = path.with_file_name(unique);
        match OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&temporary)
        {
            Ok(file) => return Ok((file, temporary)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Makes the renaming last. Some network file systems cannot, and say so: that is no failure.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        Err(error)
            if matches!(
                error.kind(),
                ErrorKind::InvalidInput | ErrorKind::Unsupported
            ) =>
        {
            Ok(())
        }
        result => result,
    }
}

/// Elsewhere a folder cannot be opened as a file.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

/// An error with the path that could not be written and what to do about it.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("folder exists");
        let name = |entry: io::Result<fs::DirEntry>| entry.map(|e| e.file_name());
        entries
            .map(|e| name(e).expect("readable").to_string_lossy().into_owned())
            .collect()
    }

    #[test]
    fn a_file_is_replaced_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("plate.0001.png");
        for bytes in [&b"first and longer"[..], b"second", b""] {
            write_atomically(&path, bytes).expect("writable");
            assert_eq!(fs::read(&path).expect("readable"), bytes);
        }
        assert_eq!(names(folder.path()), ["plate.0001.png"]);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("scratch folder");
        let mode = |name: &str| {
            let path = folder.path().join(name);
            fs::metadata(path).expect("exists").permissions().mode()
        };
        write_atomically(&folder.path().join("ours"), b"x").expect("writable");
        fs::write(folder.path().join("usual"), b"x").expect("writable");
        assert_eq!(mode("ours"), mode("usual"));
    }

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

    #[test]
    fn a_missing_folder_is_named_with_its_remedy() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("renders/plate.png");
        let error = write_atomically(&path, b"x").expect_err("no such folder");
        assert_eq!(error.kind(), ErrorKind::NotFound);
        let message = error.to_string();
        assert!(
            message.starts_with(&format!("cannot write {}: ", path.display())),
            "{message}"
        );
        assert!(
            message.ends_with("renders must be an existing folder"),
            "{message}"
        );
    }

    #[test]
    fn a_folder_in_the_way_is_an_error_and_leaves_no_temporary_file() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("plate.png");
        fs::create_dir(&path).expect("writable");
        let error = write_atomically(&path, b"x").expect_err("a folder is there");
        assert!(error.to_string().contains("move it away"), "{error}");
        assert_eq!(names(folder.path()), ["plate.png"]);
    }

    #[test]
    fn what_another_process_has_swept_is_removed_as_well() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("plate.0001.png.77-0.tmp");
        fs::write(&path, b"").expect("writable");
        for _ in 0..2 {
            remove_if_there(&path).expect("removed, or not there");
        }
        assert_eq!(names(folder.path()), [""; 0]);
        assert!(remove_if_there(folder.path()).is_err());
    }

    #[test]
    fn a_path_without_a_file_name_is_refused() {
        for path in ["", "/", ".."] {
            assert!(write_atomically(Path::new(path), b"x").is_err(), "{path:?}");
        }
    }

    #[test]
    fn writers_at_once_leave_one_whole_file() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = &folder.path().join("plate.png");
        std::thread::scope(|scope| {
            for byte in 0..8_u8 {
                scope.spawn(move || write_atomically(path, &vec![byte; 100_000]));
            }
        });
        let bytes = fs::read(path).expect("written");
        assert_eq!(bytes.len(), 100_000);
        assert!(bytes.iter().all(|&byte| byte == bytes[0]));
        assert_eq!(names(folder.path()), ["plate.png"]);
    }
}
