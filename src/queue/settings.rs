//! What a run is asked to do, where its pictures go, and who is told.

use super::frames::FrameList;
use super::shard::Shard;
use super::signals::Stop;
use crate::progress::Progress;
use crate::store::{Record, Request};
use std::path::PathBuf;

/// What a run is asked to do, where its pictures go, and who is told.
#[derive(Clone)]
pub struct Settings<'a> {
    /// Size and samples of the pictures, and their folder.
    pub request: Request,
    /// Frames of each shot. Default: all.
    pub frames: FrameList,
    /// One of N parts of the frames chosen. Default: all of them.
    pub shard: Option<Shard>,
    /// Which of the frames chosen are rendered. Default: those that are missing or stale.
    pub force: Force,
    /// Where the pictures go. Default: to folders.
    pub output: Output<'a>,
    /// Told of everything.
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

/// Which frames of those chosen are rendered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Force {
    /// Those that are missing or stale.
    #[default]
    No,
    /// All.
    Yes,
}

/// Where the files of finished frames go.
#[derive(Clone, Copy)]
pub enum Output<'a> {
    /// To the folder of each shot, whole or absent, each with a record in the manifest. What is
    /// there already is kept, and other processes may render into the same folder.
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
    /// What a manifest would tell of it.
    pub record: Record,
}
