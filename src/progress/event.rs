//! Events of a run, and the sinks that take them.

use super::outcome::FrameOutcome;
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// Something that happened in a run.
#[derive(Debug)]
pub enum Event<'a> {
    /// The first: what is asked for.
    Start {
        /// The shot files.
        shots: &'a [PathBuf],
        /// How many frames of them.
        frames: u64,
    },
    /// More of the work is done.
    Advance {
        /// Share of the whole, counted in expected cost: 0 to 1. It steps back after
        /// a failed batch, which is rendered again.
        share: f64,
    },
    /// A frame is settled.
    Frame {
        /// Its shot file.
        shot: &'a Path,
        /// Its number.
        frame: u32,
        /// What became of it.
        outcome: &'a FrameOutcome,
        /// Paths of its files, whether they are there or not.
        files: &'a [PathBuf],
        /// How many frames are settled now.
        settled: u64,
        /// Of how many.
        frames: u64,
    },
    /// Something that the pictures' viewer should know.
    Warning(&'a str),
    /// Something that keeps frames from being rendered.
    Error(&'a str),
    /// A file was made of finished frames.
    Assembled(&'a Path),
    /// The last: how the run ended.
    End(Summary),
}

/// How a run ended.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Frames that were rendered.
    pub rendered: u64,
    /// Frames that were there already.
    pub kept: u64,
    /// Frames that failed.
    pub failed: u64,
    /// Frames that nothing was done about.
    pub left: u64,
    /// Seconds of the wall clock.
    pub seconds: f64,
    /// Exit status of the run.
    pub exit: u8,
}

/// A listener to the events of a run, called from any of its threads. Any closure is one.
///
/// Sinks are called outside of the lock that counts, so that a slow one holds up its own thread alone.
/// Events of two threads may thus arrive in the other order: shares of work may step back.
pub trait Sink: Send + Sync {
    /// Takes an event. Trouble is the sink's own: a run goes on without it.
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
