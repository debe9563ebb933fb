//! What each image calls for, from the shot alone: no meshes, no pixels.
//!
//! In: a [`Shot`](crate::shot::Shot) and a frame number. Out: the effects to simulate and why ([`Called`]), and the
//! motions they follow from.

mod effects;
mod motion;

pub use effects::{Called, Reason, called};
pub use motion::{MotionError, celerity, worldline};
