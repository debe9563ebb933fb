//! Extensions that a file requires: supported, harmless, or refused with a remedy.

use crate::model::{ModelError, Warning};
use serde_json::Value;
use std::path::Path;

/// Extensions besides KHR_materials_* without which a file can be read as well as with them.
const SUPPORTED: [&str; 6] = [
    "KHR_lights_punctual",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
    "EXT_mesh_gpu_instancing",
];

/// Extensions that are refused, with remedies.
const REMEDIES: [(&str, &str); 7] = [
    (
        "KHR_draco_mesh_compression",
        "in Blender's export untick Data ▸ Compression",
    ),
    (
        "EXT_meshopt_compression",
        "export without compression (gltfpack: leave out -c and -cc)",
    ),
    (
        "KHR_meshopt_compression",
        "export without compression (gltfpack: leave out -c and -cc)",
    ),
    (
        "KHR_mesh_quantization",
        "export floating-point positions (gltfpack: add -noq)",
    ),
    (
        "EXT_texture_webp",
        "in Blender's export set Material ▸ Images to Automatic, not WebP",
    ),
    ("EXT_texture_avif", "store textures as PNG or JPEG"),
    (
        "KHR_texture_basisu",
        "store textures as PNG or JPEG (gltfpack: leave out -tc)",
    ),
];

/// Refuses the first extension that is required and not supported; warns about others in use.
pub(super) fn require(
    raw: &Value,
    file: &Path,
    warnings: &mut Vec<Warning>,
) -> Result<(), ModelError> {
    for name in names(raw, "extensionsRequired", file)? {
        if !is_supported(name) {
            return Err(unsupported(name, file));
        }
    }
    for name in names(raw, "extensionsUsed", file)? {
        if !is_supported(name) {
            warnings.push(Warning::Extension {
                extension: name.to_owned(),
            });
        }
    }
    Ok(())
}

/// The error for a file that cannot be read without the extension.
pub(super) fn unsupported(name: &str, file: &Path) -> ModelError {
    let known = REMEDIES.iter().find(|(known, _)| *known == name);
    ModelError::Extension {
        file: file.to_owned(),
        extension: name.to_owned(),
        remedy: known.map_or("export the model without it", |(_, remedy)| remedy),
    }
}

fn is_supported(name: &str) -> bool {
    name.starts_with("KHR_materials_") || SUPPORTED.contains(&name)
}

fn names<'a>(raw: &'a Value, key: &str, file: &Path) -> Result<Vec<&'a str>, ModelError> {
    let Some(list) = raw.get(key) else {
        return Ok(Vec::new());
    };
    let names = list
        .as_array()
        .and_then(|list| list.iter().map(Value::as_str).collect());
    names.ok_or_else(|| ModelError::invalid(file, key, "is not a list of names"))
}
