//! The film: what the sensor gathered, and the pictures made from it.
//!
//! In: a [`Film`] of CIE XYZ in cd/m² (Y is luminance), or of three bands' radiance in W·m⁻²·sr⁻¹,
//! with optional layers of scene data. Out: linear Rec.709, or the bands, after exposure
//! ([`develop`]), PNG and OpenEXR files as bytes in memory ([`png::encode`], [`exr::encode`]), those
//! files' pixels again, whoever wrote them ([`decode`]), the
//! differences of two pictures ([`compare`]), and curves as drawings ([`plot`]).
//! Pixels are row-major, top row first. Invariant: equal input gives equal bytes, whatever the
//! number of threads; so no file holds a date, a host or a duration.

mod ciede2000;
pub mod compare;
pub mod decode;
mod develop;
mod expose;
pub mod exr;
pub mod imprint;
mod left_out;
mod metadata;
pub mod plot;
pub mod png;
pub mod raster;

pub use develop::{Developed, Development, develop};
pub use expose::{auto_exposure, luminance_percentile};
pub use left_out::{LeftOut, SILENT};
pub use metadata::{FINGERPRINT, Metadata, SOFTWARE, rational_rate};

/// A picture as the sensor gathered it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Film {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// What `xyz` holds.
    pub channels: Channels,
    /// CIE 1931 tristimulus values in cd/m², or the radiance of three bands in W·m⁻²·sr⁻¹, one for
    /// each pixel.
    pub xyz: Vec<[f32; 3]>,
    /// What else is known of each pixel.
    pub layers: Layers,
    /// What of its light was not followed in mirrors and glass.
    pub left_out: LeftOut,
}

/// What the three channels of a film hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Channels {
    /// CIE 1931 tristimulus values, cd/m².
    #[default]
    Xyz,
    /// Radiance in the long, middle and short third of the sensor's window, W·m⁻²·sr⁻¹; shown as
    /// red, green and blue.
    Bands,
}

/// Scene data beside the light, one value for each pixel, of the first surface that its centre
/// sees.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layers {
    /// Doppler factor ω_observed/ω_source, no unit. 0 where the background is seen.
    pub doppler: Option<Vec<f32>>,
    /// Lab length of the light path, m. 0 where the background is seen.
    pub distance: Option<Vec<f32>>,
    /// Lab time of the emission event, in metres of light travel. 0 where the background is seen.
    pub emission_time: Option<Vec<f32>>,
    /// Index of the worldline that carries the surface. −1 where the background is seen.
    pub worldline: Option<Vec<f32>>,
}

impl Layers {
    /// The layers that exist, with the names they have in files, in the order of those names.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &[f32])> {
        [
            ("distance", &self.distance),
            ("doppler", &self.doppler),
            ("emission_time", &self.emission_time),
            ("worldline", &self.worldline),
        ]
        .into_iter()
        .filter_map(|(name, layer)| layer.as_deref().map(|values| (name, values)))
    }
}

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
fn check_length(
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
