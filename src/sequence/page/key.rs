//! What a page tells, as one hash: a page of an equal one need not be written again.

use super::super::output::OUTPUTS;
use super::run::{Outcome, RunFacts};
use super::view::{Found, fitting};
use crate::frame::Caption;
use crate::queue::{Reel, Status};
use serde_json::{Value, json};
use std::fs;

/// Raised whenever the same frames make another page than before.
const EPOCH: u32 = 2;

/// Hash of all that a page is made of but the pixels, which the frames' fingerprints stand for, and
/// whether a run rendered or kept what is there.
pub(super) fn key(reel: &Reel, run: &RunFacts, found: &Found) -> String {
    let shot = reel.shot();
    let assembled = OUTPUTS.iter().map(|output| {
        let file = reel.folder.join(reel.names.assembled(output.suffix()));
        fs::metadata(file).ok().map(|file| file.len())
    });
    let frames = found.frames.iter().map(|(frame, status)| {
        let frame = *frame;
        let failed = match run.outcomes.get(&frame) {
            Some(Outcome::Failed { because }) => Some(because),
            _ => None,
        };
        let fingerprint = reel.keys.frame(frame).fingerprint;
        let record = fitting(reel, frame);
        let facts = Caption::text_of(shot, frame);
        json!([fingerprint, state(status), failed, record, facts])
    });
    let parts = json!([
        EPOCH,
        env!("CARGO_PKG_VERSION"),
        shot.path.file_name().map(|name| name.to_string_lossy()),
        shot.shot.title,
        shot.shot.fps,
        reel.files(1),
        reel.keys.resolution().size,
        reel.keys.resolution().samples,
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
        Status::Stale { because } => json!({ "stale": because }),
    }
}
