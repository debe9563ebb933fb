//! Shots of a million frames: what is done about them goes by what is there and what is asked for, not
//! by what could be. Bytes, rows and frames are counted; no time is measured.
use crate::common::WALL;
use crate::common::desk::Desk;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader};

/// Everything moves, so that no two frames are alike.
const SHOT: &str = r#"
[shot]
frames = FRAMES
[image]
size = [8, 8]
samples = 1
[worldline.w]
velocity = { from = [0, 0, 0], to = [0.5, 0, 0] }
[[model]]
file = "wall.obj"
worldline = "w"
material = "hot"
[material.hot]
thermal = { temperature = { from = 2000, to = 4000 } }
[camera]
position = [0, 0, 4]
[sensor]
exposure = 0
"#;

/// A folder with a shot of so many frames, `more` being added to it.
fn huge(frames: u32, more: &str) -> Desk {
    let desk = Desk::new();
    desk.write("wall.obj", WALL);
    let text = SHOT.replace("FRAMES", &frames.to_string());
    desk.write("huge.toml", text + more);
    desk
}

fn page_of(desk: &Desk) -> String {
    desk.read("renders/huge/index.html")
}

#[test]
fn two_frames_of_a_million_have_a_page_of_two() {
    let desk = huge(1_000_000, "");
    let done = desk.call("render huge.toml --frames 1,500000");
    assert_eq!(done.status, 0, "{}", done.stderr);
    for name in ["huge.0000001.png", "huge.0500000.png"] {
        assert!(desk.path("renders/huge").join(name).is_file(), "{name}");
    }
    let page = page_of(&desk);
    assert_eq!(page.matches("<tr id=\"frame-").count(), 2);
    assert_eq!(page.matches("data:image/jpeg").count(), 2);
    // As large as one may be, and not for a million to fit: the pictures are 8 pixels wide.
    assert!(page.contains("<img src=\"data:image/jpeg") && page.len() < 64_000);
    for words in [
        "1000000 frames: 2 rendered in this run, 999998 missing, 0 failed.",
        "Frames 2–499999, 500001–1000000:</b> missing",
        "frames 2–499999: missing",
        "frames 500001–1000000: missing",
        "data-frames=\"1000000\"",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let manifest = fs::read_to_string(desk.path("renders/huge/huge.manifest.jsonl")).unwrap();
    assert_eq!(manifest.lines().count(), 3);
    // All that was asked for is there: nothing is told anew.
    let again = desk.call("render huge.toml --frames 1,500000");
    assert_eq!(again.stderr.matches("kept").count(), 2, "{}", again.stderr);
    // The page tells of other frames when there are some.
    desk.call("render huge.toml --frames 3");
    assert_eq!(page_of(&desk).matches("<tr id=\"frame-").count(), 4);
    assert!(page_of(&desk).contains("frames 4–499999: missing"));
}

#[test]
fn frames_that_are_not_there_are_verified_in_runs() {
    let desk = huge(1_000_000, "[sequence]\ngif = true\n");
    assert_eq!(desk.call("render huge.toml --frames 20,500000").status, 0);
    let told = desk.call("verify huge.toml");
    assert_eq!(told.status, 1, "{}", told.stderr);
    let lines: Vec<&str> = told.stdout.lines().collect();
    assert_eq!(
        lines,
        [
            "huge.0000001.png: missing, as are all up to huge.0000019.png: 19 frames",
            "huge.0000021.png: missing, as are all up to huge.0499999.png: 499979 frames",
            "huge.0500001.png: missing, as are all up to huge.1000000.png: 500000 frames",
            "huge.toml: 2 of 1000000 frames are sound",
        ]
    );
    let assembled = desk.call("assemble huge.toml");
    assert_eq!(assembled.status, 1);
    assert!(
        assembled
            .stderr
            .contains("huge.0000001.png: missing, as are all up to"),
        "{}",
        assembled.stderr
    );
    // For programs each frame has its finding, as in short shots.
    let small = huge(40, "");
    assert_eq!(small.call("render huge.toml --frames 20").status, 0);
    let told = small.call("verify huge.toml --json");
    let told: Value = serde_json::from_str(&told.stdout).unwrap();
    let shot = &told["shots"][0];
    assert_eq!(shot["sound"], 1);
    let findings = shot["findings"].as_array().unwrap();
    assert_eq!(findings.len(), 39);
    for (finding, frame) in findings.iter().zip((1..=40).filter(|n| *n != 20)) {
        assert_eq!(finding["frame"], frame);
        assert_eq!(finding["file"], format!("huge.{frame:04}.png"));
        assert_eq!([&finding["kind"], &finding["why"]], ["missing", "missing"]);
    }
}

#[test]
fn a_plan_is_told_frame_by_frame_and_its_lines_are_not_held() {
    const FRAMES: u32 = 200_000;
    let desk = huge(FRAMES, "");
    let mut plan = desk.spawn("plan huge.toml --json");
    let mut reader = BufReader::new(plan.stdout.take().unwrap());
    let (mut text, mut bytes) = (String::new(), 0);
    let mut line = String::new();
    for number in 0.. {
        line.clear();
        if reader.read_line(&mut line).unwrap() == 0 {
            break;
        }
        bytes += line.len();
        // The first and the last are a whole plan without the others.
        if !(2..FRAMES).contains(&number) {
            text += &line;
        }
        if number == FRAMES - 1000 {
            // It waits for us, with all but the last behind it.
            assert!(peak_kib(plan.id()).is_none_or(|kib| kib < 96 << 10));
        }
    }
    assert!(plan.wait().unwrap().success());
    assert!(bytes > 400 * FRAMES as usize, "{bytes}");
    let plan: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(plan["frames"][0]["frame"], 1);
    assert_eq!(plan["frames"][1]["frame"], FRAMES);
    assert_eq!(plan["frames"][1]["trace"], FRAMES - 1);
    assert_eq!(plan["totals"]["frames"], FRAMES);
    // Whoever reads no more has it end.
    let mut unread = desk.spawn("plan huge.toml --json");
    let mut reader = BufReader::new(unread.stdout.take().unwrap());
    line.clear();
    reader.read_line(&mut line).unwrap();
    assert_eq!(line, "{\"frames\": [\n");
    drop(reader);
    assert!(unread.wait().unwrap().success());
}

/// Greatest resident memory of a process so far, where the system says.
fn peak_kib(process: u32) -> Option<u64> {
    let text = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

#[test]
fn the_plan_in_words_says_the_same_of_many_frames_once() {
    let told = huge(200_000, "").call("plan huge.toml");
    assert_eq!(told.status, 0, "{}", told.stderr);
    assert!(
        told.stdout.contains("200000 frames, 8 x 8 pixels"),
        "{}",
        told.stdout
    );
    assert!(
        told.stdout.contains("frames 2-200000  missing"),
        "{}",
        told.stdout
    );
    assert!(told.stdout.lines().count() < 20, "{}", told.stdout);
}

#[test]
fn shards_of_a_few_frames_of_a_million_take_each_once() {
    let desk = huge(1_000_000, "");
    let mut files = Vec::new();
    for shard in ["1/2", "2/2"] {
        let call = format!("render huge.toml --frames 7,900000,1000000 --shard {shard}");
        assert_eq!(desk.call(&call).status, 0);
        let entries = fs::read_dir(desk.path("renders/huge")).unwrap();
        let names = entries.map(|e| e.unwrap().file_name().into_string().unwrap());
        files.push(names.filter(|name| name.ends_with(".png")).count());
    }
    assert_eq!(files, [2, 3]);
}

#[test]
fn a_sheet_of_a_million_cells_is_told_before_the_first_is_rendered() {
    let desk = huge(1_000_000, "[sequence]\nsheet = { columns = 6 }\n");
    let told = desk.call("render huge.toml --frames 1");
    assert_eq!(told.status, 0, "{}", told.stderr);
    let words = "a sheet of 1000000 frames in 6 columns is larger than 32768 pixels a side at any width; so it is in any number of columns: leave out sequence.sheet";
    assert!(told.stderr.contains(words), "{}", told.stderr);
    assert!(
        told.stderr.find(words) < told.stderr.find("rendered"),
        "{}",
        told.stderr
    );
    let few = huge(20, "[sequence]\nsheet = { columns = 6 }\n").call("check huge.toml");
    assert_eq!((few.status, few.stderr.as_str()), (0, ""));
    let many = huge(100_000, "[sequence]\nsheet = { columns = 6 }\n").call("check huge.toml");
    assert!(
        many.stderr
            .contains("set sequence.sheet.columns nearer to 100"),
        "{}",
        many.stderr
    );
}
