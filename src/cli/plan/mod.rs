//! `restframe plan`: what each frame calls for and why, which frames share a trace, and what they
//! will take.
//!
//! A first look at all frames tells which share a trace, and what is there; then each is planned and
//! told before the next, so that of a million frames some bytes each are held, and a reader need not
//! wait for the last.

mod words;

use super::answer::{Answer, Reader};
use super::render::check_scale;
use super::{Failed, PlanArguments, failed, mistaken, misused, print};
use crate::frame::{ActiveEffects, Frames, Reason, TraceKey, refuse_shifted_rgb};
use crate::queue::{
    Costs, Estimate, Reel, ReelError, Request, Status, frame_bytes, memory_bytes, most_together,
    options,
};
use crate::shot::{self, Beaming, Shot};
use indexmap::IndexSet;
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};
use words::{head, line, sentences, word};

/// Frames that are planned between two looks at whether somebody reads.
const AT_ONCE: usize = 4096;

/// One frame.
struct Planned {
    frame: u32,
    called: ActiveEffects,
    status: Status,
    /// Number of its trace, in the order of their first frames.
    trace: u32,
    /// What rendering it would take on its own.
    estimate: Estimate,
    /// What it adds to the work that is left: 0 if it is fresh, of a shared trace its part.
    seconds: f64,
}

/// What is known of all frames at a first look.
struct Plan<'a> {
    reel: &'a Reel,
    costs: Costs,
    frames: Vec<u32>,
    /// The number of each frame's trace.
    traces: Vec<u32>,
    /// How many frames each trace has, and how many of them have to be rendered.
    sharing: Vec<[u32; 2]>,
    /// Of the frames of which something is there.
    there: BTreeMap<u32, Status>,
}

/// Sums over the frames planned so far.
#[derive(Default)]
struct Sums {
    fresh: usize,
    stale: usize,
    seconds: f64,
    guessed: usize,
}

/// All of it together.
struct Totals {
    frames: usize,
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
    refuse_shifted_rgb(&shot).map_err(|m| mistaken(&m))?;
    let request = arguments.pictures.request(arguments.frames.as_ref());
    let chosen = chosen(&shot, &request)?;
    let reel = Reel::open(&shot, &request).map_err(|error| match error {
        ReelError::Mistakes(mistakes) => mistaken(&mistakes),
        ReelError::Folder { .. } => failed(&error.to_string()),
    })?;
    check_motion(&shot, &chosen)?;
    let plan = Plan::new(&reel, chosen);
    if arguments.json {
        plan.tell_json(&request)
    } else {
        plan.tell(&request)
    }
}

