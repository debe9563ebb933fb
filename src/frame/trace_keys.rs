//! The traces of many frames, one after the other: of what they follow from only that which moves is
//! looked at again.

use super::digests::Digests;
use super::fingerprint::Resolution;
use super::trace_key::{Section, Traced};
use crate::shot::{Moving, Shot};

/// Frames in which this is equal have the same shade trees. As text, 16 hexadecimal digits, it is
/// [`FrameFingerprint::trace`](super::FrameFingerprint).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TraceKey(u64);

impl std::fmt::Display for TraceKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Tells the traces of a shot's frames; a microsecond or a few each.
#[derive(Debug, Clone)]
pub struct TraceKeys<'a> {
    shot: &'a Shot,
    digests: &'a Digests,
    picture: Resolution,
    moving: Moving,
    /// The frame that was asked for last, as far as it moves.
    still: Shot,
    /// What its trees follow from.
    sections: [String; Section::ALL.len()],
}

impl<'a> TraceKeys<'a> {
    pub(super) fn new(shot: &'a Shot, digests: &'a Digests, picture: Resolution) -> Self {
        let still = shot.at(1);
        Self {
            sections: sections(&still, digests, picture),
            moving: shot.moving(),
            still,
            shot,
            digests,
            picture,
        }
    }

    /// The trace of frame number `frame`.
    pub fn of(&mut self, frame: u32) -> TraceKey {
        self.still.move_to(frame, self.shot, self.moving);
        let traced = Traced {
            still: &self.still,
            digests: self.digests,
            picture: self.picture,
        };
        for (section, text) in Section::ALL.into_iter().zip(&mut self.sections) {
            if section.moves(self.moving) {
                *text = traced.text(section);
            }
        }
        hashed(&self.sections)
    }
}

/// The trace of a shot of one frame.
pub(super) fn trace(still: &Shot, digests: &Digests, picture: Resolution) -> TraceKey {
    hashed(&sections(still, digests, picture))
}

fn sections(still: &Shot, digests: &Digests, picture: Resolution) -> [String; Section::ALL.len()] {
    let traced = Traced {
        still,
        digests,
        picture,
    };
    Section::ALL.map(|section| traced.text(section))
}

/// Of a list of all sections.
fn hashed(sections: &[String]) -> TraceKey {
    let list = format!("[{}]", sections.join(","));
    let mut first = [0; 8];
    first.copy_from_slice(&blake3::hash(list.as_bytes()).as_bytes()[..8]);
    TraceKey(u64::from_be_bytes(first))
}
