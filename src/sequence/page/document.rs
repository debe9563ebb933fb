//! The page as a whole, and whether writing it again would change anything.

use super::frame_row::{Contents, Found, Outcomes, find, fitting};
use super::{chart, head, pictures, table};
use crate::frame::Caption;
use crate::progress::FrameOutcome;
use crate::queue::Stop;
use crate::sequence::freshness;
use crate::sequence::output::OUTPUTS;
use crate::store::{PAGE, ShotFolder, Status, write_atomically};
use maud::{DOCTYPE, html};
use serde_json::{Value, json};
use std::fs;
use std::io;
use std::path::PathBuf;

/// Raised whenever the same frames make another page than before.
const EPOCH: u32 = 2;

/// Writes the page of a shot whose records have been read since the last frame was finished, and
/// returns its path; None if asked to stop before.
///
/// # Errors
/// If it cannot be written. Faults of frames are shown on the page.
pub fn write(
    shot_folder: &ShotFolder,
    outcomes: &Outcomes,
    stop: &Stop,
) -> io::Result<Option<PathBuf>> {
    let found = find(shot_folder, outcomes);
    let key = key(shot_folder, outcomes, &found);
    let Some(contents) = Contents::new(shot_folder, outcomes, found, stop) else {
        return Ok(None);
    };
    let path = shot_folder.path.join(PAGE);
    write_atomically(&path, text(shot_folder, &contents).as_bytes())?;
    // If this fails, the page is only written again next time.
    let _unremembered = freshness::remember(shot_folder, PAGE, key);
    Ok(Some(path))
}

/// Whether the page exists and a run with these outcomes would not change it, since writing it
/// takes as long as reading all images. It does not count as a change that frames which it lists as
/// rendered are kept now.
pub fn is_fresh(shot_folder: &ShotFolder, outcomes: &Outcomes) -> bool {
    let kept = outcomes
        .values()
        .all(|outcome| matches!(outcome, FrameOutcome::Kept { .. }));
    kept && freshness::holds(shot_folder, PAGE, || {
        key(shot_folder, outcomes, &find(shot_folder, outcomes))
    })
}

/// The whole HTML file.
fn text(shot_folder: &ShotFolder, contents: &Contents<'_>) -> String {
    let rows = &contents.rows;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head::head(shot_folder))
            body {
                main {
                    (head::opening(shot_folder, contents))
                    @if !rows.is_empty() { (pictures::player(shot_folder, contents)) }
                    (pictures::grid(contents))
                    (chart::section(rows))
                    (table::section(contents))
                }
                @if !rows.is_empty() { (pictures::script()) }
            }
        }
    };
    page.into_string()
}

/// Hash of all inputs of a page except the pixels, which the frames' fingerprints represent, and
/// whether a run rendered or kept what is there.
fn key(shot_folder: &ShotFolder, outcomes: &Outcomes, found: &Found) -> String {
    let shot = shot_folder.shot();
    let assembled = OUTPUTS.iter().map(|output| {
        let file = shot_folder
            .path
            .join(shot_folder.names.assembled(output.suffix()));
        fs::metadata(file).ok().map(|file| file.len())
    });
    let frames = found.frames.iter().map(|(frame, status)| {
        let frame = *frame;
        let failed = match outcomes.get(&frame) {
            Some(FrameOutcome::Failed { reason }) => Some(reason),
            _ => None,
        };
        let fingerprint = shot_folder.keys.frame(frame).fingerprint;
        let record = fitting(shot_folder, frame);
        json!([
            fingerprint,
            state(status),
            failed,
            record,
            Caption::text_of(shot, frame)
        ])
    });
    let parts = json!([
        EPOCH,
        env!("CARGO_PKG_VERSION"),
        shot.path.file_name().map(|name| name.to_string_lossy()),
        shot.shot.title,
        shot.shot.fps,
        shot_folder.files(1),
        shot_folder.keys.resolution().size,
        shot_folder.keys.resolution().samples,
        assembled.collect::<Vec<_>>(),
        frames.collect::<Vec<_>>(),
        [json!(shot.shot.frames), json!(found.gaps)],
    ]);
    blake3::hash(parts.to_string().as_bytes())
        .to_hex()
        .to_string()
}

fn state(status: &Status) -> Value {
    match status {
        Status::Fresh => json!("fresh"),
        Status::Missing => json!("missing"),
        Status::Stale { reason } => json!({ "stale": reason }),
    }
}
