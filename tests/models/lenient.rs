//! glTF files that break a rule, or use a rare one, and are plain all the same: read as they are
//! meant, with a warning where something is left out.

use super::bad::{data, refusal, triangle, with_buffer, write};
use super::shapes::{floats, read};
use base64::prelude::{BASE64_STANDARD, Engine};
use glam::{DQuat, DVec3};
use restframe::model::{Model, Warning, load};
use serde_json::{Value, json};

/// The triangle after `change`.
fn changed(change: impl FnOnce(&mut Value)) -> Model {
    let mut gltf = triangle();
    change(&mut gltf);
    read(&gltf)
}

/// The triangle, read without a warning.
fn is_the_triangle(model: &Model) -> bool {
    (model.triangles(), model.area()) == (1, 0.5) && model.warnings.is_empty()
}

/// Unit normals of all triangles by their winding, turned as a mirrored placement turns them.
fn fronts(model: &Model) -> Vec<DVec3> {
    let front = |(placement, [a, b, c]): (usize, [DVec3; 3])| {
        let world = model.placements[placement].world;
        assert!(world.inverse().is_finite());
        (b - a).cross(c - a).normalize() * world.matrix3.determinant().signum()
    };
    model.world_triangles().map(front).collect()
}

#[test]
fn a_last_row_that_is_rounded_is_taken_for_0_0_0_1() {
    for (at, value) in [
        (15, 0.999_999_940_395_355_2),
        (15, 1.000_009),
        (3, 9e-6),
        (7, -9e-6),
    ] {
        let mut matrix = glam::DMat4::IDENTITY.to_cols_array();
        matrix[at] = value;
        assert!(is_the_triangle(&changed(
            |g| g["nodes"][0]["matrix"] = json!(matrix)
        )));
        matrix[at] += 2e-5 * f64::signum(value - 0.5);
        let message = refusal(|g| g["nodes"][0]["matrix"] = json!(matrix));
        assert!(message.contains("not affine"), "{at}: {message}");
    }
}

#[test]
fn a_stride_of_zero_is_none() {
    let model = changed(|gltf| {
        for view in gltf["bufferViews"].as_array_mut().unwrap() {
            view["byteStride"] = json!(0);
        }
    });
    assert!(is_the_triangle(&model));
}

#[test]
fn a_flat_thing_on_a_flat_scale_keeps_its_area_and_its_front() {
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, 2.5, 0.3, -1.1);
    for (scale, sign) in [
        ([1.0_f64, 1.0, 0.0], 1.0),
        ([2.0, 3.0, 0.0], 1.0),
        ([-2.0, 3.0, 0.0], 1.0),
        ([-2.0, -3.0, 0.0], 1.0),
        ([1.0, 1.0, -0.0], 1.0),
        ([1e-9, 1e-9, 0.0], 1.0),
        ([1.0, 1.0, 1e-14], 1.0),
        // What is mirrored through its own plane shows its back there, as with a scale of −1.
        ([1.0, 1.0, -1e-14], -1.0),
    ] {
        for turn in [DQuat::IDENTITY, turn] {
            let place = DVec3::new(5.0, 6.0, 7.0) * scale[0].abs();
            let model = changed(|gltf| {
                gltf["nodes"][0]["scale"] = json!(scale);
                gltf["nodes"][0]["rotation"] = json!(turn.to_array());
                gltf["nodes"][0]["translation"] = json!(place.to_array());
            });
            let area = (scale[0] * scale[1]).abs() / 2.0;
            assert!((model.area() / area - 1.0).abs() < 1e-12, "{scale:?}");
            let expected = turn * DVec3::Z * sign;
            assert!(fronts(&model)[0].distance(expected) < 1e-12, "{scale:?}");
            assert!(model.warnings.is_empty(), "{:?}", model.warnings);
            let reach = 4.0 * scale[0].abs();
            assert!(model.bounds().unwrap().0.distance(place) < reach);
        }
    }
}

