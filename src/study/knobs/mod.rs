//! The knobs, and their settings to compare. A knob that makes no difference to an image has no
//! settings.

mod all;
mod knob;
mod mirrors;
mod pixels;
mod spectra;

pub(super) use all::KNOBS;
pub(super) use knob::Knob;
pub(super) use spectra::{lines_seen, without_shift};
