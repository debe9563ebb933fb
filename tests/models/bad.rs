//! Broken and hostile model files: refused by a message that names the fault, never by a panic.

use super::blender::here;
use base64::prelude::{BASE64_STANDARD, Engine};
use restframe::model::{ModelError, load};
use restframe::shot::FileError;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A file in a folder of its own.
pub(crate) fn write(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// A triangle over a data URI: 3 positions, then 3 u16 indices.
pub(crate) fn triangle() -> Value {
    let mut bytes = Vec::new();
    for value in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(value.to_le_bytes());
    }
    for index in [0u16, 1, 2] {
        bytes.extend(index.to_le_bytes());
    }
    with_buffer(
        &bytes,
        json!({
            "asset": { "version": "2.0" },
            "nodes": [{ "mesh": 0, "name": "Tri" }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                  "min": [0, 0, 0], "max": [1, 1, 0] },
                { "bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR" },
            ],
            "bufferViews": [
                { "buffer": 0, "byteLength": 36 },
                { "buffer": 0, "byteOffset": 36, "byteLength": 6 },
            ],
        }),
    )
}

pub(crate) fn with_buffer(bytes: &[u8], mut gltf: Value) -> Value {
    let uri = format!(
        "data:application/octet-stream;base64,{}",
        BASE64_STANDARD.encode(bytes)
    );
    gltf["buffers"] = json!([{ "byteLength": bytes.len(), "uri": uri }]);
    gltf
}

/// The message that refuses the JSON after `change`.
pub(crate) fn refusal(change: impl FnOnce(&mut Value)) -> String {
    let folder = tempfile::tempdir().unwrap();
    let mut gltf = triangle();
    change(&mut gltf);
    let path = write(folder.path(), "bad.gltf", gltf.to_string().as_bytes());
    load(&path, &[]).unwrap_err().to_string()
}

fn set(pointer: &'static str, value: Value) -> impl FnOnce(&mut Value) {
    move |gltf| *gltf.pointer_mut(pointer).unwrap() = value
}

#[test]
fn broken_json_values_are_refused_by_name() {
    for (pointer, value, expected) in [
        ("/accessors/0/count", json!(4), "accessor 0"),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            "vertices and indices",
        ),
        (
            "/accessors/0/count",
            json!(1u64 << 40),
            "vertices and indices",
        ),
        (
            "/accessors/0/componentType",
            json!(5123),
            "expected 3 of [F32]",
        ),
        ("/accessors/0/componentType", json!(7), "accessor 0"),
        ("/accessors/0/type", json!("VEC2"), "2 numbers"),
        ("/accessors/0/type", json!("MAT4"), "matrices"),
        ("/accessors/0/bufferView", json!(9), "buffer view 9"),
        (
            "/accessors/1/componentType",
            json!(5126),
            "expected 1 of U8",
        ),
        ("/accessors/1/count", json!(30), "accessor 1"),
        (
            "/bufferViews/0/byteLength",
            json!(1 << 20),
            "beyond its buffer",
        ),
        (
            "/bufferViews/0/byteLength",
            json!(u64::MAX),
            "beyond its buffer",
        ),
        ("/bufferViews/0/buffer", json!(3), "buffer 3"),
        (
            "/bufferViews/1/byteOffset",
            json!(u64::MAX),
            "beyond its buffer",
        ),
        ("/buffers/0/byteLength", json!(1 << 30), "buffer 0"),
        (
            "/buffers/0/uri",
            json!("../../../etc/passwd"),
            "outside the folders",
        ),
        ("/buffers/0/uri", json!("/etc/passwd"), "absolute or remote"),
        (
            "/buffers/0/uri",
            json!("file:///etc/passwd"),
            "absolute or remote",
        ),
        (
            "/buffers/0/uri",
            json!("https://example.org/x.bin"),
            "absolute or remote",
        ),
        (
            "/buffers/0/uri",
            json!("%2e%2e/%2e%2e/etc/passwd"),
            "outside the folders",
        ),
        ("/buffers/0/uri", json!("no such.bin"), "does not exist"),
        ("/buffers/0/uri", json!("."), "not a regular file"),
        ("/buffers/0/uri", json!("data:;base64,@@@"), "base64"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(77),
            "accessor 77",
        ),
        (
            "/meshes/0/primitives/0/attributes",
            json!({}),
            "no POSITION",
        ),
        ("/meshes/0/primitives/0/indices", json!(77), "accessor 77"),
        ("/nodes/0/mesh", json!(5), "mesh 5"),
        ("/asset/version", json!("1.0"), "expected 2.0"),
        ("/meshes/0/primitives", json!([]), "is empty"),
    ] {
        let message = refusal(set(pointer, value.clone()));
        assert!(message.contains(expected), "{pointer} = {value}: {message}");
    }
}

