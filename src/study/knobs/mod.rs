//! The knobs, and the settings of each that are compared. What an image leaves nothing to choose
//! about has none.

mod bodies;
mod mirrors;
mod pixels;
mod spectra;

use super::Start;
use super::displacement::Displacement;
use super::subject::Variant;
use crate::frame::ActiveEffects;
use crate::render::View;

pub(super) use spectra::{lines_seen, without_shift};

/// Of views of a reference and of a setting, and their image's size.
type Displaced = fn(&View<'_>, &View<'_>, [u32; 2]) -> Displacement;

/// A knob, before anything is measured.
pub(super) struct Knob {
    pub(super) key: &'static str,
    pub(super) what: &'static str,
    pub(super) phase: &'static str,
    pub(super) reference: &'static str,
    pub(super) note: Option<String>,
    pub(super) variants: Vec<Variant>,
    /// By family, or one for all.
    pub(super) references: Vec<Variant>,
    /// How far surfaces move, where they do.
    pub(super) displacement: Option<Displaced>,
    /// Whether it is the files that differ.
    pub(super) files: bool,
}

impl Knob {
    pub(super) fn new(key: &'static str, phase: &'static str, what: &'static str) -> Self {
        Self {
            key,
            what,
            phase,
            reference: "",
            note: None,
            variants: Vec::new(),
            references: Vec::new(),
            displacement: None,
            files: false,
        }
    }

    /// Which of its references a variant is measured against.
    pub(super) fn reference_of(&self, variant: &Variant) -> usize {
        let same = |reference: &Variant| reference.family == variant.family;
        self.references.iter().position(same).unwrap_or(0)
    }
}

/// All knobs, in the order of a report.
pub(super) const KNOBS: [fn(&Start<'_>, &ActiveEffects) -> Knob; 7] = [
    spectra::spectra,
    |start, _| pixels::samples(start),
    mirrors::bounces,
    mirrors::cutoff,
    |start, _| bodies::tracing(start),
    |start, _| bodies::tessellation(start),
    |start, _| pixels::output(start),
];
