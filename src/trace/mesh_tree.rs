//! The triangles of one mesh, shared by its instances, and the rays that meet them.

use super::ball::{Ball, near_side};
use super::bvh::{Bvh, TreeRay};
use super::stage::{BodyHit, Member, RestRay};
use super::triangle::{Crossing, ShearedRay};
use crate::scene::Mesh;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A mesh's triangles in its unit ball, and the tree over them.
pub(super) struct MeshTree {
    pub(super) mesh: Arc<Mesh>,
    pub(super) ball: Ball,
    bounds: (DVec3, DVec3),
    tree: Bvh,
    /// In the tree's order.
    triangles: Vec<[[f64; 3]; 3]>,
    /// The mesh's own number of each triangle, in the tree's order.
    numbers: Vec<u32>,
}

/// Nearer than this, in units of the mesh's radius, is where the ray starts, not a hit: 30 times
/// the rounding of a point on the mesh.
const STARTING_POINT: f64 = 1e-14;

impl MeshTree {
    pub(super) fn build(mesh: &Arc<Mesh>) -> Self {
        let used = mesh
            .triangles
            .iter()
            .flatten()
            .map(|&i| (mesh.positions[i as usize], 0.0));
        let ball = Ball::around(used.clone());
        let unit = |p: DVec3| (p - ball.center) / ball.radius;
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
            ball,
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
        member: &Member,
        ray: &RestRay,
        reach: f64,
        rival: Option<BodyHit>,
    ) -> Option<BodyHit> {
        let local = LocalRay::enter(member, ray, reach)?;
        let mut best = rival;
        let mut found = false;
        self.tree.nearest(&local.tree_ray, |place| {
            let Some(crossing) = local.crossing(member, &self.triangles[place]) else {
                return f64::INFINITY;
            };
            let t = local.start + crossing.t;
            let hit = BodyHit {
                t,
                instance: member.instance,
                triangle: self.numbers[place],
                weights: crossing.weights,
                front: crossing.front,
            };
            if t > reach || best.is_some_and(|best| !hit.precedes(&best)) {
                return f64::INFINITY;
            }
            (best, found) = (Some(hit), true);
            crossing.t * local.length
        });
        if found { best } else { None }
    }

    #[inline(always)]
    pub(super) fn blocks(&self, member: &Member, ray: &RestRay, reach: f64) -> bool {
        LocalRay::enter(member, ray, reach).is_some_and(|local| {
            self.tree.any(&local.tree_ray, |place| {
                local
                    .crossing(member, &self.triangles[place])
                    .is_some_and(|crossing| local.start + crossing.t < reach)
            })
        })
    }
}

/// A ray in a mesh's unit ball, its parameter still in rest-frame metres.
struct LocalRay {
    /// How far along the rest-frame ray it begins.
    start: f64,
    /// Length of a rest-frame metre along the ray, in units of the ball.
    length: f64,
    /// Smallest parameter that is a hit.
    least: f64,
    tree_ray: TreeRay,
    sheared: ShearedRay,
}

impl LocalRay {
    #[inline(always)]
    fn enter(member: &Member, ray: &RestRay, reach: f64) -> Option<Self> {
        let direction = member.unit_from_rest * ray.direction;
        let from_center = member.unit_from_rest * (ray.origin - member.center);
        let d2 = direction.length_squared();
        let start = near_side(from_center, direction, d2, 1.0)?;
        if start >= reach {
            return None;
        }
        let length = d2.sqrt();
        let origin = from_center + direction * start;
        Some(Self {
            start,
            length,
            least: if start > 0.0 {
                f64::NEG_INFINITY
            } else {
                STARTING_POINT / length
            },
            tree_ray: TreeRay {
                origin,
                direction: direction / length,
                reach: (reach - start) * length,
            },
            sheared: ShearedRay::new(origin.to_array(), direction.to_array()),
        })
    }

    #[inline(always)]
    fn crossing(&self, member: &Member, triangle: &[[f64; 3]; 3]) -> Option<Crossing> {
        let crossing = self.sheared.crossing(triangle)?;
        (crossing.t > self.least && (crossing.front || !member.single_sided)).then_some(crossing)
    }
}
