//! Surfaces to which a file gives no material.

use super::bad::{triangle, write};
use restframe::frame::Frame;
use restframe::model::Warning;
use restframe::render::Prepared;
use restframe::scene::{Material, Scene, WeightedSpectrum};
use restframe::shot::Mistakes;
use serde_json::{Value, json};

const SHOT: &str =
    "[camera]\nposition = [0, 0, 5]\n[material.glow]\nemission = { spectrum = 1.0 }\n";

/// Two triangles, the second without material.
fn half_bare() -> Value {
    let mut gltf = triangle();
    let bare = gltf["meshes"][0]["primitives"][0].clone();
    gltf["meshes"][0]["primitives"][0]["material"] = json!(0);
    gltf["meshes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "primitives": [bare] }));
    gltf["nodes"] = json!([{ "mesh": 0, "name": "Red" }, { "mesh": 1, "name": "Bare" }]);
    gltf["materials"] = json!([{ "name": "Paint",
        "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.1, 0.1, 1], "metallicFactor": 0 } }]);
    gltf
}

const HALF_BARE_OBJ: &str =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no Bare\nf 1 2 3\no Red\nusemtl Paint\nf 1 2 3\n";

/// A file, the materials of its surfaces by name of the node, and what is warned of.
type Seen = (Vec<(String, Material)>, Vec<String>);

fn seen(file: &str, keys: &str) -> Result<Seen, Mistakes> {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "m.gltf", half_bare().to_string().as_bytes());
    let mut whole = half_bare();
    whole["meshes"][1]["primitives"][0]["material"] = json!(0);
    write(folder.path(), "whole.gltf", whole.to_string().as_bytes());
    write(folder.path(), "m.obj", HALF_BARE_OBJ.as_bytes());
    write(folder.path(), "m.mtl", b"newmtl Paint\nKd 0.8 0.1 0.1\n");
    let text = format!("[[model]]\nfile = \"{file}\"\n{keys}\n{SHOT}");
    let path = write(folder.path(), "shot.toml", text.as_bytes());
    let prepared = Prepared::read(&path)?;
    let scene = Scene::resolve(
        &Frame::new(&prepared.shot, 1).unwrap(),
        &prepared.library,
        None,
    )?;
    let nodes = if file.ends_with("obj") {
        ["Bare", "Red"]
    } else {
        ["Red", "Bare"]
    };
    let instances = scene.geometry.instances.iter();
    let materials = instances.map(|i| scene.materials[i.material as usize].clone());
    let warnings = prepared.library.warnings(&prepared.shot);
    let warnings = warnings.map(|(file, words)| format!("{}: {words}", file.display()));
    let by_node = nodes.map(str::to_owned).into_iter().zip(materials);
    Ok((by_node.collect(), warnings.collect()))
}

fn of<'a>(seen: &'a Seen, node: &str) -> &'a Material {
    &seen.0.iter().find(|(name, _)| name == node).unwrap().1
}

fn diffuse(material: &Material) -> Option<&WeightedSpectrum> {
    let lobe = material.bsdf.of_key("diffuse")?;
    Some(&lobe.reflectance)
}

#[test]
fn they_are_white_with_a_warning_that_names_them() {
    for file in ["m.gltf", "m.obj"] {
        let seen = seen(file, "").unwrap();
        let white = diffuse(of(&seen, "Bare")).unwrap();
        for nm in [400.0, 555.0, 700.0] {
            // To the rounding of spectra of colors.
            assert!(
                (white.weight * white.spectrum.at(nm) - 1.0).abs() < 1e-6,
                "{file} {nm}"
            );
        }
        assert_eq!(of(&seen, "Bare").emission, None);
        let red = diffuse(of(&seen, "Red")).unwrap();
        assert!(
            red.spectrum.at(650.0) > 3.0 * red.spectrum.at(500.0),
            "{file}"
        );
        let told: Vec<_> = seen
            .1
            .iter()
            .filter(|w| w.contains("no material"))
            .collect();
        assert_eq!(told.len(), 1, "{:?}", seen.1);
        assert!(
            told[0].starts_with(&format!("{file}: `Bare`: ")),
            "{}",
            told[0]
        );
        assert!(
            told[0].contains("materials = { \"\" = \"NAME\" }"),
            "{}",
            told[0]
        );
    }
}

#[test]
fn the_shot_can_name_them_alone() {
    for file in ["m.gltf", "m.obj"] {
        let seen = seen(file, "materials = { \"\" = \"glow\" }").unwrap();
        assert_eq!(of(&seen, "Bare").name, "glow");
        assert!(of(&seen, "Bare").emission.is_some() && diffuse(of(&seen, "Bare")).is_none());
        assert_eq!(of(&seen, "Red").name, "Paint");
        assert!(
            !seen.1.iter().any(|w| w.contains("no material")),
            "{:?}",
            seen.1
        );
    }
}

#[test]
fn a_material_for_all_is_theirs_too() {
    for file in ["m.gltf", "m.obj"] {
        let seen = seen(file, "material = \"glow\"").unwrap();
        assert_eq!(of(&seen, "Bare").name, "glow");
        assert_eq!(of(&seen, "Red").name, "glow");
        assert!(
            !seen.1.iter().any(|w| w.contains("no material")),
            "{:?}",
            seen.1
        );
    }
}

/// As a wall heats: one table for a file of any number of materials, and one of them cooler.
#[test]
fn the_material_star_is_laid_over_all_below_their_own() {
    let keys = "[material.\"*\"]\nthermal = { temperature = 900 }\n\
                emission = { spectrum = 0.5 }\n[material.Paint]\nthermal = { temperature = 300 }";
    for file in ["m.gltf", "m.obj"] {
        let seen = seen(file, keys).unwrap();
        let kelvin = |node| of(&seen, node).thermal.as_ref().unwrap().temperature_k;
        assert_eq!([kelvin("Bare"), kelvin("Red")], [900.0, 300.0], "{file}");
        for node in ["Bare", "Red"] {
            let material = of(&seen, node);
            assert_eq!(material.emission.as_ref().unwrap().spectrum.at(555.0), 0.5);
            assert!(diffuse(material).is_some(), "the file's own color stays");
        }
    }
    let mistakes = seen("m.gltf", "[material.\"*\"]\nmirror = { weight = 0.5 }").unwrap_err();
    assert_eq!(mistakes.iter().next().unwrap().key, "material.*.mirror");
}

#[test]
fn naming_them_where_there_are_none_is_a_mistake() {
    let mistakes = seen("whole.gltf", "materials = { \"\" = \"glow\" }").unwrap_err();
    let mistake = mistakes.iter().next().unwrap();
    assert_eq!(mistake.key, "model[0].materials.");
    assert!(
        mistake.message.contains("no surface without material"),
        "{}",
        mistake.message
    );
    let mistakes = seen("m.gltf", "materials = { \"\" = \"glwo\" }").unwrap_err();
    let mistake = mistakes.iter().next().unwrap();
    assert!(
        mistake.help.as_ref().unwrap().contains("\"glow\""),
        "{:?}",
        mistake.help
    );
}

#[test]
fn those_without_a_name_are_called_the_mesh() {
    let nodes = ["", "Bare"].map(str::to_owned).to_vec();
    let message = Warning::NoMaterial { nodes }.to_string();
    assert!(
        message.starts_with("the mesh, `Bare`: the file gives these surfaces no material"),
        "{message}"
    );
}
