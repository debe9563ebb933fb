//! Trace keys: equal ones mean equal shade trees, whatever is changed; and what only shading reads
//! changes none.

use super::desk::house;
use crate::common::desk::Desk;
use rayon::prelude::*;
use restframe::frame::Frame;
use restframe::render::View;
use restframe::scene::{Library, Scene};
use restframe::shot::{Effects, Shot, parse};
use restframe::trace::{Samples, Scratch, ShadeTrees, build_aggregate};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fmt::Write;

/// A shot that has some of everything.
const RICH: &str = r#"
[shot]
time = 0.3
light_speed = 2.0
[image]
size = [8, 6]
samples = 2
[worldline.w]
velocity = [0.3, 0.1, 0]
passes = [0.1, 0, 0]
at = 0.05
[worldline.fast]
velocity = { gamma = 1.5, direction = [0, 0.1, 1] }
[worldline.turning]
velocity = { rapidity = 0.2, direction = [1, 0, 0.1] }
[[model]]
name = "house"
file = "house.obj"
worldline = "w"
rotate = [10, 20, 30]
translate = [0.1, 0.2, 0]
scale = 1.1
[[model]]
name = "mirror"
file = "wall.obj"
translate = [0, 0, -1.5]
scale = [3, 2, 1]
material = "mirror"
[[model]]
name = "pane"
file = "wall.obj"
worldline = "turning"
translate = [0.5, 0, 1.5]
scale = 0.4
array = { count = [2, 1, 1], step = [-0.9, 0.1, 0], centered = true }
material = "glass"
[material.wall]
diffuse = { weight = 0.9 }
highlight = { weight = 0.3, spectrum = "red", exponent = 30 }
thermal = { temperature = 1000, emissivity = 0.5, curve = "peak", strength = 0.1 }
[material.roof]
diffuse = { weight = 0.5, spectrum = "red" }
emission = { scale = 0.1, spectrum = 0.5 }
[material.mirror]
mirror = { weight = 0.8, spectrum = "silver" }
diffuse = { weight = 0.1, spectrum = 1.0 }
[material.glass]
mirror = { weight = 1.0, spectrum = 1.0 }
refraction = { weight = 0.9, spectrum = { constant = 0.95 }, ior = 1.4 }
[material.unused]
thermal = { temperature = 300 }
[spectrum.red]
points = [[400, 0.1], [500, 0.2], [700, 0.9]]
tension = 0.2
[spectrum.silver]
gaussian = { center = 550, width = 200 }
[[light]]
kind = "point"
name = "lamp"
worldline = "fast"
position = [1, 2, 3]
intensity = 100
spectrum = { blackbody = 3000 }
[[light]]
kind = "sun"
direction = [0.2, -1, -1]
scale = 0.1
spectrum = "red"
[[light]]
kind = "spot"
position = [0, 3, 1]
direction = [0, -1, -0.3]
inner = 10
outer = 40
intensity = 50
[background]
worldline = "lab"
spectrum = { rgb = [0.2, 0.3, 0.4] }
scale = 0.5
[camera]
worldline = "turning"
position = [0, 0.1, 4]
yaw = 1
pitch = 2
roll = 3
pan = 1
tilt = -1
hfov = 60
[effects]
beaming = "full"
bounces = 3
[[splice]]
rows = [0.5, 1.0]
effects = { doppler = "off", shadows = "off" }
[sensor]
exposure = 0.5
[accuracy]
spectra = "spline"
wavelengths = 8
cutoff = 0.01
"#;

/// The rich shot's folder.
fn desk() -> Desk {
    let desk = house();
    desk.write(
        "wall.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl none\nf 1 2 3 4\n",
    );
    desk
}

/// Its trace key and its shade trees, hashed; None where a change makes a shot that cannot be.
fn traced(desk: &Desk, text: &str) -> Option<(String, String)> {
    let shot = parse(text, &desk.path("shot.toml")).ok()?;
    let library = Library::load(&shot).ok()?;
    let scene = Scene::resolve(&Frame::new(&shot, 1).unwrap(), &library, None).ok()?;
    Some((desk.keys(text).frame(1).trace, trees(&shot, &scene)))
}