#[test]
fn flat_scales_above_and_in_a_matrix_are_flat_scales_too() {
    let above = changed(|gltf| {
        gltf["nodes"] = json!([
            { "scale": [1, 1, 0], "rotation": [0, 1, 0, 0], "children": [1] },
            { "mesh": 0, "translation": [0, 0, 9] },
        ]);
    });
    assert_eq!(above.area(), 0.5);
    // Half a turn about y shows the back.
    assert!(fronts(&above)[0].distance(DVec3::NEG_Z) < 1e-12);
    assert!(above.bounds().unwrap().1.z.abs() < 1e-12);
    let matrix = [0, 0, 3, 0, 0, 2, 0, 0, 0, 0, 0, 0, 4, 5, 6, 1];
    let model = changed(|gltf| gltf["nodes"][0]["matrix"] = json!(matrix));
    assert_eq!(model.area(), 3.0);
    assert!(fronts(&model)[0].distance(DVec3::NEG_X) < 1e-12);
    assert_eq!(model.bounds().unwrap().0, DVec3::new(4.0, 5.0, 6.0));
}

#[test]
fn of_a_solid_thing_on_a_flat_scale_the_sides_alone_are_left_out() {
    // A tetrahedron: one face in the plane, one along the lost direction, two aslant.
    let corners = [
        0., 0., 0., 1., 0., 0., 0., 1., 0., // below
        0., 0., 0., 0., 0., 1., 1., 0., 0., // at y = 0, upright
        0., 0., 0., 0., 1., 0., 0., 0., 1., // at x = 0, upright
        1., 0., 0., 0., 0., 1., 0., 1., 0., // aslant
    ];
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, 0.5, 0.3, -1.1);
    for turn in [DQuat::IDENTITY, turn] {
        let mut gltf = with_buffer(&floats(&corners), triangle());
        gltf["bufferViews"][0]["byteLength"] = json!(144);
        gltf["accessors"][0]["count"] = json!(12);
        gltf["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0 } });
        gltf["nodes"] = json!([
            { "mesh": 0, "name": "Tent", "scale": [1, 1, 0], "rotation": turn.to_array() },
            { "mesh": 0, "name": "Again", "scale": [2, 2, 0] },
        ]);
        let model = read(&gltf);
        assert_eq!(model.triangles(), 4);
        assert!((model.area() - 5.0).abs() < 1e-12, "{}", model.area());
        assert_eq!(
            model.warnings,
            [Warning::Degenerate {
                mesh: "node `Tent`".into(),
                count: 2
            }]
        );
        // Both nodes share what is left of the mesh.
        assert_eq!((model.meshes.len(), model.placements[0].mesh), (2, 1));
        assert_eq!(model.placements[1].mesh, 1);
    }
}

#[test]
fn what_is_squashed_to_a_line_or_a_point_is_left_out_by_name() {
    for scale in [
        [1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 1.0],
        [1e-200; 3],
    ] {
        let model = changed(|gltf| {
            gltf["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "name": "Gone", "scale": scale }]);
        });
        assert_eq!(model.triangles(), 1, "{scale:?}");
        let node = "node `Gone`".to_owned();
        assert_eq!(model.warnings, [Warning::Squashed { node }], "{scale:?}");
    }
}

#[test]
fn an_accessor_without_data_is_all_zeros() {
    let model = changed(|gltf| {
        let zeros = json!({ "componentType": 5126, "count": 3, "type": "VEC3" });
        gltf["accessors"].as_array_mut().unwrap().push(zeros);
        gltf["meshes"][0]["primitives"] = json!([
            { "attributes": { "POSITION": 0 }, "indices": 1 },
            { "attributes": { "POSITION": 2 }, "indices": 1 },
            { "attributes": { "POSITION": 0, "NORMAL": 2 }, "indices": 1 },
        ]);
    });
    assert_eq!(model.triangles(), 2);
    assert_eq!(model.meshes[1].normals.as_ref().unwrap()[0].z, 1.0);
    assert_eq!(
        model.warnings,
        [
            Warning::Degenerate {
                mesh: "primitive 1 of mesh `mesh 0`".into(),
                count: 1
            },
            Warning::Normals {
                mesh: "primitive 2 of mesh `mesh 0`".into()
            }
        ]
    );
}

#[test]
fn sparse_values_over_zeros_are_read() {
    let mut bytes = vec![1u8, 2, 0, 0];
    bytes.extend(floats(&[1., 0., 0., 0., 1., 0.]));
    let mut gltf = with_buffer(&bytes, triangle());
    gltf["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 2 },
        { "buffer": 0, "byteOffset": 4, "byteLength": 24 },
    ]);
    gltf["accessors"] = json!([{ "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {
        "count": 2,
        "indices": { "bufferView": 0, "componentType": 5121 },
        "values": { "bufferView": 1 } } }]);
    gltf["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0 } });
    assert!(is_the_triangle(&read(&gltf)));
}

