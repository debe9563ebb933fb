//! What `restframe verify` finds.

use super::desk::{Desk, FRAMES, SMALL, record};
use restframe::store::{Request, ShotFolder};
use restframe::{sequence, shot};
use std::fs;
use std::path::Path;
use std::process::Command;

const BOTH: &str = "[output]\nformats = [\"png\", \"exr\"]";

#[test]
fn frames_as_they_were_rendered_are_sound() {
    let desk = Desk::new(SMALL, BOTH);
    let told = desk.verify();
    assert_eq!((told.status, told.stderr.as_str()), (0, ""));
    assert_eq!(told.stdout, "passing.toml: 10 frames are sound\n");
    assert_eq!(desk.findings(), [""; 0]);
}

#[test]
fn every_kind_of_damage_is_named_with_its_frame() {
    let desk = Desk::new(SMALL, BOTH);
    fs::remove_file(desk.file("passing.0001.png")).unwrap();
    fs::remove_file(desk.file("passing.0002.png")).unwrap();
    fs::remove_file(desk.file("passing.0002.exr")).unwrap();
    fs::write(desk.file("passing.0003.png"), "").unwrap();
    desk.cut("passing.0004.exr", 0.9);
    desk.cut("passing.0005.png", 0.5);
    let mut bytes = fs::read(desk.file("passing.0006.png")).unwrap();
    let middle = bytes.len() - 40;
    bytes[middle] ^= 0x55;
    fs::write(desk.file("passing.0006.png"), bytes).unwrap();
    fs::write(desk.file("passing.0007.exr"), "no picture at all").unwrap();
    let told = desk.verify();
    assert_eq!(told.status, 1);
    let lines: Vec<&str> = told.stdout.lines().collect();
    for (line, begins) in lines.iter().zip([
        "passing.0001.png: missing",
        "passing.0002.png: missing",
        "passing.0003.png: empty",
        "passing.0004.exr: truncated: it has ",
        "passing.0005.png: truncated: it has ",
        "passing.0006.png: damaged: ",
        "passing.0007.exr: truncated: it has 17 of ",
        "passing.toml: 3 of 10 frames are sound",
    ]) {
        assert!(line.starts_with(begins), "{line:?} is not {begins:?}");
    }
    assert_eq!(lines.len(), 8, "{}", told.stdout);
}

#[test]
fn a_whole_picture_that_is_another_than_was_written_is_found() {
    let desk = Desk::small("");
    fs::copy(desk.file("passing.0006.png"), desk.file("passing.0005.png")).unwrap();
    assert_eq!(desk.findings(), ["changed passing.0005.png"]);
}

#[test]
fn values_that_are_not_finite_and_another_size_are_found_though_recorded() {
    let desk = Desk::new(SMALL, BOTH);
    desk.put_exr(3, [64, 64], f32::NAN);
    desk.put_exr(4, [64, 64], f32::INFINITY);
    desk.put_exr(5, [32, 64], 0.25);
    desk.put_exr(6, [64, 64], 0.25);
    desk.put_png(8, &image::RgbImage::new(64, 63));
    desk.record();
    assert_eq!(
        desk.findings(),
        [
            "not-finite passing.0003.exr",
            "not-finite passing.0004.exr",
            "wrong-size passing.0005.exr",
            "wrong-size passing.0008.png",
        ]
    );
    let told = desk.verify().stdout;
    assert!(
        told.contains("passing.0003.exr: not finite: NaN or infinite values, 1 in G"),
        "{told}"
    );
    assert!(
        told.contains("passing.0008.png: wrong size: 64 x 63 pixels, not 64 x 64 pixels"),
        "{told}"
    );
}

