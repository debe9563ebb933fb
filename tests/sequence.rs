//! Frames of one sequence: each is the same picture alone and after its neighbours.
use restframe::progress::{Event, FrameOutcome, Progress};
use restframe::queue::{Force, Output, RenderedFrame, Run, RunError, Settings, Stop};
use restframe::store::Request;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

const QUAD: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl red\nf 1 2 3 4\n";

/// Two files have a material of one name and different colours; over both the shot lays a weight
/// that becomes zero, where the two look the same.
const SHOT: &str = r#"
[shot]
frames = 3
[image]
size = [32, 18]
samples = 1
[[model]]
file = "left.obj"
translate = [-1.2, 0, 0]
[[model]]
file = "right.obj"
translate = [1.2, 0, 0]
[material.red]
diffuse = { weight = { from = FROM, to = TO } }
[[light]]
kind = "sun"
direction = [0, 0, -1]
intensity = 100
[camera]
position = [0, 0, 3]
[sensor]
exposure = 0
"#;

fn render(shot: &Path, frames: &str, out: &Path) {
    let shot = restframe::shot::load(shot).unwrap();
    let (progress, stop) = (Progress::silent(), Stop::default());
    let settings = Settings {
        request: Request {
            out: out.to_owned(),
            ..Request::default()
        },
        frames: frames.parse().unwrap(),
        force: Force::Yes,
        ..Settings::new(&progress, &stop)
    };
    let mut run = Run::open(&[shot], settings).unwrap();
    run.render_all();
    assert_eq!(run.jobs()[0].missing(), [0; 0]);
}

/// The shot with its files, in a folder of its own.
fn two(name: &str, from: &str, to: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sequence-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    for (side, color) in [("left", "0.9 0.1 0.1"), ("right", "0.1 0.1 0.9")] {
        fs::write(
            folder.join(format!("{side}.obj")),
            format!("mtllib {side}.mtl\n{QUAD}"),
        )
        .unwrap();
        fs::write(
            folder.join(format!("{side}.mtl")),
            format!("newmtl red\nKd {color}\n"),
        )
        .unwrap();
    }
    let shot = SHOT.replace("FROM", from).replace("TO", to);
    fs::write(folder.join("two.toml"), shot).unwrap();
    folder
}

#[test]
fn a_frame_alone_is_the_frame_in_its_sequence_also_where_materials_come_to_look_alike() {
    for (name, from, to) in [("fading", "0.8", "0"), ("rising", "0", "0.8")] {
        let folder = two(name, from, to);
        let shot = folder.join("two.toml");
        let (all, alone) = (folder.join("all"), folder.join("alone"));
        render(&shot, "1-3", &all);
        for frame in 1..=3 {
            render(&shot, &frame.to_string(), &alone);
            let file = format!("two/two.{frame:04}.png");
            let same = fs::read(all.join(&file)).unwrap() == fs::read(alone.join(&file)).unwrap();
            assert!(same, "{name}, frame {frame}");
        }
    }
}

/// They stand in the folder that the request names: a run to memory does not look there.
#[test]
fn a_run_to_memory_renders_frames_that_are_finished_on_the_disk() {
    let folder = two("finished", "0.8", "0.2");
    let shot = folder.join("two.toml");
    let out = folder.join("out");
    render(&shot, "1-", &out);
    let (progress, stop) = (Progress::silent(), Stop::default());
    let numbers = Mutex::new(Vec::new());
    let keep = |frame: RenderedFrame| numbers.lock().unwrap().push(frame.frame);
    let settings = Settings {
        request: Request {
            out,
            ..Request::default()
        },
        output: Output::Memory(&keep),
        ..Settings::new(&progress, &stop)
    };
    let shot = restframe::shot::load(&shot).unwrap();
    Run::open(&[shot], settings).unwrap().render_all();
    assert_eq!(*numbers.lock().unwrap(), [1, 2, 3]);
}

/// Nothing of them meets on a disk.
#[test]
fn shots_of_one_name_are_rendered_to_memory_and_refused_for_one_folder() {
    let shots = ["one-name", "another-of-it"].map(|name| {
        let shot = two(name, "0.8", "0.2").join("two.toml");
        restframe::shot::load(&shot).unwrap()
    });
    let (progress, stop) = (Progress::silent(), Stop::default());
    let taken = Mutex::new(0);
    let count = |_| *taken.lock().unwrap() += 1;
    let to = |output| Settings {
        output,
        ..Settings::new(&progress, &stop)
    };
    let refused = Run::open(&shots, to(Output::Folder)).err();
    assert!(matches!(refused, Some(RunError::Contradiction(_))));
    let mut run = Run::open(&shots, to(Output::Memory(&count))).unwrap();
    run.render_all();
    assert_eq!(*taken.lock().unwrap(), 2 * 3);
}

#[test]
fn a_run_is_refused_with_the_mistakes_of_every_shot() {
    let folder = two("mistakes", "0.8", "0.2");
    let shot = restframe::shot::load(&folder.join("two.toml")).unwrap();
    fs::remove_file(folder.join("left.obj")).unwrap();
    let (progress, stop) = (Progress::silent(), Stop::default());
    let settings = Settings {
        output: Output::Memory(&|_| ()),
        ..Settings::new(&progress, &stop)
    };
    let refused = Run::open(&[shot.clone(), shot], settings).err();
    let Some(RunError::Mistakes(all)) = refused else {
        unreachable!("a model is missing: {refused:?}")
    };
    assert_eq!(all.len(), 2);
}

#[test]
fn a_run_to_memory_has_the_bytes_of_one_to_a_folder_and_leaves_no_file() {
    let folder = two("memory", "0.8", "0.2");
    let shot = folder.join("two.toml");
    let (out, unused) = (folder.join("out"), folder.join("unused"));
    render(&shot, "1-", &out);
    let settled = Mutex::new(Vec::new());
    let progress = Progress::to(|event: &Event<'_>| {
        if let Event::Frame { frame, outcome, .. } = event {
            assert!(matches!(outcome, FrameOutcome::Rendered { .. }));
            settled.lock().unwrap().push(*frame);
        }
    });
    let stop = Stop::default();
    let frames = Mutex::new(Vec::new());
    let keep = |frame: RenderedFrame| frames.lock().unwrap().push(frame);
    let settings = Settings {
        request: Request {
            out: unused.clone(),
            ..Request::default()
        },
        output: Output::Memory(&keep),
        ..Settings::new(&progress, &stop)
    };
    let shot = restframe::shot::load(&shot).unwrap();
    let mut run = Run::open(&[shot], settings).unwrap();
    assert!(run.next_finished().is_some() && run.next_finished().is_none());
    assert_eq!(*settled.lock().unwrap(), [1, 2, 3]);
    for frame in frames.lock().unwrap().iter() {
        let RenderedFrame { files, record, .. } = frame;
        let (extension, bytes) = &files[0];
        assert_eq!((files.len(), *extension), (1, "png"));
        assert_eq!(record.files[0].name, format!("two.{:04}.png", frame.frame));
        let same = fs::read(out.join("two").join(&record.files[0].name)).unwrap() == *bytes;
        assert!(same, "frame {}", frame.frame);
    }
    assert_eq!(frames.lock().unwrap().len(), 3);
    assert!(!unused.exists());
}
