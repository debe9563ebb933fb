//! The page about a shot's frames: each of them is on it, whatever became of it, and nothing on it
//! is more than text.
use indexmap::IndexMap;
use restframe::image::Metadata;
use restframe::progress::FrameOutcome;
use restframe::queue::Stop;
use restframe::sequence::page::{Outcomes, write};
use restframe::shot::parse;
use restframe::store::{FileRecord, Record, Request, Seconds, ShotFolder};
use std::fs;
use std::path::{Path, PathBuf};

const SHOT: &str = r#"
[shot]
title = "TITLE"
frames = FRAMES
fps = 12
time = { from = 0, to = 1 }
[image]
size = [160, 90]
samples = 2
[worldline.fast]
velocity = { from = [0, 0, 0], to = [0.8, 0, 0] }
[[model]]
file = "quad.obj"
worldline = "fast"
[material.hot.thermal]
temperature = { from = 0, to = 5500 }
[camera]
position = [0, 0, 3]
[sequence]
sheet = { columns = 6 }
"#;

/// A folder of its own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("page-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(
        folder.join("quad.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl hot\nf 1 2 3\n",
    )
    .unwrap();
    folder
}

fn shot_folder(folder: &Path, file: &str, title: &str, frames: u32) -> ShotFolder {
    let text = SHOT
        .replace("TITLE", title)
        .replace("FRAMES", &frames.to_string());
    let shot = parse(&text, &folder.join(file)).unwrap();
    let request = Request {
        out: folder.to_owned(),
        scale: 1.0,
        samples: None,
    };
    ShotFolder::open(&shot, &request).unwrap()
}

/// A picture unlike those of other frames, and hard to make small: noise on a hue.
fn png(shot_folder: &ShotFolder, frame: u32) -> Vec<u8> {
    let mut state = frame;
    let image = image::RgbImage::from_fn(160, 90, |x, _| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        image::Rgb([(state >> 24) as u8, (frame * 20) as u8, x as u8])
    });
    let metadata = Metadata {
        fingerprint: Some(shot_folder.keys.frame(frame).fingerprint),
        ..Metadata::default()
    };
    restframe::image::png::encode(160, 90, image.as_raw(), &metadata).unwrap()
}

/// The record of a finished frame.
fn record(shot_folder: &ShotFolder, frame: u32, bytes: u64) -> Record {
    let key = shot_folder.keys.frame(frame);
    let time = |seconds: f64| seconds * (1.0 + f64::from(frame) / 12.0);
    Record {
        frame,
        fingerprint: key.fingerprint,
        parts: key.inputs,
        files: vec![FileRecord {
            name: shot_folder.names.frame(frame, "png"),
            bytes,
            blake3: "0".repeat(64),
        }],
        size: [160, 90],
        samples: 2,
        effects: vec!["geometry".to_owned(), "doppler".to_owned()],
        trace: key.trace,
        shared: if frame > 4 { 3 } else { 1 },
        exposure: -6.25,
        seconds: Seconds {
            prepare: time(0.01),
            trace: time(0.12),
            shade: time(0.05),
            encode: time(0.02),
            write: time(0.003),
        },
        warnings: if frame == 5 {
            vec!["7 values <beyond> what a file can hold were clamped".to_owned()]
        } else {
            Vec::new()
        },
        cut: 0.0,
        memory_mib: Some(80),
        threads: 2,
        host: "owl".to_owned(),
        version: "0.1.0".to_owned(),
        finished: format!("2026-01-02T03:04:{:02}Z", frame % 60),
    }
}

/// Writes some frames and their manifest, as a finished run leaves them.
fn finish(shot_folder: &mut ShotFolder, frames: &[u32]) {
    fs::create_dir_all(&shot_folder.path).unwrap();
    let mut lines = String::new();
    for &frame in frames {
        let bytes = png(shot_folder, frame);
        fs::write(
            shot_folder.path.join(shot_folder.names.frame(frame, "png")),
            &bytes,
        )
        .unwrap();
        let record = record(shot_folder, frame, bytes.len() as u64);
        lines += &(serde_json::to_string(&record).unwrap() + "\n");
    }
    fs::write(
        shot_folder.path.join(shot_folder.names.manifest(None)),
        lines,
    )
    .unwrap();
    shot_folder.refresh().unwrap();
}

