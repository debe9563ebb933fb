//! Findings: what is wrong with a shot's frames and with the files beside them, and the runs of frames
//! that are missing.

use super::output::{OUTPUTS, Output};
use crate::store::{PAGE, ShotFolder};
use serde::Serialize;
use std::fs;
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
    /// Sorted by frame; findings without a frame come last.
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

/// Frames in a row that are reported one by one; longer runs are one finding.
pub(super) const SINGLY: u32 = 12;

/// Frames in a row.
pub(super) type Run = RangeInclusive<u32>;

/// How many there are in a run.
pub(super) fn count(run: &Run) -> u32 {
    run.end() - run.start() + 1
}

/// The runs of those of `frames` that are not `there`, both ascending.
pub(super) fn gaps(there: impl IntoIterator<Item = u32>, frames: u32) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut next = 1;
    for frame in there.into_iter().chain([frames + 1]) {
        if frame > next {
            runs.push(next..=frame - 1);
        }
        next = frame + 1;
    }
    runs
}

/// Files in a shot's folder that no longer belong to it, by name: frames beyond its end or of another
/// format, what is no longer assembled, and what a killed run left.
pub(super) fn unknown_files(shot_folder: &ShotFolder) -> Vec<Finding> {
    let Ok(entries) = fs::read_dir(&shot_folder.path) else {
        return Vec::new();
    };
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort_unstable();
    let orphan = |file: String| {
        Some(Finding {
            frame: None,
            last: None,
            why: format!("orphan: {}", why(shot_folder, &file)?),
            kind: Kind::Orphan,
            file,
        })
    };
    names.into_iter().filter_map(orphan).collect()
}

/// Why a file is none of the shot's; none if it is, or if it is none of ours.
fn why(shot_folder: &ShotFolder, file: &str) -> Option<String> {
    let names = &shot_folder.names;
    if file == PAGE && !shot_folder.shot().sequence.page {
        return Some("[sequence] asks for no page".to_owned());
    }
    if names.claim_of_temporary(file).is_some() {
        return Some("a run that was killed left it, or one is at work; remove it".to_owned());
    }
    if let Some((frame, extension)) = names.frame_of(file) {
        let frames = shot_folder.shot().shot.frames;
        return if !(1..=frames).contains(&frame) {
            Some(format!("the shot has frames 1 to {frames}"))
        } else if names.frame(frame, extension) != file {
            Some(format!(
                "frame {frame} is called {}",
                names.frame(frame, extension)
            ))
        } else if !shot_folder.files(frame).iter().any(|own| own == file) {
            let format = extension.to_uppercase();
            Some(format!("the shot's output.formats have no {format}"))
        } else {
            None
        };
    }
    let asked = Output::of(&shot_folder.shot().sequence);
    let off = OUTPUTS.iter().filter(|output| !asked.contains(output));
    let mut off = off.filter(|output| names.assembled(output.suffix()) == file);
    off.next()
        .map(|output| format!("[sequence] asks for no {}", output.word()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_what_is_there_are_all_frames() {
        assert_eq!(gaps([], 5), [1..=5]);
        assert!(gaps([1, 2, 3], 3).is_empty());
        assert_eq!(
            gaps([2, 500_000], 1_000_000),
            [1..=1, 3..=499_999, 500_001..=1_000_000]
        );
        for there in [&[1][..], &[3], &[1, 5], &[2, 3, 4]] {
            let missing: u32 = gaps(there.iter().copied(), 5).iter().map(count).sum();
            assert_eq!(missing as usize + there.len(), 5);
        }
    }
}
