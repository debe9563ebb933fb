//! The queue: a run, which renders the frames of some shots in batches.
//!
//! In: shots and [`Settings`]. Out: images in the shots' folders or in memory ([`Output`]), the
//! outcome of each frame ([`Job::outcomes`]), and events ([`Progress`](crate::progress::Progress)).
//! A [`Run`] returns each shot as soon as nothing is left to do for it, so that its caller can
//! assemble it.
//!
//! Images do not depend on batching, order, thread count or process count.

mod batch;
mod cost;
mod forecast;
mod frames;
mod job;
mod jobs;
mod memory;
mod render_batch;
mod run;
mod settings;
mod shard;
mod signals;
mod write_batch;

pub use cost::{Costs, Estimate, frame_bytes, memory_bytes};
pub use forecast::{Forecast, FrameForecast, Totals};
pub use frames::{FrameList, FrameListError, Resolved, list_of};
pub use job::Job;
pub use jobs::{Contradiction, choose};
pub use memory::{TooLarge, most_together};
pub use run::{Run, RunError};
pub use settings::{Force, Output, RenderedFrame, Settings};
pub use shard::{Shard, ShardError};
pub use signals::Stop;
