//! A spectrum for a color: RGB to a smooth, bounded curve.
//!
//! S(λ) = ½ + x/(2√(1 + x²)), x a quadratic in λ (Jakob and Hanika 2019, A Low-Dimensional Function
//! Space for Efficient Spectral Upsampling), between 0 and 1 whatever x. Under D65 it has
//! the color that was asked for: RGB is linear Rec. 709, and each channel is taken relative to that
//! of S = 1, so that white is exactly white although the table of D65 and its chromaticity, rounded
//! to four digits, differ by 1e-4. Greys are constant. Between 360 and 830 nm the curve is the
//! color's; beyond, where no color says what it is, the end's value goes on.

mod curve;
mod fit;
mod light;
mod sigmoid;

pub use curve::{DARKEST, RGB_ERROR, Uplift};
pub use light::{ColoredLight, HUE_ERROR};
