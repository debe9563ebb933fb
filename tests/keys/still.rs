//! Shots at one frame: nothing moves, the text reads as an equal shot, and what it says of a
//! picture renders it again.

use super::desk::house;
use restframe::frame::Frame;
use restframe::shot::{Places, Sequence, Shot, parse, schema};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Two shots in which, between them, every value that may move does.
const MOVING: [&str; 2] = [include_str!("moving-1.toml"), include_str!("moving-2.toml")];

/// Every shot of the gallery, and those above.
fn shots() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let gallery = std::fs::read_dir(root.join("shots")).unwrap();
    let paths = gallery.map(|entry| entry.unwrap().path());
    let tomls = paths.filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let read = |path: PathBuf| (path.clone(), std::fs::read_to_string(path).unwrap());
    let moving = MOVING
        .iter()
        .map(|text| (root.join("shots/moving.toml"), (*text).to_owned()));
    tomls.map(read).chain(moving).collect()
}

/// Where in a file a key may stand, `*` for a name and `[]` for an index; spectra stand in many
/// places and count as one.
fn pattern(holder: &str, key: &str) -> String {
    match (holder, key) {
        ("", _) => key.to_owned(),
        (_, "spectrum" | "emissivity") if !holder.is_empty() => "spectrum.*".to_owned(),
        _ => format!("{holder}.{key}"),
    }
}

/// The patterns of the values of a schema that may move.
fn may_move(schema: &Value, root: &Value, at: &str, found: &mut BTreeSet<String>, depth: u32) {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.rsplit('/').next().unwrap();
        if name.starts_with("TrackOf") {
            found.insert(at.to_owned());
        } else if depth < 12 {
            may_move(&root["definitions"][name], root, at, found, depth + 1);
        }
    }
    for list in ["anyOf", "allOf", "oneOf"] {
        for form in schema[list].as_array().into_iter().flatten() {
            may_move(form, root, at, found, depth);
        }
    }
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        may_move(property, root, &pattern(at, key), found, depth);
    }
    if schema["items"].is_object() {
        may_move(&schema["items"], root, &format!("{at}[]"), found, depth);
    }
    if schema["additionalProperties"].is_object() {
        may_move(
            &schema["additionalProperties"],
            root,
            &format!("{at}.*"),
            found,
            depth,
        );
    }
}

/// The patterns of a shot's values that do move.
fn moves(value: &Value, at: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(track) if track.contains_key("from") || track.contains_key("keys") => {
            found.insert(at.to_owned());
        }
        Value::Object(table) => {
            let names = matches!(at, "material" | "worldline" | "spectrum");
            for (key, value) in table {
                let at = if names {
                    format!("{at}.*")
                } else {
                    pattern(at, key)
                };
                moves(value, &at, found);
            }
        }
        Value::Array(items) => items
            .iter()
            .for_each(|item| moves(item, &format!("{at}[]"), found)),
        _ => {}
    }
}

#[test]
fn no_track_survives_in_a_shot_of_one_frame() {
    let schema = schema();
    let mut all = BTreeSet::new();
    may_move(&schema, &schema, "", &mut all, 0);
    assert!(all.len() > 40, "{all:?}");
    let mut moving = BTreeSet::new();
    for text in MOVING {
        let shot = parse(text, &shots()[0].0).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        moves(&shot.to_json(), "", &mut moving);
        let mut left = BTreeSet::new();
        let still = shot.at(2);
        moves(&still.to_json(), "", &mut left);
        assert_eq!(left, BTreeSet::new());
        assert_eq!(still.shot.frames, 1);
    }
    let missed: Vec<_> = all.difference(&moving).collect();
    assert!(missed.is_empty(), "the moving shots lack {missed:?}");
}

/// All that a shot says, by a way that has nothing to do with how it is written.
fn said(shot: &Shot) -> String {
    let mut shot = shot.clone();
    shot.places = Places::default();
    shot.path = PathBuf::new();
    shot.sequence = Sequence::default();
    format!("{shot:?}")
}

#[test]
fn the_text_of_a_shot_reads_as_an_equal_shot() {
    for (path, text) in shots() {
        let shot = parse(&text, &path).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let middle = shot.shot.frames.div_ceil(2);
        for written in [
            shot.clone(),
            shot.at(1),
            shot.at(middle),
            shot.at(shot.shot.frames),
        ] {
            let text = written.to_toml();
            let read = parse(&text, &path)
                .unwrap_or_else(|mistakes| panic!("{}: {mistakes}\n{text}", path.display()));
            assert_eq!(said(&read), said(&written), "{}", path.display());
        }
    }
}

#[test]
fn a_shot_of_defaults_is_written_without_them() {
    let desk = house();
    let text = "[[model]]\nfile = \"house.obj\"\n\n[camera]\n";
    assert_eq!(desk.shot(text).to_toml(), text);
}

/// The text of a keyword of a PNG.
fn text_of(png: &[u8], keyword: &str) -> String {
    let reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let info = reader.info();
    let latin = info.uncompressed_latin1_text.iter();
    let mut texts = latin.filter(|chunk| chunk.keyword == keyword);
    texts.next().unwrap().text.clone()
}

