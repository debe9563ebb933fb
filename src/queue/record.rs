//! The record of a frame that has just been finished.

use super::job::Job;
use super::machine::{host, now, peak_memory_mib};
use super::manifest::{Record, Seconds};
use super::picture::Pictures;
use crate::frame::{Frame, FrameFingerprint};
use crate::shot::Shot;

/// Exposure of a frame, stops.
pub(super) fn stops(job: &Job, frame: &Frame<'_>) -> f64 {
    let exposing = job.exposing.as_ref();
    exposing.map_or(0.0, |exposing| exposing.stops(frame))
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
pub(super) fn blank(job: &Job, frame: &Frame<'_>, key: &FrameFingerprint) -> Record {
    let options = &job.options;
    Record {
        frame: frame.number,
        fingerprint: key.fingerprint.clone(),
        parts: key.inputs.clone(),
        files: Vec::new(),
        size: [options.width, options.height],
        samples: options.samples,
        effects: frame.active_names(),
        trace: key.trace.clone(),
        shared: 1,
        exposure: stops(job, frame),
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

/// Names of the effects that are simulated in a frame; none in one that is refused.
pub(super) fn active_names(shot: &Shot, frame: u32) -> Vec<String> {
    Frame::new(shot, frame).map_or_else(|_| Vec::new(), |frame| frame.active_names())
}
