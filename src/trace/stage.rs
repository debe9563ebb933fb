//! The bodies of each worldline, standing still in its rest frame, and the rays that meet them
//! there. Two levels: a tree over the instances of a worldline, and a tree over the triangles of
//! each mesh, which instances share.
//!
//! This is the one border between f64 and f32: before a ray enters a tree its origin is moved, in
//! f64, to the near side of the tree's bounding sphere, and only box tests are f32. Triangles are
//! tested in f64, so the crossing is the event.
//!
//! A stage in f32 ([`Stage::with_precision`]) has its border here too, only all of what lies beyond
//! is f32: the ray once it is boosted, where bodies stand, triangles, and what is found.

use super::ball::{Ball, brought_near, is_near, left, near_side};
use super::bvh::{Bvh, TreeRay};
use super::mesh_tree::{MeshTree, starting_point};
use super::real::Real;
use crate::model::Mesh;
use crate::scene::{Geometry, Instance};
use crate::shot::Precision;
use glam::DVec3;
use indexmap::IndexSet;
use std::sync::Arc;

/// A ray in one worldline's rest frame.
#[derive(Debug, Clone, Copy)]
pub struct RestRay {
    /// Start, in metres.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
}

/// What a ray meets first among the bodies of one worldline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyHit {
    /// Length along the ray, in metres of the rest frame.
    pub t: f64,
    /// Which instance of the geometry.
    pub instance: u32,
    /// Which triangle of its mesh.
    pub triangle: u32,
    /// Barycentric weights of the triangle's vertices.
    pub weights: [f64; 3],
    /// Whether the mesh's front is seen.
    pub front: bool,
}

/// All bodies, ready for rays.
pub struct Stage {
    crowds: Crowds,
    /// The worldlines that have bodies, in the order of the geometry.
    order: Vec<usize>,
}

/// The bodies by index of their worldline, in one of the precisions.
enum Crowds {
    F64(Vec<Option<Crowd<f64>>>),
    F32(Vec<Option<Crowd<f32>>>),
}

impl Stage {
    /// [`Stage::with_precision`] in f64.
    pub fn build(geometry: &Geometry, earlier: Option<&Stage>) -> Self {
        Self::with_precision(geometry, earlier, Precision::F64)
    }

    /// Builds the trees. Meshes of an earlier stage of the same precision are taken over where they
    /// are the same, so a body that moves within its rest frame from image to image costs only the
    /// instance tree.
    ///
    /// In f32 triangles take 36 bytes each in place of 72, and rays as long as in f64 while meshes fit
    /// the processor's cache (`benches/rays.rs`). In a rest frame directions are off by
    /// 6·10⁻⁸ rad (less along an axis), and places by 6·10⁻⁸ of the coordinates of camera and body
    /// and of the distance between them. Weak where bodies stand far from the origin of their
    /// worldline, and where they come on obliquely at a large Lorentz factor γ: the rest frame holds
    /// the image in a cone of 1/γ, and what is off there is off by up to 2γ as much in the image.
    /// Bodies of one worldline that together reach over more than 10¹⁸ m, or less than 10⁻¹⁸ m, are
    /// not seen.
    pub fn with_precision(
        geometry: &Geometry,
        earlier: Option<&Stage>,
        precision: Precision,
    ) -> Self {
        let order: IndexSet<usize> = geometry
            .instances
            .iter()
            .map(|i| i.worldline as usize)
            .collect();
        let crowds = match (precision, earlier.map(|stage| &stage.crowds)) {
            (Precision::F64, Some(Crowds::F64(known))) => Crowds::F64(crowds(geometry, known)),
            (Precision::F64, _) => Crowds::F64(crowds(geometry, &[])),
            (Precision::F32, Some(Crowds::F32(known))) => Crowds::F32(crowds(geometry, known)),
            (Precision::F32, _) => Crowds::F32(crowds(geometry, &[])),
        };
        Self {
            crowds,
            order: order.into_iter().collect(),
        }
    }

    /// The worldlines that have bodies, in the order of the geometry's instances. Where surfaces of
    /// two are met at one event the first of them is seen, so it must not depend on how the shot is
    /// written ([`Geometry::instances`]).
    pub fn worldlines(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().copied()
    }

    /// The first body of `worldline` that the ray meets nearer than `reach` (rest-frame metres).
    #[inline]
    pub fn nearest(&self, worldline: usize, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        match &self.crowds {
            Crowds::F64(crowds) => crowds.get(worldline)?.as_ref()?.nearest(ray, reach),
            Crowds::F32(crowds) => crowds.get(worldline)?.as_ref()?.nearest(ray, reach),
        }
    }

    /// [`Stage::nearest`] by trying every triangle of every instance, with the same arithmetic but no
    /// tree and no bound that a ray could miss: the same to the bit in f64, only slowly. What the
    /// trees are tested against.
    pub fn nearest_of_all(&self, worldline: usize, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        match &self.crowds {
            Crowds::F64(crowds) => crowds.get(worldline)?.as_ref()?.nearest_of_all(ray, reach),
            Crowds::F32(crowds) => crowds.get(worldline)?.as_ref()?.nearest_of_all(ray, reach),
        }
    }