#[test]
fn broken_additions_are_refused_by_name() {
    let inf = |gltf: &mut Value| gltf["nodes"][0]["scale"] = json!([1e38, 1e38, 1e38]);
    let too_far = |gltf: &mut Value| {
        inf(gltf);
        gltf["nodes"] = json!([{ "scale": [1e38, 1, 1], "children": [1] }, gltf["nodes"][0]]);
    };
    for (message, expected) in [
        (refusal(too_far), "is not finite"),
        (
            refusal(|g| g["nodes"][0]["children"] = json!([0])),
            "its own ancestor",
        ),
        (
            refusal(|g| g["nodes"][0]["children"] = json!([8])),
            "node 8",
        ),
        (
            refusal(|g| g["scenes"] = json!([{ "nodes": [0, 0] }])),
            "its own ancestor",
        ),
        (
            refusal(|g| g["scenes"] = json!([{ "nodes": [4] }])),
            "node 4",
        ),
        (refusal(|g| g["scene"] = json!(4)), "scene 4"),
        (
            refusal(|g| g["nodes"][0]["rotation"] = json!([0, 0, 0, 0])),
            "quaternion",
        ),
        (
            refusal(|g| g["nodes"][0]["matrix"] = json!(vec![1; 16])),
            "not affine",
        ),
        (
            refusal(|g| g["nodes"][0]["matrix"] = json!(vec![1; 3])),
            "JSON",
        ),
        (
            refusal(|g| g["meshes"][0]["primitives"][0]["material"] = json!(1)),
            "material 1",
        ),
        (
            refusal(|g| g["meshes"][0]["primitives"][0]["mode"] = json!(9)),
            "mode",
        ),
        (
            refusal(|g| g["bufferViews"][0]["byteStride"] = json!(4)),
            "stride",
        ),
        (
            refusal(|g| {
                drop(
                    g["accessors"][0]
                        .as_object_mut()
                        .unwrap()
                        .remove("bufferView"),
                )
            }),
            "is empty",
        ),
    ] {
        assert!(message.contains(expected), "{expected}: {message}");
    }
}

#[test]
fn required_extensions_that_are_not_supported_are_named_with_the_way_out() {
    for (extension, remedy) in [
        ("KHR_draco_mesh_compression", "untick Data ▸ Compression"),
        ("EXT_meshopt_compression", "gltfpack"),
        ("KHR_mesh_quantization", "-noq"),
        ("EXT_texture_webp", "not WebP"),
        ("ACME_unheard_of", "export the model without it"),
    ] {
        let message = refusal(|gltf| gltf["extensionsRequired"] = json!([extension]));
        assert!(
            message.contains(extension) && message.contains(remedy),
            "{message}"
        );
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for value in [f32::NAN, f32::INFINITY] {
        let mut bytes = BASE64_STANDARD.decode(data(&triangle())).unwrap();
        bytes[4..8].copy_from_slice(&value.to_le_bytes());
        let message = refusal(|gltf| *gltf = with_buffer(&bytes, gltf.take()));
        assert!(
            message.contains("vertex 0 of mesh `mesh 0` is not finite"),
            "{message}"
        );
    }
    let mut bytes = BASE64_STANDARD.decode(data(&triangle())).unwrap();
    bytes[40..42].copy_from_slice(&900u16.to_le_bytes());
    let message = refusal(|gltf| *gltf = with_buffer(&bytes, gltf.take()));
    assert!(message.contains("vertex 900, but only 3"), "{message}");
}

/// The base64 of its only buffer.
pub(crate) fn data(gltf: &Value) -> String {
    gltf["buffers"][0]["uri"]
        .as_str()
        .unwrap()
        .split_once(',')
        .unwrap()
        .1
        .to_owned()
}

#[test]
fn every_truncation_of_a_glb_is_refused() {
    let whole = std::fs::read(here("tests/models/units-point.glb")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for length in 0..whole.len() {
        let path = write(folder.path(), "cut.glb", &whole[..length]);
        let error = load(&path, &[]).unwrap_err();
        assert!(matches!(error, ModelError::Glb { .. }), "{length}: {error}");
    }
}

#[test]
fn lying_lengths_of_a_glb_are_refused() {
    let whole = std::fs::read(here("tests/models/units-point.glb")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for at in [4, 8, 12, 16] {
        for value in [0u32, 1, 11, 1 << 20, u32::MAX - 7, u32::MAX] {
            let mut bytes = whole.clone();
            bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
            let path = write(folder.path(), "lies.glb", &bytes);
            assert!(load(&path, &[]).is_err(), "{value} at {at}");
        }
    }
}

#[test]
fn broken_obj_lines_are_refused_with_their_number() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
            "bad.obj:4: the face asks for position 4",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
            "bad.obj:4: the face asks for position -4",
        ),
        ("v 0 0 0\nvn 0 0 1\nf 1//2 1//2 1//2\n", "normal 2"),
        (
            "v 0 0 0\nf 1//-9223372036854775808 1 1\nvn 0 0 1\n",
            "normal -9223372036854775808",
        ),
        ("v 0 0 nan\n", "bad.obj:1: found `v 0 0 nan`"),
        ("v 0 0 1e300\n", "bad.obj:1"),
        ("v 0 0\n", "bad.obj:1"),
        ("v 0 0 0 0\n", "bad.obj:1"),
        ("v 0 0 0\nf 1 1\n", "is empty"),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", "corners such as"),
        ("v 0 0 0\nf a b c\n", "corners such as"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "is empty"),
        ("", "is empty"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "is empty"),
        ("<html>\n<body>\n", "is not an OBJ file: line 1"),
        (
            "mtllib ../../../etc/passwd\nv 0 0 0\n",
            "outside the folders",
        ),
    ] {
        let path = write(folder.path(), "bad.obj", text.as_bytes());
        let message = load(&path, &[]).unwrap_err().to_string();
        assert!(message.contains(expected), "{text:?}: {message}");
    }
}

