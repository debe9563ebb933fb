//! A surface event and its surroundings, in the surface's rest frame.

use crate::accel::Hit;
use crate::relativity::Event;
use crate::scene::{Scene, SurfacePoint};
use glam::DVec3;

/// A ray's end on a surface, seen from the surface.
pub(super) struct Place {
    pub(super) worldline: usize,
    /// When and where the light left.
    pub(super) event: Event,
    /// Normals turned to the viewer.
    pub(super) point: SurfacePoint,
    /// Unit direction of the ray that found it.
    pub(super) incoming: DVec3,
    /// Whether the mesh's front is seen.
    pub(super) front: bool,
}

impl Place {
    /// Where a ray of unit direction `incoming` (rest frame of what it hit) ends, at `time` there.
    pub(super) fn new(scene: &Scene, hit: &Hit, incoming: DVec3, time: f64) -> Self {
        let geometry = &scene.geometry;
        let mut point = geometry.surface_point(hit.instance, hit.triangle, hit.weights);
        if !hit.front {
            point.flat_normal = -point.flat_normal;
            point.normal = -point.normal;
            // Seen from behind, the smooth surface is hollow.
            point.bulge = DVec3::ZERO;
        }
        Self {
            worldline: geometry.instances[hit.instance as usize].worldline as usize,
            event: Event::new(time, point.position),
            point,
            incoming,
            front: hit.front,
        }
    }

    /// Towards the viewer.
    pub(super) fn view(&self) -> DVec3 {
        -self.incoming
    }

    /// An event just off the surface, on the viewer's side or beyond.
    pub(super) fn beside(&self, beyond: bool) -> Event {
        let off = self.point.flat_normal * self.point.clearance;
        let x = if beyond {
            self.event.x - off
        } else {
            self.event.x + off
        };
        Event::new(self.event.t, x)
    }
}
