//! What a ray met, in its rest frame: the event, its surface and the direction to the viewer.

use super::nearest::NearestHit;
use crate::accel::Hit;
use crate::relativity::Event;
use crate::scene::{Scene, SurfacePoint};
use glam::DVec3;

/// The event in which a ray ends on a surface, in the surface's rest frame.
///
/// The point rests there, so there is no velocity; one belongs here when bodies bend or turn within
/// their rest frame.
pub(super) struct Interaction {
    /// The worldline in whose frame it is given.
    pub(super) worldline: usize,
    /// When and where the light left.
    pub(super) event: Event,
    /// Unit normal of the triangle, turned to the viewer.
    pub(super) geometric_normal: DVec3,
    /// Unit normal interpolated between the vertices, turned like the geometric one.
    pub(super) shading_normal: DVec3,
    /// From the event to the smooth surface that the vertex normals describe; zero where that is
    /// hollow for the viewer.
    pub(super) bulge: DVec3,
    /// A distance that surely separates a point from the surface, metres.
    pub(super) clearance: f64,
    /// Unit direction to the viewer: of the light that is seen.
    pub(super) to_viewer: DVec3,
    /// What was met: instance, triangle, barycentric position, and which side.
    pub(super) hit: Hit,
}

impl Interaction {
    /// The end of a ray.
    #[inline(always)]
    pub(super) fn new(scene: &Scene, found: &NearestHit) -> Self {
        let NearestHit {
            hit,
            time,
            direction,
            ..
        } = *found;
        let geometry = &scene.geometry;
        let SurfacePoint {
            position,
            flat_normal,
            normal,
            bulge,
            clearance,
        } = geometry.surface_point(hit.instance, hit.triangle, hit.weights);
        let (geometric_normal, shading_normal, bulge) = if hit.front {
            (flat_normal, normal, bulge)
        } else {
            // Seen from behind, the smooth surface is hollow.
            (-flat_normal, -normal, DVec3::ZERO)
        };
        Self {
            worldline: geometry.instances[hit.instance as usize].worldline as usize,
            event: Event::new(time, position),
            geometric_normal,
            shading_normal,
            bulge,
            clearance,
            to_viewer: -direction,
            hit,
        }
    }

    /// An event just off the surface, on the viewer's side or beyond.
    pub(super) fn beside(&self, beyond: bool) -> Event {
        let off = self.geometric_normal * self.clearance;
        let x = if beyond {
            self.event.x - off
        } else {
            self.event.x + off
        };
        Event::new(self.event.t, x)
    }

    /// From the event to where shadow rays start: off the smooth surface, or facets of a round body
    /// would shade each other where lamps rise.
    #[inline(always)]
    pub(super) fn off_smooth_surface(&self) -> DVec3 {
        self.bulge + self.geometric_normal * self.clearance
    }
}
