//! `restframe verify`.

use super::{FAILURE, Failed, FinishedArguments, MISTAKE, failed, mistaken, print, print_json};
use crate::queue::{FrameList, Reel, ReelError, Request};
use crate::sequence::{Report, verify};
use crate::shot;
use serde_json::json;
use std::path::Path;

/// Looks at the frames of every shot; one with a mistake does not keep the others from it.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    let mut worst = None;
    let mut reports = Vec::new();
    for path in &arguments.shots {
        let reel = match open(path, arguments) {
            Ok(reel) => reel,
            Err(failed) => {
                worst = worse(worst, failed);
                continue;
            }
        };
        let report = verify(&reel);
        if !report.findings.is_empty() {
            worst = worse(worst, Failed(FAILURE));
        }
        if arguments.json {
            reports.push(json!({
                "shot": path.to_string_lossy(),
                "folder": reel.folder.to_string_lossy(),
                "frames": report.frames,
                "sound": report.sound(),
                "findings": report.findings,
            }));
        } else {
            tell(path, &report)?;
        }
    }
    if arguments.json {
        print_json(&json!({ "shots": reports }))?;
    }
    worst.map_or(Ok(()), Err)
}

fn tell(path: &Path, report: &Report) -> Result<(), Failed> {
    for finding in &report.findings {
        print(&finding.to_string())?;
    }
    print(&format!("{}: {}", path.display(), report.summary()))
}

/// The finished frames of a shot.
pub(super) fn open(path: &Path, arguments: &FinishedArguments) -> Result<Reel, Failed> {
    let shot = shot::load(path).map_err(|m| mistaken(&m))?;
    let request = Request {
        out: arguments.out.clone(),
        frames: FrameList::all(),
        scale: arguments.scale,
        samples: arguments.samples,
    };
    Reel::open(&shot, &request).map_err(|error| match error {
        ReelError::Mistakes(mistakes) => mistaken(&mistakes),
        error @ ReelError::Folder { .. } => failed(&error.to_string()),
    })
}

/// Of two failures the one that no further try will help.
pub(super) fn worse(old: Option<Failed>, new: Failed) -> Option<Failed> {
    Some(match old {
        Some(Failed(MISTAKE)) => Failed(MISTAKE),
        _ => new,
    })
}
