//! The manifest of a shot's folder: a line of JSON for each finished frame, appended and never
//! rewritten, so that a killed run loses at most the line it was writing.
//!
//! Facts of the clock (seconds, date, host) stand here and not in the pictures, which are the same
//! bytes on every machine. Of several lines on one frame the last holds. Shards write manifests
//! of their own beside; readers take all, and of each one's last line on a frame the latest.

use super::journal::{Journal, each_line};
use super::names::Names;
use crate::shot::Shot;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

/// Version of the manifest's lines.
const MANIFEST: u32 = 1;

/// A finished frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Its number.
    pub frame: u32,
    /// What it is made of: [`FrameFingerprint::fingerprint`](crate::frame::FrameFingerprint).
    pub fingerprint: String,
    /// The same part by part: [`FrameFingerprint::inputs`](crate::frame::FrameFingerprint).
    pub parts: IndexMap<String, String>,
    /// Its files.
    pub files: Vec<FileRecord>,
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Names of the effects that were simulated.
    pub effects: Vec<String>,
    /// [`FrameFingerprint::trace`](crate::frame::FrameFingerprint).
    pub trace: String,
    /// How many frames shared the trace with it, itself counted.
    pub shared: u32,
    /// Exposure, stops.
    pub exposure: f64,
    /// Where its time went.
    pub seconds: Seconds,
    /// What its viewer should know.
    pub warnings: Vec<String>,
    /// Estimated share of its light that was not followed in mirrors and glass; 0 of frames of before
    /// it was known.
    #[serde(default)]
    pub cut: f64,
    /// Largest memory of the process so far, MiB, where the system says.
    pub memory_mib: Option<u64>,
    /// Threads that worked on it.
    pub threads: u32,
    /// Name of the machine.
    pub host: String,
    /// Version of this program.
    pub version: String,
    /// When it was finished, UTC, as RFC 3339 has it, to the millisecond.
    pub finished: String,
}

/// A file of a frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its name in the folder.
    pub name: String,
    /// Its length.
    pub bytes: u64,
    /// BLAKE3 of it, hexadecimal.
    pub blake3: String,
}

/// Seconds of the clock on the wall that a frame took; of a shared trace its part of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The scene resolved, trees built, curves and links made ready.
    pub prepare: f64,
    /// Rays traced.
    pub trace: f64,
    /// Shade trees to light.
    pub shade: f64,
    /// Developed and encoded, insets drawn.
    pub encode: f64,
    /// Written and flushed to the disk.
    pub write: f64,
}

impl Seconds {
    /// All of them.
    pub fn total(&self) -> f64 {
        self.prepare + self.trace + self.shade + self.encode + self.write
    }
}

/// Frame files that decode completely but have no record, e.g. of a run killed before it appended one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Found {
    /// The frame's number.
    pub(super) found: u32,
    /// What the files say that it is made of.
    pub(super) fingerprint: String,
    /// The files.
    pub(super) files: Vec<FileRecord>,
}

/// What all manifests of a folder tell.
#[derive(Debug, Default)]
pub(super) struct Manifests {
    /// The last record of each frame.
    pub(super) records: BTreeMap<u32, Record>,
    /// The last that was found of each frame.
    pub(super) found: BTreeMap<u32, Found>,
}

/// The last record of each frame in all manifests of a folder. Lines that are none, such as one
/// that a killed run did not finish, are passed over. A folder that is not there holds none.
///
/// # Errors
/// When the folder or a manifest cannot be read.
pub fn read_records(folder: &Path, names: &Names) -> io::Result<BTreeMap<u32, Record>> {
    Ok(Manifests::read(folder, names)?.records)
}

impl Manifests {
    /// Reads them. Links, folders and pipes that are called like manifests are none.
    ///
    /// # Errors
    /// When the folder or a manifest cannot be read.
    pub(super) fn read(folder: &Path, names: &Names) -> io::Result<Self> {
        let mut all = Self::default();
        let entries = match fs::read_dir(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(all),
            entries => entries?,
        };
        for entry in entries {
            let entry = entry?;
            let is_manifest = names.is_manifest(&entry.file_name().to_string_lossy());
            if is_manifest && entry.file_type()?.is_file() {
                all.add(&entry.path())?;
            }
        }
        Ok(all)
    }

    fn add(&mut self, path: &Path) -> io::Result<()> {
        let mut own: BTreeMap<u32, Record> = BTreeMap::new();
        each_line(path, |line| {
            if let Ok(record) = serde_json::from_slice::<Record>(line) {
                own.insert(record.frame, record);
            } else if let Ok(found) = serde_json::from_slice::<Found>(line) {
                self.found.insert(found.found, found);
            }
        })?;
        for (frame, record) in own {
            let newer = |old: &Record| old.finished <= record.finished;
            if self.records.get(&frame).is_none_or(newer) {
                self.records.insert(frame, record);
            }
        }
        Ok(())
    }
}

/// The manifest that this run appends to. A shard has one of its own, so that machines that share a
/// folder without locks do not write to one file.
#[derive(Debug)]
pub(crate) struct ManifestWriter(Journal);

impl ManifestWriter {
    /// The manifest of a shot in its folder, made if it is not there. `shard` is K and N.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn open(
        folder: &Path,
        names: &Names,
        shard: Option<[u32; 2]>,
        shot: &Shot,
    ) -> io::Result<Self> {
        let opening = json!({
            "manifest": MANIFEST,
            "stem": names.stem,
            "shot": shot.path.to_string_lossy(),
            "version": env!("CARGO_PKG_VERSION"),
        });
        let path = folder.join(names.manifest(shard));
        let journal = Journal::new(path, Some(opening.to_string()));
        journal.append::<()>(&[])?;
        Ok(Self(journal))
    }

    /// Appends the record of a finished frame.
    ///
    /// # Errors
    /// When it cannot be written; no part of it is there then.
    pub(crate) fn append(&self, record: &Record) -> io::Result<()> {
        self.0.append(std::slice::from_ref(record))
    }

    /// Appends frames that were found without a record.
    ///
    /// # Errors
    /// As [`append`](Self::append).
    pub(crate) fn append_found(&self, found: &[Found]) -> io::Result<()> {
        self.0.append(found)
    }
}