/// Text that is hashed and not kept: the trees of two mirrors may be long.
struct Hashing(blake3::Hasher);

impl Write for Hashing {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

/// All numbers of a shot's shade trees, hashed.
fn trees(shot: &Shot, scene: &Scene) -> String {
    let aggregate = build_aggregate(&scene.geometry, None);
    let samples = Samples::new(shot.image.samples, shot.image.filter);
    let [width, height] = shot.image.size;
    let mut all = Hashing(blake3::Hasher::new());
    write!(all, "{width} x {height}, {} samples", shot.image.samples).unwrap();
    let mut scratch = Scratch::default();
    let frame = Frame::new(shot, 1).unwrap();
    let view = |effects: &Effects| View::new(&frame, effects, scene, &aggregate);
    let whole = view(&frame.effects);
    let splices = frame.splices.iter();
    let parts: Vec<_> = splices
        .map(|splice| (splice.rows_of(height), view(&splice.effects)))
        .collect();
    for y in 0..height {
        let part = parts.iter().rev().find(|(rows, _)| rows.contains(&y));
        let view = part.map_or(&whole, |(_, view)| view);
        let looks = |x: u32, index: u32| {
            let [dx, dy] = samples.position(x, y, index);
            let point = [
                (f64::from(x) + dx) / f64::from(width),
                (f64::from(y) + dy) / f64::from(height),
            ];
            scene.camera.looks_along(point)
        };
        let rays = (0..width).flat_map(|x| (0..shot.image.samples).map(move |i| (x, i)));
        let directions: Vec<_> = rays.filter_map(|(x, i)| looks(x, i)).collect();
        let mut trees = ShadeTrees::default();
        view.tracer().trace(&directions, &mut scratch, &mut trees);
        write!(all, "{trees:?}").unwrap();
    }
    all.0.finalize().to_hex().to_string()
}

/// Every place of a value that a change may be made at: leaves, and whole keys.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(table) => {
            for (key, value) in table {
                let at = format!("{at}/{}", key.replace('~', "~0").replace('/', "~1"));
                found.push(at.clone());
                places(value, &at, found);
            }
        }
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                let at = format!("{at}/{i}");
                found.push(at.clone());
                places(item, &at, found);
            }
        }
        _ => {}
    }
}

/// Other values that may stand in place of one.
fn others(value: &Value) -> Vec<Value> {
    const WORDS: [&str; 16] = [
        "auto",
        "off",
        "square",
        "lab",
        "camera",
        "w",
        "red",
        "silver",
        "D65",
        "roof",
        "mirror",
        "f32",
        "sun",
        "equirectangular",
        "box",
        "bands",
    ];
    match value {
        Value::Number(n) if n.is_u64() => {
            let n = n.as_u64().unwrap();
            [0, 1, n + 1].into_iter().map(Value::from).collect()
        }
        Value::Number(n) => {
            let v = n.as_f64().unwrap();
            [0.0, v * 1.25 + 0.01, v * 0.5, -v, 1e-9]
                .into_iter()
                .map(Value::from)
                .collect()
        }
        Value::Bool(yes) => vec![json!(!yes)],
        Value::String(_) => WORDS.into_iter().map(Value::from).collect(),
        _ => Vec::new(),
    }
}

/// The rich shot with one thing changed, in every way.
fn variants(desk: &Desk) -> Vec<(String, String)> {
    let base = desk.shot(RICH).to_json();
    let mut all = Vec::new();
    places(&base, "", &mut all);
    let mut variants = Vec::new();
    // Without a size the image would be of the default one: a minute's work to show what the size
    // of `others` shows.
    all.retain(|place| !matches!(place.as_str(), "/image" | "/image/size"));
    for place in &all {
        let value = base.pointer(place).unwrap();
        for other in others(value) {
            let mut changed = base.clone();
            *changed.pointer_mut(place).unwrap() = other.clone();
            variants.push((
                format!("{place} = {other}"),
                toml::to_string(&changed).unwrap(),
            ));
        }
        let (holder, key) = place.rsplit_once('/').unwrap();
        let mut changed = base.clone();
        match changed.pointer_mut(holder).unwrap() {
            Value::Object(table) => drop(table.shift_remove(key)),
            Value::Array(items) => drop(items.remove(key.parse().unwrap())),
            _ => {}
        }
        variants.push((
            format!("{place} left out"),
            toml::to_string(&changed).unwrap(),
        ));
    }
    variants
}

