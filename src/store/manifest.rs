//! The manifest of a shot's folder: a JSON line for each finished frame, appended and never
//! rewritten, so that a killed run loses at most the line that it was writing.
//!
//! Wall-clock facts (seconds, date, host) are here and not in the images, which have the same bytes
//! wherever they are rendered. Of several lines on one frame the last counts. Shards write
//! manifests of their own; readers take all of them, and of each one's last line on a frame the
//! latest.

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
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples per pixel.
    pub samples: u32,
    /// Names of the effects that were simulated.
    pub effects: Vec<String>,
    /// [`FrameFingerprint::trace`](crate::frame::FrameFingerprint).
    pub trace: String,
    /// Number of frames that shared its trace, including itself.
    pub shared: u32,
    /// Exposure, stops.
    pub exposure: f64,
    /// Seconds by phase.
    pub seconds: Seconds,
    /// Warnings about the image.
    pub warnings: Vec<String>,
    /// Estimated share of its light that was not followed in mirrors and glass; 0 for frames of
    /// versions that did not record it.
    #[serde(default)]
    pub cut: f64,
    /// Largest memory of the process so far, MiB, if the system states it.
    pub memory_mib: Option<u64>,
    /// Threads that worked on it.
    pub threads: u32,
    /// Name of the machine.
    pub host: String,
    /// Version of this program.
    pub version: String,
    /// Time when it was finished, UTC, in the format of RFC 3339 to the millisecond.
    pub finished: String,
}

/// A file of a frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its name in the folder.
    pub name: String,
    /// Its length.
    pub bytes: u64,
    /// Its BLAKE3 hash, hexadecimal.
    pub blake3: String,
}

/// Wall-clock seconds that a frame took; its share of those of a shared trace.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// Resolving the scene, building trees, preparing curves and links.
    pub prepare: f64,
    /// Tracing rays.
    pub trace: f64,
    /// From shade trees to light.
    pub shade: f64,
    /// Developing, drawing insets, encoding.
    pub encode: f64,
    /// Writing and flushing to the disk.
    pub write: f64,
}

impl Seconds {
    /// Sum of all phases.
    pub fn total(&self) -> f64 {
        self.prepare + self.trace + self.shade + self.encode + self.write
    }
}

/// Frame files that decode completely but have no record, e.g. of a run killed before it appended one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Found {
    /// The frame's number.
    pub(super) found: u32,
    /// Fingerprint in the files.
    pub(super) fingerprint: String,
    /// The files.
    pub(super) files: Vec<FileRecord>,
}

/// Contents of all manifests of a folder.
#[derive(Debug, Default)]
pub(super) struct Manifests {
    /// The last record of each frame.
    pub(super) records: BTreeMap<u32, Record>,
    /// The last finding for each frame without a record.
    pub(super) found: BTreeMap<u32, Found>,
}

/// The last record of each frame in all manifests of a folder. Invalid lines, such as an incomplete
/// last one, are skipped. A folder that does not exist has none.
///
/// # Errors
/// If the folder or a manifest cannot be read.
pub fn read_records(folder: &Path, names: &Names) -> io::Result<BTreeMap<u32, Record>> {
    Ok(Manifests::read(folder, names)?.records)
}

impl Manifests {
    /// Reads all manifests. Links, folders and pipes with names of manifests are ignored.
    ///
    /// # Errors
    /// If the folder or a manifest cannot be read.
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

/// The manifest to which this run appends. A shard has its own, so that machines that share a
/// folder without locks do not write to the same file.
#[derive(Debug)]
pub(crate) struct ManifestWriter(Journal);

impl ManifestWriter {
    /// Opens or creates the manifest of a shot in its folder. `shard` is K and N.
    ///
    /// # Errors
    /// If it cannot be written.
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
        let journal = Journal::new(path, opening.to_string());
        journal.append::<()>(&[])?;
        Ok(Self(journal))
    }

    /// Appends the record of a finished frame.
    ///
    /// # Errors
    /// If it cannot be written; no part of it is there then.
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
