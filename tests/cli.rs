//! The command as its users call it: what is written where, what is said, and how it ends.
//!
//! `INSTA_UPDATE=always cargo test --test suite cli::` renews the snapshots in `tests/snapshots`.

use crate::common::desk::Desk;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Three frames of a sphere that speeds up, with a lamp that moves too, in both formats.
const SPHERE: &str = r#"
[shot]
frames = 3
time = 5.0

[image]
size = [48, 27]
samples = 4

[worldline.passing]
velocity = { from = [0, 0, 0], to = [0.8, 0, 0] }

[worldline.lamp]
velocity = [0, 0.5, 0]

[[model]]
file = "sphere.obj"
worldline = "passing"

[[light]]
kind = "point"
worldline = "lamp"
position = [0, 2, 4]
intensity = 1000

[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]

[output]
formats = ["png", "exr"]
layers = ["doppler", "distance", "emission_time", "worldline"]
"#;

/// A folder with `sphere.toml` and its model.
fn sphere() -> Desk {
    let desk = Desk::with_sphere();
    desk.write("sphere.toml", SPHERE);
    desk
}

/// All files below a folder but manifests and pages, which tell times, with their bytes.
fn files(desk: &Desk, folder: &str) -> Vec<(String, Vec<u8>)> {
    fn walk(folder: &Path, root: &Path, files: &mut Vec<(String, Vec<u8>)>) {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, root, files);
            } else if path
                .extension()
                .is_none_or(|extension| extension != "jsonl" && extension != "html")
            {
                let name = path
                    .strip_prefix(root)
                    .unwrap()
                    .to_string_lossy()
                    .into_owned();
                files.push((name, fs::read(&path).unwrap()));
            }
        }
    }
    let mut files = Vec::new();
    walk(&desk.path(folder), &desk.path(folder), &mut files);
    files.sort();
    files
}

fn names(desk: &Desk, folder: &str) -> Vec<String> {
    files(desk, folder)
        .into_iter()
        .map(|(name, _)| name)
        .collect()
}

