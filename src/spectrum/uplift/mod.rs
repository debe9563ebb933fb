//! Uplift: from RGB to a smooth, bounded spectrum.
//!
//! S(λ) = ½ + x/(2√(1 + x²)), x a quadratic in λ (Jakob & Hanika 2019, A Low-Dimensional Function
//! Space for Efficient Spectral Upsampling), between 0 and 1 for every x. Under D65 it has the
//! given color: RGB is linear Rec. 709, and each channel is taken relative to that of S = 1, so
//! that white is exactly white although the table of D65 and its chromaticity, rounded to four
//! digits, differ by 1e-4. Grays are constant. Beyond 360 to 830 nm, where a color says nothing,
//! the curve is constant.

mod curve;
mod fit;
mod light;

pub use curve::{DARKEST, RGB_ERROR, Uplift};
pub use light::{ColoredLight, HUE_ERROR};
