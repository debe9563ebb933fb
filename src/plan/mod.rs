//! What each image calls for, from the shot alone: no meshes, no pixels.
//!
//! In: a [`Shot`](crate::shot::Shot) and a frame number. Out: the effects to simulate and why ([`Called`]), the
//! motions they follow from, and what a caption tells ([`Facts`]).

mod effects;
mod facts;
mod files;
mod key;
mod motion;
mod parts;
mod traced;
mod traces;

pub use effects::{Called, Reason, called};
pub use facts::{Facts, facts};
pub use files::Digests;
pub use key::{EPOCH, FrameKey, Keys, Picture};
pub use motion::{MotionError, celerity, worldline};
pub use traces::{Trace, Traces};
