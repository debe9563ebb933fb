//! Fingerprints: what changes them, of which frames, and what does not.

use super::desk::house;
use crate::common::desk::Desk;
use restframe::frame::FrameFingerprint;
use std::time::Instant;

const SHOT: &str = r##"
# A comment.
[shot]
title = "House"
frames = 9
fps = 25
time = 0.5
[image]
size = [64, 36]
samples = 3
[worldline.w]
velocity = { keys = [[1, [0, 0, 0]], [4, [0.5, 0, 0]], [7, [0.5, 0.25, 0]]] }
[worldline.other]
velocity = [0, 0, 0.5]
[[model]]
name = "house"
file = "house.obj"
worldline = "w"
[material.wall]
diffuse = { spectrum = "paint" }
thermal = { temperature = { from = 0, to = 800 } }
[spectrum.paint]
file = "paint.csv"
[[light]]
name = "lamp"
kind = "point"
position = [0, 1, 3]
intensity = 1000
[camera]
position = [0, 0, 4]
pan = 1
[sensor]
exposure = 1
[output]
formats = ["png"]
[sequence]
gif = false
"##;

/// The frames of two texts whose fingerprints differ.
fn differing(desk: &Desk, one: &str, other: &str) -> Vec<usize> {
    let (one, other) = (desk.all(one), desk.all(other));
    let frames = one.iter().zip(&other).enumerate();
    let differ = |(_, (a, b)): &(usize, (&FrameFingerprint, &FrameFingerprint))| {
        a.fingerprint != b.fingerprint
    };
    frames.filter(differ).map(|(i, _)| i + 1).collect()
}

/// The shot with one piece of its text replaced.
fn with(from: &str, to: &str) -> String {
    assert_eq!(SHOT.matches(from).count(), 1, "{from}");
    SHOT.replace(from, to)
}

#[test]
fn a_changed_keyframe_changes_exactly_the_frames_that_it_moves() {
    let desk = house();
    // The key on frame 4 leads from frame 1 to frame 7, both excluded.
    let moved = with("[4, [0.5, 0, 0]]", "[4, [0.6, 0, 0]]");
    assert_eq!(differing(&desk, SHOT, &moved), [2, 3, 4, 5, 6]);
    // The end of a ramp moves all but the first.
    let hotter = with("to = 800", "to = 900");
    assert_eq!(differing(&desk, SHOT, &hotter), [2, 3, 4, 5, 6, 7, 8, 9]);
    let last = with("[7, [0.5, 0.25, 0]]", "[7, [0.5, 0.125, 0]]");
    assert_eq!(differing(&desk, SHOT, &last), [5, 6, 7, 8, 9]);
}

#[test]
fn what_no_pixel_shows_changes_nothing() {
    let desk = house();
    desk.write("spare.csv", "400,0.1\n700,0.2\n");
    let without = |text: &str| {
        text.replace("\"paint\"", "0.5")
            .replace("[spectrum.paint]\nfile = \"paint.csv\"\n", "")
    };
    let bare = without(SHOT);
    let spare = format!("{bare}[spectrum.spare]\nconstant = 0.3\n");
    assert_eq!(
        differing(&desk, &bare, &spare),
        [0; 0],
        "the first spectrum of a shot, unused"
    );
    for (from, to) in [
        ("# A comment.", ""),
        ("\"House\"", "\"Home\""),
        ("fps = 25", "fps = 30"),
        (
            "gif = false",
            "gif = true\nvideo = \"mp4\"\nsheet = { columns = 3 }",
        ),
        ("intensity = 1000", "intensity = 1e3"),
        ("pan = 1", "pan = 1.0"),
        ("name = \"lamp\"", "name = \"lantern\""),
        ("time = 0.5", "light_speed = 1\ntime = 0.5"),
        (
            "[spectrum.paint]",
            "[spectrum.spare]\nconstant = 0.3\n[spectrum.paint]",
        ),
        (
            "[spectrum.paint]",
            "[spectrum.spare]\nfile = \"spare.csv\"\n[spectrum.paint]",
        ),
        (
            "[output]",
            "[output]\nlayers = [\"doppler\"]\ndepth = \"half\"",
        ),
        ("[\"png\"]", "[\"png\", \"png\"]"),
        (
            "title = \"House\"\nframes = 9",
            "frames = 9\ntitle = \"House\"",
        ),
        ("[worldline.other]\nvelocity = [0, 0, 0.5]\n", ""),
    ] {
        let mut text = with(from, to);
        if from.starts_with("[worldline.other]") {
            // The same table at the end of the file.
            text.push_str(from);
        }
        assert_eq!(differing(&desk, SHOT, &text), [0; 0], "{from} -> {to}");
    }
}

#[test]
fn a_longer_shot_keeps_the_frames_whose_values_stay() {
    let desk = house();
    let keyed = with("{ from = 0, to = 800 }", "800");
    let longer = keyed.replace("frames = 9", "frames = 12");
    assert_eq!(differing(&desk, &keyed, &longer), [0; 0]);
}

