//! The two chunks of a glb file.
//!
//! Source: Khronos glTF 2.0 specification, section 4 (GLB file format).

use super::json::CONVERT;
use crate::model::ModelError;
use std::path::Path;

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