#[test]
fn frames_of_other_settings_are_stale_and_it_is_said_why() {
    let desk = Desk::small("");
    let told = desk.call(&["verify", "passing.toml", "--samples", "3"]);
    assert_eq!(told.status, 1);
    assert!(
        told.stdout.contains("passing.0010.png: stale: "),
        "{}",
        told.stdout
    );
    assert!(
        told.stdout.contains("0 of 10 frames are sound"),
        "{}",
        told.stdout
    );
    let told = desk.call(&["verify", "passing.toml", "--scale", "0.5"]);
    assert_eq!(
        told.stdout.lines().count(),
        FRAMES as usize + 1,
        "{}",
        told.stdout
    );
    assert!(!told.stdout.contains("wrong size"), "{}", told.stdout);
}

#[test]
fn what_does_not_belong_to_the_shot_is_an_orphan() {
    let desk = Desk::small("apng = true");
    for name in [
        "passing.0011.png",
        "passing.0003.exr",
        "passing.00004.png",
        "passing.0002.png.restframe-aB3xY9.tmp",
        "passing.gif",
        "passing.apng",
        "notes.txt",
        "passing.txt",
        "passings.0011.png",
    ] {
        fs::write(desk.file(name), "x").unwrap();
    }
    assert_eq!(
        desk.findings(),
        [
            "orphan passing.00004.png",
            "orphan passing.0002.png.restframe-aB3xY9.tmp",
            "orphan passing.0003.exr",
            "orphan passing.0011.png",
            "orphan passing.gif",
        ]
    );
    let told = desk.verify().stdout;
    assert!(
        told.contains("passing.0011.png: orphan: the shot has frames 1 to 10"),
        "{told}"
    );
    assert!(
        told.ends_with("passing.toml: 10 frames are sound\n"),
        "{told}"
    );
}

#[test]
fn a_black_or_shifted_frame_does_not_fit_between_its_neighbors() {
    for frame in [1, 5, FRAMES] {
        let desk = Desk::small("");
        desk.put_png(frame, &image::RgbImage::new(64, 64));
        desk.record();
        assert_eq!(desk.findings(), [format!("outlier passing.{frame:04}.png")]);
    }
    let desk = Desk::small("");
    let mut shifted = desk.frame(5).into_raw();
    shifted.rotate_right((20 * 64 + 9) * 3);
    desk.put_png(5, &image::RgbImage::from_raw(64, 64, shifted).unwrap());
    desk.record();
    assert_eq!(desk.findings(), ["outlier passing.0005.png"]);
}

#[test]
fn a_folder_that_is_not_there_has_no_frames_and_a_mistake_hides_no_other_shot() {
    let desk = Desk::small("");
    let told = desk.call(&["verify", "passing.toml", "--out", "elsewhere"]);
    assert_eq!(told.status, 1);
    assert!(
        told.stdout.ends_with("0 of 10 frames are sound\n"),
        "{}",
        told.stdout
    );
    fs::write(desk.path("wrong.toml"), "[camera]\n").unwrap();
    let told = desk.call(&["verify", "wrong.toml", "passing.toml"]);
    assert_eq!(told.status, 2, "{}", told.stderr);
    assert!(
        told.stdout.contains("10 frames are sound"),
        "{}",
        told.stdout
    );
}

#[test]
fn ramps_of_velocity_pans_and_flights_have_no_outliers() {
    for name in ["rows", "array-pan", "lattice"] {
        let shots = Path::new(env!("CARGO_MANIFEST_DIR")).join("shots");
        let path = shots.join(format!("{name}.toml"));
        let folder = tempfile::tempdir().unwrap();
        let rendered = Command::new(env!("CARGO_BIN_EXE_restframe"))
            .arg("render")
            .arg(&path)
            .args([
                "--scale",
                "0.1",
                "--samples",
                "1",
                "--progress",
                "none",
                "--out",
            ])
            .arg(folder.path())
            .status()
            .unwrap();
        assert!(rendered.success());
        let request = Request {
            out: folder.path().to_owned(),
            scale: 0.1,
            samples: Some(1),
        };
        let mut shot_folder = ShotFolder::open(&shot::load(&path).unwrap(), &request).unwrap();
        record(&shot_folder);
        shot_folder.refresh().unwrap();
        assert_eq!(sequence::verify(&shot_folder).findings, [], "{name}");
    }
}

