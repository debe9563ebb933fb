//! `restframe plan`: what each frame calls for and why, which frames share a trace, and what they
//! will take.

use super::render::check_scale;
use super::{Failed, PlanArguments, failed, mistaken, misused, print, print_json};
use crate::plan::{self, Called};
use crate::queue::{
    Costs, Estimate, Reel, ReelError, Request, Status, effect_names, frame_bytes, frame_effects,
    memory_bytes, most_together, options, refuse_shifted_numbers,
};
use crate::render::motion_mistake;
use crate::shot::{self, Beaming, Shot};
use indexmap::IndexMap;
use serde_json::{Value, json};

/// One frame.
struct Planned {
    frame: u32,
    called: Called,
    status: Status,
    /// Number of its trace, in the order of their first frames.
    trace: usize,
    /// What rendering it would take on its own.
    estimate: Estimate,
    /// What it adds to the work that is left: 0 if it is fresh, of a shared trace its part.
    seconds: f64,
}

/// All of it together.
struct Totals {
    traces: usize,
    fresh: usize,
    stale: usize,
    missing: usize,
    seconds: f64,
    measured: bool,
    memory_bytes: u64,
    disk_bytes: u64,
}

/// Runs the command.
pub(super) fn run(arguments: &PlanArguments) -> Result<(), Failed> {
    let shot = shot::load(&arguments.shot).map_err(|m| mistaken(&m))?;
    refuse_shifted_numbers(&shot).map_err(|m| mistaken(&m))?;
    let request = arguments.pictures.request(arguments.frames.as_ref());
    let chosen = chosen(&shot, &request)?;
    let reel = Reel::open(&shot, &request).map_err(|error| match error {
        ReelError::Mistakes(mistakes) => mistaken(&mistakes),
        ReelError::Folder { .. } => failed(&error.to_string()),
    })?;
    let planned = planned(&reel, &chosen)?;
    let most = most_together(&options(&shot, &request));
    let totals = totals(&reel, &planned, most);
    if arguments.json {
        return print_json(&as_json(&planned, &totals));
    }
    print(&head(&reel, &planned, &totals))?;
    let mut said = Vec::new();
    for run in runs(&planned) {
        print(&line(run))?;
        for sentence in sentences(&run[0]) {
            if !said.contains(&sentence) {
                print(&format!("    {sentence}"))?;
                said.push(sentence);
            }
        }
    }
    Ok(())
}

/// The frames that are asked for.
fn chosen(shot: &Shot, request: &Request) -> Result<Vec<u32>, Failed> {
    let (path, frames) = (shot.path.display(), shot.shot.frames);
    check_scale(shot, request).map_err(|why| misused(&why))?;
    let chosen = request.frames.resolve(frames).frames;
    if chosen.is_empty() {
        let message = format!("{path} has frames 1 to {frames}; none was chosen");
        return Err(misused(&message));
    }
    Ok(chosen)
}

fn planned(reel: &Reel, frames: &[u32]) -> Result<Vec<Planned>, Failed> {
    let shot = reel.shot();
    let costs = Costs::new(reel);
    // The frames that have to be rendered, by trace.
    let mut traces: IndexMap<String, usize> = IndexMap::new();
    let mut planned = Vec::new();
    for &frame in frames {
        let called = plan::called(shot, frame, &shot.effects)
            .map_err(|error| mistaken(&motion_mistake(shot, &error)))?;
        let key = reel.keys.frame(frame);
        let status = reel.status(frame, &key);
        let entry = traces.entry(key.trace);
        let trace = entry.index();
        *entry.or_insert(0) += usize::from(status != Status::Fresh);
        planned.push(Planned {
            frame,
            estimate: costs.estimate(&frame_effects(shot, frame), reel.keys.picture()),
            called,
            status,
            trace,
            seconds: 0.0,
        });
    }
    for frame in planned.iter_mut().filter(|p| p.status != Status::Fresh) {
        let sharing = traces[frame.trace] as f64;
        frame.seconds = frame.estimate.trace / sharing + frame.estimate.shade;
    }
    Ok(planned)
}

/// Sums, where at most so many frames of one trace are in work at once.
fn totals(reel: &Reel, planned: &[Planned], most: usize) -> Totals {
    let count = |is: fn(&Status) -> bool| planned.iter().filter(|p| is(&p.status)).count();
    let fresh = count(|status| *status == Status::Fresh);
    let mut sharing: IndexMap<usize, usize> = IndexMap::new();
    for frame in planned {
        *sharing.entry(frame.trace).or_default() += 1;
    }
    let together = sharing.values().copied().max().unwrap_or(1).min(most);
    Totals {
        traces: sharing.len(),
        fresh,
        stale: count(|status| matches!(status, Status::Stale { .. })),
        missing: count(|status| *status == Status::Missing),
        seconds: planned.iter().map(|p| p.seconds).sum(),
        measured: planned.iter().all(|p| p.estimate.measured),
        memory_bytes: memory_bytes(reel, together, rayon::current_num_threads()),
        disk_bytes: frame_bytes(reel).saturating_mul((planned.len() - fresh) as u64),
    }
}

