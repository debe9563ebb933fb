//! The bounding volume hierarchy: the only place that knows which library builds and walks it.
//!
//! Boxes live in coordinates in which the whole tree fits the unit ball, and are widened by
//! [`MARGIN`], so that the f32 box test never misses what the f64 primitive test would hit:
//! a ray that starts within 3 units carries at most 3·3 ulp (5e-7) of rounding in each slab's
//! parameter, another 5e-7 from the slab it is compared with, and 2e-7 from its own rounded
//! origin and direction. A primitive test in f32 is itself off by as much: there a hit on the rim of
//! a body may be missed, which is within f32's own error.

use super::real::Real;
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::{Ray, RayHit};
use std::time::Duration;

/// How far boxes are widened, in units of the tree's radius.
pub(super) const MARGIN: f32 = 2e-6;

/// A ray as the tree sees it: in unit-ball coordinates, direction of length 1.
pub(super) struct TreeRay<R: Real> {
    pub(super) origin: R::Vector,
    pub(super) direction: R::Vector,
    /// Nothing beyond is of interest; infinite is fine.
    pub(super) reach: R,
}

/// A tree over boxes that fit the unit ball.
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
    pub(super) fn nearest<R: Real>(&self, ray: &TreeRay<R>, mut test: impl FnMut(usize) -> R) {
        let mut hit = RayHit::none();
        self.tree
            .ray_traverse(rounded(ray), &mut hit, |_, place| above(test(place)));
    }

    /// Whether `test` finds a hit in any primitive whose box the ray meets; stops at the first.
    #[inline(always)]
    pub(super) fn any<R: Real>(
        &self,
        ray: &TreeRay<R>,
        mut test: impl FnMut(usize) -> bool,
    ) -> bool {
        !self.tree.ray_traverse_miss(
            rounded(ray),
            |_, place| if test(place) { -1.0 } else { f32::INFINITY },
        )
    }
}

fn rounded<R: Real>(ray: &TreeRay<R>) -> Ray {
    Ray::new(
        R::to_vec3a(ray.origin),
        R::to_vec3a(ray.direction),
        0.0,
        above(ray.reach),
    )
}

/// An f32 surely above `t`: boxes whose entry rounds to t are still opened, which ties need.
fn above<R: Real>(t: R) -> f32 {
    (t * R::of(1.0 + 1e-6) + R::of(1e-6)).to_f32()
}
