//! The bodies of each worldline, standing still in its rest frame, and the rays that meet them
//! there. Two levels: a tree over the instances of a worldline, and a tree over the triangles of
//! each mesh, which instances share.
//!
//! This is the one border between f64 and f32: before a ray enters a tree its origin is moved, in
//! f64, to the near side of the tree's bounding sphere, and only box tests are f32. Triangles are
//! tested in f64, so the crossing is the event.

use super::ball::{Ball, brought_near, is_near, near_side};
use super::bvh::{Bvh, TreeRay};
use super::mesh_tree::{MeshTree, starting_point};
use crate::scene::{Geometry, Instance, Mesh};
use glam::{DMat3, DVec3};
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
    /// By index of the worldline.
    crowds: Vec<Option<Crowd>>,
    /// The worldlines that have bodies, in the order of the geometry.
    order: Vec<usize>,
}

impl Stage {
    /// Builds the trees. Meshes of an earlier stage are taken over where they are the same, so a
    /// body that moves within its rest frame from image to image costs only the instance tree.
    pub fn build(geometry: &Geometry, earlier: Option<&Stage>) -> Self {
        let meshes = mesh_trees(geometry, earlier);
        let worldlines = geometry
            .instances
            .iter()
            .map(|i| i.worldline as usize + 1)
            .max();
        let crowds = (0..worldlines.unwrap_or(0))
            .map(|worldline| Crowd::build(geometry, worldline as u32, &meshes))
            .collect();
        let order: IndexSet<usize> = geometry
            .instances
            .iter()
            .map(|i| i.worldline as usize)
            .collect();
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
        self.crowds.get(worldline)?.as_ref()?.nearest(ray, reach)
    }

    /// [`Stage::nearest`] by trying every triangle of every instance, with the same arithmetic but no
    /// tree and no bound that a ray could miss: the same to the bit, only slowly. What the trees are
    /// tested against.
    pub fn nearest_of_all(&self, worldline: usize, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        self.crowds
            .get(worldline)?
            .as_ref()?
            .nearest_of_all(ray, reach)
    }

    /// Whether any body of `worldline` stands on the ray nearer than `reach`.
    #[inline]
    pub fn blocks(&self, worldline: usize, ray: &RestRay, reach: f64) -> bool {
        self.crowds
            .get(worldline)
            .and_then(Option::as_ref)
            .is_some_and(|crowd| crowd.blocks(ray, reach))
    }
}

fn mesh_trees(geometry: &Geometry, earlier: Option<&Stage>) -> Vec<Arc<MeshTree>> {
    let known: Vec<&Arc<MeshTree>> = earlier
        .into_iter()
        .flat_map(|stage| stage.crowds.iter().flatten())
        .flat_map(|crowd| crowd.meshes.iter())
        .collect();
    let tree = |mesh: &Arc<Mesh>| match known.iter().find(|tree| Arc::ptr_eq(&tree.mesh, mesh)) {
        Some(tree) => Arc::clone(tree),
        None => Arc::new(MeshTree::build(mesh)),
    };
    geometry.meshes.iter().map(tree).collect()
}

/// The bodies of one worldline.
struct Crowd {
    ball: Ball,
    tree: Bvh,
    members: Vec<Member>,
    /// Every mesh of the geometry, for a later stage to take over.
    meshes: Vec<Arc<MeshTree>>,
}

/// One instance, its mesh scaled into the unit ball.
pub(super) struct Member {
    pub(super) mesh: u32,
    pub(super) instance: u32,
    /// Linear part of the map from the rest frame to the mesh's unit ball.
    pub(super) unit_from_rest: DMat3,
    /// Center of the mesh's ball in the rest frame.
    pub(super) center: DVec3,
    /// How near, in units of the ball, a ray that starts on a surface may be to it.
    pub(super) starting_point: f64,
    /// Whether triangles are passed through from behind. Front and back are those of the mesh
    /// itself, also in a mirrored instance (glTF 2.0 §3.7.4).
    pub(super) single_sided: bool,
}

impl Crowd {
    fn build(geometry: &Geometry, worldline: u32, meshes: &[Arc<MeshTree>]) -> Option<Self> {
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
            tree,
            members,
            meshes: meshes.to_vec(),
        })
    }

    fn nearest(&self, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        let (way, ray) = self.nearby(ray)?;
        let hit = self.nearest_from(&ray, reach - way)?;
        Some(BodyHit {
            t: way + hit.t,
            ..hit
        })
    }

    #[inline(always)]
    fn nearest_from(&self, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        let (start, unit_ray) = self.entering(ray, reach)?;
        let mut best: Option<BodyHit> = None;
        self.tree.nearest(&unit_ray, |place| {
            let member = &self.members[place];
            let mesh = &self.meshes[member.mesh as usize];
            let limit = best.map_or(reach, |hit| hit.t);
            match mesh.nearest(member, ray, limit, best) {
                Some(hit) => {
                    best = Some(hit);
                    (hit.t - start) / self.ball.radius
                }
                None => f64::INFINITY,
            }
        });
        best
    }

    fn nearest_of_all(&self, ray: &RestRay, reach: f64) -> Option<BodyHit> {
        let (way, ray) = self.nearby(ray)?;
        let hit = self.members.iter().fold(None, |best, member| {
            let mesh = &self.meshes[member.mesh as usize];
            mesh.nearest_of_all(member, &ray, reach - way, best)
                .or(best)
        })?;
        Some(BodyHit {
            t: way + hit.t,
            ..hit
        })
    }

    fn blocks(&self, ray: &RestRay, reach: f64) -> bool {
        self.nearby(ray).is_some_and(|(way, ray)| {
            let reach = reach - way;
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
    fn nearby(&self, ray: &RestRay) -> Option<(f64, RestRay)> {
        let Ball { center, radius } = self.ball;
        let from_center = ray.origin - center;
        if is_near(from_center, ray.direction, radius) {
            return Some((0.0, *ray));
        }
        let (way, from_center) = brought_near(from_center, ray.direction, radius)?;
        let origin = center + from_center;
        Some((way, RestRay { origin, ..*ray }))
    }

    /// The ray in unit-ball coordinates from where it comes near the ball, and how far that is.
    fn entering(&self, ray: &RestRay, reach: f64) -> Option<(f64, TreeRay)> {
        let Ball { center, radius } = self.ball;
        let from_center = ray.origin - center;
        let start = near_side(from_center, ray.direction, 1.0, radius)?;
        (start < reach).then(|| {
            let tree_ray = TreeRay {
                origin: (from_center + ray.direction * start) / radius,
                direction: ray.direction,
                reach: (reach - start) / radius,
            };
            (start, tree_ray)
        })
    }
}

impl Member {
    fn new(index: u32, instance: &Instance, mesh: &MeshTree) -> Self {
        let unit_from_rest = (instance.rest_from_mesh.matrix3 * mesh.ball.radius).inverse();
        let center = instance.rest_from_mesh.transform_point3(mesh.ball.center);
        Self {
            mesh: instance.mesh,
            instance: index,
            unit_from_rest,
            center,
            starting_point: starting_point(unit_from_rest, center),
            single_sided: !instance.double_sided,
        }
    }
}

impl BodyHit {
    /// Nearest first; at the same place the body and the triangle that stand first in the
    /// geometry, so that the picture does not depend on the order of traversal.
    pub(super) fn precedes(&self, other: &Self) -> bool {
        (self.t, self.instance, self.triangle) < (other.t, other.instance, other.triangle)
    }
}
