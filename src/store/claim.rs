//! Claims: the right of one of several processes to work on a frame.
//!
//! A claim is a lock on a file in `.STEM.locks`. The lock belongs to the open file and so ends with
//! its process, however that ends. To give a claim up, a process removes the file while it is still
//! locked; another that then gets the lock on the removed file sees that it is no longer at its
//! path, and opens the new one. If the file system does not support locks, nothing is claimed, and
//! two processes may do the same work twice; their files are complete all the same.
//!
//! Links are refused: dropping a claim removes files, and none outside the shot's folder may go.

use super::names::{Names, SEQUENCE, is_number};
use super::plain_file::{is_real_folder, open_plain};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The right to work on a frame, or on a sequence, until it is dropped.
#[derive(Debug)]
pub struct Claim(Option<Held>);

#[derive(Debug)]
struct Held {
    // Locked as long as it is open.
    file: File,
    path: PathBuf,
}

impl Claim {
    /// Claims frame number `frame` of a folder; None if another process has it.
    ///
    /// # Errors
    /// If the lock's file cannot be created.
    pub fn frame(folder: &Path, names: &Names, frame: u32) -> io::Result<Option<Self>> {
        Self::take(folder, names, &names.number(frame))
    }

    /// Claims by name: a frame number, or [`SEQUENCE`](super::SEQUENCE). None if another process
    /// has it.
    ///
    /// # Errors
    /// If the lock's file cannot be created.
    pub fn take(folder: &Path, names: &Names, what: &str) -> io::Result<Option<Self>> {
        let path = folder.join(names.locks()).join(what);
        let explain = |error: io::Error| {
            let path = path.display();
            let message = format!("cannot lock {path}: {error}; remove it, or name another folder");
            io::Error::new(error.kind(), message)
        };
        refuse_link(&folder.join(names.locks()))?;
        loop {
            let file = open(&path).map_err(explain)?;
            match file.try_lock() {
                Ok(()) if stands_at(&file, &path) => {
                    return Ok(Some(Self(Some(Held { file, path }))));
                }
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) if knows_no_locks(&error) => {
                    remove(&path);
                    return Ok(Some(Self(None)));
                }
                Err(TryLockError::Error(error)) => return Err(explain(error)),
            }
        }
    }

    /// The claim on a frame in memory, which no other process can know of.
    pub fn none() -> Self {
        Self(None)
    }

    /// Whether the file system supports locks, so that no other process can have this claim.
    pub fn is_exclusive(&self) -> bool {
        self.0.is_some()
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        remove(&self.path);
        let _ = self.file.unlock();
    }
}

/// Removes the file of a lock, and the folder after the last one.
fn remove(path: &Path) {
    // Another machine may have removed it; the lock itself ends with the file.
    let _ = fs::remove_file(path);
    if let Some(folder) = path.parent() {
        // Succeeds for the last claim only.
        let _ = fs::remove_dir(folder);
    }
}

/// Whether locking failed because the file system does not support locks or, on a network, because
/// no server keeps them.
pub(super) fn knows_no_locks(error: &io::Error) -> bool {
    /// ENOLCK, which has no [`ErrorKind`].
    const NO_LOCKS: Option<i32> = if cfg!(any(target_os = "linux", target_os = "android")) {
        Some(37)
    } else if cfg!(unix) {
        // The BSDs and macOS.
        Some(77)
    } else {
        None
    };
    let number = error.raw_os_error();
    error.kind() == ErrorKind::Unsupported || number.is_some() && number == NO_LOCKS
}

/// Refuses a folder of locks that is a link to elsewhere.
pub(crate) fn refuse_link(locks: &Path) -> io::Result<()> {
    match fs::symlink_metadata(locks) {
        Ok(data) if !data.is_dir() => Err(io::Error::new(
            ErrorKind::NotADirectory,
            format!("{} is no folder; remove it", locks.display()),
        )),
        _ => Ok(()),
    }
}

/// Opens a lock's file, creating it and its folder if needed; another process may be removing the
/// folder with its last claim.
fn open(path: &Path) -> io::Result<File> {
    const ATTEMPTS: usize = 1000;
    let mut options = OpenOptions::new();
    options.write(true).create(true).truncate(false);
    for _ in 0..ATTEMPTS {
        match open_plain(path, &options) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
            }
            result => return result,
        }
    }
    open_plain(path, &options)
}

/// Whether an open file is still the one at its path.
#[cfg(unix)]
fn stands_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |data: fs::Metadata| (data.dev(), data.ino());
    match (file.metadata(), fs::symlink_metadata(path)) {
        (Ok(open), Ok(there)) => identity(open) == identity(there),
        _ => false,
    }
}

/// On other systems an open file keeps its name, or loses it at once.
#[cfg(not(unix))]
fn stands_at(_: &File, path: &Path) -> bool {
    path.exists()
}

/// Removes leftovers of killed runs in a folder: incomplete files, and their locks. Files of
/// running processes are left alone. Failures are ignored, since leftovers do no harm.
pub fn sweep(folder: &Path, names: &Names) {
    for name in file_names(folder) {
        let Some(what) = names.claim_of_temporary(&name) else {
            continue;
        };
        if let Ok(Some(claim)) = Claim::take(folder, names, &what)
            && claim.is_exclusive()
        {
            let _ = fs::remove_file(folder.join(name));
        }
    }
    let locks = folder.join(names.locks());
    if !is_real_folder(&locks) {
        return;
    }
    for what in file_names(&locks) {
        if is_number(&what) || what == SEQUENCE {
            drop(Claim::take(folder, names, &what));
        }
    }
}

