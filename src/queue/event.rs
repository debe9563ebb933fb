//! News of a run for programs: one object of JSON a line, each with its kind as `event`.

use super::deed::Deed;
use serde::Serialize;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// Version of what the events say.
const SCHEMA_VERSION: u32 = 1;

/// Something that happened.
#[derive(Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub(super) enum Event<'a> {
    /// The first: what is asked for.
    Start {
        schema_version: u32,
        shots: Vec<Cow<'a, str>>,
        frames: u64,
    },
    /// A frame is settled.
    Frame {
        shot: Cow<'a, str>,
        frame: u32,
        status: &'static str,
        because: Option<&'a str>,
        seconds: f64,
        cut: f64,
        files: Vec<Cow<'a, str>>,
    },
    /// Something that the pictures' viewer should know.
    Warning { message: &'a str },
    /// Something that keeps frames from being there.
    Error { message: &'a str },
    /// A file was made of finished frames.
    Assembled { file: Cow<'a, str> },
    /// The last: how it ended.
    Summary(Summary),
}

/// How a run ended.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Summary {
    pub(super) rendered: u64,
    pub(super) kept: u64,
    pub(super) failed: u64,
    pub(super) left: u64,
    pub(super) seconds: f64,
    pub(super) exit: u8,
}

impl<'a> Event<'a> {
    pub(super) fn start(shots: &'a [PathBuf], frames: u64) -> Self {
        Self::Start {
            schema_version: SCHEMA_VERSION,
            shots: texts(shots),
            frames,
        }
    }

    pub(super) fn frame(shot: &'a Path, frame: u32, deed: &'a Deed, files: &'a [PathBuf]) -> Self {
        Self::Frame {
            shot: shot.to_string_lossy(),
            frame,
            status: deed.word(),
            because: deed.because(),
            seconds: deed.seconds(),
            cut: deed.cut(),
            files: texts(files),
        }
    }

    pub(super) fn assembled(file: &'a Path) -> Self {
        let file = file.to_string_lossy();
        Self::Assembled { file }
    }

    /// The object on one line.
    pub(super) fn line(&self) -> String {
        serde_json::to_string(self).expect("texts and numbers have JSON")
    }
}

/// Paths as texts, which JSON wants; bytes that are none are replaced.
fn texts(paths: &[PathBuf]) -> Vec<Cow<'_, str>> {
    paths.iter().map(|path| path.to_string_lossy()).collect()
}
