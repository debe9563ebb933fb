//! `restframe assemble`.

use super::finish::claim;
use super::verify::{open, worse};
use super::{Failed, FinishedArguments, failed, print, print_json, say};
use crate::queue::{Reel, Stop, sweep};
use crate::sequence::page::{self, RunFacts};
use crate::sequence::{AssembleError, assemble};
use serde_json::json;
use std::path::PathBuf;

/// Assembles every shot; one that fails does not keep the others from it.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    // Asked to stop, there is nothing more to say.
    let stop = Stop::listen(|_| {})
        .map_err(|error| failed(&format!("cannot listen to signals: {error}")))?;
    let mut worst = None;
    let mut reports = Vec::new();
    for path in &arguments.shots {
        if stop.status().is_some() {
            break;
        }
        let reel = match open(path, arguments) {
            Ok(reel) => reel,
            Err(unopened) => {
                reports.push(unopened.as_json(path));
                worst = worse(worst, unopened.failed);
                continue;
            }
        };
        let shot = path.display();
        let (made, failures) = if reel.folder.is_dir() {
            // What a killed one left.
            sweep(&reel.folder, &reel.names);
            match claim(&reel) {
                Ok(_claim) => make(&reel, &stop),
                Err(unclaimed) => {
                    reports.push(unclaimed.as_json(path));
                    worst = worse(worst, unclaimed.failed);
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
            reports.push(json!({
                "shot": path.to_string_lossy(),
                "made": made.iter().map(|file| file.to_string_lossy()).collect::<Vec<_>>(),
                "failures": failures,
            }));
        } else {
            for file in &made {
                print(&file.display().to_string())?;
            }
            if made.is_empty() && failures.is_empty() && stop.status().is_none() {
                say(&format!(
                    "{shot}: nothing to assemble; ask for sheet, gif, apng or video in [sequence]"
                ));
            }
        }
    }
    if arguments.json {
        print_json(&json!({ "shots": reports }))?;
    }
    let worst = stop.status().map(Failed).or(worst);
    worst.map_or(Ok(()), Err)
}

/// What could be made, and why the rest could not.
fn make(reel: &Reel, stop: &Stop) -> (Vec<PathBuf>, Vec<String>) {
    let (mut made, mut failures) = match assemble(reel, &|note| say(note), stop) {
        Ok(made) => (made, Vec::new()),
        Err(AssembleError::Some { made, failures }) => (made, failures),
        Err(AssembleError::Stopped) => return (Vec::new(), Vec::new()),
        Err(error) => return (Vec::new(), vec![error.to_string()]),
    };
    if reel.shot().sequence.page {
        match page::write(reel, &RunFacts::default(), stop) {
            Ok(page) => made.extend(page),
            Err(error) => failures.push(error.to_string()),
        }
    }
    (made, failures)
}
