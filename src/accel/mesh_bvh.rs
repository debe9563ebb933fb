//! The triangles of one mesh, shared by its instances, and the rays that meet them.

use super::bounding_sphere::{BoundingSphere, left, near_side};
use super::bvh::{Bvh, TreeRay};
use super::instance::PlacedInstance;
use super::ray::Hit;
use super::ray::Ray;
use super::triangle::{Crossing, ShearedRay};
use crate::model::Mesh;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A mesh's triangles in its unit sphere, and the tree over them.
pub(super) struct MeshBvh {
    pub(super) mesh: Arc<Mesh>,
    pub(super) sphere: BoundingSphere,
    bounds: (DVec3, DVec3),
    tree: Bvh,
    /// In the tree's order.
    triangles: Vec<[[f64; 3]; 3]>,
    /// The mesh's own number of each triangle, in the tree's order.
    numbers: Vec<u32>,
}

impl MeshBvh {
    pub(super) fn build(mesh: &Arc<Mesh>) -> Self {
        let used = mesh
            .triangles
            .iter()
            .flatten()
            .map(|&i| (mesh.positions[i as usize], 0.0));
        let sphere = BoundingSphere::around(used.clone());
        let unit = |p: DVec3| (p - sphere.center) / sphere.radius;
        let corners: Vec<[DVec3; 3]> = mesh
            .triangles
            .iter()
            .map(|t| t.map(|i| unit(mesh.positions[i as usize])))
            .collect();
        let boxes = corners
            .iter()
            .map(|[a, b, c]| (a.min(*b).min(*c), a.max(*b).max(*c)));
        let (tree, numbers) = Bvh::build(boxes);
        let triangles = numbers
            .iter()
            .map(|&i| corners[i as usize].map(|corner| corner.to_array()))
            .collect();
        let bounds = used.fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(min, max), (p, _)| (min.min(p), max.max(p)),
        );
        Self {
            mesh: Arc::clone(mesh),
            sphere,
            bounds,
            tree,
            triangles,
            numbers,
        }
    }

    /// Box in the rest frame of the mesh placed by `rest_from_mesh`.
    pub(super) fn box_in_rest(&self, rest_from_mesh: &DAffine3) -> (DVec3, DVec3) {
        let half = self.bounds.1 / 2.0 - self.bounds.0 / 2.0;
        let center = rest_from_mesh.transform_point3(self.bounds.0 + half);
        let m = rest_from_mesh.matrix3;
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        (center - reach, center + reach)
    }

    #[inline(always)]
    pub(super) fn nearest(
        &self,
        instance: &PlacedInstance,
        ray: &Ray,
        reach: f64,
        rival: Option<Hit>,
    ) -> Option<Hit> {
        let local = LocalRay::enter(instance, ray, reach)?;
        let mut search = Search::new(self, instance, &local, reach, rival);
        self.tree
            .nearest(&local.tree_ray, |place| search.offer(place));
        search.found()
    }

    /// [`MeshBvh::nearest`] without the tree and the sphere.
    pub(super) fn nearest_of_all(
        &self,
        instance: &PlacedInstance,
        ray: &Ray,
        reach: f64,
        rival: Option<Hit>,
    ) -> Option<Hit> {
        let local = LocalRay::passing(instance, ray, reach);
        let mut search = Search::new(self, instance, &local, reach, rival);
        for place in 0..self.triangles.len() {
            search.offer(place);
        }
        search.found()
    }

    #[inline(always)]
    pub(super) fn blocks(&self, instance: &PlacedInstance, ray: &Ray, reach: f64) -> bool {
        LocalRay::enter(instance, ray, reach).is_some_and(|local| {
            self.tree.any(&local.tree_ray, |place| {
                local
                    .crossing(instance, &self.triangles[place])
                    .is_some_and(|crossing| local.start + crossing.t < reach)
            })
        })
    }
}

/// The nearest hit among the triangles offered so far.
struct Search<'a> {
    mesh: &'a MeshBvh,
    instance: &'a PlacedInstance,
    local: &'a LocalRay,
    reach: f64,
    best: Option<Hit>,
    /// Whether that is one of these triangles.
    own: bool,
}

