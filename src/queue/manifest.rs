//! The manifest of a shot's folder: a line of JSON for each finished frame, appended and never
//! rewritten, so that a killed run loses at most the line it was writing.
//!
//! Facts of the clock (seconds, date, host) stand here and not in the pictures, which are the same
//! bytes whoever renders them. Of several lines on one frame the last holds. Shards write manifests
//! of their own beside; readers take all, and of each one's last line on a frame the latest.

use super::names::Names;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

/// A finished frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Its number.
    pub frame: u32,
    /// What it is made of: [`FrameKey::fingerprint`](crate::plan::FrameKey).
    pub fingerprint: String,
    /// The same part by part: [`FrameKey::parts`](crate::plan::FrameKey).
    pub parts: IndexMap<String, String>,
    /// Its files.
    pub files: Vec<FileRecord>,
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Names of the effects that were simulated.
    pub effects: Vec<String>,
    /// [`FrameKey::trace`](crate::plan::FrameKey).
    pub trace: String,
    /// How many frames shared the trace with it, itself counted.
    pub shared: u32,
    /// Exposure, stops.
    pub exposure: f64,
    /// Where its time went.
    pub seconds: Seconds,
    /// What its viewer should know.
    pub warnings: Vec<String>,
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

/// The last record of each frame in all manifests of a folder. Lines that are none, such as one
/// that a killed run did not finish, are passed over. A folder that is not there holds none.
///
/// # Errors
/// When the folder or a manifest cannot be read.
pub fn read_records(folder: &Path, names: &Names) -> io::Result<BTreeMap<u32, Record>> {
    let mut records: BTreeMap<u32, Record> = BTreeMap::new();
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(records),
        entries => entries?,
    };
    for entry in entries {
        let entry = entry?;
        if !names.is_manifest(&entry.file_name().to_string_lossy()) {
            continue;
        }
        let bytes = fs::read(entry.path())?;
        let mut own: BTreeMap<u32, Record> = BTreeMap::new();
        for line in bytes.split(|byte| *byte == b'\n') {
            if let Ok(record) = serde_json::from_slice::<Record>(line) {
                own.insert(record.frame, record);
            }
        }
        for (frame, record) in own {
            let newer = |old: &Record| old.finished <= record.finished;
            if records.get(&frame).is_none_or(newer) {
                records.insert(frame, record);
            }
        }
    }
    Ok(records)
}
