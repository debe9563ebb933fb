//! A file in the making beside its place: whole when it gets its name, gone when it does not.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// A file that has no name yet. Dropped, it is removed.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
}

impl Draft {
    /// A new file in `folder` that will be called `name`.
    pub(super) fn new(folder: &Path, name: &str) -> io::Result<Self> {
        let prefix = format!("{name}.");
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        #[cfg(unix)]
        {
            // As any new file has them.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        Ok(Self {
            file: builder.tempfile_in(folder)?,
            path: folder.join(name),
        })
    }

    /// Where it is now.
    pub(super) fn now(&self) -> &Path {
        self.file.path()
    }

    /// To write it with.
    pub(super) fn writer(&self) -> io::Result<BufWriter<File>> {
        Ok(BufWriter::new(self.file.as_file().try_clone()?))
    }

    /// Flushes it to the disk and gives it its name, in place of an older one.
    pub(super) fn keep(self) -> io::Result<PathBuf> {
        self.file.as_file().sync_all()?;
        self.file.persist(&self.path)?;
        if let Some(folder) = self.path.parent() {
            // That the name lasts is for the file system to promise, and some cannot.
            let _unpromised = File::open(folder).and_then(|folder| folder.sync_all());
        }
        Ok(self.path)
    }
}
