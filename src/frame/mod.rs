//! The shot at one frame, evaluated once.
//!
//! In: a [`Shot`](crate::shot::Shot) and the number of a frame. Out: a [`Frame`], in which every track
//! is a number and every name of a worldline or spectrum is resolved; the effects that it calls for
//! and why ([`ActiveEffects`]); its caption; the fingerprint by which a finished image is known to be
//! up to date ([`FrameFingerprint`]); and the key of the shade trees that it shares with other frames
//! ([`TraceKey`]). No mesh, no pixel: of files only their hashes are known ([`Digests`]).

mod at;
mod camera;
mod caption;
mod digests;
mod effects;
mod fingerprint;
mod hasher;
mod light;
mod material;
mod model;
mod settings;
mod shifted_rgb;
mod spectrum;
mod trace_key;
mod trace_sections;
mod values;
mod worldline;

pub use camera::{Aim, Camera};
pub use caption::Caption;
pub use digests::Digests;
pub use effects::{ActiveEffects, Reason};
pub use fingerprint::{EPOCH, Fingerprints, FrameFingerprint};
pub use light::{Amount, Background, Light};
pub use material::{Highlight, Material, Refraction, Term, Thermal};
pub use model::{Array, Model};
pub use settings::{Resolution, Sensor, Splice};
pub use shifted_rgb::refuse_shifted_rgb;
pub use spectrum::Spectrum;
pub use trace_key::{TraceKey, TraceKeys};
pub use values::{Frame, Frames};
pub use worldline::Worldline;
