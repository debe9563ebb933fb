//! The triangles of one mesh, shared by its instances, and the rays that meet them.

use super::ball::{Ball, near_side};
use super::bvh::{Bvh, TreeRay};
use super::stage::{BodyHit, Member, RestRay};
use super::triangle::{Crossing, ShearedRay};
use crate::scene::Mesh;
use glam::{DAffine3, DMat3, DVec3};
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

/// A ray that starts nearer than this to a triangle's plane starts on it and does not meet it, also
/// where it grazes it: 45 roundings of the mesh's radius and of the place where it stands, in units
/// of the radius.
pub(super) fn starting_point(unit_from_rest: DMat3, center: DVec3) -> f64 {
    let place = (0..3).map(|i| unit_from_rest.row(i).abs().dot(center.abs()));
    1e-14 * (1.0 + place.fold(0.0, f64::max))
}

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
        let mut search = Search::new(self, member, &local, reach, rival);
        self.tree
            .nearest(&local.tree_ray, |place| search.offer(place));
        search.found()
    }

    /// [`MeshTree::nearest`] without the tree and the ball.
    pub(super) fn nearest_of_all(
        &self,
        member: &Member,
        ray: &RestRay,
        reach: f64,
        rival: Option<BodyHit>,
    ) -> Option<BodyHit> {
        let local = LocalRay::passing(member, ray, reach);
        let mut search = Search::new(self, member, &local, reach, rival);
        for place in 0..self.triangles.len() {
            search.offer(place);
        }
        search.found()
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

/// The nearest hit among the triangles offered so far.
struct Search<'a> {
    mesh: &'a MeshTree,
    member: &'a Member,
    local: &'a LocalRay,
    reach: f64,
    best: Option<BodyHit>,
    /// Whether that is one of these triangles.
    own: bool,
}

impl<'a> Search<'a> {
    #[inline(always)]
    fn new(
        mesh: &'a MeshTree,
        member: &'a Member,
        local: &'a LocalRay,
        reach: f64,
        rival: Option<BodyHit>,
    ) -> Self {
        Self {
            mesh,
            member,
            local,
            reach,
            best: rival,
            own: false,
        }
    }

    /// Answers with the ray parameter in units of the ball where this triangle is now the nearest,
    /// else with infinity.
    #[inline(always)]
    fn offer(&mut self, place: usize) -> f64 {
        let Some(crossing) = self
            .local
            .crossing(self.member, &self.mesh.triangles[place])
        else {
            return f64::INFINITY;
        };
        let hit = BodyHit {
            t: self.local.start + crossing.t,
            instance: self.member.instance,
            triangle: self.mesh.numbers[place],
            weights: crossing.weights,
            front: crossing.front,
        };
        if hit.t > self.reach || self.best.is_some_and(|best| !hit.precedes(&best)) {
            return f64::INFINITY;
        }
        (self.best, self.own) = (Some(hit), true);
        crossing.t * self.local.length
    }

    #[inline(always)]
    fn found(self) -> Option<BodyHit> {
        self.best.filter(|_| self.own)
    }
}

/// A ray in a mesh's unit ball, its parameter still in rest-frame metres.
struct LocalRay {
    /// How far along the rest-frame ray it begins.
    start: f64,
    /// Length of a rest-frame metre along the ray, in units of the ball.
    length: f64,
    tree_ray: TreeRay,
    sheared: ShearedRay,
}

impl LocalRay {
    /// The ray from where it comes near the ball, if it does so nearer than `reach`.
    #[inline(always)]
    fn enter(member: &Member, ray: &RestRay, reach: f64) -> Option<Self> {
        let (from_center, direction) = in_ball(member, ray);
        let d2 = direction.length_squared();
        let start = near_side(from_center, direction, d2, 1.0)?;
        (start < reach).then(|| Self::new((from_center, direction, d2), start, reach))
    }

    /// The ray from where it comes near the ball, or passes it.
    fn passing(member: &Member, ray: &RestRay, reach: f64) -> Self {
        let (from_center, direction) = in_ball(member, ray);
        let d2 = direction.length_squared();
        let start = near_side(from_center, direction, d2, 1.0)
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
                reach: (reach - start) * length,
            },
            sheared: ShearedRay::new(origin.to_array(), direction.to_array()),
        }
    }

    #[inline(always)]
    fn crossing(&self, member: &Member, triangle: &[[f64; 3]; 3]) -> Option<Crossing> {
        let crossing = self.sheared.crossing(triangle)?;
        let seen = crossing.front || !member.single_sided;
        let met = self.start > 0.0 || (crossing.t > 0.0 && self.starts_off(member, triangle));
        (seen && met).then_some(crossing)
    }

    /// Whether the ray, which starts among the triangles, does not start on this one's plane.
    fn starts_off(&self, member: &Member, triangle: &[[f64; 3]; 3]) -> bool {
        let [a, b, c] = triangle.map(DVec3::from);
        let normal = (b - a).cross(c - a);
        let off = normal.dot(a - self.tree_ray.origin);
        off.abs() > member.starting_point * normal.length()
    }
}

/// Origin, from the ball's center, and direction of a ray in units of a member's ball.
#[inline(always)]
fn in_ball(member: &Member, ray: &RestRay) -> (DVec3, DVec3) {
    (
        member.unit_from_rest * (ray.origin - member.center),
        member.unit_from_rest * ray.direction,
    )
}
