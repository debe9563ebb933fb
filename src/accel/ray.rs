//! Rays in one worldline's rest frame, single and as a structure of arrays, and the record of where one meets
//! a triangle.
//!
//! A ray is an event and a past-pointing null vector. In the rest frame it is given by the event's
//! time and place and by a unit direction; c = 1, lengths and times are metres.

use crate::relativity::Event;
use glam::DVec3;

/// A ray in one worldline's rest frame.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Start, in metres.
    pub origin: DVec3,
    /// Unit direction, against the light.
    pub direction: DVec3,
}

/// Rays in the rest frame of one worldline; ray `i` is element `i` of each array.
#[derive(Debug, Clone, Default)]
pub struct RayBatch {
    /// Events where the rays start. Bodies rest, so hits do not depend on the time: it is kept for
    /// the time of the hit, and for bodies that will move.
    pub origins: Vec<Event>,
    /// Unit directions, against the light.
    pub directions: Vec<DVec3>,
    /// How far along each ray hits count, in metres; infinite is fine.
    pub reaches: Vec<f64>,
}

impl RayBatch {
    /// Number of rays.
    pub fn len(&self) -> usize {
        self.reaches.len()
    }

    /// Whether it has no rays.
    pub fn is_empty(&self) -> bool {
        self.reaches.is_empty()
    }

    /// Removes all rays, keeping the memory.
    pub fn clear(&mut self) {
        self.origins.clear();
        self.directions.clear();
        self.reaches.clear();
    }

    /// Adds a ray.
    #[inline(always)]
    pub fn push(&mut self, origin: Event, direction: DVec3, reach: f64) {
        self.origins.push(origin);
        self.directions.push(direction);
        self.reaches.push(reach);
    }

    /// The rays one by one, each with its reach.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (Ray, f64)> + '_ {
        let rays = self.origins.iter().zip(&self.directions);
        rays.zip(&self.reaches).map(|((origin, direction), reach)| {
            let ray = Ray {
                origin: origin.x,
                direction: *direction,
            };
            (ray, *reach)
        })
    }
}

/// The filter of [`super::Aggregate::intersect`] and [`super::Aggregate::occluded`] that lets every
/// ray meet every instance: it costs nothing.
#[inline(always)]
pub fn every_instance(_ray: usize, _instance: u32) -> bool {
    true
}

/// What a ray meets first among the bodies of one worldline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Length along the ray, in metres of the rest frame.
    pub t: f64,
    /// Number of the instance, in the order in which instances were given.
    pub instance: u32,
    /// Number of the triangle in its mesh.
    pub triangle: u32,
    /// Barycentric weights of the triangle's vertices.
    pub weights: [f64; 3],
    /// Whether the mesh's front is seen.
    pub front: bool,
}

impl Hit {
    /// Nearest first; at the same place the body and the triangle that were given first, so that
    /// the picture does not depend on the order of traversal.
    pub(super) fn precedes(&self, other: &Self) -> bool {
        (self.t, self.instance, self.triangle) < (other.t, other.instance, other.triangle)
    }

    /// The same hit of a ray that starts earlier by `way` metres.
    #[inline(always)]
    pub(super) fn after(self, way: f64) -> Self {
        Self {
            t: way + self.t,
            ..self
        }
    }
}
