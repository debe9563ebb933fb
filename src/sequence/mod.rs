//! Finished frames: verified, and assembled to sheets, animations, videos and a page.
//!
//! In: a [`ShotFolder`](crate::store::ShotFolder), the frames of a shot in their folder. Out: the
//! faults of the frames ([`verify`]), and files beside them, each complete or absent
//! ([`assemble`]). No frame is rendered here.

mod apng;
mod assemble;
mod child_process;
mod discontinuity;
mod findings;
mod finish;
mod frame_image;
mod freshness;
mod gif;
mod output;
pub mod page;
mod palette;
mod sheet;
mod splices;
mod verify;
mod video;

pub use assemble::{AssembleError, assemble, finish, foreseen, is_finished};
pub use findings::{Finding, Kind, Report};
pub use finish::{Assembled, Unfinished, assemble_all, finish_shot};
pub use frame_image::{FrameImage, FrameImageError, read};
pub use verify::verify;
