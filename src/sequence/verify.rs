//! Verification of a shot's frames: each must exist, be complete and up to date, and fit between
//! its neighbors.
//!
//! Files are decoded on all threads, one per thread at a time, so that memory is bounded by as many
//! images as there are threads.

use super::discontinuity::{Differences, Discontinuity, Grid};
use super::findings::{Finding, Kind, Report, Run, SINGLY, count, gaps, unknown_files};
use super::frame_image::{decode_as, shown_extension};
use crate::frame::FrameFingerprint;
use crate::image::decode::{Fault, read_bytes};
use crate::queue::Stop;
use crate::store::{FileRecord, ShotFolder, Status};
use rayon::prelude::*;
use serde_json::Value;
use std::path::Path;

/// Number of frames between two comparisons, enough for all threads.
const AT_ONCE: usize = 64;

/// Share of its step by which a value of the shot must leave the range between its neighbors to
/// explain a discontinuity: a kink leaves it by a half, a jump by a half or more; smooth keys by
/// less than a third unless the step is nearly nothing.
const KINK: f64 = 0.4;

/// Verifies every frame of a shot, and the files beside them. A folder that does not exist has no
/// frames.
pub fn verify(shot_folder: &ShotFolder) -> Report {
    let never = Stop::default();
    verify_until(shot_folder, &never).unwrap_or_default()
}

/// Like [`verify`], but stops if asked to.
pub(super) fn verify_until(shot_folder: &ShotFolder, stop: &Stop) -> Option<Report> {
    let frames = shot_folder.shot().shot.frames;
    let there: Vec<u32> = shot_folder.there().into_iter().collect();
    let gaps = gaps(there.iter().copied(), frames);
    let mut findings: Vec<Finding> = gaps
        .iter()
        .flat_map(|gap| missing(shot_folder, gap))
        .collect();
    let mut differences = Differences::default();
    for some in there.chunks(AT_ONCE) {
        let looked: Vec<_> = some
            .par_iter()
            .map(|frame| (!stop.is_asked()).then(|| look(shot_folder, *frame)))
            .collect();
        for (frame, looked) in some.iter().zip(looked) {
            let (found, grid) = looked?;
            findings.extend(found);
            differences.push(*frame, grid);
        }
    }
    differences.end(frames);
    let found = differences.discontinuities().into_iter();
    findings.extend(found.filter_map(|found| unexplained(shot_folder, &found)));
    findings.sort_by_key(|finding| finding.frame);
    findings.extend(unknown_files(shot_folder));
    Some(Report { frames, findings })
}

/// Findings of missing frames: one for a long run.
fn missing(shot_folder: &ShotFolder, gap: &Run) -> Vec<Finding> {
    let file = |frame: u32| {
        shot_folder
            .files(frame)
            .into_iter()
            .next()
            .unwrap_or_default()
    };
    let one = |frame| finding(frame, file(frame), Kind::Missing, "missing".to_owned());
    let count = count(gap);
    if count <= SINGLY {
        return gap.clone().map(one).collect();
    }
    let why = format!(
        "missing, as are all up to {}: {count} frames",
        file(*gap.end())
    );
    vec![Finding {
        last: Some(*gap.end()),
        why,
        ..one(*gap.start())
    }]
}

