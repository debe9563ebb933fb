//! The JSON of a file: its version, its required extensions, and its structure in the crate's
//! types.

use super::extensions;
use crate::model::{ModelError, Warning};
use crate::shot::{GltfJson, TextFault};
use ::gltf::json::Root;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Sections of a file that are read by way of the crate's types; nothing else can make a file fail.
const READ: [&str; 8] = [
    "accessors",
    "bufferViews",
    "buffers",
    "materials",
    "meshes",
    "nodes",
    "scene",
    "scenes",
];

/// The JSON in the crate's types and as it is, with required extensions checked.
pub(super) fn parse(
    text: &[u8],
    file: &Path,
    warnings: &mut Vec<Warning>,
) -> Result<(Root, Value), ModelError> {
    let failed = |reason| ModelError::Json {
        file: file.to_owned(),
        reason,
    };
    let GltfJson { value: raw, faults } =
        GltfJson::parse(text).map_err(|error| failed(error.to_string()))?;
    warnings.extend(faults.into_iter().map(|fault| match fault {
        TextFault::NotUtf8 { line } => Warning::NotUtf8 { line },
        TextFault::ControlCharacters => Warning::ControlCharacters,
    }));
    check_version(&raw, file, warnings)?;
    extensions::require(&raw, file, warnings)?;
    let root = serde_json::from_value(shown(&raw));
    let root = root.map_err(|error: serde_json::Error| failed(located(&raw, &error)))?;
    Ok((root, raw))
}

/// Refuses every version except 2.
fn check_version(raw: &Value, file: &Path, warnings: &mut Vec<Warning>) -> Result<(), ModelError> {
    let asset = &raw["asset"];
    // Before 2.0, objects were used in place of lists.
    let is_old = ["meshes", "nodes", "scenes"]
        .iter()
        .any(|key| raw[key].is_object());
    let found = match &asset["version"] {
        Value::Null if is_old => Some((1, 0)),
        value => version(value),
    };
    let refused = |found: String, remedy| ModelError::Version {
        file: file.to_owned(),
        found,
        remedy,
    };
    match found {
        Some((2, _)) => {}
        Some((major @ 0..2, minor)) => {
            return Err(refused(format!("is glTF {major}.{minor}"), CONVERT));
        }
        Some((major, minor)) => {
            return Err(refused(format!("is glTF {major}.{minor}"), EXPORT));
        }
        None => {
            let found = asset
                .get("version")
                .map_or("missing".to_owned(), Value::to_string);
            return Err(ModelError::Json {
                file: file.to_owned(),
                reason: format!("its asset.version is {found}, expected \"2.0\"; export it again"),
            });
        }
    }
    if asset["version"].is_number() {
        warnings.push(Warning::VersionNumber);
    }
    match version(&asset["minVersion"]) {
        Some(least @ (major, minor)) if least > (2, 0) => {
            let found = format!("needs a reader of glTF {major}.{minor} (its asset.minVersion)");
            Err(refused(found, EXPORT))
        }
        _ => Ok(()),
    }
}

/// Remedy for a file of glTF 1.0.
pub(super) const CONVERT: &str =
    "convert it to 2.0, for instance by `gltf-pipeline -i OLD.gltf -o NEW.glb`";
const EXPORT: &str = "export it as glTF 2.0";

/// Major and minor version, from text or a number.
fn version(value: &Value) -> Option<(u32, u32)> {
    let text = match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        _ => return None,
    };
    let mut parts = text.trim().split('.').map(str::parse);
    let major = parts.next()?.ok()?;
    let minor = parts.next().unwrap_or(Ok(0)).ok()?;
    Some((major, minor))
}

/// The part of the JSON for the crate's types: without extensions, which are read directly, and
/// with the lists of nodes that scenes may leave out.
fn shown(raw: &Value) -> Value {
    let mut shown = json!({ "asset": { "version": "2.0" } });
    for key in READ {
        if let Some(value) = raw.get(key).filter(|value| !value.is_null()) {
            shown[key] = plain(value);
        }
    }
    let scenes = shown.get_mut("scenes").and_then(Value::as_array_mut);
    for scene in scenes.into_iter().flatten() {
        if let Some(scene) = scene.as_object_mut() {
            scene.entry("nodes").or_insert(json!([]));
        }
    }
    shown
}

fn plain(value: &Value) -> Value {
    let is_plain = |(key, value): &(&String, &Value)| {
        !["extensions", "extras"].contains(&key.as_str()) && !value.is_null()
    };
    match value {
        Value::Array(list) => list.iter().map(plain).collect(),
        Value::Object(map) => {
            let members = map.iter().filter(is_plain);
            let members: Map<String, Value> = members
                .map(|(key, value)| (key.clone(), plain(value)))
                .collect();
            members.into()
        }
        other => other.clone(),
    }
}

/// The crate's message on JSON that does not have the structure of glTF, with the first item at
/// fault.
fn located(raw: &Value, error: &serde_json::Error) -> String {
    let items = READ.iter().flat_map(|&key| {
        let list = raw[key].as_array().into_iter().flatten();
        list.enumerate()
            .map(move |(index, item)| (key, index, item))
    });
    let mut faults = items.filter_map(|(key, index, item)| {
        let alone = serde_json::from_value::<Root>(shown(&json!({ key: [item] })));
        alone.err().map(|error| format!("{key}[{index}]: {error}"))
    });
    let said = faults.next().unwrap_or_else(|| error.to_string());
    said.replace(
        "index into child of root",
        "a whole number that counts items from 0",
    )
}
