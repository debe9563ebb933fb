//! A shot's frames in their folder: what each should be made of, and what is there.

use super::because::difference;
use super::manifest::{Record, read_records};
use super::names::Names;
use super::shots::{Request, options};
use crate::film::imprint;
use crate::plan::{Digests, FrameKey, Keys, Picture};
use crate::shot::{Format, Mistakes, Shot};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::PathBuf;
use std::time::SystemTime;

/// A shot's frames and their folder. Reads hashes, no meshes.
#[derive(Debug)]
pub struct Reel {
    /// What each frame is made of.
    pub keys: Keys,
    /// Where the files are; it need not exist.
    pub folder: PathBuf,
    /// What they are called.
    pub names: Names,
    /// Of finished frames, as the manifests had them when this was last read.
    pub records: BTreeMap<u32, Record>,
}

/// Whether a frame has to be rendered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// It is there, and what it is made of has not changed.
    Fresh,
    /// There is nothing of it.
    Missing,
    /// It is there, but …
    Stale {
        /// Continues "stale because ".
        because: String,
    },
}

/// Why a reel cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReelError {
    /// Mistakes in the shot.
    #[error("{0}")]
    Mistakes(Box<Mistakes>),
    /// The folder cannot be read.
    #[error("cannot read {folder}: {error}; name another folder with --out")]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl Reel {
    /// The frames of a shot as asked for.
    ///
    /// # Errors
    /// Files of the shot or of the folder that cannot be read.
    pub fn open(shot: &Shot, request: &Request) -> Result<Self, ReelError> {
        let digests = Digests::read(shot).map_err(|m| ReelError::Mistakes(Box::new(m)))?;
        let options = options(shot, request);
        let picture = Picture {
            size: [options.width, options.height],
            samples: options.samples,
        };
        let names = Names::new(shot);
        let mut reel = Self {
            keys: Keys::new(shot.clone(), digests, picture),
            folder: request.out.join(&names.stem),
            names,
            records: BTreeMap::new(),
        };
        reel.refresh()?;
        Ok(reel)
    }

    /// The shot.
    pub fn shot(&self) -> &Shot {
        self.keys.shot()
    }

    /// Reads the manifests again.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn refresh(&mut self) -> Result<(), ReelError> {
        self.records =
            read_records(&self.folder, &self.names).map_err(|error| ReelError::Folder {
                folder: self.folder.clone(),
                error,
            })?;
        Ok(())
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

    /// Whether a frame has to be rendered: by its record, its files' lengths, and what their
    /// headers say they are made of. Where no record tells, files that say the right thing are
    /// decoded whole, so that a folder survives without its manifests.
    pub fn status(&self, frame: u32, key: &FrameKey) -> Status {
        let files = self.files(frame);
        let lengths = self.lengths(frame);
        if lengths.iter().all(Option::is_none) {
            return Status::Missing;
        }
        let stale = |because: String| Status::Stale { because };
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
        let record = record.filter(|record| record.fingerprint == key.fingerprint);
        let Some(record) = record else {
            return self.decoded(&files);
        };
        for (name, length) in files.iter().zip(lengths) {
            let bytes = match record.files.iter().find(|file| file.name == *name) {
                None => return self.decoded(&files),
                Some(file) => file.bytes,
            };
            if let Some(length) = length.filter(|length| *length != bytes) {
                return stale(format!("{name} has {length} bytes, not {bytes}"));
            }
        }
        Status::Fresh
    }

    /// What a glance at the folder shows of a frame: it changes when another process writes it.
    pub fn glance(&self, frame: u32) -> Glance {
        let look = |name: String| {
            let data = fs::metadata(self.folder.join(name)).ok()?;
            Some((data.len(), data.modified().ok()))
        };
        Glance(self.files(frame).into_iter().map(look).collect())
    }

    fn lengths(&self, frame: u32) -> Vec<Option<u64>> {
        let Glance(files) = self.glance(frame);
        files.into_iter().map(|file| Some(file?.0)).collect()
    }

    /// Whether all files that are there say that they are what `key` says.
    fn is_of(&self, files: &[String], key: &FrameKey) -> bool {
        files.iter().all(|name| {
            let path = self.folder.join(name);
            !path.exists() || imprint::fingerprint(&path).as_ref() == Some(&key.fingerprint)
        })
    }

    /// Of files that say the right thing, but that no record tells the lengths of.
    fn decoded(&self, files: &[String]) -> Status {
        let size = self.keys.picture().size;
        let broken = |name: &&String| !imprint::is_whole(&self.folder.join(name), size);
        match files.iter().find(broken) {
            None => Status::Fresh,
            Some(name) => Status::Stale {
                because: format!("{name} is broken"),
            },
        }
    }
}

/// The lengths and times of a frame's files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Glance(Vec<Option<(u64, Option<SystemTime>)>>);
