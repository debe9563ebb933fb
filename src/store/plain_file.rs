//! Opening files in folders to which others write too: a link is not followed out of the folder,
//! and a pipe is not waited for.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Opens the plain file at a path, creating it if the options say so. If it is exchanged for a link
/// at just this moment, that is noticed: the link may have been opened, but nothing is written.
///
/// # Errors
/// Of the kind `AlreadyExists` if something else is there; else as [`OpenOptions::open`].
pub(super) fn open_plain(path: &Path, options: &OpenOptions) -> io::Result<File> {
    refuse_others(path)?;
    let file = options.open(path)?;
    // A link may have been put there meanwhile.
    refuse_others(path)?;
    Ok(file)
}

/// Whether a folder exists, and is not a link.
pub(super) fn is_real_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|data| data.is_dir())
}

fn refuse_others(path: &Path) -> io::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(data) if data.is_dir() => Err(ErrorKind::IsADirectory.into()),
        Ok(data) if !data.is_file() => Err(io::Error::new(
            ErrorKind::AlreadyExists,
            "there is a link or a device, and no file",
        )),
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
