//! What was assembled, and of what: a line of JSON for each file, appended, so that what is still
//! right is not made again. STEM.sequence.jsonl, beside the manifest.

use super::output::Output;
use crate::frame::Caption;
use crate::image::decode::open;
use crate::queue::{Reel, open_plain};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::fs::OpenOptions;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Raised whenever the same frames make another file than before.
const EPOCH: u32 = 1;

/// Bytes that are read of it at most, whoever wrote them: some thousand lines.
const MOST: u64 = 1 << 20;

/// A file that was assembled.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    /// Its name.
    assembled: String,
    /// Hash of all that it was made of.
    key: String,
    /// BLAKE3 of the file.
    blake3: String,
}

/// Hash of all that a file is made of: its keys in [sequence], what it tells of the shot, and the
/// frames' fingerprints.
fn key(reel: &Reel, output: Output) -> String {
    let shot = reel.shot();
    let frames = 1..=shot.shot.frames;
    let told: Vec<String> = match output {
        Output::Sheet => frames
            .clone()
            .map(|number| Caption::text_of(shot, number))
            .collect(),
        _ => Vec::new(),
    };
    let fingerprints: Vec<String> = frames
        .into_par_iter()
        .map(|frame| reel.keys.frame(frame).fingerprint)
        .collect();
    let sheet = shot.sequence.sheet.filter(|_| output == Output::Sheet);
    let parts = json!([
        EPOCH,
        output.suffix(),
        sheet,
        told,
        shot.sequence.splices,
        shot.shot.title,
        shot.shot.fps,
        fingerprints,
    ]);
    blake3::hash(parts.to_string().as_bytes())
        .to_hex()
        .to_string()
}

fn path(reel: &Reel) -> PathBuf {
    reel.folder.join(reel.names.assembled("sequence.jsonl"))
}

/// Whether the file is there as it was assembled of just these frames.
pub(super) fn is_fresh(reel: &Reel, output: Output) -> bool {
    let name = reel.names.assembled(output.suffix());
    holds(reel, &name, || key(reel, output))
}

/// Remembers that the file was assembled of the reel's frames.
pub(super) fn remember_output(reel: &Reel, output: Output) -> io::Result<()> {
    let name = reel.names.assembled(output.suffix());
    remember(reel, &name, key(reel, output))
}

/// Whether a file of this name is there as it was made of what has this key.
pub(super) fn holds(reel: &Reel, name: &str, key: impl Fn() -> String) -> bool {
    let text = last_lines(&path(reel)).unwrap_or_default();
    let lines = text.rsplit(|byte| *byte == b'\n');
    let last = lines
        .filter_map(|line| serde_json::from_slice::<Line>(line).ok())
        .find(|line| line.assembled == name);
    last.is_some_and(|line| {
        hash(&reel.folder.join(name)).is_ok_and(|found| found == line.blake3) && line.key == key()
    })
}

/// Remembers of what a file of this name was made.
pub(super) fn remember(reel: &Reel, name: &str, key: String) -> io::Result<()> {
    let line = Line {
        key,
        blake3: hash(&reel.folder.join(name))?,
        assembled: name.to_owned(),
    };
    let text = format!("\n{}\n", serde_json::to_string(&line)?);
    let mut file = open_plain(&path(reel), OpenOptions::new().create(true).append(true))?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

/// The end of the file, which has every line that still matters.
fn last_lines(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = open(path)?;
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(MOST)))?;
    let mut text = Vec::new();
    file.take(MOST).read_to_end(&mut text)?;
    Ok(text)
}

fn hash(path: &Path) -> io::Result<String> {
    let mut file = open(path)?;
    let mut hasher = blake3::Hasher::new();
    let mut block = vec![0; 1 << 16];
    loop {
        match file.read(&mut block)? {
            0 => return Ok(hasher.finalize().to_hex().to_string()),
            length => hasher.update(&block[..length]),
        };
    }
}
