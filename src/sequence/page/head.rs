//! The part of the page above the frames: the shot, the outcome of the run, warnings.

use super::super::output::OUTPUTS;
use super::frame_row::{Contents, Entry, FrameRow, beside, span};
use crate::plot::STYLE;
use crate::plot::quantity::{bytes, time};
use crate::sequence::findings::{Run, count};
use crate::store::{Record, ShotFolder};
use indexmap::IndexMap;
use maud::{Markup, PreEscaped, html};

fn title(shot_folder: &ShotFolder) -> &str {
    shot_folder
        .shot()
        .shot
        .title
        .as_deref()
        .unwrap_or(&shot_folder.names.stem)
}

/// The `head` of the page. It allows images from its folder and nothing from anywhere else.
pub(super) fn head(shot_folder: &ShotFolder) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self' data: file:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
            link rel="icon" href="data:,";
            title { (title(shot_folder)) ": frames" }
            style { (PreEscaped(STYLE)) (PreEscaped(include_str!("style.css"))) }
        }
    }
}

/// Warnings first, then the counts, and links to what was assembled.
pub(super) fn opening(shot_folder: &ShotFolder, contents: &Contents<'_>) -> Markup {
    let rows = &contents.rows;
    html! {
        header {
            p.kicker { "Frames" }
            h1 { (title(shot_folder)) }
            (warnings(contents))
            p #counts { strong { (counts(contents)) } }
            p.facts { (shot_file(shot_folder)) (when(rows)) (seconds(rows)) (machines(rows)) }
            (assembled(shot_folder))
        }
    }
}

/// Faults, and warnings of the frames' records, each with its frames.
fn warnings(contents: &Contents<'_>) -> Markup {
    let mut frames: IndexMap<String, Vec<Run>> = IndexMap::new();
    for entry in contents.entries() {
        let (words, run) = match entry {
            Entry::Gap(run) => ("missing".to_owned(), run.clone()),
            Entry::Frame(row) if row.state.is_amiss() => {
                let reason = row.state.reason().map(|b| format!(": {b}"));
                let words = format!("{}{}", row.state.word(), reason.unwrap_or_default());
                (words, row.frame..=row.frame)
            }
            Entry::Frame(_) => continue,
        };
        add(frames.entry(words).or_default(), run);
    }
    for row in &contents.rows {
        for warning in row.record.iter().flat_map(|record| &record.warnings) {
            let run = row.frame..=row.frame;
            add(frames.entry(warning.clone()).or_default(), run);
        }
    }
    html! {
        @if !frames.is_empty() {
            section.noise.warning aria-label="Warnings" {
                ul {
                    @for (words, frames) in &frames {
                        li { b { (named(frames)) ":" } " " (words) }
                    }
                }
            }
        }
    }
}

/// Adds a run after others.
fn add(runs: &mut Vec<Run>, run: Run) {
    match runs.last_mut() {
        Some(last) if last.end() + 1 == *run.start() => *last = *last.start()..=*run.end(),
        _ => runs.push(run),
    }
}

/// `72 frames: 60 rendered in this run, 12 kept.`
fn counts(contents: &Contents<'_>) -> String {
    let gaps: u32 = contents.gaps.iter().map(count).sum();
    let mut counts: IndexMap<&str, usize> = IndexMap::new();
    for word in [
        "rendered", "kept", "finished", "stale", "missing", "broken", "failed",
    ] {
        let shown = contents.rows.iter().filter(|v| v.state.word() == word);
        let missing = if word == "missing" { gaps } else { 0 };
        let count = shown.count() + missing as usize;
        // Users look for the statement that nothing is missing.
        if count > 0 || matches!(word, "missing" | "failed") {
            counts.insert(word, count);
        }
    }
    let words: Vec<String> = counts
        .iter()
        .map(|(word, count)| match *word {
            "rendered" => format!("{count} rendered in this run"),
            word => format!("{count} {word}"),
        })
        .collect();
    let plural = if contents.frames == 1 { "" } else { "s" };
    format!("{} frame{plural}: {}.", contents.frames, words.join(", "))
}

fn shot_file(shot_folder: &ShotFolder) -> String {
    let picture = shot_folder.keys.resolution();
    let [width, height] = picture.size;
    let fps = shot_folder.shot().shot.fps;
    let plural = if picture.samples == 1 { "" } else { "s" };
    format!(
        "{}, {width} × {height} pixels, {} sample{plural} a pixel, {fps} frames a second. ",
        shot_folder.shot().path.display(),
        picture.samples
    )
}

fn records<'a>(rows: &'a [FrameRow<'a>]) -> impl Iterator<Item = &'a Record> {
    rows.iter().filter_map(|row| row.record)
}

fn when(rows: &[FrameRow<'_>]) -> String {
    let finished = || records(rows).map(|record| record.finished.as_str());
    match (finished().min(), finished().max()) {
        (Some(first), Some(last)) if first != last => {
            format!("The first frame was finished at {first}, the last at {last}. ")
        }
        (Some(only), _) => format!("Finished at {only}. "),
        _ => String::new(),
    }
}

fn seconds(rows: &[FrameRow<'_>]) -> String {
    let all: f64 = records(rows).map(|record| record.seconds.total()).sum();
    format!("Rendering all frames took {}. ", time(all))
}

fn machines(rows: &[FrameRow<'_>]) -> String {
    let mut machines: Vec<String> = Vec::new();
    for record in records(rows) {
        let plural = if record.threads == 1 { "" } else { "s" };
        let Record {
            host,
            threads,
            version,
            ..
        } = record;
        let machine = format!("{host} ({threads} thread{plural}, restframe {version})");
        if !machines.contains(&machine) {
            machines.push(machine);
        }
    }
    match machines.len() {
        0 => String::new(),
        _ => format!("Rendered on {}.", machines.join(", ")),
    }
}

fn assembled(shot_folder: &ShotFolder) -> Markup {
    let files = OUTPUTS.iter().filter_map(|output| {
        let name = shot_folder.names.assembled(output.suffix());
        let length = std::fs::metadata(shot_folder.path.join(&name)).ok()?.len();
        Some((output.title(), name, length))
    });
    let files: Vec<_> = files.collect();
    html! {
        @if !files.is_empty() {
            nav aria-label="Assembled" { ul.links {
                @for (words, name, length) in &files {
                    li { a href=(beside(name)) { (words) } " " span.faint { (bytes(*length)) } }
                }
            } }
        }
    }
}

/// `Frames 3, 7–9`
fn named(runs: &[Run]) -> String {
    let list: Vec<String> = runs.iter().map(span).collect();
    let noun = match runs {
        [only] if count(only) == 1 => "Frame",
        _ => "Frames",
    };
    format!("{noun} {}", list.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_named_by_ranges() {
        for (frames, words) in [
            (&[3][..], "Frame 3"),
            (&[3, 4], "Frames 3–4"),
            (&[1, 3, 4, 5, 9], "Frames 1, 3–5, 9"),
        ] {
            let mut runs = Vec::new();
            frames
                .iter()
                .for_each(|frame| add(&mut runs, *frame..=*frame));
            assert_eq!(named(&runs), words);
        }
    }
}
