//! What is traced: everything that does not change from ray to ray, and the trees of a scene's bodies
//! without their materials.

use super::clock::Clock;
use super::spacetime::Spacetime;
use crate::accel::{Aggregate, Instance};
use crate::scene::{Geometry, Scene};
use glam::DVec3;

/// What of the scene is traced: everything that does not change from ray to ray.
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its bodies.
    pub aggregate: &'a Aggregate,
    /// How its worldlines move relative to each other.
    pub spacetime: &'a Spacetime,
    /// Whether bodies cast shadows.
    pub shadows: bool,
    /// How many mirrors and boundaries of glass are followed, one after the other; 0 where the
    /// image calls for none.
    pub bounces: u32,
    /// Branches that carry no more than this share of what arrives by them are not followed. What
    /// is lost is [`super::Root::cut`].
    pub cutoff: f64,
    /// Where seconds are counted, if anywhere.
    pub clock: Option<&'a Clock>,
}

impl Tracer<'_> {
    /// The background in a unit direction of some rest frame: the direction on its own axes, and D
    /// from it to that frame. None where it is black.
    pub(super) fn sky(&self, worldline: usize, direction: DVec3) -> Option<(DVec3, f64)> {
        let background = &self.scene.background;
        if background.is_black() {
            return None;
        }
        let light = self
            .spacetime
            .link(background.worldline, worldline)
            .light(-direction);
        let seen = background.axes.transpose() * -light.direction;
        Some((seen, 1.0 / light.frequency_ratio))
    }
}

/// The aggregate of a scene's bodies. Meshes of an `earlier` one are taken over where they are the
/// same ([`Aggregate::build`]).
pub fn build_aggregate(geometry: &Geometry, earlier: Option<&Aggregate>) -> Aggregate {
    let instances: Vec<Instance> = geometry
        .instances
        .iter()
        .map(|instance| Instance {
            mesh: instance.mesh,
            worldline: instance.worldline,
            double_sided: instance.double_sided,
            rest_from_mesh: instance.rest_from_mesh,
        })
        .collect();
    Aggregate::build(&geometry.meshes, &instances, earlier)
}
