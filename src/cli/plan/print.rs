//! The forecast of a shot, in words a line for consecutive equal frames, or as JSON.

use crate::cli::messages::{Answer, Reader};
use crate::cli::open::open;
use crate::cli::{Failed, PlanArguments, frames, mistaken, misused, print};
use crate::frame::Reason;
use crate::queue::{Forecast, FrameForecast, Totals, choose};
use crate::shot::Beaming;
use crate::store::{ShotFolder, Status};
use indexmap::{IndexMap, IndexSet};
use serde::{Serialize, Serializer};
use serde_json::json;
use std::convert::Infallible;
use std::ops::ControlFlow;

/// Runs the command.
pub(in crate::cli) fn run(arguments: &PlanArguments) -> Result<(), Failed> {
    let folder = open(&arguments.shot, &arguments.pictures).map_err(|unopened| unopened.failed)?;
    let chosen = choose(folder.shot(), &frames(arguments.frames.as_ref()));
    let chosen = chosen.map_err(|error| misused(&error.to_string()))?;
    let forecast = Forecast::new(&folder, chosen.frames).map_err(|m| mistaken(&m))?;
    if arguments.json {
        tell_json(&forecast)
    } else {
        tell(&folder, &forecast)
    }
}

/// Prints the plan for programs: one object with a frame per line.
fn tell_json(forecast: &Forecast<'_>) -> Result<(), Failed> {
    let mut answer = Answer::new();
    let mut before = "{\"frames\": [\n";
    let told = forecast.each(
        |planned| Frame::of(planned).line(),
        |_, line| {
            let line = format!("{}{line}", std::mem::replace(&mut before, ",\n"));
            match answer.write(&line) {
                Ok(Reader::There) => ControlFlow::Continue(()),
                Ok(Reader::Gone) => ControlFlow::Break(Ok(())),
                Err(failed) => ControlFlow::Break(Err(failed)),
            }
        },
    );
    match told.map_err(|m| mistaken(&m))? {
        ControlFlow::Break(end) => end?,
        ControlFlow::Continue(totals) => {
            answer.write(&format!("\n],\n\"totals\": {}}}\n", json!(totals)))?;
        }
    }
    answer.end()
}

/// Prints the plan for people: one line for consecutive frames with equal plans.
fn tell(folder: &ShotFolder, forecast: &Forecast<'_>) -> Result<(), Failed> {
    let mut runs: Vec<Run> = Vec::new();
    let told = forecast.each(
        |_| (),
        |planned, ()| {
            match runs.last_mut() {
                Some(run) if run.takes(&planned) => run.last = [planned.frame, planned.trace],
                _ => runs.push(Run::of(planned)),
            }
            ControlFlow::<Infallible>::Continue(())
        },
    );
    let ControlFlow::Continue(totals) = told.map_err(|m| mistaken(&m))?;
    print(&head(folder, &totals))?;
    let mut said = IndexSet::new();
    for run in &runs {
        print(&line(run))?;
        for sentence in sentences(&run.first) {
            if said.insert(sentence.clone()) {
                print(&format!("    {sentence}"))?;
            }
        }
    }
    Ok(())
}

/// A frame in the JSON output.
#[derive(Serialize)]
struct Frame<'a> {
    frame: u32,
    effects: Effects,
    #[serde(serialize_with = "by_effect")]
    because: &'a [Reason],
    trace: u32,
    status: &'static str,
    seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    stale_because: Option<&'a str>,
}

/// Whether each effect is simulated.
#[derive(Serialize)]
struct Effects {
    geometry: bool,
    doppler: bool,
    beaming: bool,
    thermal: bool,
    shadows: bool,
    mirror: bool,
    refraction: bool,
}

impl<'a> Frame<'a> {
    fn of(planned: &'a FrameForecast) -> Self {
        let effects = &planned.effects;
        Self {
            frame: planned.frame,
            effects: Effects {
                geometry: effects.geometry,
                doppler: effects.doppler,
                beaming: effects.beaming != Beaming::Off,
                thermal: effects.thermal,
                shadows: effects.shadows,
                mirror: effects.mirror,
                refraction: effects.refraction,
            },
            because: &effects.reasons,
            trace: planned.trace,
            status: word(&planned.status),
            seconds: planned.seconds,
            stale_because: match &planned.status {
                Status::Stale { reason } => Some(reason),
                Status::Fresh | Status::Missing => None,
            },
        }
    }

    fn line(&self) -> String {
        serde_json::to_string(self).expect("texts and finite numbers have JSON")
    }
}

fn by_effect<S: Serializer>(reasons: &[Reason], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(reasons.iter().map(|reason| (reason.effect, &reason.why)))
}

/// Consecutive frames with equal plans, which either share one trace or have one each.
pub(super) struct Run {
    pub(super) first: FrameForecast,
    /// Number of the last frame, and that of its trace.
    pub(super) last: [u32; 2],
}

impl Run {
    pub(super) fn of(first: FrameForecast) -> Self {
        let last = [first.frame, first.trace];
        Self { first, last }
    }

    /// Whether the next frame belongs to this run: from the second on, its trace is the same or the
    /// next one, as it was from the first to the second.
    pub(super) fn takes(&self, next: &FrameForecast) -> bool {
        let [frame, trace] = self.last;
        let (first, length) = (&self.first, frame - self.first.frame);
        let step = next.trace.wrapping_sub(trace);
        let same_step = match length {
            0 => step <= 1,
            _ => step == u32::from(trace != first.trace),
        };
        let effects = first.effects.names() == next.effects.names();
        next.frame == frame + 1 && same_step && first.status == next.status && effects
    }
}

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
