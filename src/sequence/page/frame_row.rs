//! One frame on the page.

use super::thumbnail::{Thumbnail, small};
use crate::frame::{Caption, Frame};
use crate::progress::FrameOutcome;
use crate::queue::Stop;
use crate::sequence::findings::{Run, SINGLY, count, gaps};
use crate::sequence::frame_image::read;
use crate::shot::Format;
use crate::store::{Record, ShotFolder, Status};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Outcomes of the frames that the writing run was asked for, by number; empty if it rendered
/// nothing.
pub type Outcomes = BTreeMap<u32, FrameOutcome>;

/// Whether a frame exists, and why not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum State {
    Rendered { reason: String },
    Kept,
    Finished,
    Stale { reason: String },
    Missing,
    Broken { reason: String },
    Failed { reason: String },
}

impl State {
    /// The word for it, which is also its CSS class.
    pub(super) fn word(&self) -> &'static str {
        match self {
            Self::Rendered { .. } => "rendered",
            Self::Kept => "kept",
            Self::Finished => "finished",
            Self::Stale { .. } => "stale",
            Self::Missing => "missing",
            Self::Broken { .. } => "broken",
            Self::Failed { .. } => "failed",
        }
    }

    /// The reason, if it needs one.
    pub(super) fn reason(&self) -> Option<&str> {
        match self {
            Self::Rendered { reason }
            | Self::Stale { reason }
            | Self::Broken { reason }
            | Self::Failed { reason } => Some(reason).filter(|b| !b.is_empty()).map(|b| &**b),
            Self::Kept | Self::Finished | Self::Missing => None,
        }
    }

    /// Whether the user should act on it.
    pub(super) fn is_amiss(&self) -> bool {
        matches!(
            self,
            Self::Stale { .. } | Self::Missing | Self::Broken { .. } | Self::Failed { .. }
        )
    }
}

/// One frame.
pub(super) struct FrameRow<'a> {
    pub(super) frame: u32,
    pub(super) state: State,
    /// None if there is no image that can be shown.
    pub(super) picture: Option<Thumbnail>,
    /// URL of its full image beside the page.
    pub(super) full: Option<String>,
    pub(super) record: Option<&'a Record>,
    pub(super) caption: Option<Caption>,
}

/// Contents of a page: frames that exist or that a run was to make; and runs of the other frames.
pub(super) struct Contents<'a> {
    /// Number of frames of the shot.
    pub(super) frames: u32,
    /// Frames that are shown one by one, ascending.
    pub(super) rows: Vec<FrameRow<'a>>,
    /// Runs of all other frames.
    pub(super) gaps: Vec<Run>,
}

/// One entry of a page's contents.
pub(super) enum Entry<'a> {
    Frame(&'a FrameRow<'a>),
    Gap(&'a Run),
}

impl<'a> Contents<'a> {
    /// The contents for the frames found; None if asked to stop.
    pub(super) fn new(
        shot_folder: &'a ShotFolder,
        outcomes: &Outcomes,
        found: Found,
        stop: &Stop,
    ) -> Option<Self> {
        let shown = found.frames.len() as u32;
        let frames = found.frames.par_iter();
        let row = |(frame, found): &(u32, Status)| {
            (!stop.is_asked()).then(|| FrameRow::one(shot_folder, outcomes, (*frame, found), shown))
        };
        Some(Self {
            frames: shot_folder.shot().shot.frames,
            rows: frames.map(row).collect::<Option<_>>()?,
            gaps: found.gaps,
        })
    }

    /// All entries in the order of frames.
    pub(super) fn entries(&self) -> impl Iterator<Item = Entry<'_>> {
        let mut gaps = self.gaps.iter().peekable();
        let mut rows = self.rows.iter().peekable();
        std::iter::from_fn(move || {
            let next = rows.peek().map_or(u32::MAX, |row| row.frame);
            match gaps.next_if(|gap| *gap.start() < next) {
                Some(gap) => Some(Entry::Gap(gap)),
                None => rows.next().map(Entry::Frame),
            }
        })
    }
}

/// A run as `3–17`.
pub(super) fn span(run: &Run) -> String {
    match (run.start(), run.end()) {
        (first, last) if first == last => first.to_string(),
        (first, last) => format!("{first}–{last}"),
    }
}

impl<'a> FrameRow<'a> {
    /// The row of one of this many frames.
    fn one(
        shot_folder: &'a ShotFolder,
        outcomes: &Outcomes,
        (frame, found): (u32, &Status),
        shown: u32,
    ) -> Self {
        let shot = shot_folder.shot();
        let image = read(shot_folder, frame);
        let found = match found {
            Status::Missing => State::Missing,
            Status::Stale { reason } => State::Stale {
                reason: reason.clone(),
            },
            Status::Fresh => match &image {
                Err(error) => State::Broken {
                    reason: error.why.clone(),
                },
                _ => told(outcomes.get(&frame)),
            },
        };
        let state = match outcomes.get(&frame) {
            Some(FrameOutcome::Failed { reason }) => State::Failed {
                reason: reason.clone(),
            },
            _ => found,
        };
        let picture = image.ok().and_then(|image| small(image, shown));
        let name = shot_folder.names.frame(frame, "png");
        let browsers_show_it = shot.output.formats.contains(&Format::Png);
        Self {
            frame,
            state,
            full: (picture.is_some() && browsers_show_it).then(|| beside(&name)),
            picture,
            record: fitting(shot_folder, frame),
            caption: Frame::new(shot, frame)
                .ok()
                .map(|frame| Caption::new(&frame)),
        }
    }
}

/// The record of a frame, if it is up to date: a run killed between an image and its record leaves
/// that of an older image.
pub(super) fn fitting(shot_folder: &ShotFolder, frame: u32) -> Option<&Record> {
    let record = shot_folder.records.get(&frame)?;
    (record.fingerprint == shot_folder.keys.frame(frame).fingerprint).then_some(record)
}

/// The frames of a shot in its folder.
pub(super) struct Found {
    /// Frames that exist or that a run was to make, and those in short gaps between.
    pub(super) frames: Vec<(u32, Status)>,
    /// Longer runs of other frames.
    pub(super) gaps: Vec<Run>,
}

/// Looks for a shot's frames; those that nobody made cost nothing.
pub(super) fn find(shot_folder: &ShotFolder, outcomes: &Outcomes) -> Found {
    let mut shown = shot_folder.there();
    shown.extend(outcomes.keys());
    let runs = gaps(shown.iter().copied(), shot_folder.shot().shot.frames);
    let (long, short): (Vec<Run>, Vec<Run>) = runs.into_iter().partition(|r| count(r) > SINGLY);
    shown.extend(short.into_iter().flatten());
    let frames: Vec<u32> = shown.into_iter().collect();
    let statuses = shot_folder.statuses(&frames);
    Found {
        frames: frames.into_iter().zip(statuses).collect(),
        gaps: long,
    }
}

/// The state of a frame that exists and is up to date.
fn told(outcome: Option<&FrameOutcome>) -> State {
    match outcome {
        Some(FrameOutcome::Rendered { reason, .. }) => State::Rendered {
            reason: reason.clone().unwrap_or_default(),
        },
        Some(FrameOutcome::Kept { .. }) => State::Kept,
        Some(FrameOutcome::Failed { .. }) | None => State::Finished,
    }
}

/// The URL of a file beside the page, whatever its name.
pub(super) fn beside(name: &str) -> String {
    format!("./{}", urlencoding::encode(name))
}
