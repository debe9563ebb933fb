//! `restframe check`: all mistakes of shots, without rendering.

use super::{Failed, MISTAKE, mistaken, print, print_json, say, warn};
use crate::render::Prepared;
use crate::sequence;
use serde_json::json;
use std::path::PathBuf;

/// Reads every shot with its files, and resolves each frame.
pub(super) fn run(shots: &[PathBuf], as_json: bool) -> Result<(), Failed> {
    let mut wrong = false;
    let mut reports = Vec::new();
    for path in shots {
        match Prepared::read(path) {
            Ok(prepared) if as_json => reports.push(sound(&prepared)),
            Ok(prepared) => {
                warn(&prepared);
                if let Some(why) = foreseen(&prepared) {
                    say(&format!("warning: {why}"));
                }
                let frames = prepared.shot.shot.frames;
                let s = if frames == 1 { "" } else { "s" };
                print(&format!(
                    "{}: {frames} frame{s}, no mistakes",
                    path.display()
                ))?;
            }
            Err(mistakes) => {
                wrong = true;
                if as_json {
                    let report = json!({"shot": path.to_string_lossy(), "ok": false, "mistakes": mistakes.json()});
                    reports.push(report);
                } else {
                    mistaken(&mistakes);
                }
            }
        }
    }
    if as_json {
        print_json(&json!({ "shots": reports }))?;
    }
    if wrong { Err(Failed(MISTAKE)) } else { Ok(()) }
}

/// The part of `[sequence]` that cannot be made from the shot's frames.
fn foreseen(prepared: &Prepared) -> Option<String> {
    let shot = &prepared.shot;
    let why = sequence::foreseen(shot, shot.image.size)?;
    Some(format!("{}: {why}", shot.path.display()))
}

fn sound(prepared: &Prepared) -> serde_json::Value {
    let warnings: Vec<String> = prepared
        .warnings()
        .into_iter()
        .chain(foreseen(prepared))
        .collect();
    json!({
        "shot": prepared.shot.path.to_string_lossy(),
        "ok": true,
        "frames": prepared.shot.shot.frames,
        "mistakes": [],
        "warnings": warnings,
    })
}
