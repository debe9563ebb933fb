//! Why a study failed.

use crate::image::EncodeError;
use crate::image::compare::CompareError;
use crate::shot::Mistakes;

/// Reason why a study failed.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The shot has a mistake that shows in this frame.
    #[error("the shot has mistakes")]
    Mistakes(#[from] Mistakes),
    /// An image could not be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file could not be written.
    #[error("{0}")]
    Write(#[from] std::io::Error),
    /// A file that was written could not be read back.
    #[error("a picture just written cannot be read: {0}")]
    Read(#[from] image::ImageError),
    /// Two images could not be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
}
