//! Time of an image by phase, for studies.

use crate::trace::{Clock, Phase};
use std::sync::Mutex;
use std::sync::PoisonError;

/// Seconds of one image by phase. Those of phases within an image are summed over its threads.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Seconds {
    /// Curves, tables, and links between worldlines.
    pub prepare: f64,
    /// Directions of camera rays.
    pub aim: f64,
    /// Boosts of camera rays into the rest frames of bodies.
    pub boost: f64,
    /// Camera rays against the bodies of each rest frame.
    pub traverse: f64,
    /// Rays from surfaces to lamps.
    pub shadow: f64,
    /// Surface events, lamps as seen from there, branches of mirrors and glass.
    pub surfaces: f64,
    /// From shade trees to light.
    pub shade: f64,
}

/// Collects [`Seconds`] from all threads of an image.
#[derive(Debug, Default)]
pub struct Profile(Mutex<Seconds>);

impl Profile {
    /// The seconds so far.
    pub fn seconds(&self) -> Seconds {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn add(&self, change: impl FnOnce(&mut Seconds)) {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// Seconds of one thread.
#[derive(Debug, Default)]
pub(super) struct PhaseTimes {
    pub(super) clock: Clock,
    pub(super) aim: f64,
    pub(super) shade: f64,
}

impl PhaseTimes {
    pub(super) fn report(&self, profile: &Profile) {
        profile.add(|sum| {
            sum.aim += self.aim;
            sum.boost += self.clock.seconds(Phase::Boost);
            sum.traverse += self.clock.seconds(Phase::Traverse);
            sum.shadow += self.clock.seconds(Phase::Shadow);
            sum.surfaces += self.clock.seconds(Phase::Surfaces);
            sum.shade += self.shade;
        });
    }
}
