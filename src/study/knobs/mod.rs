//! The knobs, and their settings to compare. A knob that makes no difference to an image has no
//! settings.

mod bodies;
mod mirrors;
mod pixels;
mod spectra;

use super::Start;
use super::displacement::Displacement;
use super::timed_render::Variant;
use crate::frame::ActiveEffects;
use crate::render::View;

pub(super) use spectra::{lines_seen, without_shift};

/// Displacement between the views of a reference and of a setting, for an image of this size.
type Displaced = fn(&View<'_>, &View<'_>, [u32; 2]) -> Displacement;

/// A knob before it is measured.
pub(super) struct Knob {
    pub(super) key: &'static str,
    pub(super) what: &'static str,
    pub(super) phase: &'static str,
    pub(super) reference: &'static str,
    pub(super) note: Option<String>,
    pub(super) variants: Vec<Variant>,
    /// References, one per family or one for all.
    pub(super) references: Vec<Variant>,
    /// How displacements are measured, if surfaces move.
    pub(super) displacement: Option<Displaced>,
    /// Whether the settings differ in the files only.
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

    /// The index of the reference against which a variant is measured.
    pub(super) fn reference_of(&self, variant: &Variant) -> usize {
        let same = |reference: &Variant| reference.family == variant.family;
        self.references.iter().position(same).unwrap_or(0)
    }
}

/// All knobs, in the order of a report.
pub(super) const KNOBS: [fn(&Start<'_>, &ActiveEffects) -> Knob; 6] = [
    spectra::spectra,
    |start, _| pixels::samples(start),
    mirrors::bounces,
    mirrors::cutoff,
    |start, _| bodies::tessellation(start),
    |start, _| pixels::output(start),
];
