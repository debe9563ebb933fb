//! What is there already, and why it is not enough.

use super::desk::{PASSING, passing};
use std::fs;

#[test]
fn a_run_whose_frames_are_fresh_reads_no_model_and_records_nothing() {
    let desk = passing();
    // The model's warning shows whether it is read.
    let model = fs::read_to_string(desk.path("sphere.obj")).unwrap();
    desk.write("sphere.obj", format!("{model}\nl 1 2\n"));
    let first = desk.done("render passing.toml --progress none");
    assert!(
        first.stderr.contains("warning: sphere.obj"),
        "{}",
        first.stderr
    );
    let again = desk.done("render passing.toml --progress none");
    assert_eq!(again.stderr, "");
    assert_eq!(
        desk.done("render passing.toml --json").frames("kept").len(),
        20
    );
    assert_eq!(desk.recorded("renders").len(), 20);
}

#[test]
fn what_has_changed_is_rendered_anew_with_the_reason() {
    let desk = passing();
    desk.done("render passing.toml --frames 1-2");
    desk.write(
        "passing.toml",
        PASSING.replace("intensity = 1000", "intensity = 900"),
    );
    let outcome = desk.done("render passing.toml --frames 1-3");
    let lines: Vec<&str> = outcome.stderr.lines().collect();
    assert!(lines[0].contains("  stale because "), "{lines:?}");
    assert!(lines[1].contains("  stale because "), "{lines:?}");
    assert!(!lines[2].contains("because"), "{lines:?}");
    // As the shot was before, the frames are those of another run.
    desk.write("passing.toml", PASSING);
    let outcome = desk.done("render passing.toml --frames 1-3 --json");
    assert_eq!(outcome.frames("rendered"), [1, 2, 3]);
    let file = fs::read_to_string(desk.path("sphere.obj")).unwrap();
    desk.write("sphere.obj", file.replacen("v ", "v  ", 1));
    let outcome = desk.done("render passing.toml --frames 1 --json");
    assert_eq!(outcome.frames("rendered"), [1]);
}

#[test]
fn a_picture_that_was_cut_or_taken_away_is_rendered_anew() {
    let desk = passing();
    desk.done("render glowing.toml --out whole");
    desk.done("render glowing.toml");
    let path = |name: &str| desk.path("renders/glowing").join(name);
    let bytes = fs::read(path("glowing.0002.exr")).unwrap();
    fs::write(path("glowing.0002.exr"), &bytes[..bytes.len() - 1]).unwrap();
    fs::remove_file(path("glowing.0004.png")).unwrap();
    fs::copy(path("glowing.0001.png"), path("glowing.0005.png")).unwrap();
    let outcome = desk.done("render glowing.toml --json");
    assert_eq!(outcome.frames("rendered"), [2, 4, 5]);
    let reasons = outcome.stdout;
    let length = bytes.len();
    for reason in [
        format!("glowing.0002.exr has {} bytes, not {length}", length - 1),
        "glowing.0004.png is missing".to_owned(),
        "glowing.0005.png or glowing.0005.exr is of another run".to_owned(),
    ] {
        assert!(
            reasons.contains(&format!("stale because {reason}")),
            "{reasons}"
        );
    }
    assert!(desk.pictures("renders") == desk.pictures("whole"));
}

#[test]
fn a_folder_survives_without_its_manifest_but_not_its_broken_pictures() {
    let desk = passing();
    desk.done("render glowing.toml");
    fs::remove_file(desk.path("renders/glowing/glowing.manifest.jsonl")).unwrap();
    let exr = desk.path("renders/glowing/glowing.0003.exr");
    let mut bytes = fs::read(&exr).unwrap();
    let end = bytes.len();
    bytes.truncate(end - 10);
    fs::write(&exr, bytes).unwrap();
    let outcome = desk.done("render glowing.toml --json");
    assert_eq!(outcome.frames("rendered"), [3]);
    assert!(
        outcome.stdout.contains("glowing.0003.exr is broken"),
        "{}",
        outcome.stdout
    );
}

/// A frame that is decoded each time would show that a byte of it has been turned.
#[test]
fn frames_found_without_a_manifest_are_written_down_and_not_decoded_again() {
    let desk = passing();
    desk.done("render glowing.toml");
    let manifest = desk.path("renders/glowing/glowing.manifest.jsonl");
    fs::remove_file(&manifest).unwrap();
    let kept = |line: &str| desk.done(line).frames("kept");
    let call = "render glowing.toml --json";
    assert_eq!(kept(call), [1, 2, 3, 4, 5, 6]);
    let written = fs::read_to_string(&manifest).unwrap();
    assert_eq!(written.matches("\"found\":").count(), 6, "{written}");
    let picture = desk.path("renders/glowing/glowing.0003.png");
    let mut bytes = fs::read(&picture).unwrap();
    let middle = bytes.len() - 100;
    bytes[middle] ^= 1;
    fs::write(&picture, &bytes).unwrap();
    assert_eq!(kept(call), [1, 2, 3, 4, 5, 6]);
    assert_eq!(fs::read_to_string(&manifest).unwrap(), written);
    fs::write(&picture, &bytes[..middle]).unwrap();
    let outcome = desk.done(call);
    assert_eq!(outcome.frames("rendered"), [3], "{}", outcome.stdout);
}

#[test]
fn force_renders_what_is_fresh_to_the_same_bytes() {
    let desk = passing();
    desk.done("render glowing.toml");
    let before = desk.pictures("renders");
    let outcome = desk.done("render glowing.toml --force --json");
    assert_eq!(outcome.frames("rendered").len(), 6);
    assert!(desk.pictures("renders") == before);
}
