//! The triangles of one mesh, shared by its instances, and the rays that meet them.

use super::ball::{Ball, left, near_side};
use super::bvh::{Bvh, TreeRay};
use super::real::Real;
use super::stage::{Approach, Hit, Member};
use super::triangle::{Crossing, ShearedRay};
use crate::model::Mesh;
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// A mesh's triangles in its unit ball, and the tree over them.
pub(super) struct MeshTree<R> {
    pub(super) mesh: Arc<Mesh>,
    pub(super) ball: Ball,
    bounds: (DVec3, DVec3),
    tree: Bvh,
    /// In the tree's order.
    triangles: Vec<[[R; 3]; 3]>,
    /// The mesh's own number of each triangle, in the tree's order.
    numbers: Vec<u32>,
}

/// A ray that starts nearer than this to a triangle's plane starts on it and does not meet it, also
/// where it grazes it: 45 roundings of the mesh's radius and of the place where it stands, in units
/// of the radius.
pub(super) fn starting_point<R: Real>(unit_from_rest: DMat3, center: DVec3) -> R {
    let place = (0..3).map(|i| unit_from_rest.row(i).abs().dot(center.abs()));
    let roundings = 1e-14 * (R::EPSILON.to_f64() / f64::EPSILON);
    R::of(roundings * (1.0 + place.fold(0.0, f64::max)))
}

impl<R: Real> MeshTree<R> {
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
            .map(|&i| corners[i as usize].map(|corner| R::to_array(R::vector(corner))))
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
        member: &Member<R>,
        ray: &Approach<R>,
        reach: R,
        rival: Option<Hit<R>>,
    ) -> Option<Hit<R>> {
        let local = LocalRay::enter(member, ray, reach)?;
        let mut search = Search::new(self, member, &local, reach, rival);
        self.tree
            .nearest(&local.tree_ray, |place| search.offer(place));
        search.found()
    }

    /// [`MeshTree::nearest`] without the tree and the ball.
    pub(super) fn nearest_of_all(
        &self,
        member: &Member<R>,
        ray: &Approach<R>,
        reach: R,
        rival: Option<Hit<R>>,
    ) -> Option<Hit<R>> {
        let local = LocalRay::passing(member, ray, reach);
        let mut search = Search::new(self, member, &local, reach, rival);
        for place in 0..self.triangles.len() {
            search.offer(place);
        }
        search.found()
    }

    #[inline(always)]
    pub(super) fn blocks(&self, member: &Member<R>, ray: &Approach<R>, reach: R) -> bool {
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
struct Search<'a, R: Real> {
    mesh: &'a MeshTree<R>,
    member: &'a Member<R>,
    local: &'a LocalRay<R>,
    reach: R,
    best: Option<Hit<R>>,
    /// Whether that is one of these triangles.
    own: bool,
}

impl<'a, R: Real> Search<'a, R> {
    #[inline(always)]
    fn new(
        mesh: &'a MeshTree<R>,
        member: &'a Member<R>,
        local: &'a LocalRay<R>,
        reach: R,
        rival: Option<Hit<R>>,
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
    fn offer(&mut self, place: usize) -> R {
        let none = R::of(f64::INFINITY);
        let Some(crossing) = self
            .local
            .crossing(self.member, &self.mesh.triangles[place])
        else {
            return none;
        };
        let hit = Hit {
            t: self.local.start + crossing.t,
            instance: self.member.instance,
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
    fn found(self) -> Option<Hit<R>> {
        self.best.filter(|_| self.own)
    }
}

/// A ray in a mesh's unit ball, its parameter still in rest-frame metres.
struct LocalRay<R: Real> {
    /// How far along the rest-frame ray it begins.
    start: R,
    /// Length of a rest-frame metre along the ray, in units of the ball.
    length: R,
    tree_ray: TreeRay<R>,
    sheared: ShearedRay<R>,
}

impl<R: Real> LocalRay<R> {
    /// The ray from where it comes near the ball, if it does so nearer than `reach`.
    #[inline(always)]
    fn enter(member: &Member<R>, ray: &Approach<R>, reach: R) -> Option<Self> {
        let (from_center, direction) = in_ball(member, ray);
        let d2 = R::dot(direction, direction);
        let start = near_side(from_center, direction, d2, member.ball_reach)?;
        (start < reach).then(|| Self::new((from_center, direction, d2), start, reach))
    }

    /// The ray from where it comes near the ball, or passes it.
    fn passing(member: &Member<R>, ray: &Approach<R>, reach: R) -> Self {
        let (from_center, direction) = in_ball(member, ray);
        let d2 = R::dot(direction, direction);
        let start = near_side(from_center, direction, d2, member.ball_reach)
            .unwrap_or_else(|| (-R::dot(from_center, direction) / d2).max(R::of(0.0)));
        Self::new((from_center, direction, d2), start, reach)
    }

    #[inline(always)]
    fn new((from_center, direction, d2): (R::Vector, R::Vector, R), start: R, reach: R) -> Self {
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
            sheared: ShearedRay::new(R::to_array(origin), R::to_array(direction)),
        }
    }

    #[inline(always)]
    fn crossing(&self, member: &Member<R>, triangle: &[[R; 3]; 3]) -> Option<Crossing<R>> {
        let zero = R::of(0.0);
        let crossing = self.sheared.crossing(triangle)?;
        let seen = crossing.front || !member.single_sided;
        let met = self.start > zero || (crossing.t > zero && self.starts_off(member, triangle));
        // Numbers that left the range are no place.
        (seen && met && crossing.t.is_finite()).then_some(crossing)
    }

    /// Whether the ray, which starts among the triangles, does not start on this one's plane.
    fn starts_off(&self, member: &Member<R>, triangle: &[[R; 3]; 3]) -> bool {
        let [a, b, c] = triangle.map(R::from_array);
        let normal = R::cross(b - a, c - a);
        let off = R::dot(normal, a - self.tree_ray.origin);
        off.abs() > member.starting_point * R::dot(normal, normal).sqrt()
    }
}

/// Origin, from the ball's center, and direction of a ray in units of a member's ball.
#[inline(always)]
fn in_ball<R: Real>(member: &Member<R>, ray: &Approach<R>) -> (R::Vector, R::Vector) {
    (
        member.unit_from_rest * (ray.origin - member.center),
        member.unit_from_rest * ray.direction,
    )
}