#[test]
fn frames_of_one_trace_key_have_the_same_shade_trees_whatever_is_changed() {
    let desk = desk();
    let base = traced(&desk, RICH).unwrap();
    let mut by_key = HashMap::from([(base.0.clone(), (String::from("nothing"), base.1.clone()))]);
    let (mut sound, mut apart, mut together) = (0, 0, 0);
    let variants = variants(&desk);
    let answers: Vec<_> = variants
        .par_iter()
        .map(|(_, text)| traced(&desk, text))
        .collect();
    for ((change, _), answer) in variants.into_iter().zip(answers) {
        let Some((key, trees)) = answer else {
            continue;
        };
        sound += 1;
        apart += usize::from(key != base.0);
        together += usize::from(key == base.0);
        let (other, known) = by_key
            .entry(key)
            .or_insert_with(|| (change.clone(), trees.clone()));
        assert!(
            *known == trees,
            "{change} and {other} have one key and different trees"
        );
    }
    eprintln!(
        "{sound} shots, {apart} with a trace of their own, {together} with that of the first"
    );
    // Neither all nor none, or the test would show nothing.
    assert!(apart > 150 && together > 100, "{sound} {apart} {together}");
}

/// One thing of the rich shot changed.
fn with(from: &str, to: &str) -> String {
    assert!(RICH.contains(from), "{from}");
    RICH.replacen(from, to, 1)
}

#[test]
fn what_only_shading_reads_shares_the_trace() {
    let desk = desk();
    let base = traced(&desk, RICH).unwrap();
    for (from, to) in [
        ("temperature = 1000", "temperature = 0"),
        ("temperature = 1000", "temperature = 20000"),
        ("emissivity = 0.5", "emissivity = 0.1"),
        ("curve = \"peak\", strength = 0.1", "curve = \"absolute\""),
        ("strength = 0.1", "strength = 3"),
        ("emission = { scale = 0.1, spectrum = 0.5 }\n", ""),
        (
            "weight = 0.5, spectrum = \"red\"",
            "weight = 0.25, spectrum = { rgb = [0.1, 0.2, 0.3] }",
        ),
        ("weight = 0.3", "weight = 0.01"),
        ("[700, 0.9]", "[700, 0.7]"),
        ("blackbody = 3000", "blackbody = 9000"),
        ("intensity = 100", "intensity = 0.01"),
        (
            "scale = 0.1\nspectrum = \"red\"",
            "intensity = 7\nspectrum = { illuminant = \"A\" }",
        ),
        ("name = \"lamp\"\n", ""),
        (
            "exposure = 0.5",
            "exposure = \"auto\"\nwindow = [300, 1000]\ncolor = \"bands\"",
        ),
        (
            "beaming = \"full\"",
            "beaming = \"off\"\ndoppler = \"off\"\nthermal = \"off\"",
        ),
        (
            "doppler = \"off\", shadows",
            "beaming = \"square\", shadows",
        ),
        ("spectra = \"spline\"\nwavelengths = 8", "wavelengths = 100"),
        ("{ rgb = [0.2, 0.3, 0.4] }", "\"D65\""),
        ("{ rgb = [0.2, 0.3, 0.4] }", "2.5"),
        ("scale = 0.5\n[camera]", "scale = 7\n[camera]"),
        ("[shot]", "[shot]\ntitle = \"another\"\nfps = 30"),
        (
            "[accuracy]",
            "[output]\nformats = [\"png\"]\n[sequence]\ngif = true\n[accuracy]",
        ),
        ("[accuracy]", "[[inset]]\n[accuracy]"),
        (
            "[material.unused]\nthermal = { temperature = 300 }\n",
            "[material.unused]\n",
        ),
        ("spectrum = { constant = 0.95 }", "spectrum = 0.95"),
        ("worldline = \"lab\"\nspectrum", "spectrum"),
    ] {
        // The sky rides on the camera's worldline unless it is told otherwise.
        let text = with(from, to);
        let text = if to == "spectrum" {
            text.replace("[camera]\nworldline = \"turning\"", "[camera]")
        } else {
            text
        };
        let base = if to == "spectrum" {
            traced(
                &desk,
                &RICH.replace("[camera]\nworldline = \"turning\"", "[camera]"),
            )
            .unwrap()
        } else {
            base.clone()
        };
        let (key, trees) = traced(&desk, &text).unwrap_or_else(|| panic!("{from} -> {to}"));
        assert!(trees == base.1, "{from} -> {to} changes the shade trees");
        assert_eq!(key, base.0, "{from} -> {to}");
    }
}