#[test]
fn a_broken_library_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let obj = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let path = write(folder.path(), "m.obj", obj);
    for (text, expected) in [
        ("newmtl a\nKd 1 2\n", "m.mtl:2"),
        ("newmtl a\nKd spectral x.rfl\n", "3 numbers"),
        ("newmtl a\nKe -1 0 0\n", "expected 0 or more"),
        ("newmtl a\nKd nan 0 0\n", "not finite"),
    ] {
        write(folder.path(), "m.mtl", text.as_bytes());
        let message = load(&path, &[]).unwrap_err().to_string();
        assert!(message.contains(expected), "{text:?}: {message}");
    }
}

#[test]
fn the_broken_models_kept_for_the_command_line_are_each_refused_for_their_fault() {
    for (file, expected) in [
        ("truncated.glb", "is no valid glb file"),
        ("index-out-of-range.gltf", "vertex 7, but only 3"),
        ("empty.obj", "is empty"),
        ("cyclic-nodes.gltf", "its own ancestor"),
        ("climbs-out.gltf", "outside the folders"),
        ("not-a-model.obj", "is not an OBJ file"),
        ("no-such-file.obj", "does not exist"),
        ("README.md", "ending in .obj, .gltf or .glb"),
    ] {
        let message = load(&here("tests/bad-models").join(file), &[])
            .unwrap_err()
            .to_string();
        assert!(message.contains(expected), "{file}: {message}");
    }
}

#[test]
fn a_part_is_read_from_a_folder_that_is_allowed_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let models = folder.path().join("models");
    std::fs::create_dir(&models).unwrap();
    let mut gltf = triangle();
    write(
        folder.path(),
        "my part.bin",
        &BASE64_STANDARD.decode(data(&gltf)).unwrap(),
    );
    gltf["buffers"][0]["uri"] = json!("../my%20part.bin");
    let path = write(&models, "m.gltf", gltf.to_string().as_bytes());
    assert!(matches!(
        load(&path, &[]),
        Err(ModelError::File(FileError::Outside { .. }))
    ));
    assert!(matches!(
        load(&path, &[Path::new("/proc")]),
        Err(ModelError::File(FileError::Outside { .. }))
    ));
    assert_eq!(load(&path, &[folder.path()]).unwrap().triangles(), 1);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../my part.bin", models.join("link.bin")).unwrap();
        gltf["buffers"][0]["uri"] = json!("link.bin");
        write(&models, "m.gltf", gltf.to_string().as_bytes());
        assert!(matches!(
            load(&path, &[]),
            Err(ModelError::File(FileError::Outside { .. }))
        ));
    }
}
