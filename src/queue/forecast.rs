//! Forecast of a shot's rendering: the effects of each frame, shared traces, frames that exist
//! already, and the cost of the rest.
//!
//! A first pass over all frames determines which share a trace, and which exist; then each is
//! planned and handed on before the next, so that only a few bytes per frame are kept for a million
//! frames.

use super::cost::{Costs, Estimate, frame_bytes, memory_bytes};
use super::memory::most_together;
use crate::frame::{ActiveEffects, Frames, TraceKey, refuse_shifted_rgb};
use crate::shot::{Mistakes, Shot};
use crate::store::{ShotFolder, Status};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::ops::ControlFlow;

/// Number of frames that are planned at once, on all threads.
const AT_ONCE: usize = 4096;

/// Forecast of some frames of a shot.
pub struct Forecast<'a> {
    folder: &'a ShotFolder,
    costs: Costs,
    frames: Vec<u32>,
    /// The number of each frame's trace.
    traces: Vec<u32>,
    /// Number of frames of each trace, and number of those that have to be rendered.
    sharing: Vec<[u32; 2]>,
    /// Status of the frames that exist.
    there: BTreeMap<u32, Status>,
}

/// Forecast of one frame.
#[derive(Debug, Clone)]
pub struct FrameForecast {
    /// Its number.
    pub frame: u32,
    /// What is simulated in it, and why.
    pub effects: ActiveEffects,
    /// Whether it has to be rendered.
    pub status: Status,
    /// Number of its trace, in the order of their first frames.
    pub trace: u32,
    /// Cost of rendering it on its own.
    pub estimate: Estimate,
    /// Seconds that it adds to the remaining work: 0 if it is fresh, its share of a shared trace.
    pub seconds: f64,
}

/// All frames of a forecast together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Totals {
    /// Number of frames.
    pub frames: usize,
    /// Number of traces that they share.
    pub traces: usize,
    /// Number of frames that are up to date.
    pub fresh: usize,
    /// Number of frames that exist but are not up to date.
    pub stale: usize,
    /// Number of frames that do not exist.
    pub missing: usize,
    /// Seconds of the remaining work.
    pub seconds: f64,
    /// Whether the time is based on frames rendered here; otherwise it is a guess.
    pub measured: bool,
    /// Memory that rendering takes, bytes.
    pub memory_bytes: u64,
    /// Disk space for the remaining frames, bytes.
    pub disk_bytes: u64,
}

/// Sums over the frames planned so far.
#[derive(Default)]
struct Sums {
    fresh: usize,
    stale: usize,
    seconds: f64,
    guessed: usize,
}

impl<'a> Forecast<'a> {
    /// Groups frames by trace and looks up their status.
    ///
    /// # Errors
    /// Frames of which three numbers would be shifted, and velocities that are none between two keys.
    pub fn new(folder: &'a ShotFolder, frames: Vec<u32>) -> Result<Self, Mistakes> {
        refuse_shifted_rgb(folder.shot())?;
        check_motion(folder.shot(), &frames)?;
        let there: Vec<u32> = {
            let there = folder.there();
            let chosen = frames.iter().copied();
            chosen.filter(|frame| there.contains(frame)).collect()
        };
        let statuses = folder.statuses(&there);
        let there: BTreeMap<u32, Status> = there.into_iter().zip(statuses).collect();
        let mut numbers: HashMap<TraceKey, u32> = HashMap::new();
        let mut sharing: Vec<[u32; 2]> = Vec::new();
        let mut traces = Vec::with_capacity(frames.len());
        for (frame, trace) in frames.iter().zip(folder.keys.trace_keys_of(&frames)) {
            let number = *numbers.entry(trace).or_insert(sharing.len() as u32);
            if number as usize == sharing.len() {
                sharing.push([0; 2]);
            }
            let [all, left] = &mut sharing[number as usize];
            *all += 1;
            *left += u32::from(there.get(frame) != Some(&Status::Fresh));
            traces.push(number);
        }
        Ok(Self {
            costs: Costs::new(folder),
            folder,
            frames,
            traces,
            sharing,
            there,
        })
    }

    /// Plans all frames in order, some at once on all threads. `made` is called on any of them,
    /// `take` with its results in order, until it breaks.
    ///
    /// # Errors
    /// Mistakes of a frame.
    pub fn each<T: Send, B>(
        &self,
        made: impl Fn(&FrameForecast) -> T + Sync,
        mut take: impl FnMut(FrameForecast, T) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B, Totals>, Mistakes> {
        let mut sums = Sums::default();
        let places: Vec<usize> = (0..self.frames.len()).collect();
        for some in places.chunks(AT_ONCE) {
            let planned = some.par_iter().map_init(
                || Frames::new(self.folder.shot()),
                |frames, place| {
                    let planned = self.frame(frames, *place)?;
                    let made = made(&planned);
                    Ok((planned, made))
                },
            );
            for planned in planned.collect::<Vec<Result<_, Mistakes>>>() {
                let (planned, made) = planned?;
                sums.add(&planned);
                if let ControlFlow::Break(end) = take(planned, made) {
                    return Ok(ControlFlow::Break(end));
                }
            }
        }
        Ok(ControlFlow::Continue(self.totals(&sums)))
    }

    /// Plans the frame at a place of the list.
    fn frame(&self, frames: &mut Frames<'_>, place: usize) -> Result<FrameForecast, Mistakes> {
        let (folder, frame) = (self.folder, self.frames[place]);
        let values = frames.at(frame)?;
        let effects = values.active_effects(&values.effects);
        let names = match values.splices.is_empty() {
            true => effects.names(),
            false => values.active_names(),
        };
        let estimate = self.costs.estimate(&names, folder.keys.resolution());
        let status = self.there.get(&frame).unwrap_or(&Status::Missing).clone();
        let trace = self.traces[place];
        let [_, left] = self.sharing[trace as usize];
        let seconds = match status {
            Status::Fresh => 0.0,
            _ => estimate.trace / f64::from(left) + estimate.shade,
        };
        Ok(FrameForecast {
            frame,
            effects,
            status,
            trace,
            estimate,
            seconds,
        })
    }

    /// The totals, with as many frames of one trace in work at once as memory allows.
    fn totals(&self, sums: &Sums) -> Totals {
        let folder = self.folder;
        let most = most_together(&folder.options);
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
                folder,
                largest.unwrap_or(1).min(most),
                rayon::current_num_threads(),
            ),
            disk_bytes: frame_bytes(folder).saturating_mul(left as u64),
        }
    }
}

impl Sums {
    fn add(&mut self, planned: &FrameForecast) {
        match planned.status {
            Status::Fresh => self.fresh += 1,
            Status::Stale { .. } => self.stale += 1,
            Status::Missing => {}
        }
        self.seconds += planned.seconds;
        self.guessed += usize::from(!planned.estimate.measured);
    }
}

/// Refuses frames in which a worldline has no velocity, before any is planned.
fn check_motion(shot: &Shot, frames: &[u32]) -> Result<(), Mistakes> {
    let wrong = frames.par_iter().map_init(
        || Frames::new(shot),
        |frames, number| frames.at(*number).err(),
    );
    let wrong = wrong.find_map_first(|mistakes| mistakes);
    wrong.map_or(Ok(()), Err)
}
