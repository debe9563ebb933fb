//! Finished frames: verified, and assembled to sheets, animations, videos and a page.
//!
//! In: a [`Reel`](crate::queue::Reel), the frames of a shot in their folder. Out: the list of what
//! is wrong with them, and files beside them, each whole or not there. No frame is rendered here.

pub mod page;
mod still;

pub use still::{Still, StillError, read};
