//! Shade trees to light: spectral radiance for whoever wants the curve, three channels for the film:
//! XYZ, or under `sensor.color = "bands"` the totals of three bands, which what is named after XYZ
//! holds then.
//!
//! In: [`ShadeTrees`](crate::trace::ShadeTrees) and the spectra of the scene. Out: what the camera
//! receives along each ray. [`received`] is the only place where a Doppler factor meets a spectrum.
//!
//! XYZ takes a short cut where one shift serves light and material together, a lamp that moves
//! with the body it lights: their product's XYZ is then a function of ln D alone, tabulated when
//! the image is prepared. Elsewhere, with `accuracy.spectra = "spline"` and for the curve itself,
//! each spectrum is read at all wavelengths under its own shift; with "exact", at as many as
//! adaptive quadrature asks for.
//!
//! Two ways of holding spectra stand beside for comparison: lines at equal distances, resampled at
//! every shift, and three numbers, which cannot be shifted.

mod bake;
mod bound;
mod components;
mod curve;
mod curves;
mod exact;
mod lamps;
mod lines;
mod narrow;
mod passage;
mod radiance;
pub mod received;
mod rgb;
mod shader;
mod sky;
mod table;
mod thermal;
mod unresolved;

pub use bake::Settings;
pub use radiance::Radiance;
pub use shader::{ShadeScratch, Shader};
pub use unresolved::{Unresolved, unresolved};
