//! `restframe verify`.

use super::render::check_scale;
use super::{
    FAILURE, Failed, FinishedArguments, MISTAKE, failed, mistaken, misused, print, print_json,
};
use crate::queue::{Reel, ReelError};
use crate::sequence::{Report, verify};
use crate::shot::{self, Mistakes};
use serde_json::{Value, json};
use std::path::Path;

/// Looks at the frames of every shot; one with a mistake does not keep the others from it.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    let mut worst = None;
    let mut reports = Vec::new();
    for path in &arguments.shots {
        let reel = match open(path, arguments) {
            Ok(reel) => reel,
            Err(unopened) => {
                reports.push(unopened.as_json(path));
                worst = worse(worst, unopened.failed);
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

/// A shot whose frames cannot be looked at; why, has been said.
pub(super) struct Unopened {
    pub(super) failed: Failed,
    why: Why,
}

/// As it stands in an answer.
enum Why {
    Mistakes(Value),
    Words(String),
}

impl Unopened {
    /// Says why.
    pub(super) fn say(why: &str) -> Self {
        Self {
            failed: failed(why),
            why: Why::Words(why.to_owned()),
        }
    }

    fn mistaken(mistakes: &Mistakes) -> Self {
        Self {
            failed: mistaken(mistakes),
            why: Why::Mistakes(mistakes.json()),
        }
    }

    /// What stands in the answer for the shot.
    pub(super) fn as_json(&self, shot: &Path) -> Value {
        let shot = shot.to_string_lossy();
        match &self.why {
            Why::Mistakes(mistakes) => json!({"shot": shot, "mistakes": mistakes}),
            Why::Words(words) => json!({"shot": shot, "error": words}),
        }
    }
}

/// The finished frames of a shot.
pub(super) fn open(path: &Path, arguments: &FinishedArguments) -> Result<Reel, Unopened> {
    let shot = shot::load(path).map_err(|m| Unopened::mistaken(&m))?;
    let request = arguments.pictures.request(None);
    if let Err(why) = check_scale(&shot, &request) {
        let failed = misused(&why);
        let why = Why::Words(why);
        return Err(Unopened { failed, why });
    }
    Reel::open(&shot, &request).map_err(|error| match error {
        ReelError::Mistakes(mistakes) => Unopened::mistaken(&mistakes),
        error @ ReelError::Folder { .. } => Unopened::say(&error.to_string()),
    })
}

/// Of two failures the one that no further try will help.
pub(super) fn worse(old: Option<Failed>, new: Failed) -> Option<Failed> {
    Some(match old {
        Some(Failed(MISTAKE)) => Failed(MISTAKE),
        _ => new,
    })
}
