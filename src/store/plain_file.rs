//! Opening files in folders that strangers may write to: links are not followed out of the folder, and
//! pipes are not waited for.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Opens the plain file at a path, or makes it, if the options say so. A link that replaces the file at
/// this moment may be opened, but is then detected before anything is written.
///
/// # Errors
/// Of the kind `AlreadyExists`, if something else is there; else as [`OpenOptions::open`].
pub(super) fn open_plain(path: &Path, options: &OpenOptions) -> io::Result<File> {
    refuse_others(path)?;
    let file = options.open(path)?;
    // A link that was put there meanwhile.
    refuse_others(path)?;
    Ok(file)
}

/// Whether a folder is there, and not by a link.
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
