//! Files in a shot's folder that no longer belong to it: frames beyond its end or of another
//! format, what is no longer assembled, and what a killed run left.

use super::finding::{Finding, Kind};
use super::output::{OUTPUTS, Output};
use super::page::PAGE;
use crate::queue::Reel;
use std::fs;

/// The orphans in a reel's folder, by name.
pub(super) fn orphans(reel: &Reel) -> Vec<Finding> {
    let Ok(entries) = fs::read_dir(&reel.folder) else {
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
            why: format!("orphan: {}", why(reel, &file)?),
            kind: Kind::Orphan,
            file,
        })
    };
    names.into_iter().filter_map(orphan).collect()
}

/// Why a file is none of the shot's; none if it is, or if it is none of ours.
fn why(reel: &Reel, file: &str) -> Option<String> {
    let names = &reel.names;
    if file == PAGE && !reel.shot().sequence.page {
        return Some("[sequence] asks for no page".to_owned());
    }
    if names.claim_of_temporary(file).is_some() {
        return Some("a run that was killed left it, or one is at work; remove it".to_owned());
    }
    if let Some((frame, extension)) = names.frame_of(file) {
        let frames = reel.shot().shot.frames;
        return if !(1..=frames).contains(&frame) {
            Some(format!("the shot has frames 1 to {frames}"))
        } else if names.frame(frame, extension) != file {
            Some(format!(
                "frame {frame} is called {}",
                names.frame(frame, extension)
            ))
        } else if !reel.files(frame).iter().any(|own| own == file) {
            let format = extension.to_uppercase();
            Some(format!("the shot's output.formats have no {format}"))
        } else {
            None
        };
    }
    let asked = Output::of(&reel.shot().sequence);
    let off = OUTPUTS.iter().filter(|output| !asked.contains(output));
    let mut off = off.filter(|output| names.assembled(output.suffix()) == file);
    off.next()
        .map(|output| format!("[sequence] asks for no {}", output.word()))
}
