//! A ray that leaves a surface: the light that arrives there, followed back in the rest frame of
//! the surface and of everything it may have come from.

use super::spacetime::Spacetime;
use crate::relativity::{Event, FourVector};
use glam::DVec3;

/// A ray from a surface event.
#[derive(Debug, Clone, Copy)]
pub(super) struct SecondaryRay {
    /// The worldline in whose rest frame it is given.
    pub(super) worldline: usize,
    /// Where it starts.
    pub(super) start: Event,
    /// Unit direction, against the light.
    pub(super) direction: DVec3,
    /// How much later light arrives per length of its way: 1, or the index of refraction inside
    /// glass that rests in `worldline`.
    pub(super) slowness: f64,
}

/// A ray in the rest frame of the bodies that it may meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct RestRay {
    /// Where it starts, there.
    pub(super) origin: Event,
    /// Unit direction there, against the light.
    pub(super) direction: DVec3,
    /// How much later light arrives per length of its way there.
    pub(super) slowness: f64,
    /// Length there per length in the ray's own frame.
    pub(super) stretch: f64,
    /// ω there over ω in the ray's own frame.
    pub(super) frequency_ratio: f64,
}

impl SecondaryRay {
    /// The ray among the bodies of `worldline`; None where they move with light that glass slows
    /// down, and none of it passes them.
    ///
    /// Inside glass light's way is no null line: the steps (n, −d) of time and space are boosted
    /// as any vector is. A body that moves through glass is taken to do so in a gap too narrow to
    /// see: frequencies are those of light in vacuum of the same direction.
    pub(super) fn among(&self, worldline: usize, spacetime: &Spacetime) -> Option<RestRay> {
        if worldline == self.worldline {
            return Some(RestRay {
                origin: self.start,
                direction: self.direction,
                slowness: self.slowness,
                stretch: 1.0,
                frequency_ratio: 1.0,
            });
        }
        let link = spacetime.link(worldline, self.worldline);
        let light = link.light(-self.direction);
        let (direction, slowness, stretch) = if self.slowness == 1.0 {
            let stretch = spacetime.path_ratio(light.frequency_ratio);
            (-light.direction, 1.0, stretch)
        } else {
            let step = link.vector(FourVector::new(self.slowness, -self.direction));
            let stretch = step.x.length();
            if stretch == 0.0 {
                return None;
            }
            (-step.x / stretch, step.t / stretch, stretch)
        };
        Some(RestRay {
            origin: link.event(self.start),
            direction,
            slowness,
            stretch,
            frequency_ratio: light.frequency_ratio,
        })
    }
}
