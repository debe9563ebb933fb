//! Reading of a frame's file to pixels, to its last byte, with all its faults.
//!
//! Files may come from anyone: nothing is decoded unless its size is the expected one, so that
//! memory is bounded by the shot's own image, and no more of a file is read than such an image can
//! need.

mod canvas;
mod file;
mod pixels;

pub use canvas::Decoded;
pub(super) use file::MOST_METADATA;
pub use file::{Fault, open, read_bytes};
pub use pixels::{exr, png};
