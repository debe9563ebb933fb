//! `restframe plan` as its users call it: effects, reasons, traces, what is there, and what is left.

use crate::common::WALL;
use crate::common::desk::{Desk, Outcome};
use restframe::frame::{Frame, FrameFingerprint};
use restframe::image;
use restframe::image::Metadata;
use restframe::queue::Costs;
use restframe::shot;
use restframe::store::{Names, Request, ShotFolder};
use serde_json::{Value, json};
use std::fs;
use std::time::Instant;

/// Five frames that heat up, then five that move.
const SHOT: &str = r#"
[shot]
frames = 10
[image]
size = [64, 36]
samples = 4
[worldline.w]
velocity = { keys = [[5, [0, 0, 0]], [10, [0.5, 0, 0]]] }
[[model]]
name = "wall"
file = "wall.obj"
worldline = "w"
material = "hot"
[material.hot]
thermal = { temperature = { keys = [[1, 0], [5, 4000]] } }
[camera]
position = [0, 0, 4]
[sensor]
exposure = 0
"#;

/// A folder with `wall.toml`.
fn wall() -> Desk {
    let desk = Desk::new();
    desk.write("wall.obj", WALL);
    desk.write("wall.toml", SHOT);
    desk
}

/// `restframe plan` with arguments that blanks part.
fn planned(desk: &Desk, arguments: &str) -> Outcome {
    desk.call(&format!("plan {arguments}"))
}

fn json(desk: &Desk, arguments: &str) -> Value {
    let told = desk.done(&format!("plan {arguments} --json"));
    serde_json::from_str(&told.stdout).unwrap()
}

fn shot_folder(desk: &Desk) -> ShotFolder {
    let shot = shot::load(&desk.path("wall.toml")).unwrap();
    let request = Request {
        out: desk.path("renders"),
        scale: 1.0,
        samples: None,
    };
    ShotFolder::open(&shot, &request).unwrap()
}

/// Files and lines of the manifest as if these frames had been rendered, each in so many
/// seconds: four parts tracing, one part shading.
fn finish(desk: &Desk, frames: &[(u32, f64)]) {
    let shot_folder = shot_folder(desk);
    fs::create_dir_all(&shot_folder.path).unwrap();
    let lines: Vec<String> = frames
        .iter()
        .map(|&(frame, seconds)| {
            let name = shot_folder.names.frame(frame, "png");
            let key = shot_folder.keys.frame(frame);
            fs::write(shot_folder.path.join(&name), picture(&key)).unwrap();
            record(frame, &key, &name, seconds).to_string()
        })
        .collect();
    let manifest = Names::new(shot_folder.shot()).manifest(None);
    fs::write(shot_folder.path.join(manifest), lines.join("\n")).unwrap();
}

/// A picture of so many bytes that says what it is made of.
fn picture(key: &FrameFingerprint) -> Vec<u8> {
    let metadata = |comments| Metadata {
        fingerprint: Some(key.fingerprint.clone()),
        comments,
        ..Metadata::default()
    };
    let bytes = |comments| image::png::encode(1, 1, &[0; 3], &metadata(comments)).unwrap();
    let filled = BYTES - bytes(Some(String::new())).len();
    bytes(Some(" ".repeat(filled)))
}

/// Bytes of a picture.
const BYTES: usize = 1000;

fn record(frame: u32, key: &FrameFingerprint, name: &str, seconds: f64) -> Value {
    json!({
        "frame": frame, "fingerprint": key.fingerprint, "parts": key.inputs,
        "files": [{"name": name, "bytes": BYTES, "blake3": ""}],
        "size": [64, 36], "samples": 4, "effects": ["thermal"], "trace": key.trace, "shared": 1,
        "exposure": 0.0,
        "seconds": {"prepare": 0.0, "trace": 0.8 * seconds, "shade": 0.2 * seconds, "encode": 0.0, "write": 0.0},
        "warnings": [], "memory_mib": null, "threads": 1, "host": "here", "version": "0.1.0",
        "finished": "2026-01-01T00:00:00Z",
    })
}

