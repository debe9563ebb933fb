//! Hashes of the files that a shot reads: models with all that they name, spectra, skies, stars.

use crate::shot::{
    FileError, GltfJson, MODEL_BYTES, Mistakes, ModelFile, ModelFiles, Shot, each_obj_line,
    keyword_and_rest,
};
use blake3::{Hash, Hasher};
use indexmap::{IndexMap, IndexSet};
use std::collections::hash_map::{Entry, HashMap};
use std::convert::Infallible;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// BLAKE3 of every file that a shot reads, each read once and none kept. What is wrong with a
/// broken file is reported where it is read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Digests(IndexMap<PathBuf, Digest>);

/// A file that the shot names.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Digest {
    hash: String,
    /// Of the files that a model names: paths from the shot's folder, and hashes.
    parts: Vec<(String, String)>,
}

impl Digests {
    /// Reads the files of a shot and hashes them; no mesh is built.
    ///
    /// # Errors
    /// Files that cannot be read, each at the key that names it.
    pub fn read(shot: &Shot) -> Result<Self, Mistakes> {
        let mut digests = IndexMap::new();
        let mut mistakes = Vec::new();
        let models = shot.model.iter().enumerate();
        let models = models.map(|(i, model)| (format!("model[{i}].file"), model.file.as_path()));
        let models: Vec<_> = models.collect();
        let is_model = |number: usize| number < models.len();
        let files = models.iter().cloned().chain(shot.data_files());
        for (number, (key, file)) in files.enumerate() {
            if digests.contains_key(file) {
                continue;
            }
            let path = shot.beside(file);
            let digest = if is_model(number) {
                model(shot, file, &path).map_err(|error| error.to_string())
            } else {
                data(&path).map_err(|error| error.to_string())
            };
            match digest {
                Ok(digest) => drop(digests.insert(file.to_owned(), digest)),
                Err(message) => mistakes.push(shot.places.mistake(&key, message, None)),
            }
        }
        if mistakes.is_empty() {
            Ok(Self(digests))
        } else {
            Err(Mistakes::new(&shot.places, mistakes))
        }
    }

    /// Paths, as the shot has them or from its folder, and hexadecimal hashes.
    pub fn iter(&self) -> impl Iterator<Item = (String, &str)> {
        self.0.iter().flat_map(|(path, digest)| {
            let own = (path.display().to_string(), digest.hash.as_str());
            let parts = digest.parts.iter();
            std::iter::once(own).chain(parts.map(|(path, hash)| (path.clone(), hash.as_str())))
        })
    }

    /// Hashes of one of the shot's files and of those that it names.
    pub(super) fn of(&self, file: &Path) -> Vec<&str> {
        let digest = self.0.get(file);
        let parts = digest.iter().flat_map(|digest| &digest.parts);
        let own = digest.iter().map(|digest| digest.hash.as_str());
        own.chain(parts.map(|(_, hash)| hash.as_str())).collect()
    }
}

/// A file that names no others; one beyond all limits is not read to its end.
fn data(path: &Path) -> io::Result<Digest> {
    let hash = rest(Hasher::new(), &mut File::open(path)?.take(MODEL_BYTES))?;
    let (hash, parts) = (hash.to_hex().to_string(), Vec::new());
    Ok(Digest { hash, parts })
}

/// A model and the files that it names.
fn model(shot: &Shot, file: &Path, path: &Path) -> Result<Digest, FileError> {
    let folder = shot.path.parent().unwrap_or(Path::new(""));
    let (mut files, opened) = ModelFiles::open(path, &[folder])?;
    let is_obj = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("obj"));
    let beside = file.parent().unwrap_or(Path::new(""));
    let mut hashes = HashMap::new();
    let mut parts = Vec::new();
    let mut add = |name: String, part: ModelFile| -> Result<(), FileError> {
        let hash = match hashes.entry(part.path.clone()) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(free) => *free.insert(part.read(|file| rest(Hasher::new(), file))?),
        };
        let name = beside.join(name).display().to_string();
        parts.push((name, hash.to_hex().to_string()));
        Ok(())
    };
    let hash = if is_obj {
        let (hash, libraries) = opened.read(obj)?;
        for line in libraries {
            let libraries = files.libraries(&line)?.into_iter();
            for (name, part) in libraries.filter_map(|library| library.found) {
                add(name, part)?;
            }
        }
        hash
    } else {
        let (hash, uris) = opened.read(gltf)?;
        for uri in uris {
            // Which buffers are used, and so missed, only their reader knows: each may be the only
            // one, with all the bytes to itself.
            match files.clone().part_by_uri(&uri) {
                Ok(Some(part)) => add(uri, part)?,
                Ok(None)
                | Err(
                    FileError::Outside { .. }
                    | FileError::Uri { .. }
                    | FileError::NotAFile { .. }
                    | FileError::TooLarge { .. },
                ) => {}
                Err(error) => return Err(error),
            }
        }
        hash
    };
    Ok(Digest {
        hash: hash.to_hex().to_string(),
        parts,
    })
}

/// The hash of what `hasher` has seen and of the rest of a file.
fn rest(mut hasher: Hasher, file: &mut impl Read) -> io::Result<Hash> {
    io::copy(file, &mut hasher)?;
    Ok(hasher.finalize())
}

/// The hash of an OBJ file, and what its `mtllib` lines name.
fn obj(file: &mut impl BufRead) -> io::Result<(Hash, IndexSet<String>)> {
    let mut hasher = Hasher::new();
    let mut libraries = IndexSet::new();
    let seen = BufReader::new(Seen(file, &mut hasher));
    let Ok(()) = each_obj_line(seen, |_, line| -> Result<(), Infallible> {
        if let ("mtllib", name) = keyword_and_rest(line) {
            libraries.insert(name.to_owned());
        }
        Ok(())
    })?;
    Ok((hasher.finalize(), libraries))
}

/// A file whose bytes are hashed as they are read.
struct Seen<'a, R>(&'a mut R, &'a mut Hasher);

impl<R: Read> Read for Seen<'_, R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.0.read(bytes)?;
        self.1.update(&bytes[..count]);
        Ok(count)
    }
}

/// The hash of a glTF or glb file, and the URIs of its buffers; images are not read.
fn gltf(file: &mut impl Read) -> io::Result<(Hash, IndexSet<String>)> {
    /// Header of a glb file and of its first chunk, the JSON.
    const HEADER: u64 = 20;
    let mut hasher = Hasher::new();
    let mut json = Vec::new();
    file.take(HEADER).read_to_end(&mut json)?;
    let length = match json.as_slice() {
        [b'g', b'l', b'T', b'F', .., a, b, c, d, _, _, _, _] if json.len() as u64 == HEADER => {
            let length = u64::from(u32::from_le_bytes([*a, *b, *c, *d]));
            hasher.update(&json);
            json.clear();
            length
        }
        _ => u64::MAX,
    };
    file.take(length).read_to_end(&mut json)?;
    hasher.update(&json);
    // What is no JSON is the loader's to refuse.
    let named = GltfJson::parse(&json).unwrap_or_default().value;
    let buffers = named["buffers"].as_array().into_iter().flatten();
    let uris = buffers.filter_map(|buffer| buffer["uri"].as_str());
    let uris = uris.filter(|uri| !uri.starts_with("data:"));
    let uris = uris.map(str::to_owned).collect();
    Ok((rest(hasher, file)?, uris))
}