fn page(shot_folder: &ShotFolder, outcomes: &Outcomes) -> String {
    let path = write(shot_folder, outcomes, &Stop::default())
        .unwrap()
        .unwrap();
    assert_eq!(path, shot_folder.path.join("index.html"));
    fs::read_to_string(path).unwrap()
}

/// The row of a frame in the table.
fn row(page: &str, frame: u32) -> &str {
    let rest = page
        .split_once(&format!("<tr id=\"frame-{frame}\">"))
        .unwrap()
        .1;
    rest.split_once("</tr>").unwrap().0
}

fn outcomes() -> Outcomes {
    let rendered = FrameOutcome::Rendered {
        reason: Some("it was missing".to_owned()),
        seconds: 0.2,
        cut: 0.0,
    };
    let kept = FrameOutcome::Kept { reason: None };
    let failed = FrameOutcome::Failed {
        reason: "the disk is full".to_owned(),
    };
    Outcomes::from([(1, rendered), (2, kept), (4, failed)])
}

#[test]
fn every_frame_is_there_or_accounted_for() {
    let folder = folder("states");
    let mut shot_folder = shot_folder(&folder, "states.toml", "All kinds", 8);
    finish(&mut shot_folder, &[1, 2, 5, 6, 7, 8]);
    let file = |frame| shot_folder.path.join(shot_folder.names.frame(frame, "png"));
    // Of the length that the manifest has, and with a sound header, but no picture.
    let mut bytes = fs::read(file(6)).unwrap();
    let half = bytes.len() / 2;
    bytes[half..].fill(7);
    fs::write(file(6), bytes).unwrap();
    let short = fs::read(file(7)).unwrap();
    fs::write(file(7), &short[..short.len() / 2]).unwrap();
    let short = format!("stale: states.0007.png has {} bytes", short.len() / 2);
    let page = page(&shot_folder, &outcomes());
    for (frame, state) in [
        (1, "rendered: it was missing"),
        (2, "kept"),
        (3, "missing"),
        (4, "failed: the disk is full"),
        (5, "finished"),
        (6, "broken: "),
        (7, &short),
        (8, "finished"),
    ] {
        let row = row(&page, frame);
        assert!(row.contains(&format!("<td>{state}")), "{frame}: {row}");
    }
    let header = page.split_once("<header>").unwrap().1;
    let header = header.split_once("</header>").unwrap().0;
    for words in [
        "8 frames: 1 rendered in this run, 1 kept, 2 finished, 1 stale, 1 missing, 1 broken, 1 failed.",
        "<b>Frame 3:</b> missing",
        "<b>Frame 4:</b> failed: the disk is full",
        "<b>Frame 5:</b> 7 values &lt;beyond&gt; what",
        "restframe 0.1.0",
        "2 threads",
    ] {
        assert!(header.contains(words), "{words} in {header}");
    }
    // Warnings come before the counts.
    assert!(header.find("Frame 3") < header.find("8 frames:"));
    // Frames 3, 4, 6 and 7 have no picture, the others have one each.
    assert_eq!(page.matches("no picture").count(), 4);
    assert_eq!(page.matches("data:image/jpeg").count(), 4);
}

#[test]
fn what_moves_stands_in_the_row_of_its_frame() {
    let folder = folder("facts");
    let mut shot_folder = shot_folder(&folder, "facts.toml", "Facts", 12);
    finish(&mut shot_folder, &(1..=12).collect::<Vec<u32>>());
    let page = page(&shot_folder, &Outcomes::default());
    // In the last frame β is 0.8, γ 1/0.6, the material is at 5500 K and the clock at 1 s.
    for value in ["1", "0.8", "1.6667", "5500", "−6.25"] {
        let cell = format!("<td class=\"n\">{value}</td>");
        assert!(
            row(&page, 12).contains(&cell),
            "{value}: {}",
            row(&page, 12)
        );
    }
    assert!(row(&page, 12).contains("shared by 3 frames"));
    assert!(row(&page, 12).contains("href=\"./facts.0012.png\""));
    assert_eq!(
        page,
        fs::read_to_string(
            write(&shot_folder, &Outcomes::default(), &Stop::default())
                .unwrap()
                .unwrap()
        )
        .unwrap()
    );
}

