//! The bodies of a scene as rays meet them: without materials.

use crate::accel::{Aggregate, Instance};
use crate::scene::Geometry;

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
