//! The light path from a surface to the camera, in the lab.

use super::View;
use crate::relativity::Event;
use crate::trace::Surface;
use glam::DVec3;

/// The light path from a surface to the camera, in the lab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabPath {
    /// The emission event.
    pub emission: Event,
    /// Length, meters.
    pub distance: f64,
}

impl LabPath {
    /// The path to the first surface that a camera ray of unit `direction` (camera's rest frame)
    /// meets.
    pub fn new(view: &View<'_>, surface: &Surface, direction: DVec3) -> Self {
        const LAB: usize = 0;
        let spacetime = view.spacetime();
        let camera = spacetime.camera_event(LAB);
        // Followed as light that travels from the surface to the camera, which does not cancel far
        // away.
        let light = spacetime
            .link(LAB, view.scene().camera.worldline)
            .light(-direction);
        let distance = surface.s * spacetime.path_ratio(light.frequency_ratio);
        let emission = Event::new(
            camera.t - spacetime.delay(distance),
            camera.x - light.direction * distance,
        );
        Self { emission, distance }
    }
}
