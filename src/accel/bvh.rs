//! The bounding volume hierarchy: the only place that knows which library builds and walks it.
//!
//! Boxes live in coordinates in which the whole tree fits the unit sphere, and are widened by
//! [`MARGIN`], so that the f32 box test never misses what the f64 primitive test would hit:
//! a ray that starts within 3 units carries at most 3·3 ulp (5e-7) of rounding in each slab's
//! parameter, another 5e-7 from the slab it is compared with, and 2e-7 from its own rounded
//! origin and direction.

use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::{Ray, RayHit};
use std::time::Duration;

/// How far boxes are widened, in units of the tree's radius.
pub(super) const MARGIN: f32 = 2e-6;

/// A ray as the tree sees it: in unit-sphere coordinates, direction of length 1.
pub(super) struct TreeRay {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
    /// Nothing beyond is of interest; infinite is fine.
    pub(super) reach: f64,
}

/// A tree over boxes that fit the unit sphere.
pub(super) struct Bvh {
    tree: Bvh2,
}

impl Bvh {
    /// Builds the tree over `boxes` (corner to corner) and says in which order it wants the
    /// primitives: place `i` holds the box of the primitive `order[i]`.
    pub(super) fn build(boxes: impl Iterator<Item = (DVec3, DVec3)>) -> (Self, Vec<u32>) {
        let margin = Vec3A::splat(MARGIN);
        let boxes: Vec<Aabb> = boxes
            .map(|(min, max)| Aabb::new(min.as_vec3a() - margin, max.as_vec3a() + margin))
            .collect();
        let params = BvhBuildParams {
            max_prims_per_leaf: 4,
            ..BvhBuildParams::medium_build()
        };
        let mut took = Duration::ZERO;
        let mut tree = build_bvh2(&boxes, params, &mut took);
        let order = std::mem::take(&mut tree.primitive_indices);
        (Self { tree }, order)
    }

    /// Offers the primitives whose boxes the ray meets. `test` is given a place and answers with
    /// the ray parameter of the hit it now holds to be the nearest, or infinity.
    #[inline(always)]
    pub(super) fn nearest(&self, ray: &TreeRay, mut test: impl FnMut(usize) -> f64) {
        let mut hit = RayHit::none();
        self.tree
            .ray_traverse(rounded(ray), &mut hit, |_, place| above(test(place)));
    }

    /// Whether `test` finds a hit in any primitive whose box the ray meets; stops at the first.
    #[inline(always)]
    pub(super) fn any(&self, ray: &TreeRay, mut test: impl FnMut(usize) -> bool) -> bool {
        !self.tree.ray_traverse_miss(
            rounded(ray),
            |_, place| if test(place) { -1.0 } else { f32::INFINITY },
        )
    }
}

fn rounded(ray: &TreeRay) -> Ray {
    Ray::new(
        ray.origin.as_vec3a(),
        ray.direction.as_vec3a(),
        0.0,
        above(ray.reach),
    )
}

/// An f32 surely above `t`: boxes whose entry rounds to t are still opened, which ties need.
fn above(t: f64) -> f32 {
    (t * (1.0 + 1e-6) + 1e-6) as f32
}
