//! Points of spacetime and differences between them. Both are four numbers, but two types, because
//! a translation changes a point and leaves a difference as it is.

use glam::DVec3;
use std::ops::{Add, Sub};

/// A point of spacetime in the coordinates of one reference frame: `t` in metres of light travel,
/// `x` in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Coordinate time, in metres of light travel.
    pub t: f64,
    /// Position, in metres.
    pub x: DVec3,
}

/// A difference of two events, or a direction through spacetime; in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourVector {
    /// Time component.
    pub t: f64,
    /// Space component.
    pub x: DVec3,
}

impl Event {
    /// The event at time `t` and position `x`.
    pub const fn new(t: f64, x: DVec3) -> Self {
        Self { t, x }
    }
}

impl FourVector {
    /// The difference of an event from itself.
    pub const ZERO: Self = Self {
        t: 0.0,
        x: DVec3::ZERO,
    };

    /// The vector with time component `t` and space component `x`.
    pub const fn new(t: f64, x: DVec3) -> Self {
        Self { t, x }
    }

    /// The invariant interval −t² + x², in m²: negative if timelike, zero for light, positive if
    /// spacelike. Computed as a product, which keeps its digits near the light cone.
    pub fn interval(self) -> f64 {
        let distance = self.x.length();
        (distance - self.t) * (distance + self.t)
    }
}

impl Sub for Event {
    type Output = FourVector;
    fn sub(self, from: Event) -> FourVector {
        FourVector::new(self.t - from.t, self.x - from.x)
    }
}

impl Add<FourVector> for Event {
    type Output = Event;
    fn add(self, step: FourVector) -> Event {
        Event::new(self.t + step.t, self.x + step.x)
    }
}

impl Add for FourVector {
    type Output = FourVector;
    fn add(self, other: FourVector) -> FourVector {
        FourVector::new(self.t + other.t, self.x + other.x)
    }
}
