//! `restframe assemble`.

use super::verify::{open, worse};
use super::{Failed, FinishedArguments, failed, print, print_json, say};
use crate::sequence::{AssembleError, assemble};
use serde_json::json;

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
        let (made, failures) = match assemble(&reel, &|note| say(note)) {
            Ok(made) => (made, Vec::new()),
            Err(AssembleError::Some { made, failures }) => (made, failures),
            Err(error) => (Vec::new(), vec![error.to_string()]),
        };
        for failure in &failures {
            worst = worse(worst, failed(&format!("{shot}: {failure}")));
        }
        if arguments.json {
            reports.push(json!({"shot": path, "made": made, "failures": failures}));
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
