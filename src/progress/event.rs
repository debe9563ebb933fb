//! Events of a run, and their receivers.

use super::outcome::FrameOutcome;
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// Something that happened in a run.
#[derive(Debug)]
pub enum Event<'a> {
    /// The first event: what is asked for.
    Start {
        /// The shot files.
        shots: &'a [PathBuf],
        /// Number of their frames.
        frames: u64,
    },
    /// Some of the work is done.
    Advance {
        /// Share of the whole, counted in expected cost: 0 to 1.
        share: f64,
    },
    /// A frame is settled.
    Frame {
        /// Its shot file.
        shot: &'a Path,
        /// Its number.
        frame: u32,
        /// Its outcome.
        outcome: &'a FrameOutcome,
        /// Paths of its files, whether they exist or not.
        files: &'a [PathBuf],
        /// Number of frames settled so far.
        settled: u64,
        /// Number of all frames.
        frames: u64,
    },
    /// A warning about the images.
    Warning(&'a str),
    /// An error that keeps frames from being rendered.
    Error(&'a str),
    /// A file was made of finished frames.
    Assembled(&'a Path),
    /// The last event: how the run ended.
    End(Summary),
}

/// Summary of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Frames that were rendered.
    pub rendered: u64,
    /// Frames that existed already.
    pub kept: u64,
    /// Frames that failed.
    pub failed: u64,
    /// Frames without an outcome.
    pub left: u64,
    /// Seconds of the wall clock.
    pub seconds: f64,
    /// Exit status of the run.
    pub exit: u8,
}

/// A listener to the events of a run, called from any of its threads. Any closure is one.
pub trait Sink: Send + Sync {
    /// Takes an event. Failures are the sink's own: the run continues.
    fn event(&self, event: &Event<'_>);

    /// The first error of a stream that programs read, if there was one.
    fn trouble(&self) -> Option<&io::Error> {
        None
    }
}

impl<F: Fn(&Event<'_>) + Send + Sync> Sink for F {
    fn event(&self, event: &Event<'_>) {
        self(event);
    }
}
