//! Faults of a file.

use ::exr::error::Error as ExrError;
use ::png::DecodingError;
use std::io;

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
