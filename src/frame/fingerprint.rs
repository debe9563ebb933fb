//! What a frame is made of: its fingerprint, by which a finished picture is known to be still the
//! right one, and the trace that it shares with others.

use super::digests::Digests;
use super::fingerprint_inputs::{self, FingerprintInputs, For};
use super::trace_keys::{TraceKey, TraceKeys, trace};
use crate::shot::{Exposure, Shot};
use indexmap::IndexMap;
use rayon::prelude::*;

/// Raised whenever the same shot gives other pixels than before, so that no older picture passes
/// for a new one.
pub const EPOCH: u32 = 2;

/// Size and samples of a shot's images as they are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// For in a row, and rows.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
}

/// What one frame is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameFingerprint {
    /// BLAKE3 of `parts`, hexadecimal.
    pub fingerprint: String,
    /// Every value that may reach the frame's pixels, by its key in the shot: a short one as it stands
    /// in JSON, a long one by its hash; the files by their paths and hashes. That something reaches
    /// them is judged by the shot's text alone: materials and worldlines count though no model may
    /// use them, since model files may name the former and the latter bound what is tabulated; of
    /// EXR files also their depth and layers. A default that is written out counts as another value
    /// where only the renderer knows it.
    pub inputs: IndexMap<String, String>,
    /// Frames in which this is equal have the same shade trees.
    pub trace: String,
}

/// The keys of a shot's frames.
#[derive(Debug, Clone)]
pub struct Fingerprints {
    shot: Shot,
    digests: Digests,
    picture: Resolution,
    /// Of the parts of frame 1 that exposure is metered on; None where it is authored.
    metered: Option<String>,
}

impl Fingerprints {
    /// Fingerprints of the frames of `shot` at a size.
    pub fn new(shot: Shot, digests: Digests, picture: Resolution) -> Self {
        let metered = matches!(shot.sensor.exposure, Exposure::Auto(_)).then(|| {
            let first = made_of(&shot.at(1), &digests, For::Metering);
            format!("#{}", &fingerprint_inputs::hash(&first).to_hex()[..16])
        });
        Self {
            shot,
            digests,
            picture,
            metered,
        }
    }

    /// The shot.
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    /// Size and samples of its images.
    pub fn picture(&self) -> Resolution {
        self.picture
    }

    /// The traces of its frames, for whoever asks for many and for nothing else.
    pub fn traces(&self) -> TraceKeys<'_> {
        TraceKeys::new(&self.shot, &self.digests, self.picture)
    }

    /// The traces of some frames, in their order.
    pub fn traces_of(&self, frames: &[u32]) -> Vec<TraceKey> {
        const AT_ONCE: usize = 1024;
        let some = frames.par_chunks(AT_ONCE).map_init(
            || self.traces(),
            |traces, frames| frames.iter().map(|f| traces.of(*f)).collect::<Vec<_>>(),
        );
        some.collect::<Vec<_>>().concat()
    }

    /// What frame number `frame` is made of.
    pub fn frame(&self, frame: u32) -> FrameFingerprint {
        let still = self.shot.at(frame);
        let pixels = For::Output {
            picture: self.picture,
            metered: self.metered.as_deref(),
        };
        let parts = made_of(&still, &self.digests, pixels);
        FrameFingerprint {
            fingerprint: fingerprint_inputs::hash(&parts).to_hex().to_string(),
            trace: trace(&still, &self.digests, self.picture).to_string(),
            inputs: parts,
        }
    }
}

/// What the pixels of a shot of one frame are made of.
fn made_of(still: &Shot, digests: &Digests, pixels: For<'_>) -> FingerprintInputs {
    let mut made_of = FingerprintInputs::new();
    made_of.insert("epoch".to_owned(), EPOCH.to_string());
    made_of.extend(fingerprint_inputs::inputs(still, pixels));
    let file = |(path, hash): (String, &str)| (format!("file {path}"), hash[..16].to_owned());
    made_of.extend(digests.iter().map(file));
    made_of
}
