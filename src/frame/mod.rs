//! What each image calls for, from the shot alone: no meshes, no pixels.
//!
//! In: a [`Shot`](crate::shot::Shot) and a frame number. Out: the effects to simulate and why
//! ([`ActiveEffects`]), the motions they follow from, what a caption tells ([`Facts`]), the
//! fingerprint by which a finished image is known to be up to date ([`FrameFingerprint`]), and the
//! key of the shade trees that it shares with other frames ([`TraceKey`]).

mod caption;
mod digests;
mod effects;
mod fingerprint;
mod fingerprint_inputs;
mod motion;
mod trace_key;
mod trace_keys;

pub use caption::{Facts, facts};
pub use digests::Digests;
pub use effects::{ActiveEffects, Reason, active_effects};
pub use fingerprint::{EPOCH, Fingerprints, FrameFingerprint, Resolution};
pub use motion::{MotionError, celerity, worldline};
pub use trace_keys::{TraceKey, TraceKeys};