#[test]
fn the_units_of_a_file_s_lamps_shade_anew_and_trace_nothing() {
    let desk = desk();
    desk.write(
        "lamp.gltf",
        r#"{ "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "scene": 0,
            "nodes": [{ "translation": [0, 2, 3],
                "extensions": { "KHR_lights_punctual": { "light": 0 } } }],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point" }] } } }"#,
    );
    let lit = |keys: &str| format!("{RICH}[[model]]\nfile = \"lamp.gltf\"\n{keys}");
    let (key, trees) = traced(&desk, &lit("")).unwrap();
    let fingerprint = |text: &str| desk.keys(text).frame(1).fingerprint;
    for units in ["unitless", "raw"] {
        let text = lit(&format!("light_units = \"{units}\"\n"));
        let (own_key, own_trees) = traced(&desk, &text).unwrap();
        assert!(own_trees == trees, "{units}");
        assert_eq!(own_key, key, "{units}");
        assert_ne!(fingerprint(&text), fingerprint(&lit("")), "{units}");
    }
}

#[test]
fn a_spectrum_s_name_and_the_shot_s_own_path_are_no_part_of_a_trace() {
    let desk = desk();
    let renamed = RICH
        .replace("\"red\"", "\"rouge\"")
        .replace("spectrum.red", "spectrum.rouge");
    let renamed = renamed
        .replace("\"silver\"", "\"argent\"")
        .replace(".silver", ".argent");
    assert_eq!(desk.all(&renamed)[0].trace, desk.all(RICH)[0].trace);
    let elsewhere = self::desk();
    assert_eq!(elsewhere.all(RICH)[0].trace, desk.all(RICH)[0].trace);
    elsewhere.write(
        "wall.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0.1\nusemtl none\nf 1 2 3 4\n",
    );
    assert_ne!(elsewhere.all(RICH)[0].trace, desk.all(RICH)[0].trace);
}

#[test]
fn a_ramp_of_temperature_is_one_trace_and_a_ramp_of_velocity_is_many() {
    let desk = desk();
    let frames = |text: String| {
        let text = text.replace("[shot]", "[shot]\nframes = 20");
        let keys = desk.all(&text);
        keys.into_iter()
            .map(|key| key.trace)
            .collect::<std::collections::HashSet<_>>()
            .len()
    };
    assert_eq!(
        frames(with(
            "temperature = 1000",
            "temperature = { from = 0, to = 20000 }"
        )),
        1
    );
    assert_eq!(
        frames(with(
            "[0.3, 0.1, 0]",
            "{ from = [0, 0, 0], to = [0.3, 0.1, 0] }"
        )),
        20
    );
    // A lamp that goes out is one thing less to aim at.
    assert_eq!(
        frames(with(
            "intensity = 100",
            "intensity = { from = 100, to = 0 }"
        )),
        2
    );
}

#[test]
fn a_lamp_lost_in_rounding_does_not_share_with_one_that_shines() {
    let desk = desk();
    for (from, to) in [
        ("intensity = 100", "intensity = 5e-324"),
        ("spectrum = { blackbody = 3000 }", "spectrum = 1e307"),
    ] {
        let lost = traced(&desk, &with(from, to)).unwrap();
        let base = traced(&desk, RICH).unwrap();
        assert!(
            lost.1 != base.1,
            "{to}: the lamp is not lost, and the test shows nothing"
        );
        assert_ne!(lost.0, base.0, "{to}");
    }
}
