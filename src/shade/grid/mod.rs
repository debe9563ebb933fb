//! `accuracy.spectra = "grid"` and `"spline"`: light over the sensor's wavelengths.
//!
//! In: a tree and the scene's curves. Out: the sensor's channels (`channels`), or the spectral
//! radiance itself (`wavelengths`). The two modes differ in their curves alone: a grid's are baked
//! on the sensor's axis, and have tables.

mod bound;
mod channels;
mod lamps;
mod meeting;
mod throughput;
mod unresolved;

pub(super) use throughput::Throughputs;
pub use unresolved::{Unresolved, unresolved};
