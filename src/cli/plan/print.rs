//! The forecast of a shot, as lines or as JSON.

use super::frame_range::Run;
use super::words::{head, line, sentences, word};
use crate::cli::answer::{Answer, Reader};
use crate::cli::open::open;
use crate::cli::{Failed, PlanArguments, frames, mistaken, misused, print};
use crate::frame::Reason;
use crate::queue::{Forecast, FrameForecast, choose};
use crate::shot::Beaming;
use crate::store::{ShotFolder, Status};
use indexmap::IndexSet;
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
