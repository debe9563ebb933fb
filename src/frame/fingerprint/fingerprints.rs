//! Fingerprints of a shot's frames, each with the inputs that it is the hash of and the trace key.

use super::super::at::At;
use super::super::digests::Digests;
use super::super::settings::Resolution;
use super::super::trace_key::{TraceKey, TraceKeys};
use super::super::values::{Frame, Frames};
use super::inputs::{For, inputs};
use super::list::{FingerprintInputs, hash};
use crate::shot::{Exposure, Shot};
use indexmap::IndexMap;
use rayon::prelude::*;

/// Raised whenever the same shot gives other pixels than before, so that no older picture passes
/// for a new one.
pub const EPOCH: u32 = 2;

/// What one frame is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameFingerprint {
    /// BLAKE3 of `inputs`, hexadecimal.
    pub fingerprint: String,
    /// Every value that may reach the frame's pixels, by its key in the shot: a short one as it stands
    /// in JSON, a long one by its hash; the files by their paths and hashes. That something reaches
    /// them is judged by the shot's text alone: materials and worldlines count though no model may
    /// use them, since model files may name the former and the latter bound what is tabulated; of
    /// EXR files also their depth and layers. A default that is written out counts as another value
    /// where only the renderer knows it.
    pub inputs: IndexMap<String, String>,
    /// The [`TraceKey`]: frames in which it is equal have the same shade trees.
    pub trace: String,
}

/// The fingerprints and trace keys of a shot's frames.
#[derive(Debug, Clone)]
pub struct Fingerprints {
    shot: Shot,
    digests: Digests,
    resolution: Resolution,
    /// Hash of the inputs of frame 1 that exposure is metered on; None where it is authored.
    metered: Option<String>,
}

impl Fingerprints {
    /// Fingerprints of the frames of `shot`, whose files `digests` are of.
    pub fn new(shot: Shot, digests: Digests, resolution: Resolution) -> Self {
        let metered = matches!(shot.sensor.exposure, Exposure::Auto(_)).then(|| {
            let first = all_inputs(&shot, 1, &digests, For::Metering);
            format!("#{}", &hash(&first).to_hex()[..16])
        });
        Self {
            shot,
            digests,
            resolution,
            metered,
        }
    }

    /// The shot.
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    /// Size and samples of its images.
    pub fn resolution(&self) -> Resolution {
        self.resolution
    }

    /// The trace keys of its frames, to be asked for many and for nothing else.
    pub fn trace_keys(&self) -> TraceKeys<'_> {
        TraceKeys::new(Frames::new(&self.shot), &self.digests, self.resolution)
    }

    /// The trace keys of some frames, in their order.
    pub fn trace_keys_of(&self, frames: &[u32]) -> Vec<TraceKey> {
        const AT_ONCE: usize = 1024;
        let some = frames.par_chunks(AT_ONCE).map_init(
            || self.trace_keys(),
            |keys, frames| frames.iter().map(|f| keys.of(*f)).collect::<Vec<_>>(),
        );
        some.collect::<Vec<_>>().concat()
    }

    /// What frame number `frame` is made of.
    pub fn frame(&self, frame: u32) -> FrameFingerprint {
        let pixels = For::Output {
            resolution: self.resolution,
            metered: self.metered.as_deref(),
        };
        let inputs = all_inputs(&self.shot, frame, &self.digests, pixels);
        // A frame without a velocity is refused before it is rendered; its key is never used.
        let values = Frame::unchecked(&self.shot, frame);
        FrameFingerprint {
            fingerprint: hash(&inputs).to_hex().to_string(),
            trace: TraceKey::new(&values, &self.digests, self.resolution).to_string(),
            inputs,
        }
    }
}

/// What the pixels of a frame are made of, its files and the epoch with them.
fn all_inputs(shot: &Shot, number: u32, digests: &Digests, pixels: For<'_>) -> FingerprintInputs {
    let mut all = FingerprintInputs::new();
    all.insert("epoch".to_owned(), EPOCH.to_string());
    all.extend(inputs(At { shot, number }, pixels));
    let file = |(path, hash): (String, &str)| (format!("file {path}"), hash[..16].to_owned());
    all.extend(digests.iter().map(file));
    all
}
