//! One frame as the page tells of it.

use super::run::{Outcome, RunFacts};
use super::thumbnail::{Thumbnail, small};
use crate::plan::{Facts, facts};
use crate::queue::{Record, Reel, Status, Stop};
use crate::sequence::read;
use crate::sequence::verify::is_asked;
use crate::shot::Format;
use rayon::prelude::*;

/// Whether a frame is there, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum State {
    Rendered { because: String },
    Kept,
    Finished,
    Stale { because: String },
    Missing,
    Broken { because: String },
    Failed { because: String },
}

impl State {
    /// The word for it, which is also its class.
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

    /// Why it is so, where that is not plain.
    pub(super) fn because(&self) -> Option<&str> {
        match self {
            Self::Rendered { because }
            | Self::Stale { because }
            | Self::Broken { because }
            | Self::Failed { because } => Some(because).filter(|b| !b.is_empty()).map(|b| &**b),
            Self::Kept | Self::Finished | Self::Missing => None,
        }
    }

    /// Whether somebody has to do something about it.
    pub(super) fn is_amiss(&self) -> bool {
        matches!(
            self,
            Self::Stale { .. } | Self::Missing | Self::Broken { .. } | Self::Failed { .. }
        )
    }
}

/// One frame.
pub(super) struct View<'a> {
    pub(super) frame: u32,
    pub(super) state: State,
    /// None where there is no picture that can be shown.
    pub(super) picture: Option<Thumbnail>,
    /// URL of its full picture beside the page.
    pub(super) full: Option<String>,
    pub(super) record: Option<&'a Record>,
    pub(super) facts: Option<Facts>,
}

impl<'a> View<'a> {
    /// All frames of a reel, in order, as they were found; none if asked to stop.
    pub(super) fn all(
        reel: &'a Reel,
        run: &RunFacts,
        found: &[Status],
        stop: &Stop,
    ) -> Option<Vec<Self>> {
        let numbered = found.par_iter().enumerate();
        numbered
            .map(|(n, found)| (!is_asked(stop)).then(|| Self::one(reel, run, n as u32 + 1, found)))
            .collect()
    }

    fn one(reel: &'a Reel, run: &RunFacts, frame: u32, found: &Status) -> Self {
        let shot = reel.shot();
        let still = read(reel, frame);
        let found = match found {
            Status::Missing => State::Missing,
            Status::Stale { because } => State::Stale {
                because: because.clone(),
            },
            Status::Fresh => match &still {
                Err(error) => State::Broken {
                    because: error.why.clone(),
                },
                _ => told(run.outcomes.get(&frame)),
            },
        };
        let state = match run.outcomes.get(&frame) {
            Some(Outcome::Failed { because }) => State::Failed {
                because: because.clone(),
            },
            _ => found,
        };
        let picture = still.ok().and_then(|still| small(still, shot.shot.frames));
        let name = reel.names.frame(frame, "png");
        let browsers_show_it = shot.output.formats.contains(&Format::Png);
        Self {
            frame,
            state,
            full: (picture.is_some() && browsers_show_it).then(|| beside(&name)),
            picture,
            record: fitting(reel, frame),
            facts: facts(shot, frame).ok(),
        }
    }
}

/// The record of a frame, if it is of the frame as it should be: a run that was killed between a
/// picture and its record leaves that of an older one.
pub(super) fn fitting(reel: &Reel, frame: u32) -> Option<&Record> {
    let record = reel.records.get(&frame)?;
    (record.fingerprint == reel.keys.frame(frame).fingerprint).then_some(record)
}

/// What there is of each frame of a reel, in order.
pub(super) fn statuses(reel: &Reel) -> Vec<Status> {
    let frames = (1..=reel.shot().shot.frames).into_par_iter();
    frames
        .map(|frame| reel.status(frame, &reel.keys.frame(frame)))
        .collect()
}

/// Of a frame that is there and as it should be.
fn told(outcome: Option<&Outcome>) -> State {
    match outcome {
        Some(Outcome::Rendered { because }) => State::Rendered {
            because: because.clone(),
        },
        Some(Outcome::Kept) => State::Kept,
        Some(Outcome::Failed { .. }) | None => State::Finished,
    }
}

/// The URL of a file beside the page, whatever its name.
pub(super) fn beside(name: &str) -> String {
    format!("./{}", urlencoding::encode(name))
}
