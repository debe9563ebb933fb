//! Shade trees to light: spectral radiance along a ray, and three channels for the film. Channels
//! are XYZ; fields and functions named `xyz` hold band totals when `sensor.color = "bands"`.
//!
//! In: [`ShadeTrees`](crate::trace::ShadeTrees) and the spectra of the scene. Out: what the camera
//! receives along each ray. [`received`] is the only place where a Doppler factor meets a spectrum.
//!
//! `walk` visits the nodes of a tree, with the surfaces that pass their light on, their lamps and
//! the weights of their lobes. What it hands over is the same in all modes of `accuracy.spectra`,
//! each of which makes light of it in its own way:
//!
//! - `grid/`: "grid" and "spline". Curves at the sensor's wavelengths, multiplied one by one. A grid
//!   takes a short cut where one shift serves light and material together, as for a lamp that moves
//!   with the body it lights: the channels are then a function of ln D alone, tabulated in advance.
//! - `exact`: "exact". One integral over wavelength for a ray, by adaptive quadrature.
//! - `compare/`: "lines" and "rgb", for comparison: samples at equal distances, resampled at every
//!   shift, and three numbers, which cannot be shifted.
//!
//! `curves` holds the spectra of the first three: each a `curve`, of `material`s and lamps made by
//! `bake`, of thermal light (`thermal`) and of the `sky`; `narrow` if it is narrower than the
//! wavelengths are apart.

mod bake;
mod compare;
mod curve;
mod curves;
mod exact;
mod grid;
mod integrand;
mod material;
mod narrow;
mod radiance;
pub mod received;
mod scratch;
mod settings;
mod shader;
mod sky;
mod table;
mod thermal;
mod walk;

pub use grid::{Unresolved, unresolved};
pub use radiance::Radiance;
pub use scratch::ShadeScratch;
pub use settings::Settings;
pub use shader::Shader;
