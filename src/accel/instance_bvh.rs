//! The instances that rest in one worldline's frame, and the tree over them.

use super::bounding_sphere::{BoundingSphere, brought_near, is_near, left, near_side};
use super::bvh::{Bvh, TreeRay};
use super::instance::{Instance, PlacedInstance};
use super::mesh_bvh::MeshBvh;
use super::ray::Hit;
use super::ray::Ray;
use glam::DVec3;
use std::sync::Arc;

/// The instances of one worldline.
pub(super) struct InstanceBvh {
    sphere: BoundingSphere,
    /// How far the instances reach from the sphere's center.
    reach: f64,
    tree: Bvh,
    /// In the tree's order.
    instances: Vec<PlacedInstance>,
    /// Every mesh of the aggregate.
    meshes: Arc<[Arc<MeshBvh>]>,
}

impl InstanceBvh {
    /// The tree over instances and their numbers; None without any.
    pub(super) fn build(
        instances: &[(u32, Instance)],
        meshes: &Arc<[Arc<MeshBvh>]>,
    ) -> Option<Self> {
        if instances.is_empty() {
            return None;
        }
        let mesh = |instance: &Instance| &meshes[instance.mesh as usize];
        let boxes: Vec<(DVec3, DVec3)> = instances
            .iter()
            .map(|(_, instance)| mesh(instance).box_in_rest(&instance.rest_from_mesh))
            .collect();
        let sphere = BoundingSphere::around(boxes.iter().map(|(min, max)| {
            let half = *max / 2.0 - *min / 2.0;
            (*min + half, half.length())
        }));
        let unit = |p: DVec3| (p - sphere.center) / sphere.radius;
        let (tree, order) = Bvh::build(boxes.iter().map(|(min, max)| (unit(*min), unit(*max))));
        let instances = order
            .iter()
            .map(|&i| {
                let (number, instance) = &instances[i as usize];
                PlacedInstance::new(*number, instance, &mesh(instance).sphere)
            })
            .collect();
        Some(Self {
            sphere,
            reach: sphere.radius * sphere.reach,
            tree,
            instances,
            meshes: Arc::clone(meshes),
        })
    }

    /// The first hit nearer than `reach`, among the instances that `accepts` lets through.
    #[inline(always)]
    pub(super) fn nearest(
        &self,
        ray: &Ray,
        reach: f64,
        accepts: impl Fn(u32) -> bool,
    ) -> Option<Hit> {
        let (way, ray) = self.nearby(ray)?;
        let hit = self.nearest_from(&ray, reach - way, accepts)?;
        Some(hit.after(way))
    }

    #[inline(always)]
    fn nearest_from(&self, ray: &Ray, reach: f64, accepts: impl Fn(u32) -> bool) -> Option<Hit> {
        let (start, unit_ray) = self.entering(ray, reach)?;
        let mut best: Option<Hit> = None;
        self.tree.nearest(&unit_ray, |place| {
            let instance = &self.instances[place];
            if !accepts(instance.number) {
                return f64::INFINITY;
            }
            let mesh = &self.meshes[instance.mesh as usize];
            let limit = best.map_or(reach, |hit| hit.t);
            match mesh.nearest(instance, ray, limit, best) {
                Some(hit) => {
                    best = Some(hit);
                    left(hit.t, start) / self.sphere.radius
                }
                None => f64::INFINITY,
            }
        });
        best
    }

    /// [`InstanceBvh::nearest`] without trees: every triangle of every instance is tried.
    pub(super) fn nearest_of_all(&self, ray: &Ray, reach: f64) -> Option<Hit> {
        let (way, ray) = self.nearby(ray)?;
        let reach = reach - way;
        let hit = self.instances.iter().fold(None, |best, instance| {
            let mesh = &self.meshes[instance.mesh as usize];
            mesh.nearest_of_all(instance, &ray, reach, best).or(best)
        })?;
        Some(hit.after(way))
    }

    /// Whether any instance that `accepts` lets through is met nearer than `reach`.
    #[inline(always)]
    pub(super) fn blocks(&self, ray: &Ray, reach: f64, accepts: impl Fn(u32) -> bool) -> bool {
        self.nearby(ray).is_some_and(|(way, ray)| {
            let reach = reach - way;
            self.entering(&ray, reach).is_some_and(|(_, unit_ray)| {
                self.tree.any(&unit_ray, |place| {
                    let instance = &self.instances[place];
                    accepts(instance.number)
                        && self.meshes[instance.mesh as usize].blocks(instance, &ray, reach)
                })
            })
        })
    }

    /// The ray itself, or, where its start is so far off that f64 would lose the bodies on the way,
    /// the ray from nearer by, and how much nearer.
    #[inline(always)]
    fn nearby(&self, ray: &Ray) -> Option<(f64, Ray)> {
        let BoundingSphere { center, radius, .. } = self.sphere;
        let from_center = ray.origin - center;
        if is_near(from_center, ray.direction, radius) {
            return Some((0.0, *ray));
        }
        let (way, from_center) = brought_near(from_center, ray.direction, radius)?;
        let nearer = Ray {
            origin: center + from_center,
            direction: ray.direction,
        };
        Some((way, nearer))
    }

    /// The ray in unit-sphere coordinates from where it comes near the sphere, and how far that is.
    #[inline(always)]
    fn entering(&self, ray: &Ray, reach: f64) -> Option<(f64, TreeRay)> {
        let from_center = ray.origin - self.sphere.center;
        let start = near_side(from_center, ray.direction, 1.0, self.reach)?;
        (start < reach).then(|| {
            let tree_ray = TreeRay {
                origin: (from_center + ray.direction * start) / self.sphere.radius,
                direction: ray.direction,
                reach: left(reach, start) / self.sphere.radius,
            };
            (start, tree_ray)
        })
    }
}
