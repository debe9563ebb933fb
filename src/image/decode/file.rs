//! The file of a frame, opened and read up to the size that such a frame can need, and its faults.

use ::exr::error::Error as ExrError;
use ::png::DecodingError;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Bytes that a file may have besides its pixels; the shot's text is at most 4 MiB of it.
pub(in crate::image) const MOST_METADATA: u64 = 16 << 20;

/// Largest number of channels: three colors and four layers.
pub(super) const MOST_CHANNELS: usize = 7;

/// Largest number of bytes per pixel: channels of 32 bits, and as much again for data that do not
/// compress.
const MOST_PIXEL: u64 = 2 * 4 * MOST_CHANNELS as u64;

/// Opens a regular file for reading. Anything else is refused: a pipe would wait for a writer
/// forever, and a device may never end.
///
/// # Errors
/// Those of the system, and anything that is not a regular file.
pub fn open(path: &Path) -> io::Result<File> {
    if !fs::metadata(path)?.is_file() {
        let why = "it is no regular file; move it away";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    File::open(path)
}

/// The bytes of a file, unless there are more than an image of this size can need.
///
/// # Errors
/// A file that is missing, empty, too long or unreadable.
pub fn read_bytes(path: &Path, size: [u32; 2]) -> Result<Vec<u8>, Fault> {
    let most = u64::from(size[0]) * u64::from(size[1]) * MOST_PIXEL + MOST_METADATA;
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => Fault::Missing,
        _ => Fault::Unreadable(error.to_string()),
    };
    let file = open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    match bytes.len() as u64 {
        0 => Err(Fault::Empty),
        length if length > most => Err(Fault::Damaged(format!(
            "it has more than {most} bytes, and no {} can need so many",
            pixels(size.map(|side| side as usize))
        ))),
        _ => Ok(bytes),
    }
}

/// A fault of a file. Messages continue "FILE: ".
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// The file does not exist.
    #[error("missing")]
    Missing,
    /// The file has no bytes.
    #[error("empty: it has no bytes")]
    Empty,
    /// The file ends too early.
    #[error("truncated: it ends before the picture does")]
    Truncated,
    /// The content is not an image of ours.
    #[error("damaged: {0}")]
    Damaged(String),
    /// The image has another size.
    #[error("wrong size: {}, not {}", pixels(*found), pixels(*expected))]
    Size {
        /// Width and height, pixels.
        found: [usize; 2],
        /// Expected width and height, pixels.
        expected: [usize; 2],
    },
    /// The system cannot read the file.
    #[error("unreadable: {0}")]
    Unreadable(String),
}

/// A size in words.
pub(super) fn pixels([width, height]: [usize; 2]) -> String {
    format!("{width} x {height} pixels")
}

pub(super) fn png_fault(error: DecodingError) -> Fault {
    match error {
        DecodingError::IoError(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
            Fault::Truncated
        }
        error => Fault::Damaged(plain(&error.to_string())),
    }
}

pub(super) fn exr_fault(error: ExrError) -> Fault {
    let text = error.to_string();
    // The decoder's words for an early end of file.
    if text.contains("reference to missing bytes") {
        return Fault::Truncated;
    }
    Fault::Damaged(plain(&text))
}

/// A decoder's message on one line.
pub(super) fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

pub(super) fn check_size(found: [usize; 2], expected: [u32; 2]) -> Result<(), Fault> {
    let expected = expected.map(|side| side as usize);
    if found == expected {
        return Ok(());
    }
    Err(Fault::Size { found, expected })
}
