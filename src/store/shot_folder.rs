//! A shot's frames in their folder: the inputs of each, and the files that exist.

use super::manifest::{FileRecord, Found, Manifests, Record};
use super::names::Names;
use super::reason::difference;
use super::request::Request;
use crate::frame::{Digests, Fingerprints, FrameFingerprint, Resolution};
use crate::image::fingerprint;
use crate::render::Options;
use crate::shot::{Format, Mistakes, Shot};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::PathBuf;
use std::time::SystemTime;

/// A shot's frames and their folder. Opening it hashes the files that the shot names, and parses no
/// mesh.
#[derive(Debug)]
pub struct ShotFolder {
    /// The fingerprint of each frame.
    pub keys: Fingerprints,
    /// Path of the folder; it need not exist.
    pub path: PathBuf,
    /// Names of its files.
    pub names: Names,
    /// Records of finished frames, as of the last reading of the manifests.
    pub records: BTreeMap<u32, Record>,
    /// Other frames that were found complete.
    found: BTreeMap<u32, Found>,
    /// Size, samples and layers of each.
    pub(crate) options: Options,
}

/// Whether a frame has to be rendered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// The frame exists, and its inputs have not changed.
    Fresh,
    /// The frame does not exist.
    Missing,
    /// The frame exists but is not up to date.
    Stale {
        /// Continues "stale because ".
        reason: String,
    },
}

/// Reason why a shot's folder cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// Mistakes in the shot.
    #[error("{0}")]
    Mistakes(Box<Mistakes>),
    /// The folder cannot be read.
    #[error("cannot read {folder}: {error}; name another folder with --out")]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The error.
        error: io::Error,
    },
}

impl ShotFolder {
    /// Opens the folder of a shot's frames.
    ///
    /// # Errors
    /// Files of the shot or of the folder that cannot be read.
    pub fn open(shot: &Shot, request: &Request) -> Result<Self, FolderError> {
        let shot_folder = Self::new(shot, request);
        let mut shot_folder = shot_folder.map_err(|m| FolderError::Mistakes(Box::new(m)))?;
        shot_folder.refresh()?;
        Ok(shot_folder)
    }

    /// [`open`](Self::open) without a look at the folder: fingerprints are the same on every machine.
    ///
    /// # Errors
    /// Files of the shot that cannot be read.
    pub fn new(shot: &Shot, request: &Request) -> Result<Self, Mistakes> {
        let digests = Digests::read(shot)?;
        let options = request.options(shot);
        let picture = Resolution {
            size: [options.width, options.height],
            samples: options.samples,
        };
        let names = Names::new(shot);
        Ok(Self {
            keys: Fingerprints::new(shot.clone(), digests, picture),
            path: request.out.join(&names.stem),
            names,
            records: BTreeMap::new(),
            found: BTreeMap::new(),
            options,
        })
    }

    /// The shot.
    pub fn shot(&self) -> &Shot {
        self.keys.shot()
    }

