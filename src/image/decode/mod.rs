//! A frame's file to pixels, read to its last byte, with all that can be wrong with it.
//!
//! The files may be anybody's: nothing is decoded whose size is not the one expected, so that
//! memory is bounded by the shot's own image, and no more of a file is read than such an image can
//! need.

mod canvas;
mod fault;
mod file;
mod pixels;

pub use canvas::Decoded;
pub use fault::Fault;
pub(super) use file::MOST_METADATA;
pub use file::{open, read_bytes};
pub use pixels::{exr, png};
