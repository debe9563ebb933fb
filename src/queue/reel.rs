//! A shot's frames in their folder: what each should be made of, and what is there.

use super::manifest::{Record, read_records};
use super::names::Names;
use super::shots::{Request, options};
use crate::plan::{Digests, FrameKey, Keys, Picture};
use crate::shot::{Format, Mistakes, Shot};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::PathBuf;

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

    /// Whether a frame has to be rendered, judged by the manifests and the files' lengths.
    pub fn status(&self, frame: u32, key: &FrameKey) -> Status {
        let files = self.files(frame);
        let lengths: Vec<Option<u64>> = files
            .iter()
            .map(|name| fs::metadata(self.folder.join(name)).ok().map(|m| m.len()))
            .collect();
        if lengths.iter().all(Option::is_none) {
            return Status::Missing;
        }
        let stale = |because: String| Status::Stale { because };
        let Some(record) = self.records.get(&frame) else {
            return stale("no manifest tells what it was made of".to_owned());
        };
        if record.fingerprint != key.fingerprint {
            return stale(difference(&record.parts, &key.parts));
        }
        for (name, length) in files.iter().zip(lengths) {
            let written = record.files.iter().find(|file| file.name == *name);
            match (length, written) {
                (None, _) => return stale(format!("{name} is missing")),
                (Some(_), None) => return stale(format!("{name} is of another run")),
                (Some(length), Some(file)) if length != file.bytes => {
                    let bytes = file.bytes;
                    return stale(format!("{name} has {length} bytes, not {bytes}"));
                }
                _ => {}
            }
        }
        Status::Fresh
    }
}

type Parts = indexmap::IndexMap<String, String>;

/// What differs between what a frame was made of and what it should be made of.
fn difference(was: &Parts, is: &Parts) -> String {
    let changed = is
        .iter()
        .filter(|(key, value)| was.get(*key) != Some(value));
    let gone = was.keys().filter(|key| !is.contains_key(*key));
    let names: Vec<&str> = changed
        .map(|(key, _)| key)
        .chain(gone)
        .map(String::as_str)
        .collect();
    format!("{} changed", names.join(", "))
}