impl<'a> Search<'a> {
    #[inline(always)]
    fn new(
        mesh: &'a MeshBvh,
        instance: &'a PlacedInstance,
        local: &'a LocalRay,
        reach: f64,
        rival: Option<Hit>,
    ) -> Self {
        Self {
            mesh,
            instance,
            local,
            reach,
            best: rival,
            own: false,
        }
    }

    /// Answers with the ray parameter in units of the sphere where this triangle is now the nearest,
    /// else with infinity.
    #[inline(always)]
    fn offer(&mut self, place: usize) -> f64 {
        let none = f64::INFINITY;
        let Some(crossing) = self
            .local
            .crossing(self.instance, &self.mesh.triangles[place])
        else {
            return none;
        };
        let hit = Hit {
            t: self.local.start + crossing.t,
            instance: self.instance.number,
            triangle: self.mesh.numbers[place],
            weights: crossing.weights,
            front: crossing.front,
        };
        if hit.t > self.reach || self.best.is_some_and(|best| !hit.precedes(&best)) {
            return none;
        }
        (self.best, self.own) = (Some(hit), true);
        crossing.t * self.local.length
    }

    #[inline(always)]
    fn found(self) -> Option<Hit> {
        self.best.filter(|_| self.own)
    }
}

/// A ray in a mesh's unit sphere, its parameter still in rest-frame metres.
struct LocalRay {
    /// How far along the rest-frame ray it begins.
    start: f64,
    /// Length of a rest-frame metre along the ray, in units of the sphere.
    length: f64,
    tree_ray: TreeRay,
    sheared: ShearedRay,
}

impl LocalRay {
    /// The ray from where it comes near the sphere, if it does so nearer than `reach`.
    #[inline(always)]
    fn enter(instance: &PlacedInstance, ray: &Ray, reach: f64) -> Option<Self> {
        let (from_center, direction) = instance.in_sphere(ray);
        let d2 = direction.dot(direction);
        let start = near_side(from_center, direction, d2, instance.sphere_reach)?;
        (start < reach).then(|| Self::new((from_center, direction, d2), start, reach))
    }

    /// The ray from where it comes near the sphere, or passes it.
    fn passing(instance: &PlacedInstance, ray: &Ray, reach: f64) -> Self {
        let (from_center, direction) = instance.in_sphere(ray);
        let d2 = direction.dot(direction);
        let start = near_side(from_center, direction, d2, instance.sphere_reach)
            .unwrap_or_else(|| (-from_center.dot(direction) / d2).max(0.0));
        Self::new((from_center, direction, d2), start, reach)
    }

    #[inline(always)]
    fn new((from_center, direction, d2): (DVec3, DVec3, f64), start: f64, reach: f64) -> Self {
        let length = d2.sqrt();
        let origin = from_center + direction * start;
        Self {
            start,
            length,
            tree_ray: TreeRay {
                origin,
                direction: direction / length,
                reach: left(reach, start) * length,
            },
            sheared: ShearedRay::new(origin.to_array(), direction.to_array()),
        }
    }

    #[inline(always)]
    fn crossing(&self, instance: &PlacedInstance, triangle: &[[f64; 3]; 3]) -> Option<Crossing> {
        let crossing = self.sheared.crossing(triangle)?;
        let seen = crossing.front || !instance.single_sided;
        let met = self.start > 0.0 || (crossing.t > 0.0 && self.starts_off(instance, triangle));
        // Numbers that left the range are no place.
        (seen && met && crossing.t.is_finite()).then_some(crossing)
    }

    /// Whether the ray, which starts among the triangles, does not start on this one's plane.
    fn starts_off(&self, instance: &PlacedInstance, triangle: &[[f64; 3]; 3]) -> bool {
        let [a, b, c] = triangle.map(DVec3::from);
        let normal = (b - a).cross(c - a);
        let off = normal.dot(a - self.tree_ray.origin);
        off.abs() > instance.starting_point * normal.dot(normal).sqrt()
    }
}