/// The faults of one frame by itself; and its grid, if it can be decoded.
fn look(shot_folder: &ShotFolder, frame: u32) -> (Vec<Finding>, Option<Grid>) {
    let key = shot_folder.keys.frame(frame);
    let record = shot_folder.records.get(&frame);
    let record = record.filter(|record| record.fingerprint == key.fingerprint);
    let told = shot_folder.written(frame, &key);
    let told = told.or_else(|| Some(record?.files.as_slice()));
    let same = told.is_some();
    let told = told.unwrap_or_default();
    let status = shot_folder.status(frame, &key);
    let mut findings = Vec::new();
    let mut grid = None;
    if status == Status::Missing {
        // It vanished at this moment.
        return (missing(shot_folder, &(frame..=frame)), grid);
    }
    let shown = shown_extension(shot_folder.shot());
    for file in shot_folder.files(frame) {
        let extension = if file.ends_with(".exr") { "exr" } else { "png" };
        match inspect(shot_folder, told, &file, extension) {
            Ok(inspected) => {
                let what = inspected.wrong.into_iter();
                findings.extend(what.map(|(kind, why)| finding(frame, file.clone(), kind, why)));
                if extension == shown {
                    grid = inspected.grid;
                }
            }
            // A frame of something else may have another size; that needs no finding of its own.
            Err(Fault::Size { .. }) if !same => {}
            Err(fault) => {
                let why = cut_short(told, &shot_folder.path, &file, &fault);
                findings.push(finding(frame, file, kind_of(&fault), why));
            }
        }
    }
    // If the files themselves show the fault, differences of length are not reported too.
    if let Status::Stale { reason } = status
        && (!same || findings.is_empty())
    {
        let file = shot_folder
            .files(frame)
            .into_iter()
            .next()
            .unwrap_or_default();
        let why = format!("stale: {reason}; render it again");
        findings.insert(0, finding(frame, file, Kind::Stale, why));
        grid = None;
    }
    (findings, grid)
}

/// A file that could be decoded.
struct Inspected {
    wrong: Vec<(Kind, String)>,
    grid: Option<Grid>,
}

/// Reads a file. `told` are the manifest's records of the frame's files, if up to date.
fn inspect(
    shot_folder: &ShotFolder,
    told: &[FileRecord],
    file: &str,
    extension: &str,
) -> Result<Inspected, Fault> {
    let size = shot_folder.keys.resolution().size;
    let bytes = read_bytes(&shot_folder.path.join(file), size)?;
    let decoded = decode_as(shot_folder.shot(), extension, &bytes, size)?;
    let mut wrong = Vec::new();
    let written = told.iter().find(|f| f.name == file);
    if written.is_some_and(|written| written.blake3 != blake3::hash(&bytes).to_hex().as_str()) {
        let why = "changed: its bytes are not those that were written; render it again";
        wrong.push((Kind::Changed, why.to_owned()));
    }
    if !decoded.not_finite.is_empty() {
        let channels: Vec<String> = decoded
            .not_finite
            .iter()
            .map(|(name, count)| format!("{count} in {name}"))
            .collect();
        let why = format!(
            "not finite: NaN or infinite values, {}",
            channels.join(", ")
        );
        wrong.push((Kind::NotFinite, why));
    }
    Ok(Inspected {
        wrong,
        grid: Some(Grid::new(&decoded.rgb8, size[0] as usize)),
    })
}

/// The fault in words, with the number of missing bytes if the file is shorter than it was written.
fn cut_short(told: &[FileRecord], folder: &Path, file: &str, fault: &Fault) -> String {
    let written = told.iter().find(|f| f.name == file);
    let length = std::fs::metadata(folder.join(file)).map_or(0, |m| m.len());
    match written {
        Some(written) if length > 0 && length < written.bytes => {
            format!("truncated: it has {length} of {} bytes", written.bytes)
        }
        _ => fault.to_string(),
    }
}

fn kind_of(fault: &Fault) -> Kind {
    match fault {
        Fault::Missing => Kind::Missing,
        Fault::Size { .. } => Kind::WrongSize,
        Fault::Empty | Fault::Truncated | Fault::Damaged(_) | Fault::Unreadable(_) => {
            Kind::Undecodable
        }
    }
}

fn finding(frame: u32, file: String, kind: Kind, why: String) -> Finding {
    Finding {
        frame: Some(frame),
        last: None,
        file,
        kind,
        why,
    }
}

