//! The files a model may read: its own, and those it names within the folders allowed.

use super::ModelError;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Bytes read for one model at most, files that it names included: 2 GiB.
pub(super) const MAX_BYTES: u64 = 2 << 30;

/// Longest part of a URI that a message repeats.
const SHOWN_URI: usize = 80;

/// Access to the disk on behalf of one model.
#[derive(Debug)]
pub(super) struct Files {
    /// The model file, as it was called.
    pub(super) model: PathBuf,
    folder: PathBuf,
    may_read: Vec<PathBuf>,
    bytes_left: u64,
}

impl Files {
    /// Reads the model file itself.
    pub(super) fn open(path: &Path, may_read: &[&Path]) -> Result<(Self, Vec<u8>), ModelError> {
        let canonical = path.canonicalize().map_err(|source| match source.kind() {
            ErrorKind::NotFound => ModelError::Missing {
                file: path.to_owned(),
            },
            _ => ModelError::Read {
                file: path.to_owned(),
                source,
            },
        })?;
        let folder = canonical.parent().unwrap_or(Path::new("/")).to_owned();
        let mut allowed = vec![folder.clone()];
        allowed.extend(
            may_read
                .iter()
                .filter_map(|folder| folder.canonicalize().ok()),
        );
        let model = path.to_owned();
        let mut files = Self {
            model,
            folder,
            may_read: allowed,
            bytes_left: MAX_BYTES,
        };
        let bytes = files.read(&canonical, path)?;
        Ok((files, bytes))
    }

    /// Reads a file that the model names, relative to the model's folder.
    pub(super) fn part(&mut self, name: &str) -> Result<Vec<u8>, ModelError> {
        let has_scheme = name.split_once(':').is_some_and(|(scheme, _)| {
            scheme.starts_with(|c: char| c.is_ascii_alphabetic())
                && scheme
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || "+.-".contains(c))
        });
        if has_scheme || name.starts_with(['/', '\\']) {
            return Err(self.bad_uri(name, "absolute or remote"));
        }
        let outside = || ModelError::Outside {
            file: self.model.clone(),
            uri: shorten(name),
        };
        // By the letters first, so that the message does not tell what exists elsewhere.
        if !self.allows(&lexical(&self.folder.join(name))) {
            return Err(outside());
        }
        let canonical =
            self.folder
                .join(name)
                .canonicalize()
                .map_err(|_| ModelError::MissingPart {
                    file: self.model.clone(),
                    uri: shorten(name),
                })?;
        if !self.allows(&canonical) {
            return Err(outside());
        }
        self.read(&canonical, Path::new(name))
    }

    /// The error for a file name that cannot be used.
    pub(super) fn bad_uri(&self, uri: &str, problem: &'static str) -> ModelError {
        ModelError::Uri {
            file: self.model.clone(),
            uri: shorten(uri),
            problem,
        }
    }

    fn allows(&self, path: &Path) -> bool {
        self.may_read.iter().any(|folder| path.starts_with(folder))
    }

    fn read(&mut self, canonical: &Path, called: &Path) -> Result<Vec<u8>, ModelError> {
        let failed = |source| ModelError::Read {
            file: called.to_owned(),
            source,
        };
        let about = fs::metadata(canonical).map_err(failed)?;
        if !about.is_file() {
            return Err(ModelError::NotAFile {
                file: called.to_owned(),
            });
        }
        let mut bytes = Vec::new();
        if about.len() <= self.bytes_left {
            let file = fs::File::open(canonical).map_err(failed)?;
            file.take(self.bytes_left + 1)
                .read_to_end(&mut bytes)
                .map_err(failed)?;
        }
        let found = about.len().max(bytes.len() as u64);
        self.bytes_left = self
            .bytes_left
            .checked_sub(found)
            .ok_or(ModelError::TooLarge {
                file: self.model.clone(),
                bytes: MAX_BYTES - self.bytes_left + found,
                limit: MAX_BYTES,
            })?;
        Ok(bytes)
    }
}

/// The path with `.` and `..` taken out by the letters, links not followed.
fn lexical(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                out.pop();
            }
            other => out.push(other),
        }
    }
    out
}

fn shorten(uri: &str) -> String {
    match uri.char_indices().nth(SHOWN_URI) {
        Some((end, _)) => format!("{}…", &uri[..end]),
        None => uri.to_owned(),
    }
}
