//! A file in the making beside its place: whole when it gets its name, gone when it does not.
//!
//! Encoders write their last bytes as they are dropped, and pass over what then goes wrong. So it
//! is the draft that remembers whether every byte was taken, and only then is a file kept.

use crate::queue::explain;
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use tempfile::{Builder, NamedTempFile};

/// A file that has no name yet. Dropped, it is removed.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
    ink: Rc<RefCell<Ink>>,
}

/// What is written, and the first thing that went wrong with it.
#[derive(Debug)]
struct Ink {
    file: BufWriter<File>,
    /// Where the file will be, for messages.
    path: PathBuf,
    failed: Option<io::Error>,
}

/// To write a draft with.
#[derive(Debug)]
pub(super) struct Pen(Rc<RefCell<Ink>>);

impl Draft {
    /// A new file in `folder` that will be called `name`.
    pub(super) fn new(folder: &Path, name: &str) -> io::Result<Self> {
        let path = folder.join(name);
        let prefix = format!("{name}.");
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        #[cfg(unix)]
        {
            // As any new file has them.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let begin = || {
            let file = builder.tempfile_in(folder)?;
            let ink = Ink {
                file: BufWriter::new(file.as_file().try_clone()?),
                path: path.clone(),
                failed: None,
            };
            Ok((file, Rc::new(RefCell::new(ink))))
        };
        let (file, ink) = begin().map_err(|error| explain(&path, &error))?;
        Ok(Self { file, path, ink })
    }

    /// Where it is now.
    pub(super) fn now(&self) -> &Path {
        self.file.path()
    }

    /// To write it with; all that is written by any pen goes to one place.
    pub(super) fn pen(&self) -> Pen {
        Pen(Rc::clone(&self.ink))
    }

    /// Flushes it to the disk and gives it its name, in place of an older one; unless a byte of it
    /// could not be written.
    pub(super) fn keep(self) -> io::Result<PathBuf> {
        let Self { file, path, ink } = self;
        ink.borrow_mut().finish()?;
        let synced = file.as_file().sync_all();
        let persisted = synced.and_then(|()| Ok(file.persist(&path)?));
        persisted.map_err(|error| explain(&path, &error))?;
        if let Some(folder) = path.parent() {
            // That the name lasts is for the file system to promise, and some cannot.
            let _unpromised = File::open(folder).and_then(|folder| folder.sync_all());
        }
        Ok(path)
    }
}

impl Ink {
    fn finish(&mut self) -> io::Result<()> {
        match self.failed.take() {
            Some(error) => Err(error),
            None => {
                let flushed = self.file.flush();
                flushed.map_err(|error| explain(&self.path, &error))
            }
        }
    }

    /// Remembers the first failure, with what to do about it; its caller gets another of its kind.
    fn told<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        result.map_err(|error| {
            let error = explain(&self.path, &error);
            let again = io::Error::new(error.kind(), error.to_string());
            self.failed.get_or_insert(error);
            again
        })
    }
}

impl Write for Pen {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut ink = self.0.borrow_mut();
        let written = ink.file.write(bytes);
        ink.told(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let mut ink = self.0.borrow_mut();
        let flushed = ink.file.flush();
        ink.told(flushed)
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn a_draft_whose_last_bytes_were_lost_is_not_kept() {
        let folder = tempfile::tempdir().expect("scratch folder");
        let draft = Draft::new(folder.path(), "a.png").expect("writable");
        let full = File::options().write(true).open("/dev/full");
        draft.ink.borrow_mut().file = BufWriter::new(full.expect("of Linux"));
        // Fits the buffer: as with what encoders write when they are dropped, nobody is told.
        draft.pen().write_all(b"IEND").expect("buffered");
        let error = draft.keep().expect_err("the disk is full");
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        assert!(error.to_string().contains("free some space"), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).expect("there").count(), 0);

        let draft = Draft::new(folder.path(), "b.png").expect("writable");
        let full = File::options().write(true).open("/dev/full");
        draft.ink.borrow_mut().file = BufWriter::with_capacity(0, full.expect("of Linux"));
        let _passed_over = draft.pen().write_all(b"IEND");
        assert!(draft.keep().is_err());
    }
}
