//! The film: sums of light, metering, exposure, development.
//!
//! In: a [`Film`] of CIE XYZ in cd/m² (Y is luminance), or of three bands' radiance in W·m⁻²·sr⁻¹,
//! with optional layers of scene data. Out: linear Rec. 709, or the bands, after exposure
//! ([`develop`]). Pixels are row-major, top row first. File formats are in [`image`](crate::image).

mod develop;
mod left_out;
mod metering;
mod sums;

pub use develop::{Developed, Development, compress_gamut, develop, to_rgb8};
pub use left_out::{LeftOut, SILENT};
pub use metering::{WHITE_AT_ZERO_STOPS, auto_exposure, luminance_percentile};
pub use sums::{Channels, Film, Layers};
