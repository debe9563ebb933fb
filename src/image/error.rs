//! Errors of encoding an image.

/// Reason why an image cannot be encoded.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// A side is zero, or the number of pixels overflows.
    #[error("a picture of {width} x {height} pixels cannot be held; both sides must be at least 1")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The data are too few or too many for the image.
    #[error("{what} has {found} values where {width} x {height} pixels need {expected}")]
    Length {
        /// Name of the data: a channel or layer.
        what: &'static str,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Number of values that the image needs.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// Error of the PNG encoder.
    #[error("cannot encode the PNG: {0}")]
    Png(#[from] ::png::EncodingError),
    /// Error of the OpenEXR encoder.
    #[error("cannot encode the EXR: {0}")]
    Exr(#[from] ::exr::error::Error),
}

/// Number of values of an image with `channels` per pixel.
///
/// # Errors
/// [`EncodeError::Size`] if a side is zero or the product overflows.
pub fn value_count(width: u32, height: u32, channels: usize) -> Result<usize, EncodeError> {
    let pixels = (width as usize).checked_mul(height as usize);
    match pixels.and_then(|pixels| pixels.checked_mul(channels)) {
        Some(count) if count > 0 => Ok(count),
        _ => Err(EncodeError::Size { width, height }),
    }
}

/// Checks that `found` values of `what` fill an image with `channels` per pixel.
pub(super) fn check_length(
    what: &'static str,
    (width, height): (u32, u32),
    channels: usize,
    found: usize,
) -> Result<(), EncodeError> {
    let expected = value_count(width, height, channels)?;
    if found == expected {
        return Ok(());
    }
    Err(EncodeError::Length {
        what,
        width,
        height,
        expected,
        found,
    })
}
