//! The record of a frame that has just been finished.

use super::batch::Task;
use super::cost::effect_names;
use super::job::Job;
use super::machine::{host, now, peak_memory_mib};
use super::manifest::{Record, Seconds};
use super::picture::Pictures;
use crate::frame::{self, ActiveEffects, FrameFingerprint};
use crate::render::spliced;
use crate::shot::{Beaming, Shot};

/// Exposure of a frame, stops.
pub(super) fn stops(job: &Job, frame: u32) -> f64 {
    let frames = job.reel.shot().shot.frames;
    let exposing = job.exposing.as_ref();
    exposing.map_or(0.0, |exposing| exposing.stops(frame, frames))
}

/// What a frame's viewer should know.
pub(super) fn warnings(made: &Pictures) -> Vec<String> {
    let saturated = (made.saturated > 0).then(|| {
        let values = made.saturated;
        format!("{values} values beyond what a file can hold were clamped")
    });
    saturated.into_iter().chain(made.warnings.clone()).collect()
}

/// The record of a frame, but for its files, times and warnings.
pub(super) fn blank(job: &Job, task: &Task, key: &FrameFingerprint) -> Record {
    let options = &job.options;
    Record {
        frame: task.frame,
        fingerprint: key.fingerprint.clone(),
        parts: key.inputs.clone(),
        files: Vec::new(),
        size: [options.width, options.height],
        samples: options.samples,
        effects: frame_effects(job.reel.shot(), task.frame),
        trace: key.trace.clone(),
        shared: 1,
        exposure: stops(job, task.frame),
        seconds: Seconds::default(),
        warnings: Vec::new(),
        cut: 0.0,
        memory_mib: peak_memory_mib(),
        threads: u32::try_from(rayon::current_num_threads()).unwrap_or(u32::MAX),
        host: host(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        finished: now(),
    }
}

/// Names of the effects that are simulated in a frame, in all of it or in a splice.
pub fn frame_effects(shot: &Shot, frame: u32) -> Vec<String> {
    let splices = shot
        .splice
        .iter()
        .map(|splice| spliced(&shot.effects, splice));
    let mut found: Vec<String> = Vec::new();
    for effects in std::iter::once(shot.effects).chain(splices) {
        // A frame without a velocity is refused by whoever renders it.
        let called = frame::active_effects(shot, frame, &effects);
        found.extend(called.iter().flat_map(effect_names));
    }
    let mut named = effect_names(&ALL);
    named.retain(|name| found.contains(name));
    named
}

/// Every effect, for the order of their names.
const ALL: ActiveEffects = ActiveEffects {
    geometry: true,
    doppler: true,
    beaming: Beaming::Full,
    thermal: true,
    shadows: true,
    mirror: true,
    refraction: true,
    because: Vec::new(),
};
