//! Sequences of which nothing must be made, and what is said instead.

use super::desk::{Desk, SMALL};
use std::fs;

const ALL: &str = "gif = true\napng = true\nvideo = \"mp4\"\nsheet = { columns = 4, width = 64 }";

/// Nothing is made of the desk's frames, and the reason begins so for a file.
fn refused(desk: &Desk, why: &str) {
    let told = desk.assemble();
    assert_eq!(told.status, 1, "{}", told.stderr);
    assert_eq!(told.stdout, "");
    assert!(
        told.stderr.contains("nothing is assembled"),
        "{}",
        told.stderr
    );
    assert!(told.stderr.contains(why), "{}", told.stderr);
    for suffix in [".gif", ".apng", ".mp4", "sheet.png", ".tmp"] {
        assert_eq!(desk.names(suffix), [""; 0]);
    }
}

#[test]
fn a_gap_and_an_empty_frame_are_refused_by_name() {
    let desk = Desk::small(ALL);
    let picture = fs::read(desk.file("passing.0005.png")).unwrap();
    fs::remove_file(desk.file("passing.0005.png")).unwrap();
    refused(&desk, "passing.0005.png: missing");
    fs::write(desk.file("passing.0005.png"), "").unwrap();
    refused(&desk, "passing.0005.png: empty");
    fs::write(desk.file("passing.0005.png"), picture).unwrap();
    assert_eq!(desk.assemble().status, 0);
}

#[test]
fn a_truncated_exr_and_one_with_nan_are_refused_by_name() {
    let both = format!("[output]\nformats = [\"png\", \"exr\"]\n[sequence]\n{ALL}");
    let desk = Desk::new(SMALL, &both);
    let picture = fs::read(desk.file("passing.0005.exr")).unwrap();
    desk.cut("passing.0005.exr", 0.8);
    refused(&desk, "passing.0005.exr: truncated");
    fs::write(desk.file("passing.0005.exr"), picture).unwrap();
    desk.put_exr(9, [64, 64], f32::NAN);
    desk.record();
    refused(&desk, "passing.0009.exr: not finite");
}

#[test]
fn stale_frames_are_refused() {
    let desk = Desk::small(ALL);
    let told = desk.call(&["assemble", "passing.toml", "--samples", "9"]);
    assert_eq!(told.status, 1);
    assert!(
        told.stderr.contains("passing.0001.png: stale"),
        "{}",
        told.stderr
    );
    assert!(told.stderr.contains("and 2 more"), "{}", told.stderr);
}

#[test]
fn an_outlier_is_a_warning_and_an_orphan_none() {
    let desk = Desk::small("apng = true");
    desk.put_png(5, &image::RgbImage::new(64, 64));
    desk.record();
    fs::write(desk.file("passing.0099.png"), "x").unwrap();
    let told = desk.assemble();
    assert_eq!(told.status, 0, "{}", told.stderr);
    assert!(
        told.stderr
            .starts_with("warning: passing.0005.png: outlier"),
        "{}",
        told.stderr
    );
    assert_eq!(told.stderr.lines().count(), 1);
}

#[test]
fn a_shot_that_asks_for_nothing_is_told_what_it_could() {
    let told = Desk::small("").assemble();
    assert_eq!(told.stdout, "renders/passing/index.html\n");
    let told = Desk::small("page = false").assemble();
    assert_eq!((told.status, told.stdout.as_str()), (0, ""));
    assert!(
        told.stderr.contains("nothing to assemble; ask for sheet"),
        "{}",
        told.stderr
    );
}
