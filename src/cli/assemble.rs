//! `restframe assemble`: sheets, animations, video and page of finished frames.

use super::open::{Unopened, open, worse};
use super::{Failed, FinishedArguments, failed, print, print_json, say};
use crate::queue::Stop;
use crate::sequence::{Assembled, assemble_all};
use serde_json::json;

/// Assembles every shot. If one fails, the others are still assembled.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    // When the user asks to stop, no further message is needed.
    let stop = Stop::listen(|_| {})
        .map_err(|error| failed(&format!("cannot listen to signals: {error}")))?;
    let mut worst = None;
    let mut reports = Vec::new();
    for path in &arguments.shots {
        if stop.status().is_some() {
            break;
        }
        let shot_folder = match open(path, &arguments.pictures) {
            Ok(shot_folder) => shot_folder,
            Err(unopened) => {
                reports.push(unopened.as_json(path));
                worst = worse(worst, unopened.failed);
                continue;
            }
        };
        let assembled = assemble_all(&shot_folder, &|note| say(note), &stop);
        let Assembled { made, failures } = match assembled {
            Ok(assembled) => assembled,
            Err(why) => {
                let unclaimed = Unopened::say(&why);
                reports.push(unclaimed.as_json(path));
                worst = worse(worst, unclaimed.failed);
                continue;
            }
        };
        let shot = path.display();
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
