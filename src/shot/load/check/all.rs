//! All checks of a shot, in the order of its sections.

use super::super::walk::Walk;
use super::checks::Checks;
use crate::shot::{Mistake, Shot};

/// All mistakes of a shot: those that the walk has found, and those of the checks.
pub(in super::super) fn check(shot: &Shot, walk: Walk<'_>) -> Vec<Mistake> {
    let Walk {
        mistakes,
        names,
        kept,
        ..
    } = walk;
    let mut checks = Checks {
        shot,
        names,
        kept,
        mistakes,
    };
    checks.settings();
    checks.worldlines();
    checks.models();
    checks.spectra();
    checks.materials();
    checks.lights();
    checks.sky();
    checks.camera();
    checks.insets();
    checks.mistakes
}
