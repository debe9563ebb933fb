//! A glTF file split into its parts: its JSON, its buffers, and the two chunks of a glb file.
//!
//! Source: Khronos glTF 2.0 specification, section 4 (GLB file format).

use super::buffers::Buffers;
use super::json::CONVERT;
use crate::model::ModelError;
use ::gltf::json::{Index, Root};
use serde_json::Value;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// A glTF file split into its parts; only its structure has been checked.
pub(super) struct Source<'a> {
    pub(super) file: PathBuf,
    pub(super) root: Root,
    /// The same JSON, for values that `root` lacks or rounds.
    pub(super) raw: Value,
    pub(super) buffers: Buffers<'a>,
    pub(super) elements_left: Cell<u64>,
}

impl Source<'_> {
    /// An item by its index, or the error that names the item that refers to it.
    pub(super) fn item<'a, T>(
        &self,
        list: &'a [T],
        index: Index<T>,
        what: &'static str,
        from: &str,
    ) -> Result<&'a T, ModelError> {
        let index = index.value();
        list.get(index)
            .ok_or_else(|| self.dangling(from, what, index, list.len()))
    }

    pub(super) fn dangling(
        &self,
        from: &str,
        what: &'static str,
        index: usize,
        count: usize,
    ) -> ModelError {
        let (file, from) = (self.file.clone(), from.to_owned());
        ModelError::Dangling {
            file,
            from,
            what,
            index,
            count,
        }
    }

    pub(super) fn invalid(&self, at: &str, problem: impl Into<String>) -> ModelError {
        ModelError::invalid(&self.file, at, problem)
    }
}

/// An item's name for messages: its own, or its kind and index.
pub(super) fn name_of(name: Option<&str>, kind: &str, index: usize) -> String {
    match name {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => format!("{kind} {index}"),
    }
}

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// A file's parts.
pub(super) struct Container<'a> {
    /// The JSON text.
    pub(super) json: &'a [u8],
    /// The binary chunk of a glb file.
    pub(super) binary: Option<&'a [u8]>,
}

/// Splits a file into its chunks. A file that neither begins as glb nor has its extension is JSON.
pub(super) fn split<'a>(bytes: &'a [u8], file: &Path) -> Result<Container<'a>, ModelError> {
    if bytes.starts_with(b"glTF") {
        return split_glb(bytes, file);
    }
    let is_called_glb = file
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("glb"));
    if is_called_glb && !bytes.trim_ascii_start().starts_with(b"{") {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4)]).into_owned();
        return Err(broken(file, 0, "the letters glTF", &format!("{start:?}")));
    }
    Ok(Container {
        json: bytes,
        binary: None,
    })
}

fn split_glb<'a>(bytes: &'a [u8], file: &Path) -> Result<Container<'a>, ModelError> {
    let version = word(bytes, 4, file)?;
    if version == 1 {
        return Err(ModelError::Version {
            file: file.to_owned(),
            found: "is glTF 1.0 (version 1 of glb)".to_owned(),
            remedy: CONVERT,
        });
    }
    if version != 2 {
        return Err(broken(file, 4, "version 2", &format!("version {version}")));
    }
    let length = word(bytes, 8, file)? as usize;
    let whole = bytes.get(HEADER..length).ok_or_else(|| {
        let found = format!("a length of {length} in a file of {}", bytes.len());
        broken(file, 8, "the file's length", &found)
    })?;
    let (mut json, mut binary) = (None, None);
    let mut at = 0;
    while at < whole.len() {
        let size = word(whole, at, file)? as usize;
        let kind = word(whole, at + 4, file)?;
        let start = at + CHUNK_HEADER;
        let data = whole
            .get(start..)
            .and_then(|rest| rest.get(..size))
            .ok_or_else(|| {
                let left = whole.len() - start;
                broken(
                    file,
                    HEADER + at,
                    &format!("a chunk within {left} bytes"),
                    &size.to_string(),
                )
            })?;
        match (kind, json) {
            (JSON, None) => json = Some(data),
            (BIN, Some(_)) if binary.is_none() => binary = Some(data),
            (_, None) => {
                return Err(broken(
                    file,
                    HEADER + at + 4,
                    "a JSON chunk",
                    &format!("{kind:#x}"),
                ));
            }
            _ => {}
        }
        at = start + size;
    }
    let json = json.ok_or_else(|| broken(file, HEADER, "a JSON chunk", "nothing"))?;
    Ok(Container { json, binary })
}

fn word(bytes: &[u8], at: usize, file: &Path) -> Result<u32, ModelError> {
    let four = bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
    four.map(|four| u32::from_le_bytes(*four))
        .ok_or_else(|| broken(file, at, "4 bytes", "the file's end"))
}

fn broken(file: &Path, byte: usize, expected: &str, found: &str) -> ModelError {
    let (expected, found) = (expected.to_owned(), found.to_owned());
    ModelError::Glb {
        file: file.to_owned(),
        byte,
        expected,
        found,
    }
}
