//! One frame as the page tells of it.

use super::run::{Outcome, RunFacts};
use super::thumbnail::{Thumbnail, small};
use crate::frame::{Caption, Frame};
use crate::queue::{Record, Reel, Status, Stop};
use crate::sequence::gaps::{Run, SINGLY, count, gaps};
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
    pub(super) facts: Option<Caption>,
}

/// What a page tells of: frames that are there or that a run was to make, and where there are more,
/// runs of those that are not.
pub(super) struct Contents<'a> {
    /// How many frames the shot has.
    pub(super) frames: u32,
    /// Those that are shown one by one, ascending.
    pub(super) views: Vec<View<'a>>,
    /// The runs of all others.
    pub(super) gaps: Vec<Run>,
}

/// One thing of a page's contents.
pub(super) enum Entry<'a> {
    Frame(&'a View<'a>),
    Gap(&'a Run),
}

impl<'a> Contents<'a> {
    /// Of a reel as it was found; none if asked to stop.
    pub(super) fn new(reel: &'a Reel, run: &RunFacts, found: Found, stop: &Stop) -> Option<Self> {
        let shown = found.frames.len() as u32;
        let frames = found.frames.par_iter();
        let view = |(frame, found): &(u32, Status)| {
            (!is_asked(stop)).then(|| View::one(reel, run, (*frame, found), shown))
        };
        Some(Self {
            frames: reel.shot().shot.frames,
            views: frames.map(view).collect::<Option<_>>()?,
            gaps: found.gaps,
        })
    }

    /// All of it in the order of frames.
    pub(super) fn entries(&self) -> impl Iterator<Item = Entry<'_>> {
        let mut gaps = self.gaps.iter().peekable();
        let mut views = self.views.iter().peekable();
        std::iter::from_fn(move || {
            let next = views.peek().map_or(u32::MAX, |view| view.frame);
            match gaps.next_if(|gap| *gap.start() < next) {
                Some(gap) => Some(Entry::Gap(gap)),
                None => views.next().map(Entry::Frame),
            }
        })
    }
}

/// `3–17`, as of frames.
pub(super) fn span(run: &Run) -> String {
    match (run.start(), run.end()) {
        (first, last) if first == last => first.to_string(),
        (first, last) => format!("{first}–{last}"),
    }
}

impl<'a> View<'a> {
    /// One of so many frames that are shown.
    fn one(reel: &'a Reel, run: &RunFacts, (frame, found): (u32, &Status), shown: u32) -> Self {
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
        let picture = still.ok().and_then(|still| small(still, shown));
        let name = reel.names.frame(frame, "png");
        let browsers_show_it = shot.output.formats.contains(&Format::Png);
        Self {
            frame,
            state,
            full: (picture.is_some() && browsers_show_it).then(|| beside(&name)),
            picture,
            record: fitting(reel, frame),
            facts: Frame::new(shot, frame)
                .ok()
                .map(|frame| Caption::new(&frame)),
        }
    }
}

/// The record of a frame, if it is of the frame as it should be: a run that was killed between a
/// picture and its record leaves that of an older one.
pub(super) fn fitting(reel: &Reel, frame: u32) -> Option<&Record> {
    let record = reel.records.get(&frame)?;
    (record.fingerprint == reel.keys.frame(frame).fingerprint).then_some(record)
}

/// What there is of a reel's frames.
pub(super) struct Found {
    /// Those that are there or that a run was to make, and those between in short gaps.
    pub(super) frames: Vec<(u32, Status)>,
    /// Runs of others, longer ones.
    pub(super) gaps: Vec<Run>,
}

/// Looks at a reel's frames; those that nobody made cost nothing.
pub(super) fn find(reel: &Reel, run: &RunFacts) -> Found {
    let mut shown = reel.there();
    shown.extend(run.outcomes.keys());
    let runs = gaps(shown.iter().copied(), reel.shot().shot.frames);
    let (long, short): (Vec<Run>, Vec<Run>) = runs.into_iter().partition(|r| count(r) > SINGLY);
    shown.extend(short.into_iter().flatten());
    let frames: Vec<u32> = shown.into_iter().collect();
    let statuses = reel.statuses(&frames);
    Found {
        frames: frames.into_iter().zip(statuses).collect(),
        gaps: long,
    }
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