/// The finding of a discontinuity, unless the shot itself explains it.
fn unexplained(shot_folder: &ShotFolder, discontinuity: &Discontinuity) -> Option<Finding> {
    let frame = discontinuity.frame;
    // An end is judged by the frames beside it.
    let middle = frame.clamp(2, shot_folder.shot().shot.frames.saturating_sub(1).max(2));
    if explained([middle - 1, middle, middle + 1].map(|frame| shot_folder.keys.frame(frame))) {
        return None;
    }
    let file = shot_folder
        .names
        .frame(frame, shown_extension(shot_folder.shot()));
    let why = format!(
        "outlier: it is {:.3} from what its neighbours let expect, others around it {:.3}; look at it",
        discontinuity.difference, discontinuity.usual
    );
    Some(finding(frame, file, Kind::Outlier, why))
}

/// Whether a value of the shot leaves the range between its neighbors.
fn explained(keys: [FrameFingerprint; 3]) -> bool {
    let [before, here, after] = keys.map(|key| key.inputs);
    let one_way = |part: &str, value: &String| match (before.get(part), after.get(part)) {
        (Some(before), Some(after)) => smooth(before, value, after),
        _ => false,
    };
    let gone = |part: &String| !here.contains_key(part);
    let smooth = here.iter().all(|(part, value)| one_way(part, value));
    !smooth || before.keys().chain(after.keys()).any(gone)
}

/// Whether a value lies between two others as if on its way; words must equal those of a neighbor.
fn smooth(before: &str, here: &str, after: &str) -> bool {
    match [before, here, after].map(numbers) {
        [Some(before), Some(here), Some(after)]
            if before.len() == here.len() && here.len() == after.len() =>
        {
            before.iter().zip(&here).zip(&after).all(|((p, v), n)| {
                let step = (v - p).abs().max((n - v).abs());
                (v - (p + n) / 2.0).abs() <= KINK * step
            })
        }
        // A hash only shows that something changed, which it does if things move.
        _ => here == before || here == after || before != after,
    }
}

/// The numbers in a JSON value; None if it is a word.
fn numbers(text: &str) -> Option<Vec<f64>> {
    fn collect(value: &Value, numbers: &mut Vec<f64>) -> Option<()> {
        match value {
            Value::Number(number) => numbers.push(number.as_f64()?),
            Value::Array(values) => values.iter().try_for_each(|v| collect(v, numbers))?,
            Value::Object(values) => values.values().try_for_each(|v| collect(v, numbers))?,
            _ => return None,
        }
        Some(())
    }
    let mut list = Vec::new();
    collect(&serde_json::from_str(text).ok()?, &mut list)?;
    Some(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(values: [&str; 3]) -> [FrameFingerprint; 3] {
        values.map(|value| FrameFingerprint {
            fingerprint: String::new(),
            inputs: [("camera.pan".to_owned(), value.to_owned())]
                .into_iter()
                .collect(),
            trace: String::new(),
        })
    }

    #[test]
    fn jumps_and_kinks_of_a_value_explain_a_frame_and_ramps_do_not() {
        for values in [
            ["0", "1", "0"],
            ["0", "0", "1"],
            ["1", "5", "5"],
            ["[0, 0, 0]", "[0, 0, 0]", "[0.5, 0, 0]"],
            ["\"off\"", "\"full\"", "\"off\""],
            ["{\"gamma\": 2}", "{\"gamma\": 9}", "{\"gamma\": 2}"],
        ] {
            assert!(explained(keys(values)), "{values:?}");
        }
        for values in [
            ["0", "1", "2"],
            ["0.1", "0.2", "0.30000000000000004"],
            ["7", "7", "7"],
            ["0", "1", "2.2"],
            ["[0, 1, 0]", "[0.5, 1, 0]", "[1, 1, 0]"],
            ["\"off\"", "\"off\"", "\"off\""],
            ["9f3c", "11aa", "0b2e"],
        ] {
            assert!(!explained(keys(values)), "{values:?}");
        }
    }

    #[test]
    fn a_part_that_one_frame_alone_has_explains_it() {
        let [before, mut here, after] = keys(["1", "1", "1"]);
        here.inputs
            .insert("model[1].file".to_owned(), "x".to_owned());
        assert!(explained([before, here, after]));
    }
}
