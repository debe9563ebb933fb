//! What is wrong with a file, in words.

use ::exr::error::Error as ExrError;
use ::png::DecodingError;
use std::io;

/// What is wrong with a file. Messages continue "FILE: ".
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// It is not there.
    #[error("missing")]
    Missing,
    /// It has no bytes.
    #[error("empty: it has no bytes")]
    Empty,
    /// It ends too early.
    #[error("truncated: it ends before the picture does")]
    Truncated,
    /// What it holds is no picture of ours.
    #[error("damaged: {0}")]
    Damaged(String),
    /// Another size.
    #[error("wrong size: {}, not {}", pixels(*found), pixels(*expected))]
    Size {
        /// Pixels in a row, and rows.
        found: [usize; 2],
        /// What they should be.
        expected: [usize; 2],
    },
    /// The system cannot read it.
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
    // The decoder's words for an end of file.
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
