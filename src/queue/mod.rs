//! The queue: which frames are rendered, how far they have come, and how they reach the disk.
//!
//! In: shot files ([`Prepared`]) and the frame list of the command line ([`FrameList`]). Out: files
//! that are either whole or not there ([`write_atomically`]), and news of the work on standard
//! error ([`Progress`]). Standard output is never written to.

mod cost;
mod frames;
mod manifest;
mod names;
mod picture;
mod progress;
mod reel;
mod shifts;
mod shots;
mod write;

pub use cost::{Costs, Estimate, effect_names, frame_bytes, memory_bytes};
pub use frames::{FrameList, FrameListError, Resolved};
pub use manifest::{FileRecord, Record, Seconds, read_records};
pub use names::Names;
pub use picture::{Pictures, pictures};
pub use progress::{Mode, Progress};
pub use reel::{Reel, ReelError, Status};
pub use shifts::refuse_shifted_numbers;
pub use shots::{Exposing, Prepared, RenderError, Request, options, render_shot};
pub use write::write_atomically;