    /// Whether any body of `worldline` stands on the ray nearer than `reach`.
    #[inline]
    pub fn blocks(&self, worldline: usize, ray: &RestRay, reach: f64) -> bool {
        match &self.crowds {
            Crowds::F64(crowds) => crowd(crowds, worldline).is_some_and(|c| c.blocks(ray, reach)),
            Crowds::F32(crowds) => crowd(crowds, worldline).is_some_and(|c| c.blocks(ray, reach)),
        }
    }

    /// A distance that surely separates a point from its surface here, from that in f64
    /// ([`crate::scene::SurfacePoint::clearance`]): in f32, where it would show if it were so
    /// generous, 100 roundings in place of 1000.
    pub(super) fn clearance(&self, in_f64: f64) -> f64 {
        match &self.crowds {
            Crowds::F64(_) => in_f64,
            Crowds::F32(_) => in_f64 * (0.1 * f64::from(f32::EPSILON) / f64::EPSILON),
        }
    }
}

fn crowd<R: Real>(crowds: &[Option<Crowd<R>>], worldline: usize) -> Option<&Crowd<R>> {
    crowds.get(worldline)?.as_ref()
}

fn crowds<R: Real>(geometry: &Geometry, earlier: &[Option<Crowd<R>>]) -> Vec<Option<Crowd<R>>> {
    let meshes = mesh_trees(geometry, earlier);
    let worldlines = geometry
        .instances
        .iter()
        .map(|i| i.worldline as usize + 1)
        .max();
    (0..worldlines.unwrap_or(0))
        .map(|worldline| Crowd::build(geometry, worldline as u32, &meshes))
        .collect()
}

fn mesh_trees<R: Real>(geometry: &Geometry, earlier: &[Option<Crowd<R>>]) -> Vec<Arc<MeshTree<R>>> {
    let known: Vec<&Arc<MeshTree<R>>> = earlier
        .iter()
        .flatten()
        .flat_map(|crowd| crowd.meshes.iter())
        .collect();
    let tree = |mesh: &Arc<Mesh>| match known.iter().find(|tree| Arc::ptr_eq(&tree.mesh, mesh)) {
        Some(tree) => Arc::clone(tree),
        None => Arc::new(MeshTree::build(mesh)),
    };
    geometry.meshes.iter().map(tree).collect()
}

/// A [`RestRay`] as triangles are met by it.
pub(super) struct Approach<R: Real> {
    pub(super) origin: R::Vector,
    pub(super) direction: R::Vector,
}

/// A [`BodyHit`] in the numbers it is found in.
#[derive(Clone, Copy)]
pub(super) struct Hit<R> {
    pub(super) t: R,
    pub(super) instance: u32,
    pub(super) triangle: u32,
    pub(super) weights: [R; 3],
    pub(super) front: bool,
}

/// The bodies of one worldline.
struct Crowd<R: Real> {
    ball: Ball,
    /// The ball's, as rays meet it.
    center: R::Vector,
    radius: R,
    /// How far the bodies reach from the center.
    reach: R,
    tree: Bvh,
    members: Vec<Member<R>>,
    /// Every mesh of the geometry, for a later stage to take over.
    meshes: Vec<Arc<MeshTree<R>>>,
}

/// One instance, its mesh scaled into the unit ball.
pub(super) struct Member<R: Real> {
    pub(super) mesh: u32,
    pub(super) instance: u32,
    /// Linear part of the map from the rest frame to the mesh's unit ball.
    pub(super) unit_from_rest: R::Matrix,
    /// Center of the mesh's ball in the rest frame.
    pub(super) center: R::Vector,
    /// How near, in units of the ball, a ray that starts on a surface may be to it.
    pub(super) starting_point: R,
    /// Reach of the mesh in its unit ball.
    pub(super) ball_reach: R,
    /// Whether triangles are passed through from behind. Front and back are those of the mesh
    /// itself, also in a mirrored instance (glTF 2.0 §3.7.4).
    pub(super) single_sided: bool,
}

impl<R: Real> Crowd<R> {
    fn build(geometry: &Geometry, worldline: u32, meshes: &[Arc<MeshTree<R>>]) -> Option<Self> {
        let standing: Vec<(u32, &Instance)> = geometry
            .instances
            .iter()
            .enumerate()
            .filter(|(_, instance)| instance.worldline == worldline)
            .map(|(i, instance)| (i as u32, instance))
            .collect();
        if standing.is_empty() {
            return None;
        }
        let boxes: Vec<(DVec3, DVec3)> = standing
            .iter()
            .map(|(_, instance)| {
                meshes[instance.mesh as usize].box_in_rest(&instance.rest_from_mesh)
            })
            .collect();
        let ball = Ball::around(boxes.iter().map(|(min, max)| {
            let half = *max / 2.0 - *min / 2.0;
            (*min + half, half.length())
        }));
        if !(1.0 / R::WIDEST..=R::WIDEST).contains(&ball.radius) {
            return None;
        }
        let unit = |p: DVec3| (p - ball.center) / ball.radius;
        let (tree, order) = Bvh::build(boxes.iter().map(|(min, max)| (unit(*min), unit(*max))));
        let members = order
            .iter()
            .map(|&i| {
                let (index, instance) = standing[i as usize];
                Member::new(index, instance, &meshes[instance.mesh as usize])
            })
            .collect();
        Some(Self {
            ball,
            center: R::vector(ball.center),
            radius: R::of(ball.radius),
            reach: R::of(ball.radius * ball.reach),
            tree,
            members,
            meshes: meshes.to_vec(),
        })
    }

