//! Freshness of files made from frames, recorded in STEM.sequence.jsonl beside the manifest: a line
//! for each file that was made, with a hash of all its inputs.

use super::output::Output;
use crate::frame::Caption;
use crate::image::decode::open;
use crate::store::{Journal, ShotFolder, each_line};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Raised whenever the same frames make another file than before.
const EPOCH: u32 = 1;

/// A file that was assembled.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    /// Its name.
    assembled: String,
    /// Hash of all its inputs.
    key: String,
    /// BLAKE3 of the file.
    blake3: String,
}

/// Hash of all inputs of a file: its keys in [sequence], the facts about the shot that it shows,
/// and the frames' fingerprints.
fn key(shot_folder: &ShotFolder, output: Output) -> String {
    let shot = shot_folder.shot();
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
        .map(|frame| shot_folder.keys.frame(frame).fingerprint)
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

fn journal(shot_folder: &ShotFolder) -> Journal {
    Journal::new(path(shot_folder), String::new())
}

fn path(shot_folder: &ShotFolder) -> PathBuf {
    shot_folder
        .path
        .join(shot_folder.names.assembled("sequence.jsonl"))
}

/// Whether the file exists as it was assembled from exactly these frames.
pub(super) fn is_fresh(shot_folder: &ShotFolder, output: Output) -> bool {
    let name = shot_folder.names.assembled(output.suffix());
    holds(shot_folder, &name, || key(shot_folder, output))
}

/// Records that the file was assembled from the shot's frames.
pub(super) fn remember_output(shot_folder: &ShotFolder, output: Output) -> io::Result<()> {
    let name = shot_folder.names.assembled(output.suffix());
    remember(shot_folder, &name, key(shot_folder, output))
}

/// Whether a file of this name exists as it was made from inputs with this key.
pub(super) fn holds(shot_folder: &ShotFolder, name: &str, key: impl Fn() -> String) -> bool {
    let mut last = None;
    let _unread = each_line(&path(shot_folder), |line| {
        if let Ok(line) = serde_json::from_slice::<Line>(line)
            && line.assembled == name
        {
            last = Some(line);
        }
    });
    last.is_some_and(|line: Line| {
        hash(&shot_folder.path.join(name)).is_ok_and(|found| found == line.blake3)
            && line.key == key()
    })
}

/// Records the inputs of a file of this name.
pub(super) fn remember(shot_folder: &ShotFolder, name: &str, key: String) -> io::Result<()> {
    let line = Line {
        key,
        blake3: hash(&shot_folder.path.join(name))?,
        assembled: name.to_owned(),
    };
    journal(shot_folder).append(&[line])
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