/// What a person sees, with the folders and times of this run taken out.
fn said(desk: &Desk, text: &str) -> String {
    let text = text.replace(&desk.path("").display().to_string(), "DESK");
    let line = |line: &str| match line.split_once(" s  ") {
        Some((before, name)) if line.starts_with("frame ") => {
            let (frame, _seconds) = before.rsplit_once(' ').unwrap();
            format!("{frame} N s  {name}")
        }
        _ => line.to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn all_frames_are_written_where_the_contract_says() {
    let desk = sphere();
    let outcome = desk.call("render sphere.toml");
    assert_eq!((outcome.status, outcome.stdout.as_str()), (0, ""));
    assert_eq!(
        names(&desk, "renders"),
        [
            "sphere/sphere.0001.exr",
            "sphere/sphere.0001.png",
            "sphere/sphere.0002.exr",
            "sphere/sphere.0002.png",
            "sphere/sphere.0003.exr",
            "sphere/sphere.0003.png",
        ]
    );
    assert!(desk.path("renders/sphere/sphere.manifest.jsonl").is_file());
    insta::assert_snapshot!("progress-lines", said(&desk, &outcome.stderr));
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads_and_any_run() {
    let desk = sphere();
    for (out, threads) in [("one", 1), ("two", 2), ("again", 2), ("seven", 7)] {
        let outcome = desk.call(&format!(
            "render sphere.toml --out {out} --threads {threads}"
        ));
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let one = files(&desk, "one");
    assert_eq!(one.len(), 6);
    for other in ["two", "again", "seven"] {
        assert!(files(&desk, other) == one, "{other}");
    }
}

#[test]
fn a_frame_is_the_same_whichever_frames_are_rendered_with_it() {
    let desk = sphere();
    assert_eq!(desk.call("render sphere.toml --out all").status, 0);
    assert_eq!(
        desk.call("render sphere.toml --out last --frames 3").status,
        0
    );
    let all = files(&desk, "all");
    for file in files(&desk, "last") {
        assert!(all.contains(&file), "{}", file.0);
    }
}

#[test]
fn frames_outside_the_shot_are_left_out_with_a_warning() {
    let desk = sphere();
    let outcome = desk.call("render sphere.toml --frames 2-3,7,9- --progress none");
    assert_eq!(outcome.status, 0);
    insta::assert_snapshot!("frames-outside", said(&desk, &outcome.stderr));
    assert_eq!(names(&desk, "renders").len(), 4);
}

#[test]
fn frame_lists_that_choose_nothing_or_cannot_be_read_are_refused() {
    let desk = sphere();
    let mut answers = String::new();
    for list in ["4-9", "1:10", "3-1", "1-3:0", "2.5", "first"] {
        let outcome = desk.call(&format!("render sphere.toml --frames {list}"));
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{list}");
        answers.push_str(&format!(
            "--frames {list}\n{}\n",
            said(&desk, &outcome.stderr)
        ));
    }
    insta::assert_snapshot!("frames-refused", answers);
    assert_eq!(names(&desk, "renders"), [""; 0]);
}

#[test]
fn scale_and_samples_take_the_place_of_the_shots() {
    let desk = sphere();
    let outcome = desk.call("render sphere.toml --frames 1 --scale 0.5 --samples 1 --out small");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let png = &files(&desk, "small")[1].1;
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    // Width and height stand first in the IHDR chunk.
    assert_eq!((side(16), side(20)), (24, 14));
    assert_eq!(
        desk.call("render sphere.toml --frames 1 --scale 0.5 --out more")
            .status,
        0
    );
    assert_ne!(&files(&desk, "more")[1].1, png);
}

#[test]
fn calls_that_make_no_sense_are_answered_with_status_2() {
    let desk = sphere();
    let mut answers = String::new();
    for call in [
        "render",
        "render sphere.toml --frame 1",
        "render sphere.toml --scale 0",
        "render sphere.toml --scale inf",
        "render sphere.toml --samples 0",
        "render sphere.toml --threads -1",
        "render sphere.toml --progress loud",
        "render sphere.toml sphere.toml",
        "probe sphere.toml",
        "probe sphere.toml --pixel 3",
        "probe sphere.toml --pixel 48 0",
        "probe sphere.toml --pixel 0 27",
        "probe sphere.toml --pixel 0 0 --frame 4",
        "probe sphere.toml --pixel 0 0 --frame 0",
        "rendr sphere.toml",
    ] {
        let outcome = desk.call(call);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{call}");
        answers.push_str(&format!(
            "$ restframe {call}\n{}\n\n",
            said(&desk, &outcome.stderr)
        ));
    }
    insta::assert_snapshot!("misuse", answers);
    assert_eq!(names(&desk, "renders"), [""; 0]);
}

#[test]
fn a_broken_shot_among_several_stops_all_of_them_before_the_first_frame() {
    let desk = sphere();
    desk.write("broken.toml", SPHERE.replace("samples = 4", "sampels = 4"));
    desk.write("worse.toml", SPHERE.replace("0.8, 0, 0", "1.0, 0, 0"));
    let outcome = desk.call("render sphere.toml broken.toml worse.toml missing.toml");
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""));
    insta::assert_snapshot!("broken-among-several", said(&desk, &outcome.stderr));
    assert_eq!(names(&desk, "renders"), [""; 0]);
}

/// A shot of the given model.
fn shot_of(model: &str) -> String {
    SPHERE.replace("sphere.obj", model)
}

#[test]
fn a_mistake_in_a_model_file_is_one_of_the_call_and_names_the_file() {
    let desk = sphere();
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad-models");
    let mut files: Vec<String> = fs::read_dir(models.clone())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.ends_with(".md"))
        .collect();
    files.sort();
    assert!(files.len() >= 6, "{files:?}");
    let mut answers = String::new();
    for name in files {
        fs::copy(models.join(&name), desk.path(&name)).unwrap();
        desk.write("bad.toml", shot_of(&name));
        for command in ["check", "render"] {
            let outcome = desk.call(&format!("{command} bad.toml"));
            assert_eq!(
                (outcome.status, outcome.stdout.as_str()),
                (2, ""),
                "{command} {name}"
            );
            assert!(outcome.stderr.contains(&name), "{}", outcome.stderr);
            if command == "check" {
                answers.push_str(&said(&desk, &outcome.stderr));
                answers.push('\n');
            }
        }
    }
    insta::assert_snapshot!("bad-models", answers);
    assert_eq!(names(&desk, "renders"), [""; 0]);
}

#[test]
fn check_tells_what_is_sound_and_what_is_not() {
    let desk = sphere();
    desk.write("broken.toml", SPHERE.replace("samples = 4", "sampels = 4"));
    let sound = desk.call("check sphere.toml");
    assert_eq!((sound.status, sound.stderr.as_str()), (0, ""));
    assert_eq!(sound.stdout, "sphere.toml: 3 frames, no mistakes\n");
    let both = desk.call("check sphere.toml broken.toml --json");
    assert_eq!(both.status, 2);
    let report: Value = serde_json::from_str(&both.stdout).unwrap();
    assert_eq!(report["shots"][0]["ok"], true);
    assert_eq!(report["shots"][0]["frames"], 3);
    let mistake = &report["shots"][1]["mistakes"][0];
    assert_eq!(mistake["file"], "broken.toml");
    assert_eq!(mistake["line"], 8);
    assert_eq!(mistake["key"], "image.sampels");
}

#[test]
fn probe_answers_in_the_shape_of_the_contract() {
    let desk = sphere();
    let outcome = desk.call("probe sphere.toml --frame 3 --pixel 27 13 --json");
    assert_eq!((outcome.status, outcome.stderr.as_str()), (0, ""));
    let answer: Value = serde_json::from_str(&outcome.stdout).unwrap();
    let keys = |value: &Value| {
        value
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<Vec<_>>()
    };
    let numbers = |value: &Value, count: usize| {
        let list = value.as_array().unwrap();
        assert!(
            list.len() == count && list.iter().all(Value::is_f64),
            "{value}"
        );
    };
    assert_eq!(
        keys(&answer),
        [
            "frame",
            "pixel",
            "hit",
            "wavelengths",
            "radiance",
            "xyz",
            "rgb",
            "chain",
            "cut",
            "surface",
            "thermal"
        ]
    );
    let seen = &answer["chain"][0];
    assert_eq!(
        keys(seen),
        ["parent", "by", "coefficient", "doppler", "hit"]
    );
    assert_eq!(seen["hit"], answer["hit"]);
    assert_eq!(seen["doppler"], answer["hit"]["doppler"]);
    for (i, total) in answer["radiance"].as_array().unwrap().iter().enumerate() {
        let parts = ["surface", "thermal"].map(|part| answer[part][i].as_f64().unwrap());
        assert_eq!(total.as_f64().unwrap(), parts[0] + parts[1]);
    }
    assert_eq!(answer["frame"], 3);
    assert_eq!(answer["pixel"], serde_json::json!([27, 13]));
    let hit = &answer["hit"];
    assert_eq!(
        keys(hit),
        [
            "model",
            "material",
            "worldline",
            "event",
            "distance",
            "normal",
            "doppler"
        ]
    );
    assert_eq!(
        [&hit["model"], &hit["material"], &hit["worldline"]],
        ["sphere", "red", "passing"]
    );
    assert_eq!(keys(&hit["event"]), ["t", "x"]);
    numbers(&hit["event"]["x"], 3);
    numbers(&hit["normal"], 3);
    numbers(&answer["wavelengths"], 84);
    numbers(&answer["radiance"], 84);
    numbers(&answer["xyz"], 3);
    numbers(&answer["rgb"], 3);
    // The light was emitted on the past cone of the exposure: t = 5 at z = 5.
    let [x, y, z] = [0, 1, 2].map(|i| hit["event"]["x"][i].as_f64().unwrap());
    let path = (x.powi(2) + y.powi(2) + (z - 5.0).powi(2)).sqrt();
    assert!((path - hit["distance"].as_f64().unwrap()).abs() < 1e-9);
    assert!((5.0 - path - hit["event"]["t"].as_f64().unwrap()).abs() < 1e-9);
    let sky = desk.call("probe sphere.toml --pixel 0 0 --json").stdout;
    assert_eq!(
        serde_json::from_str::<Value>(&sky).unwrap()["hit"],
        Value::Null
    );
}

#[test]
fn the_schema_is_json_of_draft_7_on_standard_output_alone() {
    let desk = sphere();
    let outcome = desk.call("schema");
    assert_eq!((outcome.status, outcome.stderr.as_str()), (0, ""));
    let schema: Value = serde_json::from_str(&outcome.stdout).unwrap();
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    assert_eq!(names(&desk, ".").len(), 3, "{:?}", names(&desk, "."));
    // The copy that editors read beside the shots: `restframe schema > shots/shot.schema.json`.
    assert_eq!(outcome.stdout, include_str!("../shots/shot.schema.json"));
}

#[test]
fn help_and_version_are_results_and_go_to_standard_output() {
    let desk = sphere();
    for call in ["--help", "render --help", "probe --help", "--version"] {
        let outcome = desk.call(call);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (0, ""), "{call}");
        assert!(outcome.stdout.contains("restframe"), "{call}");
    }
    insta::assert_snapshot!("help-render", desk.call("render --help").stdout);
}