#[test]
fn geometry_that_is_there_in_compressed_form_alone_is_no_zeros() {
    let message = refusal(|gltf| {
        let zeros = json!({ "componentType": 5126, "count": 3, "type": "VEC3" });
        gltf["accessors"][0] = zeros;
        gltf["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
        gltf["meshes"][0]["primitives"][0]["extensions"] =
            json!({ "KHR_draco_mesh_compression": { "bufferView": 0 } });
    });
    assert!(message.contains("untick Data ▸ Compression"), "{message}");
    let message = refusal(|gltf| {
        gltf["buffers"]
            .as_array_mut()
            .unwrap()
            .push(json!({ "byteLength": 36 }));
        gltf["bufferViews"][0] = json!({ "buffer": 1, "byteLength": 36,
            "extensions": { "EXT_meshopt_compression": { "buffer": 0 } } });
    });
    assert!(message.contains("leave out -c"), "{message}");
}

#[test]
fn zero_bytes_after_the_json_are_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let text = triangle().to_string();
    let padded = [text.as_bytes(), &[0; 7]].concat();
    let path = write(folder.path(), "m.gltf", &padded);
    assert!(is_the_triangle(&load(&path, &[]).unwrap()));
    let path = write(folder.path(), "m.glb", &glb(&padded, 2));
    assert!(is_the_triangle(&load(&path, &[]).unwrap()));
}

/// A glb file of this JSON alone.
fn glb(json: &[u8], version: u32) -> Vec<u8> {
    let words = [version, 20 + json.len() as u32, json.len() as u32];
    let words = words.map(u32::to_le_bytes).concat();
    [b"glTF", &words[..], b"JSON", json].concat()
}

#[test]
fn data_uris_are_read_in_every_form() {
    let base64 = data(&triangle());
    let bytes = BASE64_STANDARD.decode(&base64).unwrap();
    let percent: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    let (front, back) = base64.split_at(20);
    for uri in [
        format!("data:application/octet-stream,{percent}"),
        format!("data:,{percent}"),
        format!("data:;base64,{base64}"),
        format!("DATA:application/gltf-buffer;charset=x;BASE64,{base64}"),
        format!("data:;base64,{front}\r\n  {back}\n"),
        format!("data:;base64,{front}%0D%0A%20{back}"),
        format!(
            "data:;base64,{}",
            base64.replace('+', "%2B").replace('/', "%2F")
        ),
        format!("data:;base64,{}", base64.trim_end_matches('=')),
    ] {
        let model = changed(|gltf| gltf["buffers"][0]["uri"] = json!(uri));
        assert!(is_the_triangle(&model), "{uri}");
    }
    // Raw line breaks are no JSON; they are read and told of.
    let folder = tempfile::tempdir().unwrap();
    let text = triangle().to_string().replace(front, &format!("{front}\n"));
    let model = load(&write(folder.path(), "m.gltf", text.as_bytes()), &[]).unwrap();
    assert_eq!(model.triangles(), 1);
    assert_eq!(model.warnings, [Warning::ControlCharacters]);
    let message = refusal(|gltf| gltf["buffers"][0]["uri"] = json!("data:nothing"));
    assert!(message.contains("without a comma"), "{message}");
}

