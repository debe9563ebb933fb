//! Curves over wavelength: what a light emits, a surface reflects, a sensor adds up.
//!
//! Wavelengths are in nm, temperatures in K, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹, everything f64.
//! A curve is defined, finite and never negative at every wavelength above 0, since a Doppler shift
//! may bring any of them into view. The curves that the author wrote stand here as they were
//! written; how they are held for rendering is another matter.
//!
//! Of ours, only [`color`](crate::color) is imported.

mod band;
mod bound;
pub mod cardinal;
pub mod csv;
mod cubic;
mod curve;
mod daylight;
mod error;
mod fine;
pub mod illuminant;
mod lines;
mod log_grid;
mod luminous;
mod narrow_bound;
pub mod planck;
mod points;
pub mod quadrature;
mod roughness;
mod sampled;
mod sensor;
mod through;
mod tinted;
pub mod uplift;

pub use bound::GridBound;
pub use cardinal::Cardinal;
pub use cubic::catmull_rom;
pub use curve::Spectrum;
pub use error::{MAX_ROWS, MAX_VALUE, SpectrumError};
pub use fine::{Fine, FineSensor};
pub use illuminant::illuminant;
pub use lines::{LINES_NM, LineAxis, Lines};
pub use log_grid::{Baked, LogAxis, Shifted, Smoothing};
pub use luminous::luminous_integral;
pub use planck::PlanckShape;
pub use points::Beyond;
pub use quadrature::Quadrature;
pub use roughness::Roughness;
pub use sampled::Sampled;
pub use sensor::Sensor;
pub use through::{Responses, Sparse};
pub use tinted::Tinted;
pub use uplift::{ColoredLight, Uplift};
