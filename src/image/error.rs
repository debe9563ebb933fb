//! Why a picture cannot be put into a file.

/// Why a picture cannot be put into a file.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// A side is zero, or there are more pixels than this machine can count.
    #[error("a picture of {width} x {height} pixels cannot be held; both sides must be at least 1")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The data do not fill the picture, or overflow it.
    #[error("{what} has {found} values where {width} x {height} pixels need {expected}")]
    Length {
        /// Which of the data: a channel or layer.
        what: &'static str,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// How many values the picture needs.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// The PNG encoder refused.
    #[error("cannot encode the PNG: {0}")]
    Png(#[from] ::png::EncodingError),
    /// The OpenEXR encoder refused.
    #[error("cannot encode the EXR: {0}")]
    Exr(#[from] ::exr::error::Error),
}

/// How many values a picture has, with `channels` to a pixel.
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

/// Checks that `found` values of `what` fill a picture with `channels` to a pixel.
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
