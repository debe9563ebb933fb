//! What each image calls for, from the shot alone: no meshes, no pixels.
//!
//! In: a [`Shot`](crate::shot::Shot) and a frame number. Out: the effects to simulate and why ([`Called`]), and the
//! motions they follow from.

mod effects;
mod files;
mod key;
mod motion;
mod parts;
mod traced;

pub use effects::{Called, Reason, called};
pub use files::Digests;
pub use key::{EPOCH, FrameKey, Keys, Picture};
pub use motion::{MotionError, celerity, worldline};
