//! Forms of glTF and OBJ that Blender's files do not show: strips, sparse and interleaved
//! accessors, instancing, deep trees, odd lines.

use super::bad::{refusal, triangle, with_buffer, write};
use glam::DVec3;
use restframe::model::{Model, Warning, load};
use serde_json::{Value, json};

pub(crate) fn read(gltf: &Value) -> Model {
    let folder = tempfile::tempdir().unwrap();
    load(
        &write(folder.path(), "m.gltf", gltf.to_string().as_bytes()),
        &[],
    )
    .unwrap()
}

fn read_obj(text: &str) -> Model {
    let folder = tempfile::tempdir().unwrap();
    load(&write(folder.path(), "m.obj", text.as_bytes()), &[]).unwrap()
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn a_triangle_is_read() {
    let model = read(&triangle());
    assert_eq!((model.triangles(), model.area()), (1, 0.5));
    assert_eq!(model.meshes[0].normals, None);
    assert_eq!(model.placements[0].node, "Tri");
}

#[test]
fn strips_and_fans_without_indices_keep_their_winding() {
    for (mode, square) in [
        (5, [0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]),
        (6, [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]),
    ] {
        let mut gltf = with_buffer(&floats(&square), triangle());
        gltf["meshes"][0]["primitives"][0] =
            json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        gltf["bufferViews"][0]["byteLength"] = json!(48);
        gltf["accessors"][0]["count"] = json!(4);
        let model = read(&gltf);
        assert_eq!((model.triangles(), model.area()), (2, 1.0), "mode {mode}");
        let up = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).z > 0.0;
        assert!(
            model.world_triangles().all(|(_, corners)| up(corners)),
            "mode {mode}"
        );
    }
}

#[test]
fn interleaved_and_sparse_accessors_are_read() {
    let mut bytes = floats(&[
        0., 0., 0., 0., 0., 2., 9., 9., 9., 0., 0., 2., 0., 1., 0., 0., 0., 2.,
    ]);
    bytes.extend([1u8, 0, 0, 0]);
    bytes.extend(floats(&[1., 0., 0.]));
    let mut gltf = with_buffer(&bytes, triangle());
    gltf["bufferViews"] = json!([
        { "buffer": 0, "byteLength": 72, "byteStride": 24 },
        { "buffer": 0, "byteOffset": 72, "byteLength": 1 },
        { "buffer": 0, "byteOffset": 76, "byteLength": 12 },
    ]);
    gltf["accessors"] = json!([
        { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {
            "count": 1,
            "indices": { "bufferView": 1, "componentType": 5121 },
            "values": { "bufferView": 2 } } },
        { "bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 3, "type": "VEC3" },
    ]);
    gltf["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0, "NORMAL": 1 } });
    let model = read(&gltf);
    assert_eq!(model.area(), 0.5);
    assert_eq!(
        model.meshes[0].normals.as_ref().unwrap()[0].to_array(),
        [0.0, 0.0, 1.0]
    );
}

#[test]
fn every_instance_of_gpu_instancing_stands() {
    let mut bytes = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    bytes.extend(floats(&[0., 0., 0., 5., 0., 0., 0., 0., 7.]));
    bytes.extend(floats(&[1., 1., 1., 2., 2., 2., 0., 1., 1.]));
    let mut gltf = with_buffer(&bytes, triangle());
    let views = gltf["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": 44, "byteLength": 36 }));
    views.push(json!({ "buffer": 0, "byteOffset": 80, "byteLength": 36 }));
    let accessors = gltf["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3" }));
    accessors.push(json!({ "bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3" }));
    gltf["nodes"][0]["translation"] = json!([0, 100, 0]);
    gltf["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing":
        { "attributes": { "TRANSLATION": 2, "SCALE": 3 } } });
    let model = read(&gltf);
    assert_eq!((model.meshes.len(), model.placements.len()), (1, 2));
    assert_eq!(
        model.placements[1].world.translation,
        DVec3::new(5.0, 100.0, 0.0)
    );
    assert_eq!(model.area(), 0.5 + 2.0);
    assert_eq!(
        model.warnings,
        [Warning::Squashed {
            node: "node `Tri`".into()
        }]
    );
}

