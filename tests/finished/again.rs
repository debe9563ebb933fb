//! What a second call does: the page is written again when it would tell something else, nothing is
//! claimed where nothing is to be made, and what a killed or stopped call left does no harm.

use super::desk::Desk;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const RENDER: [&str; 4] = ["render", "passing.toml", "--progress", "none"];

fn render(desk: &Desk, more: &[&str]) {
    let told = desk.call(&[&RENDER[..], more].concat());
    assert_eq!(told.status, 0, "{}", told.stderr);
}

fn page(desk: &Desk) -> String {
    fs::read_to_string(desk.file("index.html")).unwrap()
}

#[test]
fn a_page_that_would_tell_something_else_is_written_again_though_all_was_kept() {
    let desk = Desk::small("");
    render(&desk, &[]);
    let (first, written) = (page(&desk), fs::metadata(desk.file("index.html")).unwrap());
    render(&desk, &[]);
    let again = fs::metadata(desk.file("index.html")).unwrap();
    assert_eq!(
        written.modified().unwrap(),
        again.modified().unwrap(),
        "nothing is new"
    );

    let shot = fs::read_to_string(desk.path("passing.toml")).unwrap();
    let other = shot
        .replace("A square", "Another")
        .replace("fps = 24", "fps = 25");
    fs::write(desk.path("passing.toml"), other).unwrap();
    render(&desk, &[]);
    let second = page(&desk);
    assert!(!first.contains("Another") && second.contains("Another"));
    assert!(second.contains("25 frames a second"));

    fs::remove_file(desk.file("passing.0004.png")).unwrap();
    render(&desk, &["--frames", "1-3"]);
    assert!(second.contains(", 0 missing") && page(&desk).contains(", 1 missing"));

    fs::write(desk.file("index.html"), "another").unwrap();
    render(&desk, &["--frames", "1-3"]);
    assert!(page(&desk).contains(", 1 missing"));
}

/// So it ends well on a disk that has been made read-only since, too.
#[test]
fn a_call_with_nothing_to_make_claims_nothing() {
    let desk = Desk::small("apng = true");
    render(&desk, &[]);
    // Where the folder of the claims would be.
    fs::write(desk.file(".passing.locks"), "").unwrap();
    render(&desk, &[]);
    fs::remove_file(desk.file("passing.apng")).unwrap();
    let told = desk.call(&RENDER);
    assert_eq!(told.status, 1);
    assert!(
        told.stderr.contains(".passing.locks is no folder"),
        "{}",
        told.stderr
    );
}

#[test]
fn what_a_killed_call_left_is_swept_by_assemble_too() {
    let desk = Desk::small("apng = true");
    fs::write(desk.file("passing.apng.AbC123.tmp"), "torn").unwrap();
    assert_eq!(desk.assemble().status, 0);
    assert_eq!(desk.names(".tmp"), [""; 0]);
    assert_eq!(desk.findings(), [""; 0]);
}

/// Waits for something, at most half a minute.
fn until(what: &str, mut is: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is() {
        assert!(begin.elapsed() < Duration::from_secs(30), "{what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_call_told_to_stop_while_it_assembles_ends_ffmpeg_and_leaves_nothing() {
    let desk = Desk::small("page = false\nvideo = \"mp4\"");
    // The first never reads a byte, the second reads all and never ends.
    for script in ["exec sleep 60", "cat > /dev/null; exec sleep 60"] {
        for call in [&RENDER[..], &["assemble", "passing.toml"]] {
            let pid = desk.path("pid");
            let _ = fs::remove_file(&pid);
            let line = format!("#!/bin/sh\necho $$ > {}\n{script}\n", pid.display());
            let path = desk.with_ffmpeg(&line);
            let mut child = Command::new(env!("CARGO_BIN_EXE_restframe"))
                .current_dir(desk.path(""))
                .args(call)
                .env("PATH", path)
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
            let told = || fs::read_to_string(&pid).unwrap_or_default();
            until("ffmpeg starts", || told().ends_with('\n'));
            let ffmpeg = told();
            // Until all frames have gone to it, or as many as the pipe holds.
            std::thread::sleep(Duration::from_millis(300));
            let begin = Instant::now();
            let sent = Command::new("kill").arg(child.id().to_string()).status();
            assert!(sent.unwrap().success());
            let ended = child.wait().unwrap();
            assert_eq!(ended.code(), Some(143), "{script}, {call:?}");
            // Two seconds are promised.
            let took = begin.elapsed();
            assert!(
                took < Duration::from_secs(2),
                "{script}, {call:?}: {took:?}"
            );
            assert_eq!(desk.names(".tmp"), [""; 0], "{script}, {call:?}");
            assert_eq!(desk.names(".locks"), [""; 0], "{script}, {call:?}");
            let ffmpeg = Path::new("/proc").join(ffmpeg.trim());
            until("ffmpeg ends", || !ffmpeg.exists());
        }
    }
}

#[test]
fn every_file_that_cannot_be_made_is_named() {
    let desk = Desk::small("gif = true\napng = true\npage = false");
    // Folders in the places of both.
    for name in ["passing.gif", "passing.apng"] {
        fs::create_dir(desk.file(name)).unwrap();
    }
    let told = desk.call(&RENDER);
    assert_eq!(told.status, 1);
    for name in ["passing.gif", "passing.apng"] {
        assert!(told.stderr.contains(name), "{name}: {}", told.stderr);
    }
}

#[test]
fn a_frame_that_was_found_without_a_record_is_verified_by_its_bytes_from_then_on() {
    let desk = Desk::small("page = false");
    fs::remove_file(desk.file("passing.manifest.jsonl")).unwrap();
    render(&desk, &[]);
    assert_eq!(desk.findings(), [""; 0]);
    // A letter of the title, in the header's text: the picture itself stays.
    let file = desk.file("passing.0004.png");
    let mut bytes = fs::read(&file).unwrap();
    let title = bytes
        .windows(8)
        .position(|eight| eight == b"A square")
        .unwrap();
    bytes[title] = b'B';
    fs::write(&file, bytes).unwrap();
    assert_eq!(desk.findings(), ["changed passing.0004.png"]);
}

/// In the middle of a file as at its end.
#[cfg(unix)]
#[test]
fn a_file_that_cannot_be_written_says_where_and_what_to_do() {
    let desk = Desk::small("gif = true\napng = true\nsheet = { columns = 4 }\npage = false");
    let line = "ulimit -f 3; exec \"$0\" assemble passing.toml";
    let told = std::process::Command::new("sh")
        .args(["-c", line, env!("CARGO_BIN_EXE_restframe")])
        .current_dir(desk.path(""))
        .output()
        .unwrap();
    assert_eq!(told.status.code(), Some(1));
    let said = String::from_utf8(told.stderr).unwrap();
    for name in ["passing.gif", "passing.apng", "passing.sheet.png"] {
        let place = format!("cannot write renders/passing/{name}: ");
        let lines: Vec<&str> = said.lines().filter(|line| line.contains(&place)).collect();
        assert_eq!(lines.len(), 1, "{name}: {said}");
        assert!(lines[0].contains("raise the limit on file sizes"), "{said}");
    }
    assert_eq!(desk.names(".tmp"), [""; 0]);
}
