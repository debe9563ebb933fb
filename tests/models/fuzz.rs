//! Random damage to small model files: any answer will do but a panic.

use super::bad::{triangle, with_buffer, write};
use super::blender::here;
use super::shapes::floats;
use proptest::prelude::*;
use restframe::model::load;
use serde_json::json;

/// Overwrites, deletes or repeats bytes.
fn damage(bytes: &mut Vec<u8>, wounds: &[(usize, u8, u8)]) {
    for &(at, kind, value) in wounds {
        if bytes.is_empty() {
            return;
        }
        let at = at % bytes.len();
        match kind % 4 {
            0 => bytes[at] = value,
            1 => bytes[at] ^= 1 << (value % 8),
            2 => drop(bytes.drain(at..(at + usize::from(value)).min(bytes.len()))),
            _ => bytes.insert(at, value),
        }
    }
}

/// Replaces whole numbers in the text, lengths kept where they can be.
fn renumber(bytes: &mut [u8], at: usize, digit: u8) {
    let digits: Vec<usize> = (0..bytes.len())
        .filter(|&i| bytes[i].is_ascii_digit())
        .collect();
    if let Some(&i) = digits.get(at % digits.len().max(1)) {
        bytes[i] = b'0' + digit % 10;
    }
}

/// A file of what exporters seldom write: flat scales, matrices, hidden nodes, zeros, sparse values,
/// strides of 0, percent-encoded data, buffers that are not there, Latin-1, floats for integers.
fn rare(name: &str) -> Vec<u8> {
    let mut bytes = vec![1u8, 2, 0, 0];
    bytes.extend(floats(&[1., 0., 0., 0., 1., 0.]));
    let mut gltf = with_buffer(&bytes, triangle());
    let percent: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    gltf["buffers"] = json!([
        { "byteLength": 28.0, "uri": format!("data:,{percent}") },
        { "byteLength": 9 },
        { "byteLength": 9, "uri": "no%20such\\file.bin" },
    ]);
    gltf["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 2, "byteStride": 0 },
        { "buffer": 0, "byteOffset": 4, "byteLength": 24 },
        { "buffer": 1, "byteLength": 9, "extensions": { "EXT_meshopt_compression": {} } },
    ]);
    gltf["accessors"] = json!([
        { "componentType": 5126, "count": 3.0, "type": "VEC3", "sparse": {
            "count": 2,
            "indices": { "bufferView": 0, "componentType": 5121 },
            "values": { "bufferView": 1 } } },
        { "componentType": 5126, "count": 3, "type": "VEC3" },
    ]);
    gltf["meshes"] = json!([
        { "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 1 } },
            { "attributes": { "POSITION": 1 } }] },
    ]);
    gltf["nodes"] = json!([
        { "mesh": 0, "scale": [1, 1, 0], "rotation": [0, 0.6, 0, 0.8] },
        { "mesh": 0, "matrix": [1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 4, 5, 6, 1] },
        { "mesh": 0, "extensions": { "KHR_node_visibility": { "visible": false } } },
        { "mesh": 0, "scale": [1e-30, 1e30, 0], "children": [2], "name": "T~r" },
    ]);
    gltf["scenes"] = json!([{ "name": "empty" }, { "nodes": [0, 1, 3] }]);
    let text = gltf.to_string();
    // A letter of Latin-1.
    let json: Vec<u8> = text
        .bytes()
        .map(|b| if b == b'~' { 0xFC } else { b })
        .collect();
    if name.ends_with("gltf") {
        return json;
    }
    let words = [2, 20 + json.len() as u32, json.len() as u32]
        .map(u32::to_le_bytes)
        .concat();
    [b"glTF", &words[..], b"JSON", &json].concat()
}

#[test]
fn the_rare_file_is_read_where_it_is_whole() {
    for name in ["rare.gltf", "rare.glb"] {
        let folder = tempfile::tempdir().unwrap();
        let model = load(&write(folder.path(), name, &rare(name)), &[]).unwrap();
        assert_eq!(model.triangles(), 2, "{:?}", model.warnings);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn damaged_models_do_not_panic(
        which in 0usize..7,
        wounds in prop::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 0..6),
        digits in prop::collection::vec((any::<usize>(), any::<u8>()), 0..4),
    ) {
        let file = ["units-spot.glb", "units-emissive.glb", "bar.obj", "bar.mtl", "zoo-groups.obj", "rare.gltf", "rare.glb"][which];
        let mut bytes = match file.strip_prefix("rare") {
            Some(_) => rare(file),
            None => std::fs::read(here("tests/models").join(file)).unwrap(),
        };
        damage(&mut bytes, &wounds);
        for (at, digit) in digits {
            // Only the text of a glb, which stands at its front.
            let end = bytes.len().min(if file.ends_with("glb") { 1600 } else { usize::MAX });
            renumber(&mut bytes[..end], at, digit);
        }
        let folder = tempfile::tempdir().unwrap();
        let path = match file.strip_suffix(".mtl") {
            Some(_) => {
                write(folder.path(), file, &bytes);
                let obj = std::fs::read(here("tests/models/bar.obj")).unwrap();
                write(folder.path(), "bar.obj", &obj)
            }
            None => write(folder.path(), file, &bytes),
        };
        if let Ok(model) = load(&path, &[]) {
            let total = model.area();
            prop_assert!(total >= 0.0 && model.bounds().is_some() || model.triangles() == 0);
            for mesh in &model.meshes {
                prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
            }
        }
    }
}
