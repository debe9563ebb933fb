//! `restframe plan`: effects of each frame and their reasons, shared traces, time. Frames are
//! printed as they are planned, so that a reader need not wait for the last.

mod words;

use super::answer::{Answer, Reader};
use super::{Failed, PlanArguments, failed, frames, mistaken, misused, print};
use crate::frame::Reason;
use crate::queue::{Forecast, FrameForecast, Totals};
use crate::shot::{self, Beaming};
use crate::store::{FolderError, ShotFolder, Status};
use indexmap::IndexSet;
use serde::{Serialize, Serializer};
use serde_json::json;
use std::ops::ControlFlow;
use words::{head, line, sentences, word};

/// Runs the command.
pub(super) fn run(arguments: &PlanArguments) -> Result<(), Failed> {
    let shot = shot::load(&arguments.shot).map_err(|m| mistaken(&m))?;
    let request = arguments.pictures.request();
    request.check(&shot).map_err(|why| misused(&why))?;
    let all = shot.shot.frames;
    let chosen = frames(arguments.frames.as_ref()).resolve(all).frames;
    if chosen.is_empty() {
        let path = shot.path.display();
        let message = format!("{path} has frames 1 to {all}; none was chosen");
        return Err(misused(&message));
    }
    let folder = ShotFolder::open(&shot, &request).map_err(|error| match error {
        FolderError::Mistakes(mistakes) => mistaken(&mistakes),
        FolderError::Folder { .. } => failed(&error.to_string()),
    })?;
    let forecast = Forecast::new(&folder, chosen).map_err(|m| mistaken(&m))?;
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
            ControlFlow::<Totals>::Continue(())
        },
    );
    let (ControlFlow::Continue(totals) | ControlFlow::Break(totals)) =
        told.map_err(|m| mistaken(&m))?;
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

/// Consecutive frames with equal plans, which either share one trace or have one each.
struct Run {
    first: FrameForecast,
    /// Number of the last frame, and that of its trace.
    last: [u32; 2],
}

impl Run {
    fn of(first: FrameForecast) -> Self {
        let last = [first.frame, first.trace];
        Self { first, last }
    }

    /// Whether the next frame belongs to this run: from the second on, its trace is the same or the
    /// next one, as it was from the first to the second.
    fn takes(&self, next: &FrameForecast) -> bool {
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
