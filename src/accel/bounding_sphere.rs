//! Bounding spheres: where a ray comes near one, before boxes in f32 take over.

use glam::DVec3;

/// A sphere around a tree's content. Its radius is a power of two, so scaling by it is exact.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoundingSphere {
    pub(super) center: DVec3,
    pub(super) radius: f64,
    /// How far the content reaches from the center, over the radius: at most 1. What comes no nearer
    /// meets nothing.
    pub(super) reach: f64,
}

impl BoundingSphere {
    pub(super) fn around(points: impl Iterator<Item = (DVec3, f64)> + Clone) -> Self {
        let (min, max) = points.clone().fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(min, max), (p, r)| (min.min(p - r), max.max(p + r)),
        );
        let center = min / 2.0 + max / 2.0;
        let reach = points
            .map(|(p, r)| (p - center).length() + r)
            .fold(0.0, f64::max);
        let radius = 2f64.powi(reach.clamp(1e-290, 1e290).log2().ceil() as i32);
        let reach = (reach / radius).min(1.0);
        Self {
            center,
            radius,
            reach,
        }
    }
}

/// How far a way is off where it ends, at most, as a part of its length.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Where the rounding of a way is this many radii, f32 would overflow, and nothing is known any more.
const LOST: f64 = 1e30;

/// How far along a ray (from the center of a sphere, direction of squared length `d2`) it is on the
/// near side of the sphere; 0 inside or past that; None where the ray misses the sphere.
#[inline(always)]
pub(super) fn near_side(from_center: DVec3, direction: DVec3, d2: f64, radius: f64) -> Option<f64> {
    let closest = -from_center.dot(direction) / d2;
    // From afar, the rounding of `closest` counts beside the radius.
    let span = radius * 1.0001 + ROUNDINGS * closest.abs() * d2.sqrt();
    // Behind and outside, or passing by: the closest point of the ray is outside the sphere.
    let passing = from_center + direction * closest.max(0.0);
    // What is no number, since it left the range, misses too.
    let meets = passing.dot(passing) <= span * span && span <= LOST * radius;
    meets.then(|| (closest - span / d2.sqrt()).max(0.0))
}

/// What is left of `reach` from `start` on, not less by rounding: a tree must open what lies there.
#[inline(always)]
pub(super) fn left(reach: f64, start: f64) -> f64 {
    (reach - start) + ROUNDINGS * start
}

/// Whether a ray of unit direction comes from so near a sphere that [`near_side`] takes it there: the
/// rounding of its way is within the radius.
#[inline(always)]
pub(super) fn is_near(from_center: DVec3, direction: DVec3, radius: f64) -> bool {
    ROUNDINGS * from_center.dot(direction).abs() <= radius
}

/// A ray of unit direction d from far away: how far it goes until it [`is_near`], and where it is
/// then, from the sphere's center. None where it misses the sphere, or nobody knows.
///
/// A way of length L ends off by ε|d_i|L in each coordinate. Along the ray that does no harm: from
/// where it got to it is another way to the sphere, 10¹⁵ times shorter. Across it, the coordinate i
/// takes part with √(1 − d_i²) of its rounding, and no further step finds back what is lost:
/// ε L |(d_i √(1 − d_i²))|. That vanishes where the ray goes along an axis; there a body coming on at
/// γ = 10⁷⁴ is met as exactly as at 10. Obliquely it is about εL, where a camera at the distance r
/// of a body that comes on has L = 2γr. Where it exceeds the radius, on which side of the sphere the
/// ray passes is left to chance, and then it is said to miss.
#[cold]
pub(super) fn brought_near(
    from_center: DVec3,
    direction: DVec3,
    radius: f64,
) -> Option<(f64, DVec3)> {
    let DVec3 { x, y, z } = direction;
    let across = (direction * DVec3::new(y.hypot(z), z.hypot(x), x.hypot(y))).length();
    let (mut way, mut from_center) = (0.0, from_center);
    while from_center.is_finite() {
        if is_near(from_center, direction, radius) {
            return Some((way, from_center));
        }
        let closest = -from_center.dot(direction);
        // Also where it is behind: the ray starts outside the sphere.
        if closest <= 0.0 || ROUNDINGS * closest * across > radius {
            return None;
        }
        // As near_side does, which would be lost.
        let step = closest - (radius * 1.0001 + ROUNDINGS * closest);
        way += step;
        from_center += direction * step;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a ray towards (0.5, 0, 0) of a unit sphere, from `way` before it, has come near.
    fn come_near(direction: DVec3, way: f64) -> Option<(f64, DVec3)> {
        brought_near(DVec3::new(0.5, 0.0, 0.0) - direction * way, direction, 1.0)
    }

    #[test]
    fn along_an_axis_a_sphere_is_met_from_any_distance() {
        for way in [1e17, 1e25, 1e45, 1e75, 1e150, 1e290] {
            let (gone, at) = come_near(DVec3::NEG_Z, way).unwrap();
            assert!((gone / way - 1.0).abs() < 1e-14, "{way:e}");
            assert_eq!((at.x, at.y), (0.5, 0.0), "{way:e}");
            assert!(is_near(at, DVec3::NEG_Z, 1.0) && at.z > 1.0, "{way:e} {at}");
        }
    }

    #[test]
    fn a_ray_that_is_as_slanted_as_aberration_leaves_it_keeps_its_place() {
        // From (0.25, 0.5) off the axis to (0.5, 0).
        for way in [1e25, 1e75] {
            let slant = DVec3::new(0.25 / way, -0.5 / way, -1.0);
            let (_, at) = brought_near(DVec3::new(0.25, 0.5, way), slant, 1.0).unwrap();
            let passes = at + slant * at.z;
            assert!(
                (passes - DVec3::new(0.5, 0.0, 0.0)).length() < 1e-14,
                "{at}"
            );
        }
    }

    #[test]
    fn obliquely_a_sphere_is_missed_where_rounding_hides_it() {
        let oblique = DVec3::new(0.48, -0.64, -0.6);
        let (_, at) = come_near(oblique, 1.2e15).unwrap();
        let passes = at - oblique * at.dot(oblique);
        assert!((passes - DVec3::new(0.5, 0.0, 0.0)).length() < 1.5, "{at}");
        for way in [1e17, 1e25, 1e75, 1e290] {
            assert_eq!(come_near(oblique, way), None, "{way:e}");
        }
    }

    #[test]
    fn what_lies_behind_or_is_no_place_is_missed() {
        for way in [-1e17, -1e75, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(come_near(DVec3::NEG_Z, way), None, "{way:e}");
        }
    }

    #[test]
    fn a_speck_too_small_for_its_place_to_be_known_is_missed() {
        let far = DVec3::new(0.0, 0.0, 1e60);
        assert_eq!(near_side(far, DVec3::NEG_Z, 1.0, 1.0), None);
    }
}
