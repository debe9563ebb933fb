//! `accuracy.spectra = "lines"` and `"rgb"`: ways of holding spectra that others are compared with.
//!
//! In: a tree and a scene's spectra as coefficients that multiply one by one (`coefficients`): samples
//! at equal distances in wavelength (`lines`), or three numbers (`rgb`). Out: the sensor's channels.

mod coefficients;
mod lines;
mod rgb;

pub(super) use coefficients::Shading;
pub(super) use lines::LineShader;
pub(super) use rgb::RgbShader;
