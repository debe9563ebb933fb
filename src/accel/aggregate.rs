//! All bodies of an image: the instances of each worldline, at rest in its frame.

use super::instance::Instance;
use super::instance_bvh::InstanceBvh;
use super::mesh_bvh::MeshBvh;
use super::ray::Hit;
use super::ray::{Ray, RayBatch, every_instance};
use crate::model::Mesh;
use indexmap::IndexSet;
use std::sync::Arc;

/// All bodies, ready for rays.
pub struct Aggregate {
    /// By number of the worldline.
    worldlines: Vec<Option<InstanceBvh>>,
    /// The worldlines that have bodies, in the order of the instances.
    order: Vec<usize>,
    /// For a later aggregate to take over.
    meshes: Arc<[Arc<MeshBvh>]>,
}

impl Aggregate {
    /// Builds the trees. Meshes of an earlier aggregate are taken over where they are the same, so a
    /// body that moves within its rest frame from image to image costs only the instance tree.
    pub fn build(
        meshes: &[Arc<Mesh>],
        instances: &[Instance],
        earlier: Option<&Aggregate>,
    ) -> Self {
        let meshes = mesh_trees(meshes, earlier);
        let count = instances.iter().map(|i| i.worldline as usize + 1).max();
        let mut resting = vec![Vec::new(); count.unwrap_or(0)];
        for (number, instance) in (0..).zip(instances) {
            resting[instance.worldline as usize].push((number, *instance));
        }
        let worldlines = resting
            .iter()
            .map(|instances| InstanceBvh::build(instances, &meshes))
            .collect();
        let order: IndexSet<usize> = instances.iter().map(|i| i.worldline as usize).collect();
        Self {
            worldlines,
            order: order.into_iter().collect(),
            meshes,
        }
    }

    /// The worldlines that have bodies, in the order of the instances. Where surfaces of two are met
    /// at one event the first of them is seen, so it must not depend on how the shot is written.
    pub fn worldlines(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().copied()
    }

    /// The first hit of each ray of a batch among the instances of `worldline` that `accepts` lets
    /// through, given the numbers of ray and instance ([`every_instance`] lets all through). Writes
    /// one element a ray to `hits`; None where nothing is met within the ray's reach.
    #[inline]
    pub fn intersect(
        &self,
        worldline: usize,
        rays: &RayBatch,
        accepts: impl Fn(usize, u32) -> bool,
        hits: &mut Vec<Option<Hit>>,
    ) {
        hits.clear();
        let Some(bodies) = self.bodies(worldline) else {
            hits.resize(rays.len(), None);
            return;
        };
        hits.extend(rays.iter().enumerate().map(|(number, (ray, reach))| {
            bodies.nearest(&ray, reach, |instance| accepts(number, instance))
        }));
    }

    /// Whether each ray of a batch meets any instance of `worldline` that `accepts` lets through,
    /// within its reach. Writes one element a ray to `blocked`.
    #[inline]
    pub fn occluded(
        &self,
        worldline: usize,
        rays: &RayBatch,
        accepts: impl Fn(usize, u32) -> bool,
        blocked: &mut Vec<bool>,
    ) {
        blocked.clear();
        let Some(bodies) = self.bodies(worldline) else {
            blocked.resize(rays.len(), false);
            return;
        };
        blocked.extend(rays.iter().enumerate().map(|(number, (ray, reach))| {
            bodies.blocks(&ray, reach, |instance| accepts(number, instance))
        }));
    }

    /// [`Aggregate::intersect`] for one ray.
    pub fn intersect_ray(&self, worldline: usize, ray: &Ray, reach: f64) -> Option<Hit> {
        let accepts = |instance| every_instance(0, instance);
        self.bodies(worldline)?.nearest(ray, reach, accepts)
    }

    /// [`Aggregate::occluded`] for one ray.
    pub fn occludes_ray(&self, worldline: usize, ray: &Ray, reach: f64) -> bool {
        let accepts = |instance| every_instance(0, instance);
        self.bodies(worldline)
            .is_some_and(|bodies| bodies.blocks(ray, reach, accepts))
    }