/// Verifies the desk's shot by a command that begins so; a call that never ends is status 124.
#[cfg(target_os = "linux")]
fn verify_by(desk: &Desk, command: &str) -> (Option<i32>, String) {
    let line = format!(
        "{command} {} verify passing.toml",
        env!("CARGO_BIN_EXE_restframe")
    );
    let told = Command::new("sh")
        .args(["-c", &line])
        .current_dir(desk.path(""))
        .output()
        .unwrap();
    (told.status.code(), String::from_utf8(told.stdout).unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_in_place_of_frames_hold_nobody_up() {
    let desk = Desk::new(SMALL, BOTH);
    for name in ["passing.0003.png", "passing.0005.exr"] {
        fs::remove_file(desk.file(name)).unwrap();
        let made = Command::new("mkfifo").arg(desk.file(name)).status();
        assert!(made.unwrap().success());
    }
    let (status, said) = verify_by(&desk, "timeout 30");
    assert_eq!(status, Some(1));
    for file in ["passing.0003.png", "passing.0005.exr"] {
        let line = format!("{file}: unreadable: it is no regular file; move it away\n");
        assert!(said.contains(&line), "{said}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_header_that_claims_two_billion_bytes_is_not_believed() {
    let desk = Desk::new(SMALL, BOTH);
    // Magic number, version 2, and an attribute of so many bytes.
    let mut bytes = b"\x76\x2f\x31\x01\x02\0\0\0fingerprint\0string\0".to_vec();
    bytes.extend(2_000_000_000_u32.to_le_bytes());
    fs::write(desk.file("passing.0004.exr"), bytes).unwrap();
    let file = fs::File::options()
        .append(true)
        .open(desk.file("passing.0004.exr"));
    file.unwrap().set_len(2_000_001_000).unwrap();
    // KiB of addresses, less than the attribute alone would take.
    let (status, said) = verify_by(&desk, "ulimit -v 1900000; timeout 30");
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("9 of 10 frames are sound"), "{said}");
}

#[test]
fn a_scale_that_no_picture_can_have_is_a_mistake_of_the_call() {
    let desk = Desk::small("");
    for command in ["verify", "assemble", "render", "plan"] {
        let told = desk.call(&[command, "passing.toml", "--scale", "1000"]);
        assert_eq!(told.status, 2, "{command}: {}", told.stdout);
        assert!(
            told.stderr.contains("--scale 1000 makes 64000"),
            "{}",
            told.stderr
        );
    }
}

#[test]
fn every_shot_of_the_call_is_in_the_answer_as_json() {
    let desk = Desk::small("apng = true");
    fs::write(desk.path("wrong.toml"), "[camera]\n").unwrap();
    let answer = |command: &str| -> serde_json::Value {
        let told = desk.call(&[command, "wrong.toml", "passing.toml", "--json"]);
        assert_eq!(told.status, 2, "{}", told.stderr);
        serde_json::from_str(&told.stdout).unwrap()
    };
    for command in ["verify", "assemble"] {
        let answer = answer(command);
        assert_eq!(answer["shots"][0]["shot"], "wrong.toml");
        let mistakes = answer["shots"][0]["mistakes"].to_string();
        assert!(mistakes.contains("[[model]]"), "{mistakes}");
        assert_eq!(answer["shots"][1]["shot"], "passing.toml");
    }
    // In the way of whoever claims.
    fs::write(desk.file(".passing.locks"), "").unwrap();
    let error = answer("assemble")["shots"][1]["error"].clone();
    let said = error.as_str().unwrap();
    assert!(said.contains(".passing.locks is no folder"), "{error}");
}