#[test]
fn without_a_terminal_nothing_has_an_escape_or_a_carriage_return() {
    let desk = sphere();
    desk.write("broken.toml", SPHERE.replace("samples = 4", "sampels = 4"));
    for line in [
        "$restframe render sphere.toml 2>err | cat",
        "$restframe render sphere.toml --progress bar 2>err | cat",
        "$restframe render broken.toml 2>err | cat",
        "$restframe render sphere.toml --frame 1 2>err | cat",
        "$restframe probe sphere.toml --pixel 1 1 2>err | cat",
    ] {
        let outcome = desk.shell(line);
        let said = fs::read_to_string(desk.path("err")).unwrap() + &outcome.stdout;
        assert!(
            !said.is_empty() && !said.contains(['\u{1b}', '\r']),
            "{line}: {said:?}"
        );
    }
}

#[test]
fn a_reader_who_goes_away_is_no_failure_but_a_full_disk_is() {
    let desk = sphere();
    let line = "$restframe schema | head -c 1; exit ${PIPESTATUS[0]}";
    assert_eq!(desk.shell(line).status, 0);
    if Path::new("/dev/full").exists() {
        let outcome = desk.shell("$restframe schema > /dev/full");
        assert_eq!(outcome.status, 1);
        assert!(
            outcome.stderr.starts_with("error: standard output: "),
            "{}",
            outcome.stderr
        );
    }
}