    /// [`Aggregate::intersect_ray`] by trying every triangle of every instance, with the same
    /// arithmetic but no tree and no bound that a ray could miss: the same to the bit, only slowly.
    /// What the trees are tested against.
    pub fn intersect_without_trees(&self, worldline: usize, ray: &Ray, reach: f64) -> Option<Hit> {
        self.bodies(worldline)?.nearest_of_all(ray, reach)
    }

    fn bodies(&self, worldline: usize) -> Option<&InstanceBvh> {
        self.worldlines.get(worldline)?.as_ref()
    }
}

fn mesh_trees(meshes: &[Arc<Mesh>], earlier: Option<&Aggregate>) -> Arc<[Arc<MeshBvh>]> {
    let known = earlier.map_or(&[][..], |earlier| &earlier.meshes);
    let tree = |mesh: &Arc<Mesh>| match known.iter().find(|tree| Arc::ptr_eq(&tree.mesh, mesh)) {
        Some(tree) => Arc::clone(tree),
        None => Arc::new(MeshBvh::build(mesh)),
    };
    meshes.iter().map(tree).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::relativity::Event;
    use glam::{DAffine3, DVec3};

    /// Three unit squares across the z axis, at z = −1, −2 and −3.
    fn three_squares() -> Aggregate {
        let square = Mesh {
            positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[x, y]| DVec3::new(x - 0.5, y - 0.5, 0.0))
                .to_vec(),
            normals: None,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material: None,
        };
        let at = |z: f64| Instance {
            mesh: 0,
            worldline: 1,
            double_sided: true,
            rest_from_mesh: DAffine3::from_translation(DVec3::Z * z),
        };
        Aggregate::build(&[Arc::new(square)], &[at(-1.0), at(-2.0), at(-3.0)], None)
    }

    /// Rays down the z axis from the origin, some of which pass by.
    fn rays() -> RayBatch {
        let mut rays = RayBatch::default();
        for i in 0..40 {
            let start = DVec3::new(f64::from(i) * 0.02 + 0.013, 0.1, 0.0);
            let reach = [f64::INFINITY, 1.5, 0.5][i as usize % 3];
            rays.push(Event::new(2.0, start), DVec3::NEG_Z, reach);
        }
        rays
    }

    #[test]
    fn a_batch_meets_what_its_rays_meet_one_by_one() {
        let (bodies, rays) = (three_squares(), rays());
        let (mut hits, mut blocked) = (Vec::new(), Vec::new());
        bodies.intersect(1, &rays, every_instance, &mut hits);
        bodies.occluded(1, &rays, every_instance, &mut blocked);
        let singly = |i: usize| {
            let (origin, direction) = (rays.origins[i].x, rays.directions[i]);
            bodies.intersect_ray(1, &Ray { origin, direction }, rays.reaches[i])
        };
        for i in 0..rays.len() {
            assert_eq!(hits[i], singly(i));
            assert_eq!(blocked[i], hits[i].is_some());
        }
        assert!(blocked.contains(&true) && blocked.contains(&false));
        bodies.intersect(0, &rays, every_instance, &mut hits);
        assert_eq!(hits, vec![None; rays.len()]);
    }

    #[test]
    fn filtered_instances_are_passed_through_by_the_rays_that_are_told_so() {
        let (bodies, mut rays) = (three_squares(), rays());
        rays.reaches.fill(f64::INFINITY);
        let accepts = |ray: usize, instance: u32| ray.is_multiple_of(2) || instance == 2;
        let (mut hits, mut blocked) = (Vec::new(), Vec::new());
        bodies.intersect(1, &rays, accepts, &mut hits);
        for (ray, hit) in hits.iter().enumerate().take(24) {
            let (distance, instance) = if ray % 2 == 0 { (1.0, 0) } else { (3.0, 2) };
            let hit = hit.expect("the squares cover these rays");
            assert!((hit.t - distance).abs() < 1e-14 && hit.instance == instance);
        }
        bodies.occluded(1, &rays, |ray, _| ray.is_multiple_of(2), &mut blocked);
        assert!((0..24).all(|ray| blocked[ray] == (ray % 2 == 0)));
    }
}
