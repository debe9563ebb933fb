//! `restframe assemble`.

use super::finish::claim;
use super::verify::{open, worse};
use super::{Failed, FinishedArguments, failed, print, print_json, say};
use crate::queue::Reel;
use crate::sequence::page::{self, RunFacts};
use crate::sequence::{AssembleError, assemble};
use serde_json::json;
use std::path::PathBuf;

/// Assembles every shot; one that fails does not keep the others from it.
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
        let shot = path.display();
        let (made, failures) = if reel.folder.is_dir() {
            match claim(&reel) {
                Ok(_claim) => make(&reel),
                Err(failed) => {
                    worst = worse(worst, failed);
                    continue;
                }
            }
        } else {
            let folder = reel.folder.display();
            (
                Vec::new(),
                vec![format!(
                    "there is no folder {folder}; render the shot first"
                )],
            )
        };
        for failure in &failures {
            worst = worse(worst, failed(&format!("{shot}: {failure}")));
        }
        if arguments.json {
            let made: Vec<_> = made.iter().map(|file| file.to_string_lossy()).collect();
            reports.push(json!({
                "shot": path.to_string_lossy(),
                "made": made,
                "failures": failures,
            }));
        } else {
            for file in &made {
                print(&file.display().to_string())?;
            }
            if made.is_empty() && failures.is_empty() {
                say(&format!(
                    "{shot}: nothing to assemble; ask for sheet, gif, apng or video in [sequence]"
                ));
            }
        }
    }
    if arguments.json {
        print_json(&json!({ "shots": reports }))?;
    }
    worst.map_or(Ok(()), Err)
}

/// What could be made, and why the rest could not.
fn make(reel: &Reel) -> (Vec<PathBuf>, Vec<String>) {
    let (mut made, mut failures) = match assemble(reel, &|note| say(note)) {
        Ok(made) => (made, Vec::new()),
        Err(AssembleError::Some { made, failures }) => (made, failures),
        Err(error) => return (Vec::new(), vec![error.to_string()]),
    };
    if reel.shot().sequence.page {
        match page::write(reel, &RunFacts::default()) {
            Ok(page) => made.push(page),
            Err(error) => failures.push(error.to_string()),
        }
    }
    (made, failures)
}
