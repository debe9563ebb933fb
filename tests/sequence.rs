//! Frames of one sequence: each is the same picture alone and after its neighbours.
use restframe::queue::{Force, FrameList, Job, Mode, Night, Progress, Request, Results};
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

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

fn render(shot: &Path, frames: &[u32], out: &Path) {
    let shot = restframe::shot::load(shot).unwrap();
    let request = Request {
        out: out.to_owned(),
        frames: FrameList::all(),
        scale: 1.0,
        samples: None,
    };
    let mut job = Job::open(&shot, &request, frames).unwrap();
    job.prepare(Force::Yes).unwrap();
    job.furnish(None);
    let night = Night {
        progress: &Progress::new(Mode::None, Results::Nothing),
        stop: &AtomicBool::new(false),
        force: Force::Yes,
    };
    let mut jobs = [job];
    night.render(&mut jobs, &mut |_| ());
    assert_eq!(jobs[0].missing(), [0; 0]);
}

#[test]
fn a_frame_alone_is_the_frame_in_its_sequence_also_where_materials_come_to_look_alike() {
    for (name, from, to) in [("fading", "0.8", "0"), ("rising", "0", "0.8")] {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sequence-{name}"));
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
        let shot = folder.join("two.toml");
        fs::write(&shot, SHOT.replace("FROM", from).replace("TO", to)).unwrap();
        let (all, alone) = (folder.join("all"), folder.join("alone"));
        render(&shot, &[1, 2, 3], &all);
        for frame in 1..=3 {
            render(&shot, &[frame], &alone);
            let file = format!("two/two.{frame:04}.png");
            let same = fs::read(all.join(&file)).unwrap() == fs::read(alone.join(&file)).unwrap();
            assert!(same, "{name}, frame {frame}");
        }
    }
}
