//! Curves over wavelength: emission of lamps, reflectance of surfaces, sensitivity of sensors.
//!
//! In: numbers from authors, tables and files. Out: curves ([`Spectrum`]), and three forms of them
//! for rendering: baked on a grid in ln λ ([`Baked`]), fine ([`Fine`]), and lines ([`Lines`]).
//! Wavelengths are in nm, temperatures in K, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹, everything f64.
//! A curve is defined, finite and never negative at every wavelength above 0, since a Doppler shift
//! may bring any of them into view. Only [`color`](crate::color) is imported.
//!
//! # Example
//! The luminance of a black body of 6500 K, from 84 wavelengths, against the CIE's sum at 1 nm.
//! ```
//! use restframe::color::cie::xyz_of;
//! use restframe::spectrum::{LogAxis, Sensor, planck::radiance};
//!
//! let axis = LogAxis::new([360.0, 830.0], 84);
//! let seen: Vec<f64> = axis.wavelengths_nm().iter().map(|nm| radiance(*nm, 6500.0)).collect();
//! let [_, luminance, _] = Sensor::cie1931(axis).xyz(&seen);
//! let [_, exact, _] = xyz_of(|nm| radiance(nm, 6500.0));
//! assert!((luminance / exact - 1.0).abs() < 1e-4);
//! ```

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
