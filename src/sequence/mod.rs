//! Finished frames: verified, and assembled to sheets, animations, videos and a page.
//!
//! In: a [`Reel`](crate::queue::Reel), the frames of a shot in their folder. Out: the list of what
//! is wrong with them ([`verify`]), and files beside them, each whole or not there ([`assemble`]).
//! No frame is rendered here.

mod apng;
mod assemble;
mod draft;
mod finding;
mod gaps;
mod gif;
mod ledger;
mod orphans;
mod outlier;
mod output;
pub mod page;
mod palette;
mod parts;
mod program;
mod reduce;
mod sheet;
mod still;
mod target;
mod verify;
mod video;

pub use assemble::{AssembleError, assemble, finish, foreseen, is_finished};
pub use finding::{Finding, Kind, Report};
pub use still::{Still, StillError, read};
pub use verify::verify;