fn file_names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::load;

    fn names() -> Names {
        let shot = Path::new(env!("CARGO_MANIFEST_DIR")).join("shots/rows.toml");
        Names::new(&load(&shot).expect("a sound shot"))
    }

    #[test]
    fn a_claim_is_one_processs_until_it_is_dropped_and_leaves_nothing() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let take = |frame| Claim::frame(folder.path(), &names(), frame).expect("lockable");
        let first = take(7);
        assert!(first.is_some());
        assert!(take(7).is_none());
        assert!(take(8).is_some());
        drop(first);
        assert!(take(7).is_some());
        assert_eq!(file_names(folder.path()), [""; 0]);
    }

    #[cfg(unix)]
    #[test]
    fn no_link_is_followed_to_files_elsewhere() {
        use std::os::unix::fs::symlink;
        let [folder, victim] = [0, 1].map(|_| tempfile::tempdir().expect("scratch folder"));
        for name in ["0001", "sequence", "letter"] {
            fs::write(victim.path().join(name), b"dear").expect("writable");
        }
        let locks = folder.path().join(names().locks());
        symlink(victim.path(), &locks).expect("linkable");
        sweep(folder.path(), &names());
        let refused = Claim::frame(folder.path(), &names(), 1).expect_err("a link");
        assert!(refused.to_string().contains("is no folder"), "{refused}");
        assert_eq!(file_names(victim.path()).len(), 3);
        fs::remove_file(&locks).expect("there");
        fs::create_dir(&locks).expect("writable");
        symlink(victim.path().join("0001"), locks.join("0001")).expect("linkable");
        symlink(victim.path().join("new"), locks.join("0002")).expect("linkable");
        for frame in [1, 2] {
            let refused = Claim::frame(folder.path(), &names(), frame).expect_err("a link");
            assert!(refused.to_string().contains("remove it"), "{refused}");
        }
        assert_eq!(file_names(victim.path()).len(), 3);
    }

    #[test]
    fn of_the_locks_folder_only_locks_are_swept() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let locks = folder.path().join(names().locks());
        fs::create_dir(&locks).expect("writable");
        for name in ["0001", "12345", "sequence", "letter", "001"] {
            fs::write(locks.join(name), b"").expect("writable");
        }
        sweep(folder.path(), &names());
        let mut left = file_names(&locks);
        left.sort();
        assert_eq!(left, ["001", "letter"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_network_without_a_keeper_of_locks_knows_no_locks() {
        // errno(3): ENOLCK, EOPNOTSUPP, EACCES.
        for (number, none) in [(37, true), (95, true), (13, false)] {
            let error = io::Error::from_raw_os_error(number);
            assert_eq!(knows_no_locks(&error), none, "{error}");
        }
    }

    /// The unlink race: without the look at the path two threads come to hold one claim.
    #[test]
    fn of_many_who_claim_and_give_up_at_once_one_holds_at_any_time() {
        use std::sync::atomic::{AtomicU32, Ordering};
        let folder = tempfile::tempdir().expect("scratch folder");
        let (holders, turns) = (AtomicU32::new(0), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..6 {
                scope.spawn(|| {
                    for _ in 0..300 {
                        let claim = Claim::frame(folder.path(), &names(), 1).expect("lockable");
                        if claim.is_some() {
                            assert_eq!(holders.fetch_add(1, Ordering::SeqCst), 0);
                            std::thread::yield_now();
                            holders.fetch_sub(1, Ordering::SeqCst);
                            turns.fetch_add(1, Ordering::SeqCst);
                        }
                    }
                });
            }
        });
        assert!(turns.into_inner() > 0);
    }

    #[test]
    fn what_is_being_written_is_swept_once_its_writer_is_gone() {
        use super::super::AtomicFile;
        let folder = tempfile::tempdir().expect("scratch folder");
        for target in ["rows.0001.png", "rows.sheet.png", "index.html"] {
            let file = AtomicFile::create(&folder.path().join(target)).expect("writable");
            // As if the process were killed here.
            std::mem::forget(file);
        }
        assert_eq!(file_names(folder.path()).len(), 3);
        sweep(folder.path(), &names());
        assert_eq!(file_names(folder.path()), [""; 0]);
    }

    #[test]
    fn sweeping_takes_what_nobody_works_on_and_nothing_else() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let names = names();
        let swept = [
            "rows.0001.png.restframe-aaaaa0.tmp",
            "rows.gif.restframe-aB3xY9.tmp",
            "rows.av1.mp4.restframe-aB3xY9.tmp",
            "index.html.restframe-aaaaa3.tmp",
            // By earlier versions.
            "rows.0001.png.77-0.tmp",
            "rows.0004.exr.77-12.tmp",
            "index.html.77-3.tmp",
            "rows.gif.aB3xY9.tmp",
        ];
        let kept = [
            "index.html.backup.tmp",
            "other.0001.png.restframe-aaaaa4.tmp",
            "rows.0001.png.backup.tmp",
            "rows.0002.png.77-1.tmp",
            "rows.0002.png.restframe-aaaaa1.tmp",
            "rows.0003.png",
            "rows.0003.png.restframe-copy.tmp",
            "rows.0003.tmp",
            "rows.gif.old.tmp",
            "rows.notes.restframe-aB3xY9.tmp",
            "rows.notes.tmp",
        ];
        for name in swept.iter().chain(&kept) {
            fs::write(folder.path().join(name), b"x").expect("writable");
        }
        let held = Claim::frame(folder.path(), &names, 2).expect("lockable");
        sweep(folder.path(), &names);
        drop(held);
        let mut left = file_names(folder.path());
        left.sort();
        assert_eq!(left, kept);
    }
}