/// A file in the place of the folder: permissions would not stop the superuser.
#[test]
fn an_output_folder_that_cannot_be_made_fails_every_frame_with_status_1() {
    let desk = sphere();
    desk.write("taken", "a file");
    let outcome = desk.call("render sphere.toml --out taken");
    assert_eq!((outcome.status, outcome.stdout.as_str()), (1, ""));
    insta::assert_snapshot!("no-folder", said(&desk, &outcome.stderr));
    assert_eq!(fs::read_to_string(desk.path("taken")).unwrap(), "a file");
}

/// A limit on the size of files fails a write half-way, as a full disk does.
#[test]
fn an_image_that_cannot_be_written_whole_is_not_there_at_all() {
    let desk = sphere();
    let line = "trap '' XFSZ; ulimit -f 2; exec $restframe render sphere.toml --frames 1-2";
    let outcome = desk.shell(line);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (1, ""));
    insta::assert_snapshot!("no-space", said(&desk, &outcome.stderr));
    // The PNG is small enough for the limit, the EXR is not; then the shot is done with.
    assert_eq!(names(&desk, "renders"), ["sphere/sphere.0001.png"]);
}

#[test]
fn an_image_that_the_memory_cannot_hold_is_refused_before_it_is_begun() {
    let desk = sphere();
    let memory = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let kib = memory.lines().find_map(|line| {
        line.strip_prefix("MemAvailable:")?
            .split_whitespace()
            .next()
    });
    let enough = kib.is_none_or(|kib| kib.parse::<u64>().is_ok_and(|kib| kib > 40 << 20));
    if enough {
        eprintln!("not tested: this machine could hold the largest image");
        return;
    }
    desk.write("huge.toml", SPHERE.replace("[48, 27]", "[32768, 32768]"));
    let outcome = desk.call("render huge.toml --frames 1");
    assert_eq!((outcome.status, outcome.stdout.as_str()), (1, ""));
    assert!(
        outcome.stderr.contains("32768 x 32768 pixels need about"),
        "{}",
        outcome.stderr
    );
    assert!(
        outcome.stderr.contains("render with a smaller --scale"),
        "{}",
        outcome.stderr
    );
    assert_eq!(names(&desk, "renders"), [""; 0]);
    let small = desk.call("render huge.toml --frames 1 --scale 0.001 --samples 1");
    assert_eq!(small.status, 0, "{}", small.stderr);
}