#[test]
fn whatever_reaches_pixels_changes_every_frame() {
    let desk = house();
    let all: Vec<usize> = (1..=9).collect();
    for (from, to) in [
        ("[64, 36]", "[128, 72]"),
        ("samples = 3", "samples = 4"),
        ("time = 0.5", "time = 0.50000000000000011"),
        ("pan = 1", "pan = 1.0000000000000002"),
        ("intensity = 1000", "intensity = 1001"),
        ("exposure = 1", "exposure = \"auto\""),
        ("[sensor]", "[accuracy]\nwavelengths = 85\n[sensor]"),
        ("[sensor]", "[effects]\nbounces = 3\n[sensor]"),
        ("[sensor]", "[[inset]]\n[sensor]"),
        (
            "[sensor]",
            "[[splice]]\nrows = [0, 0.5]\neffects = { doppler = \"off\" }\n[sensor]",
        ),
        ("[\"png\"]", "[\"png\", \"exr\"]"),
    ] {
        assert_eq!(
            differing(&desk, SHOT, &with(from, to)),
            all,
            "{from} -> {to}"
        );
    }
}

#[test]
fn the_order_of_worldlines_counts_where_a_layer_numbers_them() {
    let desk = house();
    let exr = with("[\"png\"]", "[\"exr\"]\nlayers = [\"worldline\"]");
    let other = "[worldline.other]\nvelocity = [0, 0, 0.5]\n";
    let moved = exr
        .replace(other, "")
        .replace("[worldline.w]", &format!("{other}[worldline.w]"));
    assert_eq!(differing(&desk, &exr, &moved).len(), 9);
    let png = |text: &str| text.replace("[\"exr\"]\nlayers = [\"worldline\"]", "[\"png\"]");
    assert_eq!(differing(&desk, &png(&exr), &png(&moved)), [0; 0]);
}

#[test]
fn a_metered_exposure_makes_every_frame_depend_on_the_first() {
    let desk = house();
    let metered = with("exposure = 1", "exposure = \"auto\"");
    let moved = metered.replace("[1, [0, 0, 0]]", "[1, [0.1, 0, 0]]");
    assert_eq!(differing(&desk, &metered, &moved).len(), 9);
    let parts = |text: &str| desk.all(text)[8].inputs.clone();
    let (was, is) = (parts(&metered), parts(&moved));
    let changed: Vec<_> = is
        .iter()
        .filter(|(key, value)| was.get(*key) != Some(value))
        .collect();
    assert_eq!(changed.len(), 1);
    assert_eq!(changed[0].0, "frame 1, on which exposure is metered");
    // Metering renders at a size and samples of its own, and knows no tone.
    let finer = metered.replace("samples = 3", "samples = 4");
    let key = "frame 1, on which exposure is metered";
    assert_eq!(parts(&finer)[key], was[key]);
}

#[test]
fn parts_are_named_and_valued_as_their_author_would_write_them() {
    let desk = house();
    let parts = desk.all(SHOT)[0].inputs.clone();
    for (key, value) in [
        ("camera.pan", "1.0"),
        ("worldline.w.velocity", "[0.0,0.0,0.0]"),
        ("material.wall.thermal.temperature", "0.0"),
        ("model[0].file", "\"house.obj\""),
        ("light[0].intensity", "1000.0"),
        ("sensor.exposure", "1.0"),
        ("size", "[64,36]"),
        ("samples", "3"),
        ("epoch", &restframe::frame::EPOCH.to_string()),
    ] {
        assert_eq!(
            parts.get(key).map(String::as_str),
            Some(value),
            "{key}: {parts:#?}"
        );
    }
    for file in ["file house.obj", "file paints.mtl", "file paint.csv"] {
        assert_eq!(parts[file].len(), 16);
    }
    assert!(!parts.contains_key("shot.title") && !parts.contains_key("image.size"));
    let long = SHOT.replace(
        "file = \"paint.csv\"",
        "points = [[400, 0.1], [500, 0.2], [600, 0.3], [700, 0.4]]",
    );
    let points = desk.all(&long)[0].inputs["spectrum.paint.points"].clone();
    assert!(points.starts_with('#') && points.len() == 17, "{points}");
}

/// Keys of a thousand frames took 190 ms as tests are built, on a machine with five times the load
/// that it has processors for; the bound is for slower ones.
#[test]
fn a_thousand_frames_have_their_keys_at_once() {
    let desk = house();
    let text = SHOT.replace("frames = 9", "frames = 1000");
    let keys = desk.keys(&text);
    let begun = Instant::now();
    let fingerprints: std::collections::HashSet<String> = (1..=1000)
        .map(|frame| keys.frame(frame).fingerprint)
        .collect();
    let seconds = begun.elapsed().as_secs_f64();
    eprintln!("keys of 1000 frames: {:.1} ms", 1e3 * seconds);
    assert_eq!(fingerprints.len(), 1000, "the ramp moves in every frame");
    assert!(seconds < 5.0, "{seconds} s");
}
