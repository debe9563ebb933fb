//! A plan in words.

use super::frame_range::Run;
use crate::queue::{FrameForecast, Totals};
use crate::store::{ShotFolder, Status};
use indexmap::IndexMap;

pub(super) fn word(status: &Status) -> &'static str {
    match status {
        Status::Fresh => "fresh",
        Status::Missing => "missing",
        Status::Stale { .. } => "stale",
    }
}

/// The work to do, in a few lines.
pub(super) fn head(shot_folder: &ShotFolder, totals: &Totals) -> String {
    let picture = shot_folder.keys.resolution();
    let [width, height] = picture.size;
    let left = totals.frames - totals.fresh;
    let basis = match (left, totals.measured) {
        (0, _) => "",
        (_, true) => ", as frames took that were rendered here",
        (_, false) => ", a guess: nothing like it was rendered here yet",
    };
    format!(
        "{}: {}, {width} x {height} pixels, {}, {}\n{} fresh, {} stale, {} missing: about {}{basis}\nabout {} of memory, {} of disk",
        shot_folder.shot().path.display(),
        counted(totals.frames, "frame"),
        counted(picture.samples as usize, "sample"),
        counted(totals.traces, "trace"),
        totals.fresh,
        totals.stale,
        totals.missing,
        duration(totals.seconds),
        size(totals.memory_bytes),
        size(totals.disk_bytes),
    )
}

pub(super) fn line(run: &Run) -> String {
    let (first, [last_frame, last_trace]) = (&run.first, run.last);
    let effects = first.effects.names();
    let effects = match effects.as_slice() {
        [] => "no effects".to_owned(),
        names => names.join(", "),
    };
    let status = match &first.status {
        Status::Stale { reason } => format!("stale because {reason}"),
        status => word(status).to_owned(),
    };
    let frames = span("frame", first.frame, last_frame);
    let traces = span("trace", first.trace, last_trace);
    format!("{frames}  {status}  {effects}  {traces}")
}

/// Reasons for the effects, with those of the same reason together.
pub(super) fn sentences(planned: &FrameForecast) -> Vec<String> {
    let names = planned.effects.names();
    let mut effects: IndexMap<&str, Vec<&str>> = IndexMap::new();
    for reason in &planned.effects.reasons {
        if names.iter().any(|name| name == reason.effect) {
            effects.entry(&reason.why).or_default().push(reason.effect);
        }
    }
    let sentence = |(why, effects): (&str, Vec<&str>)| format!("{}: {why}", effects.join(", "));
    effects.into_iter().map(sentence).collect()
}

fn span(what: &str, first: u32, last: u32) -> String {
    if first == last {
        format!("{what} {first}")
    } else {
        format!("{what}s {first}-{last}")
    }
}

fn counted(count: usize, what: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {what}{s}")
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{s:.0} s"),
        s if s < 99.5 * 60.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

fn size(bytes: u64) -> String {
    let mib = bytes as f64 / f64::from(1 << 20);
    if mib < 1000.0 {
        format!("{mib:.0} MiB")
    } else {
        format!("{:.1} GiB", mib / 1024.0)
    }
}
