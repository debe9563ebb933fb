//! The queue: which frames are rendered, how far they have come, and how they reach the disk.
//!
//! In: shot files and the frame list of the command line ([`FrameList`]), which make the jobs of a
//! night ([`Job`]). Out: files that are either whole or not there ([`write_atomically`]), a line of
//! the manifest for each frame ([`Record`]), and news of the work ([`Progress`]).
//!
//! A frame is rendered if its files do not say that they are what they should be ([`Reel`]), by
//! the one process that holds its claim ([`Claim`]). Which frames are rendered together, in what
//! order, on how many threads and by how many processes, no byte of a picture tells.

mod bar;
mod batch;
mod because;
mod claim;
mod cost;
mod deed;
mod event;
mod frames;
mod inset;
mod job;
mod ledger;
mod machine;
mod manifest;
mod memory;
mod names;
mod night;
mod picture;
mod plain;
mod progress;
mod record;
mod reel;
mod shard;
mod shots;
mod signals;
mod work;
mod write;

pub use batch::most_together;
pub use claim::{Claim, sweep};
pub use cost::{Costs, Estimate, frame_bytes, memory_bytes};
pub use deed::Deed;
pub use frames::{FrameList, FrameListError, Resolved, list_of};
pub use job::{Force, Job, choose_shard};
pub use manifest::{FileRecord, Record, Seconds, read_records};
pub use names::{ASSEMBLED, Names, SEQUENCE};
pub use night::Night;
pub use picture::{Pictures, Taken, pictures};
pub use plain::open_plain;
pub use progress::{Mode, Progress, Results};
pub use reel::{Glance, Reel, ReelError, Status};
pub use shard::{Shard, ShardError};
pub use shots::{Exposing, Prepared, RenderError, Request, options};
pub use signals::Stop;
pub use write::{explain, write_atomically};
