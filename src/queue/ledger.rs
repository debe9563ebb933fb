//! Writing a manifest: a line is there whole or not at all, whoever else writes and however the run
//! ends.

use super::claim::knows_no_locks;
use super::manifest::{Found, Record};
use super::names::Names;
use super::plain::open_plain;
use super::shard::Shard;
use super::write::explain;
use crate::shot::Shot;
use serde_json::json;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Version of the manifest's lines.
const MANIFEST: u32 = 1;

/// The manifest that this run appends to. Of a shard it is one of its own, so that machines that
/// share a folder without locks do not write to one file.
#[derive(Debug)]
pub(super) struct Ledger {
    path: PathBuf,
    opening: String,
}

impl Ledger {
    /// The manifest of a shot in its folder, made if it is not there.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(super) fn open(
        folder: &Path,
        names: &Names,
        shard: Option<Shard>,
        shot: &Shot,
    ) -> io::Result<Self> {
        let opening = json!({
            "manifest": MANIFEST,
            "stem": names.stem,
            "shot": shot.path.to_string_lossy(),
            "version": env!("CARGO_PKG_VERSION"),
        });
        let ledger = Self {
            path: folder.join(names.manifest(shard.map(Shard::numbers))),
            opening: opening.to_string(),
        };
        ledger.add("")?;
        Ok(ledger)
    }

    /// Appends a line for a finished frame and flushes it to the disk.
    ///
    /// # Errors
    /// Of the kind that the system reported, with the path and what to do about it; the manifest
    /// then has no part of the line, if the system lets it be cut off.
    pub(super) fn append(&self, record: &Record) -> io::Result<()> {
        let line = serde_json::to_string(record).map_err(io::Error::from)?;
        self.add(&line)
    }

    /// Appends lines for frames that were found without a record.
    ///
    /// # Errors
    /// As [`append`](Self::append).
    pub(super) fn append_found(&self, found: &[Found]) -> io::Result<()> {
        let lines = found.iter().map(serde_json::to_string);
        let lines = lines.collect::<Result<Vec<_>, _>>()?;
        self.add(&lines.join("\n"))
    }

    fn add(&self, line: &str) -> io::Result<()> {
        self.add_locked(line)
            .map_err(|error| explain(&self.path, &error))
    }

    fn add_locked(&self, line: &str) -> io::Result<()> {
        let mut options = OpenOptions::new();
        options.read(true).append(true).create(true);
        let mut file = open_plain(&self.path, &options)?;
        match file.lock() {
            Err(error) if !knows_no_locks(&error) => return Err(error),
            _ => {}
        }
        let length = file.seek(SeekFrom::End(0))?;
        let mut text = match length {
            0 => format!("{}\n", self.opening),
            _ if ends_a_line(&mut file)? => String::new(),
            // A killed run was writing there.
            _ => "\n".to_owned(),
        };
        if !line.is_empty() {
            text.push_str(line);
            text.push('\n');
        }
        if text.is_empty() {
            return Ok(());
        }
        let written = file
            .write_all(text.as_bytes())
            .and_then(|()| file.sync_all());
        if written.is_err() {
            // The first error is the one to report.
            let _ = file.set_len(length);
        }
        written
    }
}

fn ends_a_line(file: &mut File) -> io::Result<bool> {
    let mut last = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut last)?;
    Ok(last == *b"\n")
}
