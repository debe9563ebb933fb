//! Where the time of an image goes, for studies: seconds by phase, summed over threads.

use crate::trace::{Clock, Phase};
use std::sync::Mutex;
use std::sync::PoisonError;

/// Seconds of one image by phase; those within an image are summed over its threads.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Seconds {
    /// Curves, tables and links between worldlines made ready.
    pub prepare: f64,
    /// Camera rays of samples.
    pub aim: f64,
    /// Camera rays to the rest frames of bodies.
    pub boost: f64,
    /// Camera rays through the bodies of each rest frame.
    pub traverse: f64,
    /// Rays from surfaces to lamps.
    pub shadow: f64,
    /// Surface events, lamps seen from there, and what mirrors and glass show.
    pub surfaces: f64,
    /// Shade trees to light.
    pub shade: f64,
}

/// Gathers [`Seconds`] from all threads of an image.
#[derive(Debug, Default)]
pub struct Profile(Mutex<Seconds>);

impl Profile {
    /// What has been gathered.
    pub fn seconds(&self) -> Seconds {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn add(&self, change: impl FnOnce(&mut Seconds)) {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// One thread's part.
#[derive(Debug, Default)]
pub(super) struct Lap {
    pub(super) clock: Clock,
    pub(super) aim: f64,
    pub(super) shade: f64,
}

impl Lap {
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