/// Refuses velocities that are none between two keys, before anything is told.
fn check_motion(shot: &Shot, frames: &[u32]) -> Result<(), Failed> {
    let wrong = frames.par_iter().map_init(
        || Frames::new(shot),
        |frames, number| frames.at(*number).err(),
    );
    let wrong = wrong.find_map_first(|mistakes| mistakes);
    wrong.map_or(Ok(()), |mistakes| Err(mistaken(&mistakes)))
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

impl<'a> Plan<'a> {
    /// Looks at which frames share a trace, and what is there of them.
    fn new(reel: &'a Reel, frames: Vec<u32>) -> Self {
        let there: Vec<u32> = {
            let there = reel.there();
            let chosen = frames.iter().copied();
            chosen.filter(|frame| there.contains(frame)).collect()
        };
        let statuses = reel.statuses(&there);
        let there: BTreeMap<u32, Status> = there.into_iter().zip(statuses).collect();
        let mut numbers: HashMap<TraceKey, u32> = HashMap::new();
        let mut sharing: Vec<[u32; 2]> = Vec::new();
        let mut traces = Vec::with_capacity(frames.len());
        for (frame, trace) in frames.iter().zip(reel.keys.trace_keys_of(&frames)) {
            let number = *numbers.entry(trace).or_insert(sharing.len() as u32);
            if number as usize == sharing.len() {
                sharing.push([0; 2]);
            }
            let [all, left] = &mut sharing[number as usize];
            *all += 1;
            *left += u32::from(there.get(frame) != Some(&Status::Fresh));
            traces.push(number);
        }
        Self {
            costs: Costs::new(reel),
            reel,
            frames,
            traces,
            sharing,
            there,
        }
    }

    /// Plans the frame at a place of the list.
    fn frame(&self, frames: &mut Frames<'_>, place: usize) -> Result<Planned, Failed> {
        let (reel, frame) = (self.reel, self.frames[place]);
        let values = frames.at(frame).map_err(|m| mistaken(&m))?;
        let called = values.active_effects(&values.effects);
        let effects = match values.splices.is_empty() {
            true => called.names(),
            false => values.active_names(),
        };
        let estimate = self.costs.estimate(&effects, reel.keys.resolution());
        let status = self.there.get(&frame).unwrap_or(&Status::Missing).clone();
        let trace = self.traces[place];
        let [_, left] = self.sharing[trace as usize];
        let seconds = match status {
            Status::Fresh => 0.0,
            _ => estimate.trace / f64::from(left) + estimate.shade,
        };
        Ok(Planned {
            frame,
            called,
            status,
            trace,
            estimate,
            seconds,
        })
    }

    /// Plans all frames in order, some at once on all threads, and hands them on until nobody wants
    /// more.
    fn each<T: Send>(
        &self,
        made: impl Fn(&Planned) -> T + Sync,
        mut told: impl FnMut(Planned, T) -> Result<Reader, Failed>,
    ) -> Result<(Reader, Sums), Failed> {
        let mut sums = Sums::default();
        let places: Vec<usize> = (0..self.frames.len()).collect();
        for some in places.chunks(AT_ONCE) {
            let planned = some.par_iter().map_init(
                || Frames::new(self.reel.shot()),
                |frames, place| {
                    let planned = self.frame(frames, *place)?;
                    let made = made(&planned);
                    Ok((planned, made))
                },
            );
            for planned in planned.collect::<Vec<Result<_, Failed>>>() {
                let (planned, made) = planned?;
                sums.add(&planned);
                if told(planned, made)? == Reader::Gone {
                    return Ok((Reader::Gone, sums));
                }
            }
        }
        Ok((Reader::There, sums))
    }

    /// Answers for programs: the contract's object, a frame a line.
    fn tell_json(&self, request: &Request) -> Result<(), Failed> {
        let mut answer = Answer::new();
        let mut before = "{\"frames\": [\n";
        let told = self.each(
            |planned| Frame::of(planned).line(),
            |_, line| {
                let line = format!("{}{line}", std::mem::replace(&mut before, ",\n"));
                answer.write(&line)
            },
        );
        if let (Reader::There, sums) = told? {
            let totals = self.totals(&sums, request);
            answer.write(&format!("\n],\n\"totals\": {}}}\n", totals.json()))?;
        }
        answer.end()
    }

    /// Answers for people: of frames in a row of which the same is to be said one line.
    fn tell(&self, request: &Request) -> Result<(), Failed> {
        let mut runs: Vec<Run> = Vec::new();
        let (_, sums) = self.each(
            |_| (),
            |planned, ()| {
                match runs.last_mut() {
                    Some(run) if run.takes(&planned) => run.last = [planned.frame, planned.trace],
                    _ => runs.push(Run::of(planned)),
                }
                Ok(Reader::There)
            },
        )?;
        print(&head(self.reel, &self.totals(&sums, request)))?;
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

    /// All together, where at most so many frames of one trace are in work at once as memory holds.
    fn totals(&self, sums: &Sums, request: &Request) -> Totals {
        let reel = self.reel;
        let most = most_together(&options(reel.shot(), request));
        let largest = self.sharing.iter().map(|[all, _]| *all as usize).max();
        let left = self.frames.len() - sums.fresh;
        Totals {
            frames: self.frames.len(),
            traces: self.sharing.len(),
            fresh: sums.fresh,
            stale: sums.stale,
            missing: left - sums.stale,
            seconds: sums.seconds,
            measured: sums.guessed == 0,
            memory_bytes: memory_bytes(
                reel,
                largest.unwrap_or(1).min(most),
                rayon::current_num_threads(),
            ),
            disk_bytes: frame_bytes(reel).saturating_mul(left as u64),
        }
    }
}

impl Sums {
    fn add(&mut self, planned: &Planned) {
        match planned.status {
            Status::Fresh => self.fresh += 1,
            Status::Stale { .. } => self.stale += 1,
            Status::Missing => {}
        }
        self.seconds += planned.seconds;
        self.guessed += usize::from(!planned.estimate.measured);
    }
}

impl Totals {
    fn json(&self) -> Value {
        json!({
            "frames": self.frames,
            "traces": self.traces,
            "fresh": self.fresh,
            "stale": self.stale,
            "missing": self.missing,
            "seconds": self.seconds,
            "measured": self.measured,
            "memory_bytes": self.memory_bytes,
            "disk_bytes": self.disk_bytes,
        })
    }
}

/// Frames one after the other of which the same is to be said, each with the trace of all or with
/// one of its own.
struct Run {
    first: Planned,
    /// The last one's number, and that of its trace.
    last: [u32; 2],
}

impl Run {
    fn of(first: Planned) -> Self {
        let last = [first.frame, first.trace];
        Self { first, last }
    }

    /// Whether the next frame goes with it: from the second on, its trace is the same or the next, as
    /// it was from the first to the second.
    fn takes(&self, next: &Planned) -> bool {
        let [frame, trace] = self.last;
        let (first, length) = (&self.first, frame - self.first.frame);
        let step = next.trace.wrapping_sub(trace);
        let same_step = match length {
            0 => step <= 1,
            _ => step == u32::from(trace != first.trace),
        };
        let effects = first.called.names() == next.called.names();
        next.frame == frame + 1 && same_step && first.status == next.status && effects
    }
}

/// A frame as the contract has it.
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
    fn of(planned: &'a Planned) -> Self {
        let called = &planned.called;
        Self {
            frame: planned.frame,
            effects: Effects {
                geometry: called.geometry,
                doppler: called.doppler,
                beaming: called.beaming != Beaming::Off,
                thermal: called.thermal,
                shadows: called.shadows,
                mirror: called.mirror,
                refraction: called.refraction,
            },
            because: &called.reasons,
            trace: planned.trace,
            status: word(&planned.status),
            seconds: planned.seconds,
            stale_because: match &planned.status {
                Status::Stale { because } => Some(because),
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
