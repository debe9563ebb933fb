//! Files that are either complete or absent, however the run ends.
//!
//! A temporary file in the same folder, `NAME.restframe-XXXXXX.tmp`, is written, flushed and
//! renamed to its target; then the folder is flushed. If dropped before that, it is removed. A
//! killed run can leave the temporary file but never an incomplete target; [`sweep`](super::sweep)
//! removes such files.

use super::names::MARK;
use super::write_error::{explain, folder_of};
use std::cell::RefCell;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use tempfile::{Builder, NamedTempFile};

/// Writes `bytes` to `path` so that a reader sees either the old file or the new one, even after a
/// power failure. The file gets the permissions of any newly created one.
///
/// # Errors
/// Of the kind that the system reported, with the path and a remedy. Unless the last step failed,
/// the flushing of the folder, an old file is unchanged then. No temporary file is left.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let file = AtomicFile::create(path)?;
    file.writer().write_all(bytes)?;
    file.keep().map(|_| ())
}

/// Whether files can be created in the folder of `path`, found out by creating one beside it.
///
/// # Errors
/// As [`write_atomically`].
pub(crate) fn check_writable(path: &Path) -> io::Result<()> {
    AtomicFile::create(path).map(|_| ())
}

/// A temporary file beside its target, renamed to it when complete and removed when dropped.
///
/// Encoders write their last bytes as they are dropped, and ignore errors then; so the file
/// remembers the first failure of all its writers, and is not renamed after one.
#[derive(Debug)]
pub struct AtomicFile {
    file: NamedTempFile,
    target: PathBuf,
    buffer: Rc<RefCell<Buffer>>,
}

/// Bytes on their way to the disk, and the first failure of writing them.
#[derive(Debug)]
struct Buffer {
    file: BufWriter<File>,
    /// The target, for messages.
    target: PathBuf,
    failed: Option<io::Error>,
}

/// A writer to an [`AtomicFile`]; all writers of one file share its position.
#[derive(Debug)]
pub struct AtomicWriter(Rc<RefCell<Buffer>>);

impl AtomicFile {
    /// A temporary file that will replace `target`.
    ///
    /// # Errors
    /// A folder in which no file can be made, with the target and a remedy.
    pub fn create(target: &Path) -> io::Result<Self> {
        let begin = || {
            let file = temporary(target)?;
            let buffer = Buffer {
                file: BufWriter::new(file.as_file().try_clone()?),
                target: target.to_owned(),
                failed: None,
            };
            Ok((file, Rc::new(RefCell::new(buffer))))
        };
        let (file, buffer) = begin().map_err(|error| explain(target, &error))?;
        Ok(Self {
            file,
            target: target.to_owned(),
            buffer,
        })
    }

    /// Path of the temporary file.
    pub fn temporary(&self) -> &Path {
        self.file.path()
    }

    /// A writer to the file.
    pub fn writer(&self) -> AtomicWriter {
        AtomicWriter(Rc::clone(&self.buffer))
    }

    /// Flushes the file to the disk and renames it to its target, replacing an older one. Returns
    /// the target.
    ///
    /// # Errors
    /// If any byte could not be written, or the file not be renamed; nothing is left then.
    pub fn keep(self) -> io::Result<PathBuf> {
        let Self {
            file,
            target,
            buffer,
        } = self;
        buffer.borrow_mut().finish()?;
        let persist = || {
            file.as_file().sync_all()?;
            file.persist(&target)?;
            sync_folder(folder_of(&target))
        };
        persist().map_err(|error| explain(&target, &error))?;
        Ok(target)
    }
}

/// A new file in the folder of `target`, under a unique name: another machine may be writing there,
/// and a process killed earlier may have left its own.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let mut prefix = target
        .file_name()
        .ok_or(ErrorKind::InvalidFilename)?
        .to_owned();
    prefix.push(".");
    prefix.push(MARK);
    // With the permissions of any new file, unlike those of `tempfile_in`.
    let create = |path: &Path| OpenOptions::new().write(true).create_new(true).open(path);
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    builder.make_in(folder_of(target), create)
}

impl Buffer {
    fn finish(&mut self) -> io::Result<()> {
        match self.failed.take() {
            Some(error) => Err(error),
            None => {
                let flushed = self.file.flush();
                flushed.map_err(|error| explain(&self.target, &error))
            }
        }
    }

    /// Remembers the first failure, with a remedy; the caller gets a copy.
    fn remember<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        result.map_err(|error| {
            let error = explain(&self.target, &error);
            let copy = io::Error::new(error.kind(), error.to_string());
            self.failed.get_or_insert(error);
            copy
        })
    }
}

impl Write for AtomicWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut buffer = self.0.borrow_mut();
        let written = buffer.file.write(bytes);
        buffer.remember(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let mut buffer = self.0.borrow_mut();
        let flushed = buffer.file.flush();
        buffer.remember(flushed)
    }
}

/// Makes the renaming durable. Some network file systems cannot do this and report it, which is not
/// a failure.
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

/// On other systems a folder cannot be opened as a file.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

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

    /// A folder that another process sweeps meanwhile does not seem unwritable.
    #[test]
    fn what_another_process_has_swept_is_removed_as_well() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let path = folder.path().join("plate.0001.png");
        let swept = || {
            let file = AtomicFile::create(&path).expect("writable");
            fs::remove_file(file.temporary()).expect("there");
            file
        };
        drop(swept());
        check_writable(&path).expect("writable");
        // To be written once more: the frame's claim should have kept the sweeper away.
        let error = swept().keep().expect_err("there is nothing to rename");
        assert_eq!(error.kind(), ErrorKind::NotFound);
        assert_eq!(names(folder.path()), [""; 0]);
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

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_whose_last_bytes_were_lost_is_not_kept() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let file = AtomicFile::create(&folder.path().join("a.png")).expect("writable");
        let full = File::options().write(true).open("/dev/full");
        file.buffer.borrow_mut().file = BufWriter::new(full.expect("of Linux"));
        // Fits the buffer: as with what encoders write when they are dropped, nobody is told.
        file.writer().write_all(b"IEND").expect("buffered");
        let error = file.keep().expect_err("the disk is full");
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        assert!(error.to_string().contains("free some space"), "{error}");
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);

        let file = AtomicFile::create(&folder.path().join("b.png")).expect("writable");
        let full = File::options().write(true).open("/dev/full");
        file.buffer.borrow_mut().file = BufWriter::with_capacity(0, full.expect("of Linux"));
        let _passed_over = file.writer().write_all(b"IEND");
        assert!(file.keep().is_err());
    }
}
