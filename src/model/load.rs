//! Choice of the importer by the kind of file.

use super::{Model, ModelError, gltf, obj};
use crate::shot::ModelFiles;
use std::path::Path;

/// Reads a model file: OBJ by its extension, glTF and glb by extension and content.
///
/// A file that the model names (buffers, material libraries) must be in the model's own folder or
/// one of `may_read`, or below, with links resolved; the model file itself may be anywhere.
///
/// # Errors
/// A file that is missing, broken, empty, too large, or requires something that is not supported.
///
/// # Example
/// ```
/// use restframe::model;
/// use std::path::Path;
///
/// let sphere = model::load(Path::new("assets/sphere.obj"), &[])?;
/// assert_eq!(sphere.meshes.len(), 1);
/// assert!((sphere.volume() - 4.18879).abs() < 0.1); // 4π/3, less the facets
/// # Ok::<(), model::ModelError>(())
/// ```
pub fn load(path: &Path, may_read: &[&Path]) -> Result<Model, ModelError> {
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_ascii_lowercase();
    if !["obj", "gltf", "glb"].contains(&extension.as_str()) {
        return Err(ModelError::UnknownKind {
            file: path.to_owned(),
        });
    }
    let (mut files, opened) = ModelFiles::open(path, may_read)?;
    let bytes = opened.bytes()?;
    let model = match extension.as_str() {
        "obj" => obj::read(bytes, &mut files),
        _ => gltf::read(&bytes, &mut files),
    }?;
    if model.placements.is_empty() && model.lamps.is_empty() {
        return Err(ModelError::Empty {
            file: path.to_owned(),
        });
    }
    Ok(model)
}