    /// Reads the manifests again.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn refresh(&mut self) -> Result<(), FolderError> {
        let read = Manifests::read(&self.path, &self.names);
        let Manifests { records, found } = read.map_err(|error| FolderError::Folder {
            folder: self.path.clone(),
            error,
        })?;
        (self.records, self.found) = (records, found);
        Ok(())
    }

    /// The frames of which a file exists. A folder that cannot be read has none.
    pub fn there(&self) -> BTreeSet<u32> {
        let entries = fs::read_dir(&self.path).into_iter().flatten();
        let frames = entries.filter_map(|entry| {
            let name = entry.ok()?.file_name().into_string().ok()?;
            let (frame, _) = self.names.frame_of(&name)?;
            let exists = (1..=self.shot().shot.frames).contains(&frame);
            (exists && self.files(frame).contains(&name)).then_some(frame)
        });
        frames.collect()
    }

    /// Whether frames have to be rendered, in their order. Fingerprints are computed only for
    /// frames that exist.
    pub fn statuses(&self, frames: &[u32]) -> Vec<Status> {
        let there = self.there();
        let status = |frame: &u32| match there.contains(frame) {
            true => self.status(*frame, &self.keys.frame(*frame)),
            false => Status::Missing,
        };
        frames.par_iter().map(status).collect()
    }

    /// Names of a frame's files.
    pub fn files(&self, frame: u32) -> Vec<String> {
        let formats = self.shot().output.formats.iter();
        let extension = |format: &Format| match format {
            Format::Png => "png",
            Format::Exr => "exr",
        };
        formats
            .map(|format| self.names.frame(frame, extension(format)))
            .collect()
    }

    /// Whether a frame has to be rendered, from its record, its files' lengths, and the
    /// fingerprints in their headers. Without a record, files with the right fingerprint are
    /// decoded completely, so that a folder survives the loss of its manifests.
    pub fn status(&self, frame: u32, key: &FrameFingerprint) -> Status {
        let files = self.files(frame);
        let lengths = self.lengths(frame);
        if lengths.iter().all(Option::is_none) {
            return Status::Missing;
        }
        let stale = |reason: String| Status::Stale { reason };
        let missing = files
            .iter()
            .zip(&lengths)
            .find(|(_, length)| length.is_none());
        let record = self.records.get(&frame);
        if let Some(record) = record
            && record.fingerprint != key.fingerprint
            && !self.is_of(&files, key)
        {
            return stale(difference(&record.parts, key, &record.version));
        }
        if let Some((name, _)) = missing {
            return stale(format!("{name} is missing"));
        }
        if !self.is_of(&files, key) {
            return stale(match record {
                Some(_) => format!("{} is of another run", files.join(" or ")),
                None => "no manifest tells what it was made of".to_owned(),
            });
        }
        let Some(told) = self.told(frame, key) else {
            return self.decoded(&files);
        };
        for ((name, length), bytes) in files.iter().zip(lengths).zip(told) {
            if let Some(length) = length.filter(|length| *length != bytes) {
                return stale(format!("{name} has {length} bytes, not {bytes}"));
            }
        }
        Status::Fresh
    }

    /// The manifest's records of a frame's files, if they are up to date.
    pub fn written(&self, frame: u32, key: &FrameFingerprint) -> Option<&[FileRecord]> {
        let record = self.records.get(&frame);
        let record = record.filter(|record| record.fingerprint == key.fingerprint);
        let found = self.found.get(&frame);
        let found = found.filter(|found| found.fingerprint == key.fingerprint);
        let files = self.files(frame);
        let all = |told: &&[FileRecord]| {
            let is_told = |name: &String| told.iter().any(|file| file.name == *name);
            files.iter().all(is_told)
        };
        let recorded = record.map(|record| record.files.as_slice()).filter(all);
        recorded.or_else(|| found.map(|found| found.files.as_slice()).filter(all))
    }

    /// Lengths of a frame's files according to the manifest, in their order.
    fn told(&self, frame: u32, key: &FrameFingerprint) -> Option<Vec<u64>> {
        let written = self.written(frame, key)?;
        let length = |name: String| Some(written.iter().find(|file| file.name == name)?.bytes);
        self.files(frame).into_iter().map(length).collect()
    }

    /// A record of a frame that is fresh but has none, so that it need not be decoded again.
    pub(crate) fn found(&self, frame: u32, key: &FrameFingerprint) -> Option<Found> {
        if self.told(frame, key).is_some() {
            return None;
        }
        let file = |name: String| {
            let bytes = fs::read(self.path.join(&name)).ok()?;
            Some(FileRecord {
                name,
                bytes: bytes.len() as u64,
                blake3: blake3::hash(&bytes).to_hex().to_string(),
            })
        };
        Some(Found {
            found: frame,
            fingerprint: key.fingerprint.clone(),
            files: self
                .files(frame)
                .into_iter()
                .map(file)
                .collect::<Option<_>>()?,
        })
    }

    /// Lengths and times of a frame's files; they change when another process writes it.
    pub fn stamps(&self, frame: u32) -> FileStamps {
        let look = |name: String| {
            let data = fs::metadata(self.path.join(name)).ok()?;
            Some((data.len(), data.modified().ok()))
        };
        FileStamps(self.files(frame).into_iter().map(look).collect())
    }

    fn lengths(&self, frame: u32) -> Vec<Option<u64>> {
        let FileStamps(files) = self.stamps(frame);
        files.into_iter().map(|file| Some(file?.0)).collect()
    }

    /// Whether all existing files have the fingerprint of `key`.
    fn is_of(&self, files: &[String], key: &FrameFingerprint) -> bool {
        files.iter().all(|name| {
            let path = self.path.join(name);
            !path.exists() || fingerprint::fingerprint(&path).as_ref() == Some(&key.fingerprint)
        })
    }

    /// The status of files with the right fingerprint whose lengths no record states.
    fn decoded(&self, files: &[String]) -> Status {
        let size = self.keys.resolution().size;
        let broken = |name: &&String| !fingerprint::is_whole(&self.path.join(name), size);
        match files.iter().find(broken) {
            None => Status::Fresh,
            Some(name) => Status::Stale {
                reason: format!("{name} is broken"),
            },
        }
    }
}

/// Lengths and modification times of a frame's files; empty if none was looked at.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FileStamps(Vec<Option<(u64, Option<SystemTime>)>>);
