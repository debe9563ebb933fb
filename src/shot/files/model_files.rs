//! Access to the files of one model: its own, and those that it names within the allowed folders.

use crate::shot::names::nearest_file;
use crate::shot::names::short;
use indexmap::IndexSet;
use std::fs::{self, File};
use std::io::{BufReader, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Number of material libraries that one OBJ file may name.
pub(super) const MAX_LIBRARIES: usize = 1000;

/// Number of bytes read for one model at most, with the files that it names: 2 GiB.
pub const MODEL_BYTES: u64 = 2 << 30;

/// Access to the disk on behalf of one model: folders allowed, and what is left of its limits.
#[derive(Debug, Clone)]
pub struct ModelFiles {
    /// The model file, as the shot names it.
    pub model: PathBuf,
    pub(super) folder: PathBuf,
    may_read: Vec<PathBuf>,
    bytes_left: u64,
    pub(super) libraries_left: usize,
}

/// Reason why a file of a model cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The model file does not exist.
    #[error("model file `{}` does not exist: check the path, which is relative to the shot", file.display())]
    Missing {
        /// The model file.
        file: PathBuf,
    },
    /// The file could not be read.
    #[error("model file `{}` cannot be read: {source}", file.display())]
    Read {
        /// The model file.
        file: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A folder, pipe or device instead of a file.
    #[error("`{}` is not a regular file: expected a model in OBJ, glTF or glb form", file.display())]
    NotAFile {
        /// The model file, or one that it names.
        file: PathBuf,
    },
    /// The model and the files that it names exceed [`MODEL_BYTES`].
    #[error("model `{}` and the files it names come to {bytes} bytes, more than the {limit} that are read: split or decimate it", file.display())]
    TooLarge {
        /// The model file.
        file: PathBuf,
        /// Size found.
        bytes: u64,
        /// Size allowed.
        limit: u64,
    },
    /// A file name that leads out of the allowed folders.
    #[error("model `{}` names the file `{uri}`, outside the folders it may read, its own and the shot's: put that file beside the model or the shot", file.display())]
    Outside {
        /// The model file.
        file: PathBuf,
        /// The name, as the model writes it.
        uri: String,
    },
    /// A file name that is absolute or remote.
    #[error("model `{}` names the file `{uri}`, which is {problem}: expected a name relative to the model; put that file beside it", file.display())]
    Uri {
        /// The model file.
        file: PathBuf,
        /// The name, as the model writes it, shortened.
        uri: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A file that the model names does not exist.
    #[error("model `{}` names the file `{uri}`, which does not exist: {}copy it along with the model, or export as one .glb", file.display(), did_you_mean(meant))]
    MissingPart {
        /// The model file.
        file: PathBuf,
        /// The name, as the model writes it.
        uri: String,
        /// An existing file with nearly that name.
        meant: Option<String>,
    },
    /// More material libraries than are read.
    #[error("model `{}` names more material libraries than the {limit} that are read: put its materials into one .mtl file", file.display())]
    Libraries {
        /// The model file.
        file: PathBuf,
        /// Number allowed.
        limit: usize,
    },
}

/// A file of a model that may be read. It is opened only while it is read, so that any number of them
/// can wait.
#[derive(Debug)]
pub struct ModelFile {
    /// Its path, with links resolved.
    pub path: PathBuf,
    length: u64,
    called: PathBuf,
}

impl ModelFile {
    /// Reads all bytes.
    ///
    /// # Errors
    /// The error of the system.
    pub fn bytes(self) -> Result<Vec<u8>, FileError> {
        self.read(|file| {
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).map(|_| bytes)
        })
    }

    /// Opens the file and returns what `work` makes of its bytes.
    ///
    /// # Errors
    /// The error of the system.
    pub fn read<T>(
        self,
        work: impl FnOnce(&mut BufReader<std::io::Take<File>>) -> std::io::Result<T>,
    ) -> Result<T, FileError> {
        let done = File::open(&self.path).and_then(|file| {
            work(&mut BufReader::with_capacity(
                1 << 16,
                file.take(self.length),
            ))
        });
        done.map_err(|source| FileError::Read {
            file: self.called,
            source,
        })
    }
}

impl ModelFiles {
    /// Finds the model file itself. `may_read` are folders allowed beside the model's own.
    ///
    /// # Errors
    /// If it does not exist, is not a file, or is too large.
    pub fn open(path: &Path, may_read: &[&Path]) -> Result<(Self, ModelFile), FileError> {
        let canonical = path.canonicalize().map_err(|source| match source.kind() {
            ErrorKind::NotFound => FileError::Missing {
                file: path.to_owned(),
            },
            _ => FileError::Read {
                file: path.to_owned(),
                source,
            },
        })?;
        let folder = canonical.parent().unwrap_or(Path::new("/")).to_owned();
        let mut allowed = vec![folder.clone()];
        // A path without a folder is in the current folder.
        let named = |folder: &Path| match folder.components().next() {
            None => Path::new(".").canonicalize(),
            Some(_) => folder.canonicalize(),
        };
        allowed.extend(may_read.iter().filter_map(|folder| named(folder).ok()));
        let model = path.to_owned();
        let mut files = Self {
            model,
            folder,
            may_read: allowed,
            bytes_left: MODEL_BYTES,
            libraries_left: MAX_LIBRARIES,
        };
        let file = files.counted(&canonical, path)?;
        Ok((files, file))
    }

    /// Finds a file that the model names, relative to the model's folder; None if it does not exist.
    pub(super) fn part(&mut self, name: &str) -> Result<Option<ModelFile>, FileError> {
        if is_absolute(name) {
            return Err(self.bad_uri(name, "absolute or remote"));
        }
        let outside = || FileError::Outside {
            file: self.model.clone(),
            uri: short(name),
        };
        // By the letters first, so that the message does not reveal what exists elsewhere.
        if !self.allows(&lexical(&self.folder.join(name))) {
            return Err(outside());
        }
        let Ok(canonical) = self.folder.join(name).canonicalize() else {
            return Ok(None);
        };
        if !self.allows(&canonical) {
            return Err(outside());
        }
        self.counted(&canonical, Path::new(name)).map(Some)
    }

    /// Finds a file that a glTF file names by a URI, percent-encoded or, as some exporters write it,
    /// plain, with `/` or `\\` between folders. None if it does not exist.
    ///
    /// # Errors
    /// If the model may not read it, or it is not a file, or too large.
    pub fn part_by_uri(&mut self, uri: &str) -> Result<Option<ModelFile>, FileError> {
        let names = [decoded(uri), uri.to_owned()];
        let slashed = names.clone().map(|name| name.replace('\\', "/"));
        for name in IndexSet::<String>::from_iter(names.into_iter().chain(slashed)) {
            if let Some(file) = self.part(&name)? {
                return Ok(Some(file));
            }
        }
        Ok(None)
    }

    /// The error for a URI that leads to no file, with the file that was perhaps meant.
    pub fn missing(&self, uri: &str) -> FileError {
        let name = decoded(uri);
        FileError::MissingPart {
            file: self.model.clone(),
            uri: short(&name),
            meant: self.meant(&name),
        }
    }

    /// The existing file that a name was perhaps meant to be, with `/` between folders.
    fn meant(&self, name: &str) -> Option<String> {
        let name = name.replace('\\', "/");
        let may_list = |folder: &Path| folder.canonicalize().is_ok_and(|real| self.allows(&real));
        let meant = nearest_file(&self.folder, Path::new(&name), may_list)?;
        Some(meant.display().to_string().replace('\\', "/"))
    }

    /// The error for a file name that cannot be used.
    fn bad_uri(&self, uri: &str, problem: &'static str) -> FileError {
        FileError::Uri {
            file: self.model.clone(),
            uri: short(uri),
            problem,
        }
    }

    /// Whether a path without links is in a folder that may be read.
    pub(super) fn allows(&self, path: &Path) -> bool {
        self.may_read.iter().any(|folder| path.starts_with(folder))
    }

    /// Counts the bytes of a file against the limit.
    fn counted(&mut self, canonical: &Path, called: &Path) -> Result<ModelFile, FileError> {
        let failed = |source| FileError::Read {
            file: called.to_owned(),
            source,
        };
        let about = fs::metadata(canonical).map_err(failed)?;
        if !about.is_file() {
            return Err(FileError::NotAFile {
                file: called.to_owned(),
            });
        }
        let length = about.len();
        self.bytes_left = self
            .bytes_left
            .checked_sub(length)
            .ok_or(FileError::TooLarge {
                file: self.model.clone(),
                bytes: MODEL_BYTES - self.bytes_left + length,
                limit: MODEL_BYTES,
            })?;
        Ok(ModelFile {
            path: canonical.to_owned(),
            length,
            called: called.to_owned(),
        })
    }
}

fn did_you_mean(meant: &Option<String>) -> String {
    let hint = |name| format!("did you mean `{}`? ", short(name));
    meant.as_deref().map_or_else(String::new, hint)
}

fn decoded(uri: &str) -> String {
    urlencoding::decode(uri).map_or_else(|_| uri.to_owned(), Into::into)
}

/// Whether a name is a path from a root, of this system or another, or a URL.
pub(super) fn is_absolute(name: &str) -> bool {
    let has_scheme = name.split_once(':').is_some_and(|(scheme, _)| {
        scheme.starts_with(|c: char| c.is_ascii_alphabetic())
            && scheme
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "+.-".contains(c))
    });
    has_scheme || name.starts_with(['/', '\\'])
}

/// The path without `.` and `..`, by the letters alone: links are not resolved.
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