    fn nearest(&self, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        let (way, ray) = self.nearby(ray)?;
        let hit = self.nearest_from(&ray, R::of(reach - way))?;
        Some(hit.after(way))
    }

    #[inline(always)]
    fn nearest_from(&self, ray: &Approach<R>, reach: R) -> Option<Hit<R>> {
        let (start, unit_ray) = self.entering(ray, reach)?;
        let mut best: Option<Hit<R>> = None;
        self.tree.nearest(&unit_ray, |place| {
            let member = &self.members[place];
            let mesh = &self.meshes[member.mesh as usize];
            let limit = best.map_or(reach, |hit| hit.t);
            match mesh.nearest(member, ray, limit, best) {
                Some(hit) => {
                    best = Some(hit);
                    left(hit.t, start) / self.radius
                }
                None => R::of(f64::INFINITY),
            }
        });
        best
    }

    fn nearest_of_all(&self, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        let (way, ray) = self.nearby(ray)?;
        let reach = R::of(reach - way);
        let hit = self.members.iter().fold(None, |best, member| {
            let mesh = &self.meshes[member.mesh as usize];
            mesh.nearest_of_all(member, &ray, reach, best).or(best)
        })?;
        Some(hit.after(way))
    }

    fn blocks(&self, ray: &RestRay, reach: f64) -> bool {
        self.nearby(ray).is_some_and(|(way, ray)| {
            let reach = R::of(reach - way);
            self.entering(&ray, reach).is_some_and(|(_, unit_ray)| {
                self.tree.any(&unit_ray, |place| {
                    let member = &self.members[place];
                    self.meshes[member.mesh as usize].blocks(member, &ray, reach)
                })
            })
        })
    }

    /// The ray itself, or, where its start is so far off that f64 would lose the bodies on the way,
    /// the ray from nearer by, and how much nearer.
    #[inline(always)]
    fn nearby(&self, ray: &RestRay) -> Option<(f64, Approach<R>)> {
        let Ball { center, radius, .. } = self.ball;
        let from_center = ray.origin - center;
        let (way, origin) = if is_near(from_center, ray.direction, radius) {
            (0.0, ray.origin)
        } else {
            let (way, from_center) = brought_near(from_center, ray.direction, radius)?;
            (way, center + from_center)
        };
        let approach = Approach {
            origin: R::vector(origin),
            direction: R::vector(ray.direction),
        };
        Some((way, approach))
    }

    /// The ray in unit-ball coordinates from where it comes near the ball, and how far that is.
    fn entering(&self, ray: &Approach<R>, reach: R) -> Option<(R, TreeRay<R>)> {
        let from_center = ray.origin - self.center;
        let start = near_side(from_center, ray.direction, R::of(1.0), self.reach)?;
        (start < reach).then(|| {
            let tree_ray = TreeRay {
                origin: (from_center + ray.direction * start) / self.radius,
                direction: ray.direction,
                reach: left(reach, start) / self.radius,
            };
            (start, tree_ray)
        })
    }
}

impl<R: Real> Member<R> {
    fn new(index: u32, instance: &Instance, mesh: &MeshTree<R>) -> Self {
        let unit_from_rest = (instance.rest_from_mesh.matrix3 * mesh.ball.radius).inverse();
        let center = instance.rest_from_mesh.transform_point3(mesh.ball.center);
        Self {
            mesh: instance.mesh,
            instance: index,
            unit_from_rest: R::matrix(unit_from_rest),
            center: R::vector(center),
            starting_point: starting_point(unit_from_rest, center),
            ball_reach: R::of(mesh.ball.reach),
            single_sided: !instance.double_sided,
        }
    }
}

impl<R: Real> Hit<R> {
    /// Nearest first; at the same place the body and the triangle that stand first in the
    /// geometry, so that the picture does not depend on the order of traversal.
    pub(super) fn precedes(&self, other: &Self) -> bool {
        (self.t, self.instance, self.triangle) < (other.t, other.instance, other.triangle)
    }

    /// As met by a ray that was brought nearer by `way`.
    #[inline(always)]
    fn after(self, way: f64) -> BodyHit {
        BodyHit {
            t: way + self.t.to_f64(),
            instance: self.instance,
            triangle: self.triangle,
            weights: self.weights.map(R::to_f64),
            front: self.front,
        }
    }
}