/// The triangle at each of the places or scales that accessor 2 has.
fn instanced(attribute: &str, accessor: &Value) -> Value {
    let mut bytes = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    bytes.extend(floats(&[0.0; 300]));
    let mut gltf = with_buffer(&bytes, triangle());
    let views = gltf["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": 44, "byteLength": 1200 }));
    let accessors = gltf["accessors"].as_array_mut().unwrap();
    accessors.push(accessor.clone());
    gltf["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { attribute: 2 } } });
    gltf
}

#[test]
fn instances_that_cost_the_file_no_bytes_are_refused() {
    let sparse = json!({ "count": 1, "indices": { "bufferView": 2, "componentType": 5121 },
        "values": { "bufferView": 2 } });
    for (sparse, values) in [(Value::Null, 0), (sparse, 1)] {
        let mut accessor = json!({ "componentType": 5126, "count": 4 << 20, "type": "VEC3" });
        if sparse.is_object() {
            accessor["sparse"] = sparse;
        }
        for attribute in ["TRANSLATION", "SCALE"] {
            let message = refusal(|gltf| *gltf = instanced(attribute, &accessor));
            let expected = format!("4194304 instances of which the file holds only {values}");
            assert!(message.contains(&expected), "{message}");
        }
    }
}

#[test]
fn instances_squashed_to_nothing_count_and_are_told_once_a_node() {
    let accessor = json!({ "bufferView": 2, "componentType": 5126, "count": 100, "type": "VEC3" });
    let mut gltf = instanced("SCALE", &accessor);
    gltf["nodes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "mesh": 0 }));
    let model = read(&gltf);
    assert_eq!(model.placements.len(), 1);
    let node = "node `Tri`".into();
    assert_eq!(model.warnings, [Warning::Squashed { node }]);
    let mut more = accessor;
    more["count"] = json!(9_999_901);
    gltf["accessors"].as_array_mut().unwrap().push(more);
    gltf["nodes"][1]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "SCALE": 3 } } });
    let message = refusal(|bad| *bad = gltf);
    assert!(
        message.contains("10000001 instances of meshes"),
        "{message}"
    );
}

#[test]
fn a_chain_of_a_hundred_thousand_nodes_is_walked() {
    const DEPTH: usize = 100_000;
    let mut gltf = triangle();
    let mut nodes: Vec<Value> = (1..=DEPTH)
        .map(|i| json!({ "children": [i], "translation": [0.001, 0, 0] }))
        .collect();
    nodes.push(json!({ "mesh": 0 }));
    gltf["nodes"] = json!(nodes);
    let model = read(&gltf);
    assert!((model.placements[0].world.translation.x - 100.0).abs() < 1e-6);
}

#[test]
fn transforms_are_read_in_double_precision() {
    let mut gltf = triangle();
    gltf["nodes"][0]["translation"] = json!([1_000_000_000.000001, 0.1, 0]);
    let found = read(&gltf).placements[0].world.translation;
    assert_eq!(found, DVec3::new(1_000_000_000.000001, 0.1, 0.0));
}

#[test]
fn the_default_scene_is_shown_and_others_are_told_of() {
    let mut gltf = triangle();
    gltf["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0, "scale": [0, 1, 1] }]);
    assert_eq!(read(&gltf).placements.len(), 2);
    gltf["scenes"] = json!([{ "nodes": [1, 2] }, { "nodes": [0] }]);
    assert_eq!(read(&gltf).placements.len(), 1);
    gltf["scene"] = json!(1);
    let model = read(&gltf);
    assert_eq!(model.placements.len(), 1);
    assert_eq!(model.warnings, [Warning::OtherScenes { count: 1 }]);
}

#[test]
fn a_pointer_channel_does_not_lose_the_file() {
    let mut gltf = triangle();
    gltf["extensionsUsed"] = json!(["KHR_animation_pointer"]);
    gltf["animations"] = json!([{
        "samplers": [{ "input": 1, "output": 1 }],
        "channels": [{ "sampler": 0, "target": { "path": "pointer",
            "extensions": { "KHR_animation_pointer": { "pointer": "/materials/0/emissiveFactor" } } } }],
    }]);
    let model = read(&gltf);
    assert_eq!(model.triangles(), 1);
    assert_eq!(model.warnings, [Warning::Animations { count: 1 }]);
}

#[test]
fn what_the_picture_lacks_is_told_with_the_materials_name() {
    let mut gltf = triangle();
    gltf["materials"] = json!([
        { "name": "Glass", "alphaMode": "BLEND", "pbrMetallicRoughness": { "metallicFactor": 0 },
          "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 },
                          "KHR_materials_clearcoat": { "clearcoatFactor": 0 } } },
        { "name": "Unused", "alphaMode": "MASK" },
    ]);
    gltf["meshes"][0]["primitives"][0]["material"] = json!(0);
    gltf["extensionsUsed"] = json!(["ACME_glitter"]);
    let told: Vec<String> = read(&gltf)
        .warnings
        .iter()
        .map(Warning::to_string)
        .collect();
    assert_eq!(
        told,
        [
            "extension ACME_glitter is ignored; what it adds is not in the picture",
            "material `Glass`: is see-through by its alpha; it is drawn opaque, nothing shows through",
            "material `Glass`: KHR_materials_transmission is not drawn: it is opaque, in its base color",
        ]
    );
}

