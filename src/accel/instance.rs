//! One placement of a mesh: as it is given, and as rays are brought to it.

use super::bounding_sphere::BoundingSphere;
use super::ray::Ray;
use glam::{DAffine3, DMat3, DVec3};

/// One placement of a mesh at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Index into the meshes.
    pub mesh: u32,
    /// Number of the worldline in whose frame it rests.
    pub worldline: u32,
    /// Whether the back of a triangle is seen.
    pub double_sided: bool,
    /// From the mesh's coordinates to the rest frame; invertible.
    pub rest_from_mesh: DAffine3,
}

/// An [`Instance`] with its mesh scaled into the unit sphere.
pub(super) struct PlacedInstance {
    pub(super) mesh: u32,
    /// Number of the instance among all that were given.
    pub(super) number: u32,
    /// Linear part of the map from the rest frame to the mesh's unit sphere.
    unit_from_rest: DMat3,
    /// Center of the mesh's sphere in the rest frame.
    center: DVec3,
    /// A ray that starts nearer than this to a triangle's plane, in units of the sphere, starts on
    /// it.
    pub(super) starting_point: f64,
    /// Reach of the mesh in its unit sphere.
    pub(super) sphere_reach: f64,
    /// Whether triangles are passed through from behind. Front and back are those of the mesh
    /// itself, also in a mirrored instance (glTF 2.0 §3.7.4).
    pub(super) single_sided: bool,
}

impl PlacedInstance {
    /// The instance of a given number, of a mesh with this bounding sphere.
    pub(super) fn new(number: u32, instance: &Instance, sphere: &BoundingSphere) -> Self {
        let unit_from_rest = (instance.rest_from_mesh.matrix3 * sphere.radius).inverse();
        let center = instance.rest_from_mesh.transform_point3(sphere.center);
        Self {
            mesh: instance.mesh,
            number,
            unit_from_rest,
            center,
            starting_point: starting_point(unit_from_rest, center),
            sphere_reach: sphere.reach,
            single_sided: !instance.double_sided,
        }
    }

    /// Origin, from the sphere's center, and direction of a ray in units of the sphere.
    #[inline(always)]
    pub(super) fn in_sphere(&self, ray: &Ray) -> (DVec3, DVec3) {
        (
            self.unit_from_rest * (ray.origin - self.center),
            self.unit_from_rest * ray.direction,
        )
    }
}

/// A ray that starts nearer than this to a triangle's plane starts on it and does not meet it, also
/// where it grazes it: 45 roundings of the mesh's radius and of the place where it stands, in units
/// of the radius.
fn starting_point(unit_from_rest: DMat3, center: DVec3) -> f64 {
    let place = (0..3).map(|i| unit_from_rest.row(i).abs().dot(center.abs()));
    1e-14 * (1.0 + place.fold(0.0, f64::max))
}
