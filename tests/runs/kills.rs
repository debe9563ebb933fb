//! Killed without a word.

use super::desk::{PASSING, passing};
use restframe::store::{Request, ShotFolder, Status};
use std::io::{BufRead, BufReader};
use std::time::Instant;

/// Numbers from 0 to 1 that look random (Knuth's multiplicative generator, MMIX).
fn random(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

const FRAMES: u32 = 40;

/// Two formats, so that a frame can be torn between them.
#[test]
fn after_ten_kills_every_frame_is_whole_or_absent_and_the_bytes_are_those_of_one_run() {
    let desk = passing();
    let shot = PASSING.replace("frames = 20", &format!("frames = {FRAMES}"));
    let formats = "[output]\nformats = [\"png\", \"exr\"]";
    desk.write("passing.toml", format!("{shot}{formats}"));
    let begun = Instant::now();
    desk.done("render passing.toml --out whole");
    let frame = begun.elapsed() / FRAMES;
    let mut state = 7;
    let mut killed = 0;
    for _ in 0..10 {
        let mut child = desk.spawn("render passing.toml --out torn --json --progress none");
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let is_work = |line: &String| line.contains("\"rendered\",");
        assert!(
            lines
                .by_ref()
                .map(Result::unwrap)
                .any(|line| is_work(&line))
        );
        // Anywhere in the next frame or so.
        std::thread::sleep(frame.mul_f64(1.5 * random(&mut state)));
        child.kill().unwrap();
        killed += u32::from(child.wait().unwrap().code().is_none());
        for name in desk.pictures("torn").keys() {
            let picture = image::open(desk.path("torn").join(name));
            assert!(picture.is_ok(), "{name} is torn");
        }
        let shot = restframe::shot::load(&desk.path("passing.toml")).unwrap();
        let request = Request {
            out: desk.path("torn"),
            scale: 1.0,
            samples: None,
        };
        let shot_folder = ShotFolder::open(&shot, &request).unwrap();
        for frame in 1..=FRAMES {
            let status = shot_folder.status(frame, &shot_folder.keys.frame(frame));
            let is_sound = match &status {
                Status::Fresh | Status::Missing => true,
                // Killed between the formats: the frame is rendered anew.
                Status::Stale { reason } => reason.ends_with(" is missing"),
            };
            assert!(is_sound, "frame {frame}: {status:?}");
        }
    }
    assert!(killed >= 8, "only {killed} of ten runs were killed at work");
    desk.done("render passing.toml --out torn");
    assert!(desk.pictures("torn") == desk.pictures("whole"));
    assert!(!desk.has_leftovers("torn"), "{:?}", desk.names("torn"));
}

#[test]
fn a_line_that_a_kill_tore_off_is_closed_and_the_frame_known_by_its_picture() {
    let desk = passing();
    desk.done("render passing.toml --frames 1-3");
    let manifest = desk.path("renders/passing/passing.manifest.jsonl");
    let text = std::fs::read_to_string(&manifest).unwrap();
    std::fs::write(&manifest, &text[..text.len() - 100]).unwrap();
    let outcome = desk.done("render passing.toml --frames 1-4 --json");
    assert_eq!(
        (outcome.frames("kept"), outcome.frames("rendered")),
        (vec![1, 2, 3], vec![4])
    );
    assert_eq!(desk.recorded("renders"), [1, 2, 4]);
}