#[test]
fn hidden_nodes_are_not_drawn_nor_do_their_children_or_lamps_shine() {
    let hidden = |visible: Value| json!({ "KHR_node_visibility": { "visible": visible } });
    let lamp = json!({ "KHR_lights_punctual": { "light": 0 } });
    let model = changed(|gltf| {
        gltf["extensionsUsed"] = json!(["KHR_node_visibility"]);
        gltf["extensionsRequired"] = json!(["KHR_node_visibility"]);
        gltf["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
        gltf["nodes"] = json!([
            { "mesh": 0, "name": "seen", "extensions": hidden(json!(true)) },
            { "mesh": 0, "extensions": hidden(json!(false)), "children": [2, 3] },
            { "mesh": 0, "extensions": hidden(json!(true)) },
            { "extensions": lamp },
            { "mesh": 0, "name": "too", "extensions": { "KHR_node_visibility": {} } },
        ]);
    });
    let nodes: Vec<&str> = model.placements.iter().map(|p| p.node.as_str()).collect();
    assert_eq!(nodes, ["seen", "too"]);
    assert!(model.lamps.is_empty());
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn of_scenes_without_a_default_the_first_that_has_nodes_is_shown() {
    let nodes = json!([{ "mesh": 0, "name": "a" }, { "mesh": 0, "name": "b" }]);
    let others = |count| Vec::from_iter((count > 0).then_some(Warning::OtherScenes { count }));
    for (scenes, seen, left_out) in [
        (json!([{ "nodes": [0] }, { "nodes": [1] }]), "a", 1),
        (json!([{ "nodes": [1] }, { "nodes": [0] }]), "b", 1),
        (json!([{ "name": "empty" }, { "nodes": [1] }]), "b", 0),
        (
            json!([{ "nodes": [] }, { "nodes": [1] }, { "nodes": [0] }]),
            "b",
            1,
        ),
        (json!([{ "nodes": [0] }, { "name": "empty" }]), "a", 0),
    ] {
        let model = changed(|gltf| {
            gltf["nodes"] = nodes.clone();
            gltf["scenes"] = scenes.clone();
        });
        assert_eq!(model.placements.len(), 1, "{scenes}");
        assert_eq!(model.placements[0].node, seen, "{scenes}");
        assert_eq!(model.warnings, others(left_out), "{scenes}");
    }
}

#[test]
fn whole_numbers_written_as_floats_are_whole() {
    fn float(value: &mut Value) {
        match value {
            Value::Number(number) => *value = json!(number.as_f64().unwrap()),
            Value::Array(list) => list.iter_mut().for_each(float),
            Value::Object(map) => map.values_mut().for_each(float),
            _ => {}
        }
    }
    let mut gltf = triangle();
    gltf["scenes"] = json!([{ "nodes": [0] }]);
    gltf["scene"] = json!(0);
    gltf["nodes"] = json!([{ "children": [1] }, { "mesh": 0,
        "extensions": { "KHR_lights_punctual": { "light": 0 } } }]);
    gltf["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    gltf["materials"] = json!([{ "name": "m" }]);
    gltf["meshes"][0]["primitives"][0]["material"] = json!(0);
    gltf["meshes"][0]["primitives"][0]["mode"] = json!(4);
    gltf["bufferViews"][0]["target"] = json!(34962);
    gltf["bufferViews"][0]["byteStride"] = json!(12);
    let expected = read(&gltf);
    float(&mut gltf);
    assert!(gltf.to_string().contains("5126.0"));
    assert_eq!(read(&gltf), expected);
    assert_eq!((expected.triangles(), expected.lamps.len()), (1, 1));
}

#[test]
fn what_is_no_whole_number_is_told_with_its_place() {
    let message = refusal(|gltf| gltf["nodes"][0]["mesh"] = json!(0.5));
    assert!(
        message.contains("nodes[0]: ") && message.contains("a whole number that counts items"),
        "{message}"
    );
}

#[test]
fn a_buffer_is_asked_for_when_it_is_used() {
    for unused in [
        json!({ "byteLength": 400 }),
        json!({ "byteLength": 400, "uri": "gone.bin" }),
        json!({ "byteLength": 400, "uri": "../../etc/passwd" }),
        json!({ "byteLength": 400, "uri": "https://example.org/x.bin" }),
        json!({ "byteLength": 400, "uri": "data:;base64,@@@" }),
        json!({ "byteLength": 1u64 << 50, "uri": "data:;base64,AAAA" }),
    ] {
        let model = changed(|gltf| {
            gltf["buffers"].as_array_mut().unwrap().push(unused.clone());
            let views = gltf["bufferViews"].as_array_mut().unwrap();
            views.push(json!({ "buffer": 1, "byteLength": 400 }));
            let accessors = gltf["accessors"].as_array_mut().unwrap();
            accessors.push(json!({ "bufferView": 2, "componentType": 5126, "count": 9,
                "type": "VEC3" }));
            // Of a mesh that no node has.
            let primitive = json!({ "attributes": { "POSITION": 2 } });
            let meshes = gltf["meshes"].as_array_mut().unwrap();
            meshes.push(json!({ "primitives": [primitive] }));
        });
        assert!(is_the_triangle(&model), "{unused}");
        let message = refusal(|gltf| {
            gltf["buffers"].as_array_mut().unwrap().push(unused.clone());
            gltf["bufferViews"][0]["buffer"] = json!(1);
        });
        assert!(message.contains("bad.gltf"), "{message}");
    }
}

#[test]
fn what_is_not_drawn_cannot_cost_the_file() {
    let model = changed(|gltf| {
        gltf["cameras"] = json!([{ "type": "perspective" }, 3]);
        gltf["images"] = json!({ "no": "list" });
        gltf["samplers"] = json!([{ "magFilter": "LINEAR" }]);
        gltf["skins"] = json!([{}]);
        gltf["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
        gltf["materials"] = json!(null);
        gltf["nodes"][0]["extras"] = json!([null, { "matrix": 3 }]);
        gltf["nodes"][0]["name"] = json!(null);
        gltf["meshes"][0]["primitives"][0]["extensions"] =
            json!({ "KHR_materials_variants": { "mappings": "none" } });
    });
    assert!(is_the_triangle(&model), "{:?}", model.warnings);
}

#[test]
fn names_in_another_encoding_are_read_as_far_as_they_can_be() {
    let folder = tempfile::tempdir().unwrap();
    let text = triangle().to_string();
    for (name, seen) in [
        (&b"T\xFCr"[..], "T\u{FFFD}r"),
        // In Shift-JIS, whose second byte here is a backslash.
        (b"\x95\x5C", "\u{FFFD}"),
        (b"a \x83\x5C\x83\x67", "a \u{FFFD}\u{FFFD}g"),
    ] {
        let at = text.find("Tri\"").unwrap();
        let bytes = [&text.as_bytes()[..at], name, &text.as_bytes()[at + 3..]].concat();
        let model = load(&write(folder.path(), "m.gltf", &bytes), &[]).unwrap();
        assert_eq!((model.triangles(), model.area()), (1, 0.5));
        assert_eq!(model.placements[0].node, seen);
        assert_eq!(model.warnings, [Warning::NotUtf8 { line: 1 }]);
    }
}

#[test]
fn versions_are_read_or_told_with_the_way_out() {
    for version in [json!("2.0"), json!("2.1"), json!("2")] {
        assert!(is_the_triangle(&changed(
            |g| g["asset"]["version"] = version
        )));
    }
    let least = |g: &mut Value| g["asset"]["minVersion"] = json!("2.0");
    assert!(is_the_triangle(&changed(least)));
    let number = changed(|g| g["asset"]["version"] = json!(2.0));
    assert_eq!(number.warnings, [Warning::VersionNumber]);
    assert!(
        number.warnings[0]
            .to_string()
            .contains("a number where text is expected")
    );
    let old = |gltf: &mut Value| *gltf = json!({ "nodes": {}, "meshes": { "m": {} } });
    for (message, expected) in [
        (
            refusal(|g| g["asset"]["version"] = json!("1.0")),
            "is glTF 1.0",
        ),
        (refusal(|g| g["asset"]["version"] = json!(1)), "is glTF 1.0"),
        (
            refusal(|g| g["asset"]["version"] = json!(0.8)),
            "is glTF 0.8",
        ),
        (refusal(old), "is glTF 1.0"),
    ] {
        let remedy = message.contains("expected 2.0: convert it to 2.0");
        assert!(message.contains(expected) && remedy, "{message}");
    }
    for (message, expected) in [
        (
            refusal(|g| g["asset"]["version"] = json!("3.0")),
            "is glTF 3.0",
        ),
        (
            refusal(|g| g["asset"]["minVersion"] = json!("2.1")),
            "needs a reader of glTF 2.1 (its asset.minVersion)",
        ),
        (
            refusal(|g| g["asset"] = json!({})),
            "asset.version is missing",
        ),
        (
            refusal(|g| g["asset"]["version"] = json!("new")),
            "asset.version is \"new\"",
        ),
        (
            refusal(|g| g["asset"]["version"] = json!([2])),
            "asset.version is [2]",
        ),
    ] {
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("export it"), "{message}");
    }
}

#[test]
fn a_glb_of_version_1_is_gltf_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "old.glb", &glb(b"{}", 1));
    let message = load(&path, &[]).unwrap_err().to_string();
    assert!(
        message.contains("glTF 1.0") && message.contains("convert it to 2.0"),
        "{message}"
    );
}

#[test]
fn a_buffer_is_found_as_its_name_is_meant() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = BASE64_STANDARD.decode(data(&triangle())).unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    for name in ["a%20b.bin", "c d.bin", "sub/e f.bin", "100%.bin"] {
        write(folder.path(), name, &bytes);
    }
    let named = |uri: &str| {
        let mut gltf = triangle();
        gltf["buffers"][0]["uri"] = json!(uri);
        let path = write(folder.path(), "m.gltf", gltf.to_string().as_bytes());
        load(&path, &[])
    };
    for uri in [
        "a%20b.bin",
        "a%2520b.bin",
        "c%20d.bin",
        "c d.bin",
        "sub/e%20f.bin",
        "sub\\e f.bin",
        ".\\sub\\e%20f.bin",
        "sub%5Ce f.bin",
        "100%.bin",
        "100%25.bin",
    ] {
        assert!(is_the_triangle(&named(uri).unwrap()), "{uri}");
    }
    // The name that the URI means goes before the one that it is.
    write(folder.path(), "a b.bin", &floats(&[0.0; 11]));
    assert!(named("a%20b.bin").is_err());
    for (uri, meant) in [
        ("C%20D.bin", "c d.bin"),
        ("Sub/E%20F.BIN", "sub/e f.bin"),
        ("SUB\\e f.bin", "sub/e f.bin"),
        ("c_d.bin", "c d.bin"),
    ] {
        let message = named(uri).unwrap_err().to_string();
        let hint = format!("did you mean `{meant}`?");
        assert!(message.contains(&hint), "{uri}: {message}");
    }
    let message = named("elsewhere.bin").unwrap_err().to_string();
    assert!(!message.contains("did you mean"), "{message}");
    for uri in ["..\\x.bin", "../x.bin", "%2e%2e%5cx.bin"] {
        let message = named(uri).unwrap_err().to_string();
        assert!(message.contains("outside the folders"), "{uri}: {message}");
    }
}