/// A run that is killed between a picture and its record leaves that of an older picture.
#[test]
fn a_record_of_another_picture_is_not_told_of() {
    let folder = folder("older");
    let mut shot_folder = shot_folder(&folder, "older.toml", "Older", 2);
    finish(&mut shot_folder, &[1, 2]);
    let record = shot_folder.records.get_mut(&2).unwrap();
    record.fingerprint = "0".repeat(64);
    record.warnings = vec!["of the older one".to_owned()];
    let page = page(&shot_folder, &Outcomes::default());
    assert!(row(&page, 2).contains("<td>finished"), "{}", row(&page, 2));
    assert!(row(&page, 1).contains("−6.25") && !row(&page, 2).contains("−6.25"));
    assert!(!page.contains("of the older one"));
}

#[test]
fn names_of_strangers_are_text_and_nothing_else() {
    let folder = folder("strange");
    let script = "<script>alert(1)</script>";
    let stem = "a#b?<script>alert(2)<&'\\\"x";
    let mut shot_folder = shot_folder(&folder, &format!("{stem}.toml"), script, 2);
    finish(&mut shot_folder, &[1, 2]);
    let sheet = shot_folder.names.assembled("sheet.png");
    fs::write(shot_folder.path.join(sheet), "").unwrap();
    shot_folder.records.get_mut(&1).unwrap().parts =
        IndexMap::from([("<img src=x>".to_owned(), "\"onload=\"alert(3)".to_owned())]);
    let page = page(&shot_folder, &Outcomes::default());
    assert_eq!(page.matches("<script>").count(), 1, "the page's own");
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;: frames</title>"));
    assert!(!page.contains("<img src=x>") && !page.contains("\"onload=\""));
    // As RFC 3986 has it, so that neither # nor ? ends the path.
    let link = "href=\"./a%23b%3F%3Cscript%3Ealert%282%29%3C%26%27%5C%22x.0001.png\"";
    assert!(page.contains(link));
    assert!(page.contains("%22x.sheet.png\">contact sheet</a>"));
}

#[test]
fn what_is_assembled_is_linked_where_it_is_there() {
    let folder = folder("links");
    let mut shot_folder = shot_folder(&folder, "links.toml", "Links", 1);
    finish(&mut shot_folder, &[1]);
    assert!(!page(&shot_folder, &Outcomes::default()).contains("<nav"));
    fs::write(shot_folder.path.join("links.gif"), vec![0; 12_300]).unwrap();
    fs::write(shot_folder.path.join("links.mp4"), vec![0; 2_000_000]).unwrap();
    let page = page(&shot_folder, &Outcomes::default());
    for words in [
        "./links.gif\">GIF</a>",
        "12.3 kB",
        "./links.mp4\">video</a>",
        "2 MB",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("apng"));
}

#[test]
fn a_page_of_a_thousand_noisy_frames_has_less_than_15_megabytes() {
    let folder = folder("thousand");
    let mut shot_folder = shot_folder(&folder, "thousand.toml", "Thousand", 1000);
    finish(&mut shot_folder, &[1]);
    let first = shot_folder.path.join(shot_folder.names.frame(1, "png"));
    let length = fs::metadata(&first).unwrap().len();
    for frame in 2..=1000 {
        fs::hard_link(
            &first,
            shot_folder.path.join(shot_folder.names.frame(frame, "png")),
        )
        .unwrap();
        let record = record(&shot_folder, frame, length);
        shot_folder.records.insert(frame, record);
    }
    let page = page(&shot_folder, &Outcomes::default());
    fs::remove_dir_all(&folder).unwrap();
    assert_eq!(page.matches("data:image/jpeg").count(), 1000);
    assert!(page.len() < 15_000_000, "{} bytes", page.len());
}

#[test]
fn a_shot_without_a_folder_has_no_page_and_says_so() {
    let folder = folder("absent");
    let shot_folder = shot_folder(&folder, "absent.toml", "Absent", 1);
    let error = write(&shot_folder, &Outcomes::default(), &Stop::default()).unwrap_err();
    assert!(
        error.to_string().contains("must be an existing folder"),
        "{error}"
    );
}
