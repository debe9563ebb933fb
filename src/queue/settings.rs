//! Settings of a run: what to render, where images go, and who receives events.

use super::frames::FrameList;
use super::shard::Shard;
use super::signals::Stop;
use crate::progress::Progress;
use crate::store::{Record, Request};
use std::path::PathBuf;

/// Settings of a run: what to render, where images go, and who receives events.
#[derive(Clone)]
pub struct Settings<'a> {
    /// Size, samples and folder of the images.
    pub request: Request,
    /// Frames of each shot. Default: all.
    pub frames: FrameList,
    /// One of N parts of the chosen frames. Default: all of them.
    pub shard: Option<Shard>,
    /// Which of the chosen frames are rendered. Default: those that are missing or stale.
    pub force: Force,
    /// Destination of the images. Default: folders.
    pub output: Output<'a>,
    /// Receiver of all events.
    pub progress: &'a Progress<'a>,
    /// Once asked to stop, the work ends within two seconds.
    pub stop: &'a Stop,
}

impl<'a> Settings<'a> {
    /// The defaults of every setting.
    pub fn new(progress: &'a Progress<'a>, stop: &'a Stop) -> Self {
        Self {
            request: Request::default(),
            frames: FrameList::all(),
            shard: None,
            force: Force::No,
            output: Output::Folder,
            progress,
            stop,
        }
    }

    /// Whether the work is to stop.
    pub(super) fn is_stopped(&self) -> bool {
        self.stop.is_asked()
    }
}

/// Which of the chosen frames are rendered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Force {
    /// Those that are missing or stale.
    #[default]
    No,
    /// All.
    Yes,
}

/// Destination of the files of finished frames.
#[derive(Clone, Copy)]
pub enum Output<'a> {
    /// The folder of each shot; files are complete or absent, each with a record in the manifest.
    /// Existing frames are kept, and other processes may render into the same folder.
    Folder,
    /// To the caller, frame by frame as they are finished. Nothing is read but what shots name, and
    /// nothing is written.
    Memory(&'a (dyn Fn(RenderedFrame) + Sync)),
}

impl Output<'_> {
    pub(super) fn is_folder(self) -> bool {
        matches!(self, Self::Folder)
    }
}

/// A finished frame in memory.
#[derive(Debug, Clone)]
pub struct RenderedFrame {
    /// Its shot file.
    pub shot: PathBuf,
    /// Its number.
    pub frame: u32,
    /// Extension and bytes of its files, in the order of the shot's `output.formats`.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// The record that a manifest would have.
    pub record: Record,
}
