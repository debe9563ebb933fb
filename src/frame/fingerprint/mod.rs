//! Fingerprints, by which finished frames are known to be up to date.
//!
//! In: a shot, the hashes of its files, and a resolution. Out: for each frame a hash of every value
//! that may reach its pixels, and these values by the keys that their author would change.

mod appearance;
mod fingerprints;
mod inputs;
mod list;

pub use fingerprints::{EPOCH, Fingerprints, FrameFingerprint};