fn pixels(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels
}

#[test]
fn a_frame_is_rendered_again_from_what_its_picture_says() {
    let desk = house();
    desk.write(
        "pass.toml",
        r#"
[shot]
title = "Past the house"
frames = 5
time = { from = 0, to = 1.7 }
[image]
size = [24, 18]
samples = 2
[worldline.house]
velocity = { from = [0.1, 0, 0], to = [0.7, 0, 0] }
[[model]]
file = "house.obj"
worldline = "house"
[material.roof]
thermal = { temperature = { from = 900, to = 3100 }, curve = "peak", strength = 0.01 }
[[light]]
kind = "point"
position = [0.3, 1, 4]
intensity = { keys = [[1, 100], [3, 333.3]] }
[camera]
position = [0, 0, 3]
pan = { from = -3, to = 3 }
[sequence]
gif = true
"#,
    );
    // Samples asked for in the call are written down too.
    desk.done("render pass.toml --progress none --frames 4 --samples 3");
    let first = std::fs::read(desk.path("renders/pass/pass.0004.png")).unwrap();
    let text = text_of(&first, "restframe:shot");
    assert!(!text.contains("gif") && !text.contains("auto"), "{text}");
    desk.write("again.toml", text);
    desk.done("render again.toml --progress none");
    let second = std::fs::read(desk.path("renders/again/again.0001.png")).unwrap();
    assert!(
        pixels(&first).iter().any(|value| *value > 0),
        "a black picture shows nothing"
    );
    assert_eq!(pixels(&first), pixels(&second));
    // Once resolved it says the same of itself.
    assert_eq!(
        text_of(&first, "restframe:shot"),
        text_of(&second, "restframe:shot")
    );
}

/// A sky that ramps from black while it moves; and two bodies of one name in one place, of which the
/// one that comes first in the order of bodies is seen.
const HOW_IT_IS_WRITTEN: [&str; 2] = [
    r#"
[shot]
frames = 3
[worldline.fast]
velocity = [0.5, 0, 0]
[background]
worldline = "fast"
spectrum = { from = 0, to = 0.01 }
[[model]]
file = "house.obj"
[[light]]
kind = "sun"
direction = [0, -0.3, -1]
intensity = 300
"#,
    r#"
[shot]
frames = 3
[[model]]
file = "house.obj"
material = "red"
translate = { from = [0, 0, 0], to = [0, 0, 1] }
[[model]]
file = "house.obj"
material = "blue"
translate = [0, 0, 0]
[material.red.emission]
spectrum = { rgb = [0.9, 0.1, 0.1] }
[material.blue.emission]
spectrum = { rgb = [0.1, 0.1, 0.9] }
"#,
];

const CAMERA: &str = r#"
[image]
size = [24, 18]
samples = 2
[camera]
position = [0, 0, 3]
[sensor]
exposure = 0
[output]
formats = ["png", "exr"]
"#;

#[test]
fn pixels_do_not_tell_whether_a_value_was_written_as_a_ramp_or_as_a_number() {
    for text in HOW_IT_IS_WRITTEN {
        let desk = house();
        desk.write("ramp.toml", format!("{text}{CAMERA}"));
        desk.done("render ramp.toml --progress none --frames 1");
        let file = |name: &str| std::fs::read(desk.path(name)).unwrap();
        let ramp = file("renders/ramp/ramp.0001.png");
        assert!(
            pixels(&ramp).iter().any(|value| *value > 0),
            "black: {text}"
        );
        desk.write("number.toml", text_of(&ramp, "restframe:shot"));
        desk.done("render number.toml --progress none");
        let number = file("renders/number/number.0001.png");
        assert_eq!(pixels(&ramp), pixels(&number), "{text}");
        let fingerprint = |png: &[u8]| text_of(png, "restframe:fingerprint");
        assert_eq!(fingerprint(&ramp), fingerprint(&number), "{text}");
        assert!(
            file("renders/ramp/ramp.0001.exr") == file("renders/number/number.0001.exr"),
            "{text}"
        );
    }
}

#[test]
fn what_a_frame_calls_for_is_what_the_shot_of_that_frame_alone_does() {
    let root = Path::new("shots/any.toml");
    let ramps = HOW_IT_IS_WRITTEN.map(|text| (root.to_owned(), format!("{text}{CAMERA}")));
    for (path, text) in shots().into_iter().chain(ramps) {
        let Ok(shot) = parse(&text.replace("house.obj", "../assets/sphere.obj"), &path) else {
            continue;
        };
        for frame in 1..=shot.shot.frames {
            let still = shot.at(frame);
            let alone = Frame::new(&still, 1)
                .unwrap()
                .active_effects(&still.effects);
            let called = Frame::new(&shot, frame)
                .unwrap()
                .active_effects(&shot.effects);
            assert_eq!(called, alone, "{}: {frame}", path.display());
        }
    }
}
