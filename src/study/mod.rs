//! Accuracy against time: one image rendered at many settings, one knob at a time, by the same
//! [`render`](crate::render) as every image.
//!
//! In: a shot without mistakes. Out: a [`Study`]. The other knobs keep the values of the shot, both
//! in a setting and in its reference, so that an error is that of the knob alone. Bodies and their
//! trees are built before timing, as for all frames of a sequence but the first. If the shot's
//! spectra are exact, other knobs and effects are studied with the grid.

mod compare_1990;
pub mod displacement;
mod effects;
mod errors;
mod interleaved_timing;
mod knobs;
mod ranking;
pub mod report;
pub mod results;
pub mod spheres;
mod start;
mod sweep;
mod timed_render;
mod whole;

pub use results::Study;
pub use start::{Request, default_frame, default_size};
pub use timed_render::StudyError;
pub use whole::study;