fn as_json(planned: &[Planned], totals: &Totals) -> Value {
    let frames: Vec<Value> = planned.iter().map(frame_json).collect();
    json!({
        "frames": frames,
        "totals": {
            "frames": planned.len(),
            "traces": totals.traces,
            "fresh": totals.fresh,
            "stale": totals.stale,
            "missing": totals.missing,
            "seconds": totals.seconds,
            "measured": totals.measured,
            "memory_bytes": totals.memory_bytes,
            "disk_bytes": totals.disk_bytes,
        },
    })
}

fn frame_json(planned: &Planned) -> Value {
    let called = &planned.called;
    let because = called.because.iter();
    let because: IndexMap<&str, &str> = because.map(|r| (r.effect, r.why.as_str())).collect();
    let mut frame = json!({
        "frame": planned.frame,
        "effects": {
            "geometry": called.geometry,
            "doppler": called.doppler,
            "beaming": called.beaming != Beaming::Off,
            "thermal": called.thermal,
            "shadows": called.shadows,
            "mirror": called.mirror,
            "refraction": called.refraction,
        },
        "because": because,
        "trace": planned.trace,
        "status": word(&planned.status),
        "seconds": planned.seconds,
    });
    if let Status::Stale { because } = &planned.status {
        frame["stale_because"] = json!(because);
    }
    frame
}

fn word(status: &Status) -> &'static str {
    match status {
        Status::Fresh => "fresh",
        Status::Missing => "missing",
        Status::Stale { .. } => "stale",
    }
}

/// What there is to do, in a few lines.
fn head(reel: &Reel, planned: &[Planned], totals: &Totals) -> String {
    let picture = reel.keys.picture();
    let [width, height] = picture.size;
    let left = planned.len() - totals.fresh;
    let basis = match (left, totals.measured) {
        (0, _) => "",
        (_, true) => ", as frames took that were rendered here",
        (_, false) => ", a guess: nothing like it was rendered here yet",
    };
    format!(
        "{}: {}, {width} x {height} pixels, {}, {}\n{} fresh, {} stale, {} missing: about {}{basis}\nabout {} of memory, {} of disk",
        reel.shot().path.display(),
        counted(planned.len(), "frame"),
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

/// Frames one after the other of which the same is to be said, each with the trace of all or with
/// one of its own.
fn runs(planned: &[Planned]) -> impl Iterator<Item = &[Planned]> {
    let alike = |a: &Planned, b: &Planned| {
        let effects = effect_names(&a.called) == effect_names(&b.called);
        b.frame == a.frame + 1 && a.status == b.status && effects
    };
    let mut rest = planned;
    std::iter::from_fn(move || {
        let first = rest.first()?;
        let step = rest
            .get(1)
            .map_or(0, |next| next.trace.wrapping_sub(first.trace));
        let goes_on = |pair: &[Planned]| {
            let [a, b] = pair else { return false };
            step <= 1 && b.trace == a.trace + step && alike(a, b)
        };
        let length = 1 + rest.windows(2).take_while(|pair| goes_on(pair)).count();
        let (run, after) = rest.split_at(length);
        rest = after;
        Some(run)
    })
}

fn line(run: &[Planned]) -> String {
    let (first, last) = (&run[0], &run[run.len() - 1]);
    let effects = effect_names(&first.called);
    let effects = match effects.as_slice() {
        [] => "no effects".to_owned(),
        names => names.join(", "),
    };
    let status = match &first.status {
        Status::Stale { because } => format!("stale because {because}"),
        status => word(status).to_owned(),
    };
    let frames = span("frame", first.frame as usize, last.frame as usize);
    let traces = span("trace", first.trace, last.trace);
    format!("{frames}  {status}  {effects}  {traces}")
}

/// Why effects are called for, those of one reason together.
fn sentences(planned: &Planned) -> Vec<String> {
    let names = effect_names(&planned.called);
    let mut effects: IndexMap<&str, Vec<&str>> = IndexMap::new();
    for reason in &planned.called.because {
        if names.iter().any(|name| name == reason.effect) {
            effects.entry(&reason.why).or_default().push(reason.effect);
        }
    }
    let sentence = |(why, effects): (&str, Vec<&str>)| format!("{}: {why}", effects.join(", "));
    effects.into_iter().map(sentence).collect()
}

fn span(what: &str, first: usize, last: usize) -> String {
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
