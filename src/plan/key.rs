//! What a frame is made of: its fingerprint, by which a finished picture is known to be still the
//! right one, and the trace that it shares with others.

use super::files::Digests;
use crate::shot::Shot;
use indexmap::IndexMap;

/// Raised whenever the same shot gives other pixels than before, so that no older picture passes
/// for a new one.
pub const EPOCH: u32 = 1;

/// Size and samples of a shot's images as they are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
}

/// What one frame is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameKey {
    /// BLAKE3 of `parts`, hexadecimal.
    pub fingerprint: String,
    /// Every value that reaches the frame's pixels, by its key in the shot: a short one as it stands
    /// in JSON, a long one by its hash; the files by their paths and hashes.
    pub parts: IndexMap<String, String>,
    /// Frames in which this is equal have the same shade trees.
    pub trace: String,
}

/// The keys of a shot's frames.
#[derive(Debug, Clone)]
pub struct Keys {
    shot: Shot,
    digests: Digests,
    picture: Picture,
}

impl Keys {
    /// Keys of the frames of `shot` at a size.
    pub fn new(shot: Shot, digests: Digests, picture: Picture) -> Self {
        Self {
            shot,
            digests,
            picture,
        }
    }

    /// The shot.
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    /// Size and samples of its images.
    pub fn picture(&self) -> Picture {
        self.picture
    }

    /// What frame number `frame` is made of.
    pub fn frame(&self, frame: u32) -> FrameKey {
        let mut parts = IndexMap::new();
        parts.insert("epoch".to_owned(), EPOCH.to_string());
        parts.insert("frame".to_owned(), frame.to_string());
        parts.insert("picture".to_owned(), format!("{:?}", self.picture));
        let text = blake3::hash(self.shot.places.text().as_bytes()).to_hex();
        parts.insert("shot".to_owned(), text[..16].to_owned());
        for (path, digest) in self.digests.iter() {
            parts.insert(path.to_owned(), digest[..16].to_owned());
        }
        let text = serde_json::json!(parts).to_string();
        let fingerprint = blake3::hash(text.as_bytes()).to_hex().to_string();
        FrameKey {
            trace: fingerprint.clone(),
            fingerprint,
            parts,
        }
    }
}
