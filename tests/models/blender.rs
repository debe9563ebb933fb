//! Geometry, lamps and materials as Blender itself counts them.

use glam::{DMat3, DVec3};
use restframe::model::{LampKind, Model, Warning, load};
use serde_json::Value;
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_6;
use std::path::{Path, PathBuf};

/// Blender's numbers are printed to six places; coordinates in OBJ files are too.
const TOLERANCE: f64 = 1e-5;

pub(crate) fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn open(path: &str) -> Model {
    load(&here(path), &[]).unwrap()
}

fn expected(scene: &str) -> Value {
    let text = std::fs::read_to_string(here("tests/models/expected.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    all[scene].clone()
}

fn vector(value: &Value) -> DVec3 {
    let number = |i: usize| value[i].as_f64().unwrap();
    DVec3::new(number(0), number(1), number(2))
}

fn near(found: f64, expected: f64, what: &str) {
    let allowed = TOLERANCE * expected.abs().max(1.0);
    assert!(
        (found - expected).abs() <= allowed,
        "{what}: {found}, expected {expected}"
    );
}

fn near_vector(found: DVec3, expected: DVec3, what: &str) {
    near(
        (found - expected).length(),
        0.0,
        &format!("{what}: {found}, expected {expected}"),
    );
}

fn agrees(model: &Model, scene: &str) {
    let expected = expected(scene);
    assert_eq!(
        model.triangles() as u64,
        expected["triangles"].as_u64().unwrap(),
        "{scene}"
    );
    near(model.area(), expected["area"].as_f64().unwrap(), scene);
    let (low, high) = model.bounds().unwrap();
    near_vector(low, vector(&expected["bbox_min_gltf"]), scene);
    near_vector(high, vector(&expected["bbox_max_gltf"]), scene);
    for mesh in &model.meshes {
        let normals = mesh.normals.iter().flatten();
        assert!(
            normals.clone().all(|n| (n.length() - 1.0).abs() < 1e-5),
            "{scene}"
        );
        assert!(normals.clone().count() == 0 || normals.count() == mesh.positions.len());
    }
}

/// Area, triangles and signed volume of each object, the last about the middle of its box.
fn objects_agree(model: &Model, scene: &str) {
    let mut objects: HashMap<&str, Vec<[DVec3; 3]>> = HashMap::new();
    for (placement, corners) in model.world_triangles() {
        objects
            .entry(&model.placements[placement].node)
            .or_default()
            .push(corners);
    }
    for (name, object) in expected(scene)["objects"].as_object().unwrap() {
        let underscored = name.replace(' ', "_");
        let of_obj = objects
            .keys()
            .find(|key| is_group(key, &underscored))
            .copied();
        let Some(triangles) = objects.get(name.as_str()).or_else(|| objects.get(of_obj?)) else {
            // Blender names collection instances "Cell/Part"; their nodes are "Part".
            assert!(name.contains('/'), "{scene}: no object {name}");
            continue;
        };
        if name == "Two materials" && !objects.contains_key("Two_materials") {
            continue;
        }
        let points = || triangles.iter().flatten();
        let low = points().copied().reduce(DVec3::min).unwrap();
        let high = points().copied().reduce(DVec3::max).unwrap();
        let mid = (low + high) / 2.0;
        let six = |t: &[DVec3; 3]| (t[0] - mid).dot((t[1] - mid).cross(t[2] - mid));
        let area = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).length() / 2.0;
        let volume = triangles.iter().map(six).sum::<f64>() / 6.0;
        assert_eq!(
            triangles.len() as u64,
            object["triangles"].as_u64().unwrap(),
            "{name}"
        );
        near(
            triangles.iter().map(area).sum(),
            object["area"].as_f64().unwrap(),
            name,
        );
        // Blender's OBJ exporter turns the faces of mirrored objects outwards; glTF's does not.
        let by_blender = object["signed_volume"].as_f64().unwrap();
        let is_turned = scene.starts_with("obj-") && name.contains("mirrored");
        if name == "Twisted quad" {
            // Not planar: the sign tells which way it was cut, and both ways are right.
            near(volume.abs(), by_blender.abs(), name);
            continue;
        }
        near(
            volume,
            if is_turned { -by_blender } else { by_blender },
            name,
        );
    }
}

/// `Bar` is `Bar`, `Bar_Bar` or, by material groups, `Bar_grey`; `Crate` is not `Crate_mirrored`.
fn is_group(key: &str, name: &str) -> bool {
    let Some(rest) = key.strip_prefix(name) else {
        return false;
    };
    let is_mirror = rest.starts_with("_mirrored");
    rest.is_empty() || rest.starts_with('_') && !is_mirror
}

fn lamps_agree(model: &Model, scene: &str) {
    let expected = expected(scene);
    let lights = expected["lights"].as_object().unwrap();
    assert_eq!(model.lamps.len(), lights.len(), "{scene}");
    for lamp in &model.lamps {
        let light = &lights[&lamp.name];
        near(
            lamp.intensity,
            light["gltf_intensity"].as_f64().unwrap(),
            &lamp.name,
        );
        near_vector(
            DVec3::from(lamp.color),
            vector(&light["color_linear"]),
            &lamp.name,
        );
        near_vector(
            lamp.world.translation,
            vector(&light["position_gltf"]),
            &lamp.name,
        );
        let axes = lamp.world.matrix3;
        assert!(
            (axes.transpose() * axes).abs_diff_eq(DMat3::IDENTITY, 1e-12),
            "{}",
            lamp.name
        );
        assert!(axes.determinant() > 0.0, "{}", lamp.name);
        near_vector(-axes.z_axis, vector(&light["direction_gltf"]), &lamp.name);
        match (lamp.kind, light["type"].as_str().unwrap()) {
            (LampKind::Point, "point") | (LampKind::Sun, "directional") => {}
            (LampKind::Spot { inner, outer }, "spot") => {
                let expected = light["outer_cone_rad"].as_f64().unwrap();
                near(outer, expected, &lamp.name);
                near(
                    inner,
                    expected * (1.0 - light["spot_blend"].as_f64().unwrap()),
                    &lamp.name,
                );
            }
            (kind, expected) => panic!("{}: {kind:?}, expected {expected}", lamp.name),
        }
    }
}

#[test]
fn blenders_spheres_have_blenders_measures() {
    for scene in ["sphere-rows", "sphere-array"] {
        let model = open(&format!("assets/{scene}.glb"));
        agrees(&model, scene);
        objects_agree(&model, scene);
        lamps_agree(&model, scene);
        assert_eq!(model.meshes.len(), 1, "instances share geometry");
        assert_eq!(
            model.placements.len() as u64,
            expected(scene)["mesh_instances"]
        );
        assert_eq!(model.warnings, []);
    }
}

#[test]
fn lamps_keep_blenders_candela_and_lux() {
    for (scene, kind) in [
        ("units-point", LampKind::Point),
        ("units-sun", LampKind::Sun),
        (
            "units-spot",
            LampKind::Spot {
                inner: FRAC_PI_6,
                outer: FRAC_PI_6,
            },
        ),
    ] {
        let model = open(&format!("tests/models/{scene}.glb"));
        agrees(&model, scene);
        lamps_agree(&model, scene);
        let found = model.lamps[0].kind;
        if let (LampKind::Spot { outer, .. }, LampKind::Spot { .. }) = (found, kind) {
            near(outer, FRAC_PI_6, scene);
        } else {
            assert_eq!(found, kind);
        }
        near_vector(
            DVec3::from(model.materials[0].base_color),
            DVec3::splat(0.5),
            scene,
        );
    }
}

#[test]
fn a_glowing_surface_has_the_radiance_blender_renders() {
    let model = open("tests/models/units-emissive.glb");
    assert_eq!(model.materials[0].emissive, [5.0, 2.5, 1.25]);
    assert!(model.materials[0].double_sided);
    assert_eq!(model.lamps, []);
}

#[test]
fn obj_scenes_have_blenders_measures_concave_caps_and_all() {
    for (file, scene) in [
        ("tests/models/zoo.obj", "obj-zoo"),
        ("tests/models/zoo-triangulated.obj", "obj-zoo"),
        ("tests/models/zoo-groups.obj", "obj-zoo"),
        ("tests/models/bar.obj", "obj-bar"),
        ("tests/models/vertex-colours.obj", "obj-vertex-colours"),
        ("assets/sphere.obj", "obj-sphere"),
    ] {
        let model = open(file);
        agrees(&model, scene);
        objects_agree(&model, scene);
        assert!(
            model
                .placements
                .iter()
                .all(|p| p.world == glam::DAffine3::IDENTITY)
        );
    }
}

#[test]
fn obj_materials_are_those_of_the_library() {
    for file in ["zoo", "zoo-triangulated", "zoo-groups"] {
        let model = open(&format!("tests/models/{file}.obj"));
        let find = |name: &str| model.materials.iter().find(|m| m.name == name).unwrap();
        assert_eq!(find("gold_metal").base_color, [1.0, 0.72, 0.3]);
        assert_eq!(find("lamp").emissive, [5.0, 4.5, 3.5]);
        assert_eq!(find("crate").base_color, [1.0; 3]);
        for (name, by_blender) in expected("obj-zoo")["by_material"].as_object().unwrap() {
            let name = name.replace(' ', "_");
            let mut alone = model.clone();
            alone.placements.retain(|p| {
                let material = alone.meshes[p.mesh].material.unwrap();
                alone.materials[material].name == name
            });
            assert_eq!(alone.triangles() as u64, by_blender["triangles"], "{name}");
            near(alone.area(), by_blender["area"].as_f64().unwrap(), &name);
        }
        let told = |text: &str| model.warnings.iter().any(|w| w.to_string().contains(text));
        assert!(
            told("material `crate`: its color texture"),
            "{:?}",
            model.warnings
        );
        assert!(
            told("material `pane`: is see-through"),
            "{:?}",
            model.warnings
        );
        assert!(
            told("material `gold_metal`: is a metal"),
            "{:?}",
            model.warnings
        );
        assert!(file != "zoo-groups" || model.meshes.iter().all(|mesh| mesh.normals.is_none()));
    }
    let colored = open("tests/models/vertex-colours.obj");
    assert!(matches!(
        colored.warnings[..],
        [Warning::VertexColors { .. }]
    ));
}

#[test]
fn the_lattice_cell_reaches_to_the_next_node_in_three_directions() {
    let model = open("assets/lattice-cell.obj");
    let (low, high) = model.bounds().unwrap();
    near_vector(low, DVec3::splat(-0.16), "low");
    near_vector(high, DVec3::splat(0.87), "high");
    let nodes: Vec<&str> = model.placements.iter().map(|p| p.node.as_str()).collect();
    assert_eq!(nodes, ["Sphere", "Bar_x", "Bar_y", "Bar_z"]);
    let materials: Vec<&str> = model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(materials, ["Sphere_red", "Bar_grey"]);
    assert_eq!(model.warnings, []);
    for mesh in &model.meshes {
        let normals = mesh.normals.as_ref().unwrap();
        for &[a, b, c] in &mesh.triangles {
            let [p, q, r] = [a, b, c].map(|i| mesh.positions[i as usize]);
            let face = (q - p).cross(r - p).normalize();
            for corner in [a, b, c] {
                assert!(
                    face.dot(normals[corner as usize].as_dvec3()) > 0.9,
                    "outward"
                );
            }
        }
    }
}

#[test]
fn larger_scenes_have_blenders_measures() {
    let Ok(folder) = std::env::var("RESTFRAME_SCENES") else {
        eprintln!("skipped: set RESTFRAME_SCENES to the folder of Blender's exports");
        return;
    };
    for scene in ["street", "glass", "lattice", "lattice-3d"] {
        for file in [format!("{scene}.glb"), format!("{scene}/{scene}.gltf")] {
            let path = Path::new(&folder).join(file);
            if !path.exists() {
                eprintln!("skipped: {} is not there", path.display());
                continue;
            }
            let model = load(&path, &[]).unwrap();
            agrees(&model, scene);
            objects_agree(&model, scene);
            lamps_agree(&model, scene);
            for material in &model.materials {
                let by_blender = &expected(scene)["materials"][&material.name];
                let strength = by_blender["emission_strength"].as_f64().unwrap_or(0.0);
                if by_blender["base_color"].is_array() {
                    let color = vector(&by_blender["base_color"]);
                    near_vector(DVec3::from(material.base_color), color, &material.name);
                }
                if strength > 0.0 && by_blender["emission_color"].is_array() {
                    let light = vector(&by_blender["emission_color"]) * strength;
                    near_vector(DVec3::from(material.emissive), light, &material.name);
                }
                // The exporter makes materials with a volume one-sided, whatever Blender draws.
                let sided = by_blender["double_sided"].as_bool();
                if let Some(sided) = sided.filter(|_| material.name != "Glass volume") {
                    assert_eq!(material.double_sided, sided, "{}", material.name);
                }
            }
            for warning in &model.warnings {
                eprintln!("{scene}: {warning}");
            }
        }
    }
}
