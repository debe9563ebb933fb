//! All knobs, in the order of a report.

use super::knob::Knob;
use super::{mirrors, pixels, spectra};
use crate::frame::ActiveEffects;
use crate::study::start::Start;

/// All knobs, in the order of a report.
pub(in crate::study) const KNOBS: [fn(&Start<'_>, &ActiveEffects) -> Knob; 6] = [
    spectra::spectra,
    |start, _| pixels::samples(start),
    mirrors::bounces,
    mirrors::cutoff,
    |start, _| mirrors::tessellation(start),
    |start, _| pixels::output(start),
];
