//! Events of a run, the outcomes of its frames, and their receivers.

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
///
/// Sinks are called outside of the lock that counts, so that a slow one holds up its own thread alone.
/// Events of two threads may thus arrive in the other order: shares of work may step back.
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

/// Outcome of one frame in a run.
#[derive(Debug, Clone, PartialEq)]
pub enum FrameOutcome {
    /// It existed already.
    Kept {
        /// The reason, if it did not exist when the run began.
        reason: Option<String>,
    },
    /// It was rendered.
    Rendered {
        /// The reason, if it existed before: "stale because …".
        reason: Option<String>,
        /// Wall-clock seconds; its share of those of a shared trace.
        seconds: f64,
        /// Share of its light that was not followed in mirrors and glass.
        cut: f64,
    },
    /// It could not be rendered or written.
    Failed {
        /// The reason.
        reason: String,
    },
}

impl FrameOutcome {
    /// "kept", "rendered" or "failed".
    pub fn word(&self) -> &'static str {
        match self {
            Self::Kept { .. } => "kept",
            Self::Rendered { .. } => "rendered",
            Self::Failed { .. } => "failed",
        }
    }

    /// The reason, if there is one.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Kept { reason } | Self::Rendered { reason, .. } => reason.as_deref(),
            Self::Failed { reason } => Some(reason),
        }
    }

    /// Share of its light that this run did not follow in mirrors and glass.
    pub fn cut(&self) -> f64 {
        match self {
            Self::Rendered { cut, .. } => *cut,
            _ => 0.0,
        }
    }

    /// Seconds that it took.
    pub fn seconds(&self) -> f64 {
        match self {
            Self::Rendered { seconds, .. } => *seconds,
            _ => 0.0,
        }
    }
}
