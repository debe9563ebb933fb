//! The bytes of a file's buffers, each loaded on first use: the glb's own chunk, data URIs, files
//! beside the model.

use crate::model::ModelError;
use crate::shot::ModelFiles;
use ::gltf::json::Buffer;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};

/// Base64 with its padding or without.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The buffers of a file, by their index.
pub(super) struct Buffers<'a> {
    binary: Option<&'a [u8]>,
    files: RefCell<&'a mut ModelFiles>,
    loaded: Vec<OnceCell<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    /// `count` buffers, none of them loaded yet.
    pub(super) fn new(count: usize, binary: Option<&'a [u8]>, files: &'a mut ModelFiles) -> Self {
        Self {
            binary,
            files: RefCell::new(files),
            loaded: vec![OnceCell::new(); count],
        }
    }

    /// The bytes of a buffer, cut to the length in the JSON. The index is in range.
    pub(super) fn bytes(&self, index: usize, buffer: &Buffer) -> Result<&[u8], ModelError> {
        let cell = &self.loaded[index];
        match cell.get() {
            Some(bytes) => Ok(bytes),
            None => {
                let bytes = self.load(index, buffer)?;
                Ok(cell.get_or_init(|| bytes))
            }
        }
    }

    fn load(&self, index: usize, buffer: &Buffer) -> Result<Cow<'a, [u8]>, ModelError> {
        let files = &mut **self.files.borrow_mut();
        let at = format!("buffer {index}");
        let uri = buffer.uri.as_deref().filter(|uri| !uri.is_empty());
        let mut bytes = match (uri, self.binary, index) {
            (Some(uri), _, _) => Cow::Owned(from_uri(uri, files, &at)?),
            (None, Some(binary), 0) => Cow::Borrowed(binary),
            _ => {
                let problem = "has no uri, and there is no chunk for it: export as one .glb";
                return Err(ModelError::invalid(&files.model, &at, problem));
            }
        };
        let (length, found) = (buffer.byte_length.0, bytes.len());
        if length > found as u64 {
            let problem = format!(
                "is to have {length} bytes but only {found} are there: copy the file again"
            );
            return Err(ModelError::invalid(&files.model, &at, problem));
        }
        match &mut bytes {
            Cow::Borrowed(bytes) => *bytes = &bytes[..length as usize],
            Cow::Owned(bytes) => bytes.truncate(length as usize),
        }
        Ok(bytes)
    }
}

/// The bytes of a data URI, `data:[type][;base64],data` (RFC 2397), or of the file that a URI
/// names.
fn from_uri(uri: &str, files: &mut ModelFiles, at: &str) -> Result<Vec<u8>, ModelError> {
    const SCHEME: &str = "data:";
    let scheme = uri.get(..SCHEME.len());
    if !scheme.is_some_and(|scheme| scheme.eq_ignore_ascii_case(SCHEME)) {
        let part = files.part_by_uri(uri)?;
        return Ok(part.ok_or_else(|| files.missing(uri))?.bytes()?);
    }
    let broken = |problem: &str| {
        let remedy = "the file is cut short or broken; export it again, or as one .glb";
        ModelError::invalid(
            &files.model,
            at,
            format!("has a data URI {problem}: {remedy}"),
        )
    };
    let comma = uri[SCHEME.len()..].split_once(',');
    let (kind, data) = comma.ok_or_else(|| broken("without a comma before its data"))?;
    let bytes = urlencoding::decode_binary(data.as_bytes()).into_owned();
    let is_base64 = kind.rsplit(';').next().is_some_and(|parameter| {
        let parameter = parameter.trim();
        parameter.eq_ignore_ascii_case("base64")
    });
    if !is_base64 {
        return Ok(bytes);
    }
    // Blanks and line breaks do not count (RFC 2045, section 6.8).
    let mut letters = bytes;
    letters.retain(|byte| !byte.is_ascii_whitespace());
    let bytes = BASE64.decode(letters);
    bytes.map_err(|_| broken("that is not valid base64"))
}