#[test]
fn a_black_first_frame_is_exposed_at_0_stops_with_a_warning() {
    let desk = sphere();
    desk.write(
        "dark.toml",
        SPHERE.replace("intensity = 1000", "intensity = 0"),
    );
    let outcome = desk.call("render dark.toml --progress none");
    assert_eq!(outcome.status, 0);
    insta::assert_snapshot!("black-frame", said(&desk, &outcome.stderr));
}

#[test]
fn the_first_shot_of_the_readme_renders_and_probes_as_it_says() {
    let readme = include_str!("../README.md");
    let block = |opening: &str| {
        let (_, rest) = readme.split_once(opening).unwrap();
        rest.split_once("```").unwrap().0
    };
    let desk = sphere();
    fs::create_dir(desk.path("assets")).unwrap();
    for name in ["sphere.obj", "sphere.mtl"] {
        fs::rename(desk.path(name), desk.path("assets").join(name)).unwrap();
    }
    desk.write("first.toml", block("```toml\n"));
    let rendered = desk.call("render first.toml --scale 0.1 --progress none");
    assert_eq!((rendered.status, rendered.stderr.as_str()), (0, ""));
    assert_eq!(names(&desk, "renders"), ["first/first.0001.png"]);
    let call = "probe first.toml --pixel 320 180";
    let answer = desk.call(call).stdout;
    assert_eq!(
        block("```console\n"),
        format!("$ restframe {call}\n{answer}")
    );
}

/// A glass ball in an even sky, which shows nothing but that sky.
fn glass(more: &str) -> String {
    format!(
        "[image]\nsize = [48, 48]\nsamples = 2\n[sensor]\nexposure = 0\n\
         [[model]]\nfile = \"sphere.obj\"\nmaterial = \"glass\"\n\
         [material.glass]\nmirror = {{ spectrum = 1.0 }}\nrefraction = {{ spectrum = 1.0 }}\n\
         [background]\nspectrum = 1e-3\n[camera]\nposition = [0, 0, 3]\nhfov = 30\n{more}"
    )
}

