//! Worldlines of one frame: name, celerity and origin. Lengths and times in meters.

use super::at::At;
use crate::relativity::{self, Celerity, CelerityError, Event};
use crate::shot::{GammaVelocity, RapidityVelocity, Velocity};
use glam::DVec3;

/// A reference frame at one frame of the shot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worldline<'a> {
    /// Its name; "lab" for the first.
    pub name: &'a str,
    /// Celerity in the lab, and the lab event of its rest frame's origin.
    pub motion: relativity::Worldline,
}

impl<'a> Worldline<'a> {
    const LAB: Self = Self {
        name: "lab",
        motion: relativity::Worldline::LAB,
    };

    /// The worldlines of a shot, the lab first; and those that have no velocity at this frame, by
    /// their place and why. In the list they stand at rest.
    pub(super) fn all(at: At<'a>) -> (Vec<Self>, Vec<(usize, CelerityError)>) {
        let mut all = vec![Self::LAB];
        let mut faults = Vec::new();
        for (name, line) in &at.shot.worldline {
            let celerity = celerity(&line.velocity, at).unwrap_or_else(|fault| {
                faults.push((all.len(), fault));
                Celerity::REST
            });
            let origin = Event::new(
                at.value(&line.at) * at.shot.shot.light_speed,
                DVec3::from(at.value(&line.passes)),
            );
            let motion = relativity::Worldline { celerity, origin };
            all.push(Self { name, motion });
        }
        (all, faults)
    }
}

/// The celerity of a velocity, whatever measure its author chose.
fn celerity(velocity: &Velocity, at: At<'_>) -> Result<Celerity, CelerityError> {
    match velocity {
        Velocity::Beta(beta) => Celerity::from_beta(DVec3::from(at.value(beta))),
        Velocity::Gamma(GammaVelocity { gamma, direction }) => {
            Celerity::from_lorentz_factor(at.value(gamma), DVec3::from(at.value(direction)))
        }
        Velocity::Rapidity(RapidityVelocity {
            rapidity,
            direction,
        }) => Celerity::from_rapidity(at.value(rapidity), DVec3::from(at.value(direction))),
    }
}
