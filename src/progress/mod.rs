//! Progress of a run, as events for any receiver.
//!
//! In: what a run does, frame by frame ([`Progress`]). Out: [`Event`]s to any number of [`Sink`]s:
//! a bar or plain lines on standard error, JSON, Open Job Description, or the caller's own closure.

mod bar;
mod event;
mod json;
mod mode;
mod open_jd;
mod tally;
mod text;

pub use event::{Event, FrameOutcome, Sink, Summary};
pub use mode::{Mode, Results};
pub use tally::Progress;