#[test]
fn light_that_bounces_cut_is_told_with_the_number_that_would_do() {
    let desk = sphere();
    let events = |more: &str| -> Vec<Value> {
        desk.write("glass.toml", glass(more));
        let told = desk.call("render glass.toml --json");
        assert_eq!(told.status, 0, "{}", told.stderr);
        let lines = told.stdout.lines();
        lines
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    };
    let cut = |events: &[Value]| {
        let frame = events.iter().find(|e| e["event"] == "frame").unwrap();
        frame["cut"].as_f64().unwrap()
    };
    let warning = |events: &[Value]| {
        let warning = events.iter().find(|e| e["event"] == "warning")?;
        Some(warning["message"].as_str().unwrap().to_owned())
    };
    let shallow = events("[effects]\nbounces = 2\n");
    assert!(cut(&shallow) > 0.005, "{shallow:?}");
    let message = warning(&shallow).unwrap();
    let (_, rest) = message.split_once("effects.bounces = ").unwrap();
    let (enough, rest) = rest.split_once(' ').unwrap();
    assert_eq!(rest, "would leave out less than 0.5 %", "{message}");
    let manifest = fs::read_to_string(desk.path("renders/glass/glass.manifest.jsonl")).unwrap();
    let record: Value = serde_json::from_str(manifest.lines().last().unwrap()).unwrap();
    assert_eq!(record["cut"].as_f64().unwrap(), cut(&shallow));
    let page = fs::read_to_string(desk.path("renders/glass/index.html")).unwrap();
    assert!(page.contains("Light left out, %") && page.contains("is left out, too deep"));
    let deep = events(&format!("[effects]\nbounces = {enough}\n"));
    assert!(cut(&deep) > 0.0 && cut(&deep) < 0.005, "{enough}: {deep:?}");
    assert_eq!(warning(&deep), None);
    assert_eq!(warning(&events("")), None, "eight by default");
    let faint = events("[accuracy]\ncutoff = 0.3\n");
    let message = warning(&faint).unwrap();
    assert!(
        message.contains("too faint for accuracy.cutoff = 0.3"),
        "{message}"
    );
    let off = events("[effects]\nbounces = 0\n");
    assert_eq!((cut(&off), warning(&off)), (0.0, None), "it was turned off");
    let probe = "probe glass.toml --pixel 8 24";
    desk.write("glass.toml", glass("[effects]\nbounces = 1\n"));
    let told = desk.call(probe).stdout;
    assert!(told.contains("would leave out less than 0.5 %"), "{told}");
    let json: Value = serde_json::from_str(&desk.call(&format!("{probe} --json")).stdout).unwrap();
    assert!(json["enough_bounces"].as_u64().unwrap() > 1);
}

#[test]
fn a_lamp_on_a_wall_gives_numbers_to_whoever_asks() {
    let desk = sphere();
    desk.write(
        "wall.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n",
    );
    for z in ["1e-160", "1e-320", "0"] {
        desk.write(
            "lamp.toml",
            format!(
                "[image]\nsize = [5, 5]\nsamples = 1\nfilter = \"box\"\n[sensor]\nexposure = 0\n\
                 [[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\n\
                 [material.paint]\ndiffuse = {{ spectrum = 0.5 }}\n\
                 [[light]]\nkind = \"point\"\nposition = [0, 0, {z}]\nintensity = 100\n\
                 [camera]\nposition = [0, 0, 3]\nhfov = 20\n"
            ),
        );
        let told = desk.call("probe lamp.toml --pixel 2 2 --json");
        let seen: Value = serde_json::from_str(&told.stdout).unwrap();
        for key in ["xyz", "rgb", "radiance", "surface", "thermal"] {
            let numbers = seen[key].as_array().unwrap();
            assert!(
                numbers.iter().all(Value::is_number),
                "{z} {key}: {numbers:?}"
            );
        }
        assert_eq!(seen["xyz"][1].as_f64().unwrap() > 1e38, z != "0", "{z}");
        let told = desk.call("render lamp.toml --force");
        assert_eq!(told.status, 0, "{}", told.stderr);
    }
}
