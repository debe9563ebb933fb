//! What can be wrong with a shot's frames, and the report of all that is.

use serde::Serialize;
use std::ops::RangeInclusive;

/// What kind of thing is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A file is not there.
    Missing,
    /// It is there, but made of something else than it should be.
    Stale,
    /// It cannot be decoded to its end.
    Undecodable,
    /// Its bytes are not those that were written.
    Changed,
    /// It has another size, pixels.
    WrongSize,
    /// It has values that are NaN or infinite.
    NotFinite,
    /// It does not fit between its neighbours.
    Outlier,
    /// A file that does not belong to the shot as it is.
    Orphan,
}

impl Kind {
    /// Whether nothing can be assembled of a sequence with such a finding.
    pub fn forbids_assembling(self) -> bool {
        !matches!(self, Self::Outlier | Self::Orphan)
    }
}

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// The frame's number; none if the file is no frame's of this shot.
    pub frame: Option<u32>,
    /// The last of a run of frames of which it is said, the file being that of the first.
    #[serde(skip)]
    pub last: Option<u32>,
    /// The file's name in the folder.
    pub file: String,
    /// What kind of thing it is.
    pub kind: Kind,
    /// What exactly.
    pub why: String,
}

impl Finding {
    /// The frames of which it is said; none if it is of no frame of this shot.
    pub fn frames(&self) -> Option<RangeInclusive<u32>> {
        let first = self.frame?;
        Some(first..=self.last.unwrap_or(first))
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.file, self.why)
    }
}

/// All that is wrong with a shot's frames.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Report {
    /// How many frames the shot has.
    pub frames: u32,
    /// By frame, what is no frame's last.
    pub findings: Vec<Finding>,
}

impl Report {
    /// How many frames have nothing wrong with them.
    pub fn sound(&self) -> u32 {
        let mut unsound: Vec<_> = self.findings.iter().filter_map(Finding::frames).collect();
        unsound.sort_unstable_by_key(|frames| *frames.start());
        unsound.dedup();
        let count = unsound.iter().map(|frames| frames.clone().count() as u32);
        self.frames - count.sum::<u32>()
    }

    /// `48 of 49 frames are sound`
    pub fn summary(&self) -> String {
        match (self.sound(), self.frames) {
            (1, 1) => "1 frame is sound".to_owned(),
            (sound, frames) if sound == frames => format!("{frames} frames are sound"),
            (sound, 1) => format!("{sound} of 1 frame is sound"),
            (sound, frames) => format!("{sound} of {frames} frames are sound"),
        }
    }
}
