//! Trace keys: frames in which they are equal have the same shade trees, and are traced once.

use super::digests::Digests;
use super::settings::Resolution;
use super::trace_sections::{Section, Sections, Traced};
use super::values::{Frame, Frames};

/// Frames in which this is equal have the same shade trees. As text it has 16 hexadecimal digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TraceKey(u64);

impl TraceKey {
    /// The trace key of a frame, whose files `digests` are of, at a resolution.
    pub fn new(frame: &Frame<'_>, digests: &Digests, resolution: Resolution) -> Self {
        let traced = Traced {
            frame,
            digests,
            resolution,
        };
        Self::of(&traced.sections())
    }

    fn of(sections: &Sections) -> Self {
        let mut first = [0; 8];
        let all = blake3::hash(sections.as_flattened());
        first.copy_from_slice(&all.as_bytes()[..8]);
        Self(u64::from_be_bytes(first))
    }
}

impl std::fmt::Display for TraceKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// The trace keys of a shot's frames one after the other: of each, only the sections that move are
/// evaluated and hashed again. A microsecond or a few each.
#[derive(Debug, Clone)]
pub struct TraceKeys<'a> {
    frames: Frames<'a>,
    digests: &'a Digests,
    resolution: Resolution,
    sections: Sections,
}

impl<'a> TraceKeys<'a> {
    pub(super) fn new(
        mut frames: Frames<'a>,
        digests: &'a Digests,
        resolution: Resolution,
    ) -> Self {
        let traced = Traced {
            frame: frames.unchecked(1),
            digests,
            resolution,
        };
        Self {
            sections: traced.sections(),
            frames,
            digests,
            resolution,
        }
    }

    /// The trace key of frame number `frame`.
    pub fn of(&mut self, frame: u32) -> TraceKey {
        let moving = self.frames.moving();
        let traced = Traced {
            frame: self.frames.unchecked(frame),
            digests: self.digests,
            resolution: self.resolution,
        };
        for (section, hash) in Section::ALL.into_iter().zip(&mut self.sections) {
            if section.moves(moving) {
                *hash = traced.hash(section);
            }
        }
        TraceKey::of(&self.sections)
    }
}
