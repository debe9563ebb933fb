//! The bytes of a file's buffers: the glb's own chunk, data URIs, files beside the model.

use super::super::ModelError;
use super::invalid;
use crate::shot::ModelFiles;
use ::gltf::json::Root;
use std::borrow::Cow;

/// Every buffer, cut to the length that the JSON gives it.
pub(super) fn load<'a>(
    root: &Root,
    binary: Option<&'a [u8]>,
    files: &mut ModelFiles,
) -> Result<Vec<Cow<'a, [u8]>>, ModelError> {
    let mut buffers = Vec::new();
    for (index, buffer) in root.buffers.iter().enumerate() {
        let at = format!("buffer {index}");
        let mut bytes = match (&buffer.uri, binary, index) {
            (Some(uri), _, _) => Cow::Owned(from_uri(uri, files)?),
            (None, Some(binary), 0) => Cow::Borrowed(binary),
            _ => {
                return Err(invalid(
                    &files.model,
                    &at,
                    "has no uri, and there is no chunk for it",
                ));
            }
        };
        let (length, found) = (buffer.byte_length.0, bytes.len());
        if length > found as u64 {
            let problem = format!(
                "is to have {length} bytes but only {found} are there: copy the file again"
            );
            return Err(invalid(&files.model, &at, problem));
        }
        match &mut bytes {
            Cow::Borrowed(bytes) => *bytes = &bytes[..length as usize],
            Cow::Owned(bytes) => bytes.truncate(length as usize),
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

fn from_uri(uri: &str, files: &mut ModelFiles) -> Result<Vec<u8>, ModelError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
        let encoded = encoded.ok_or_else(|| files.bad_uri(uri, "data but not in base64"))?;
        return base64::decode(encoded).map_err(|_| files.bad_uri(uri, "not valid base64").into());
    }
    Ok(files.part_by_uri(uri)?.bytes()?)
}
