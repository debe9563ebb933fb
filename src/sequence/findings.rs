//! Findings: faults of a shot's frames and of the files beside them; and runs of missing frames.

use super::output::{OUTPUTS, Output};
use crate::store::{PAGE, ShotFolder};
use serde::Serialize;
use std::fs;
use std::ops::RangeInclusive;

/// Kind of a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A file is missing.
    Missing,
    /// A file exists but was made from other inputs.
    Stale,
    /// A file cannot be decoded to its end.
    Undecodable,
    /// Its bytes are not those that were written.
    Changed,
    /// An image has another size, pixels.
    WrongSize,
    /// An image has values that are NaN or infinite.
    NotFinite,
    /// An image does not fit between its neighbors.
    Outlier,
    /// A file that does not belong to the shot as it is.
    Orphan,
}

impl Kind {
    /// Whether such a finding keeps a sequence from being assembled.
    pub fn forbids_assembling(self) -> bool {
        !matches!(self, Self::Outlier | Self::Orphan)
    }
}

/// One fault.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// The frame number; None if the file belongs to no frame of this shot.
    pub frame: Option<u32>,
    /// Last frame of a run with this fault; the file is that of the first.
    #[serde(skip)]
    pub last: Option<u32>,
    /// The file's name in the folder.
    pub file: String,
    /// Kind of the fault.
    pub kind: Kind,
    /// Details.
    pub why: String,
}

impl Finding {
    /// The frames with this fault; None if it belongs to no frame of this shot.
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

/// All faults of a shot's frames.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Report {
    /// Number of frames of the shot.
    pub frames: u32,
    /// Sorted by frame; findings without a frame come last.
    pub findings: Vec<Finding>,
}

impl Report {
    /// Number of frames without faults.
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

/// Number of consecutive frames up to which each is listed by itself; longer runs are listed as
/// one.
pub(super) const SINGLY: u32 = 12;

/// Consecutive frames.
pub(super) type Run = RangeInclusive<u32>;

/// Number of frames in a run.
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

/// Files in a shot's folder that no longer belong to it, by name: frames beyond its end or of
/// another format, outputs that are no longer assembled, leftovers of killed runs.
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

/// The reason why a file does not belong to the shot; None if it does, or is not one of ours.
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