/// A lamp that fades in on a moving car: nothing of relativity before it shines.
#[test]
fn a_dark_lamp_calls_for_no_effect() {
    let text = r#"
        shot.frames = 2
        worldline.car.velocity = [0.5, 0, 0]
        model = [{ file = "assets/sphere.obj" }]
        camera = {}
        light = [{ kind = "point", position = [0, 1, 0], worldline = "car", intensity = { from = 0, to = 10 } }]
    "#;
    let shot = shot::parse(text, "fade.toml".as_ref()).unwrap();
    let effects = |number| {
        let frame = Frame::new(&shot, number).unwrap();
        frame.active_effects(&frame.effects)
    };
    let [dark, lit] = [1, 2].map(effects);
    assert!(!dark.geometry && !dark.doppler && !dark.shadows, "{dark:?}");
    assert!(lit.geometry && lit.doppler && lit.shadows, "{lit:?}");
}

#[test]
fn effects_and_traces_of_each_frame_follow_the_contract() {
    let plan = json(&wall(), "wall.toml");
    let frames = plan["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 10);
    let still = json!({"geometry": false, "doppler": false, "beaming": false, "thermal": false,
        "shadows": false, "mirror": false, "refraction": false});
    assert_eq!(frames[0]["effects"], still);
    assert_eq!(frames[4]["effects"]["thermal"], true);
    for effect in ["geometry", "doppler", "beaming", "thermal"] {
        assert_eq!(frames[9]["effects"][effect], true, "{effect}");
    }
    // Those that only heat up share a trace; each that moves has its own.
    let traces: Vec<u64> = frames
        .iter()
        .map(|f| f["trace"].as_u64().unwrap())
        .collect();
    assert_eq!(traces, [0, 0, 0, 0, 0, 1, 2, 3, 4, 5]);
    assert_eq!(
        frames[4]["because"]["thermal"],
        "material \"hot\" is at 4000 K"
    );
    assert_eq!(frames[9]["status"], "missing");
    let totals = &plan["totals"];
    assert_eq!([&totals["frames"], &totals["traces"]], [10, 6]);
    assert_eq!(
        [&totals["fresh"], &totals["stale"], &totals["missing"]],
        [0, 0, 10]
    );
    assert_eq!(totals["measured"], false);
    let seconds: f64 = frames.iter().map(|f| f["seconds"].as_f64().unwrap()).sum();
    assert!((seconds - totals["seconds"].as_f64().unwrap()).abs() < 1e-12 && seconds > 0.0);
    // The memory of a program that has read nothing, at least, and of a small shot.
    let mib = totals["memory_bytes"].as_f64().unwrap() / f64::from(1 << 20);
    assert!(mib > 5.0 && mib < 100.0, "{mib} MiB");
}

#[test]
fn the_text_says_the_same_of_frames_in_a_row_once_and_each_reason_once() {
    let Outcome {
        status,
        stdout: out,
        stderr: err,
    } = planned(&wall(), "wall.toml");
    assert_eq!((status, err.as_str()), (0, ""));
    let lines: Vec<&str> = out.lines().collect();
    assert!(
        lines[0].starts_with("wall.toml: 10 frames, 64 x 36 pixels, 4 samples, 6 traces"),
        "{out}"
    );
    assert!(
        lines[1].starts_with("0 fresh, 0 stale, 10 missing: about "),
        "{out}"
    );
    assert!(lines[1].contains("a guess"), "{out}");
    let frames: Vec<&str> = lines
        .iter()
        .filter(|line| line.starts_with("frame"))
        .copied()
        .collect();
    assert_eq!(
        frames,
        [
            "frame 1  missing  no effects  trace 0",
            "frames 2-5  missing  thermal  trace 0",
            "frames 6-10  missing  geometry, doppler, beaming, thermal  traces 1-5",
        ]
    );
    let why =
        "    geometry, doppler, beaming: model \"wall\" moves at 0.100000 c relative to the camera";
    assert_eq!(
        lines.iter().filter(|line| **line == why).count(),
        1,
        "{out}"
    );
}

#[test]
fn finished_frames_are_fresh_until_what_they_are_made_of_changes() {
    let desk = wall();
    finish(&desk, &[(1, 1.0), (2, 1.0), (3, 1.0)]);
    let plan = json(&desk, "wall.toml");
    assert_eq!(plan["totals"]["fresh"], 3);
    assert_eq!(plan["totals"]["disk_bytes"], 7 * 1000);
    assert_eq!(plan["frames"][0]["seconds"], 0.0);
    desk.write("wall.toml", SHOT.replace("[5, 4000]", "[5, 5000]"));
    let plan = json(&desk, "wall.toml");
    assert_eq!([&plan["totals"]["fresh"], &plan["totals"]["stale"]], [1, 2]);
    let out = planned(&desk, "wall.toml").stdout;
    for stale in [
        "frame 2  stale because material.hot.thermal.temperature is 1250.0, was 1000.0  thermal  trace 0",
        "frame 3  stale because material.hot.thermal.temperature is 2500.0, was 2000.0  thermal  trace 0",
    ] {
        assert!(out.lines().any(|line| line == stale), "{out}");
    }
    desk.write("wall.obj", WALL.replace("1 1 0", "1 1 0.5"));
    let plan = json(&desk, "wall.toml --frames 1");
    assert_eq!(plan["frames"][0]["stale_because"], "file wall.obj changed");
}

/// Of two finished frames, 2 s and 4 s with nothing shared: 3 s each, of which 2.4 s trace. Frames
/// 4 and 5 share a trace, 1.2 s + 0.6 s each; frame 6 has one of its own.
#[test]
fn seconds_are_those_of_finished_frames_and_a_shared_trace_counts_once() {
    let desk = wall();
    finish(&desk, &[(2, 2.0), (3, 4.0)]);
    let plan = json(&desk, "wall.toml --frames 4-6");
    let seconds: Vec<f64> = (0..3)
        .map(|i| plan["frames"][i]["seconds"].as_f64().unwrap())
        .collect();
    for (found, expected) in seconds.iter().zip([1.8, 1.8, 3.0]) {
        assert!((found - expected).abs() < 1e-9, "{seconds:?}");
    }
    assert_eq!(plan["totals"]["measured"], true);
    // A quarter of the pixels and of the samples.
    let small = json(&desk, "wall.toml --frames 6 --scale 0.5 --samples 1");
    let small = small["frames"][0]["seconds"].as_f64().unwrap();
    assert!((small - 3.0 / 16.0).abs() < 1e-9, "{small}");
}

#[test]
fn another_shot_below_the_same_folder_is_better_than_a_guess() {
    let desk = wall();
    finish(&desk, &[(2, 3.0)]);
    desk.write("other.toml", SHOT.replace("[0.5, 0, 0]", "[0, 0.5, 0]"));
    let plan = json(&desk, "other.toml --frames 8");
    assert_eq!(plan["totals"]["measured"], true);
    let seconds = plan["totals"]["seconds"].as_f64().unwrap();
    assert!((seconds - 3.0).abs() < 1e-9, "{seconds}");
}

#[test]
fn what_is_learnt_while_rendering_mends_the_estimate() {
    let desk = wall();
    let shot_folder = shot_folder(&desk);
    let mut costs = Costs::new(&shot_folder);
    let effects = ["thermal".to_owned()];
    assert!(
        !costs
            .estimate(&effects, shot_folder.keys.resolution())
            .measured
    );
    let record = record(1, &shot_folder.keys.frame(1), "x.png", 5.0);
    costs.learn(&serde_json::from_value(record).unwrap());
    let seconds = costs.seconds(&effects, shot_folder.keys.resolution());
    assert!((seconds - 5.0).abs() < 1e-9, "{seconds}");
}

#[test]
fn mistakes_end_with_status_2() {
    let desk = wall();
    for (text, words) in [
        (SHOT.replace("[0.5, 0, 0]", "[1.5, 0, 0]"), "speed"),
        (SHOT.replace("wall.obj", "none.obj"), "there is no file"),
        (
            SHOT.replace("[camera]", "[accuracy]\nspectra = \"rgb\"\n[camera]"),
            "rgb",
        ),
    ] {
        desk.write("bad.toml", text);
        let Outcome {
            status,
            stdout: out,
            stderr: err,
        } = planned(&desk, "bad.toml");
        assert_eq!((status, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(words), "{err}");
    }
    for call in [
        "wall.toml --frames 11",
        "wall.toml --scale 1000",
        "none.toml",
    ] {
        let Outcome {
            status,
            stderr: err,
            ..
        } = planned(&desk, call);
        assert_eq!(status, 2, "{err}");
        assert!(!err.is_empty());
    }
}

/// It took 73 ms as tests are built, with the start of the program; the bound is for machines under
/// load.
#[test]
fn a_thousand_frames_are_planned_at_once() {
    let desk = wall();
    desk.write("wall.toml", SHOT.replace("frames = 10", "frames = 1000"));
    let begun = Instant::now();
    let plan = json(&desk, "wall.toml");
    let seconds = begun.elapsed().as_secs_f64();
    eprintln!("1000 frames planned in {:.0} ms", 1e3 * seconds);
    assert_eq!(plan["totals"]["frames"], 1000);
    assert!(seconds < 10.0, "{seconds} s");
}