#[test]
fn odd_obj_lines_are_understood() {
    let text = "# c\r\n  v\t0 0 0 1 0 0\nv 2 0 0 2\nv 1 1 0\nv 0 1 0\nl 1 2 3 4\np 1\nvt 0.5\n\
                g two words\nusemtl no such\nf -4/1 -3/1 \\\n -2/1 -1/1\nwhatever 3\n";
    let model = read_obj(text);
    assert_eq!((model.triangles(), model.area()), (2, 1.0));
    assert_eq!(model.placements[0].node, "two words");
    assert_eq!(model.materials[0].name, "no such");
    let told: Vec<String> = model.warnings.iter().map(Warning::to_string).collect();
    assert!(
        told.iter()
            .any(|w| w.starts_with("material `no such`: faces use it")),
        "{told:?}"
    );
    assert!(
        told.iter().any(|w| w.contains("points and lines")),
        "{told:?}"
    );
}

#[test]
fn obj_parts_of_one_name_and_material_are_one_mesh() {
    let text = "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 3\no a\nusemtl m\nf 1//1 2//1 3//1\n\
                o b\nusemtl m\nf 1//1 2//1 3//1\no a\nusemtl m\nf 3//1 2//1 1//1\nusemtl n\nf 1 2 3\n";
    let model = read_obj(text);
    let nodes: Vec<_> = model.placements.iter().map(|p| p.node.as_str()).collect();
    assert_eq!(nodes, ["a", "b", "a"]);
    assert_eq!(model.meshes[0].triangles.len(), 2);
    assert_eq!(
        model.meshes[0].normals.as_ref().unwrap()[0].to_array(),
        [0.0, 0.0, 1.0]
    );
    assert_eq!(model.meshes[2].normals, None);
    assert!(model.warnings.contains(&Warning::MissingLibrary {
        name: "gone.mtl".into(),
        near: None,
    }));
}

#[test]
fn concave_polygons_in_any_plane_keep_area_and_winding() {
    // An arrow of area 0.5, in the plane of x = 2 y far from the origin.
    let arrow = [(0.0, 0.0), (1.0, -0.5), (2.0, 0.0), (1.0, 2.0), (0.9, 0.2)];
    let area: f64 = arrow
        .iter()
        .zip(arrow.iter().cycle().skip(1))
        .map(|((x, y), (u, v))| (x * v - u * y) / 2.0)
        .sum();
    let (x, y) = (DVec3::new(2.0, 1.0, 0.0).normalize(), DVec3::Z);
    let mut text = String::new();
    for (a, b) in arrow {
        let p = DVec3::new(1000.0, 500.0, -200.0) + a * x + b * y;
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    let model = read_obj(&(text + "f 1 2 3 4 5\n"));
    assert_eq!(model.triangles(), 3);
    assert!(
        (model.area() - area).abs() < 1e-9,
        "{} {area}",
        model.area()
    );
    let outwards = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).dot(x.cross(y)) > 0.0;
    assert!(
        model
            .world_triangles()
            .all(|(_, corners)| outwards(corners))
    );
}
