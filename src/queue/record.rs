//! The record of a frame that was just finished.

use super::job::Job;
use super::render_batch::stops;
use crate::frame::{Frame, FrameFingerprint};
use crate::render::Pictures;
use crate::store::{Record, Seconds, host, now, peak_memory_mib};

/// Warnings about a frame's image.
pub(super) fn warnings(made: &Pictures, left_out: Option<String>) -> Vec<String> {
    let saturated = (made.saturated > 0).then(|| {
        let values = made.saturated;
        format!("{values} values beyond what a file can hold were clamped")
    });
    let seen = saturated.into_iter().chain(left_out);
    seen.chain(made.warnings.clone()).collect()
}

/// The record of a frame, except its files, times and warnings.
pub(super) fn new_record(job: &Job, frame: &Frame<'_>, key: &FrameFingerprint) -> Record {
    let options = job.options();
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
        memory_mib: peak_memory_mib().map(|mib| mib as u64),
        threads: u32::try_from(rayon::current_num_threads()).unwrap_or(u32::MAX),
        host: host(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        finished: now(),
    }
}
