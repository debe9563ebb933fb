//! Bounding balls: where a ray comes near one, before f32 takes over.

use glam::DVec3;

/// A ball around a tree's content. Its radius is a power of two, so scaling by it is exact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

impl Ball {
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
        Self { center, radius }
    }
}

/// How far along a ray (from the centre of a ball, direction of squared length `d2`) it is on the
/// near side of the ball; 0 inside or past that; None where the ray misses the ball.
#[inline(always)]
pub(super) fn near_side(from_center: DVec3, direction: DVec3, d2: f64, radius: f64) -> Option<f64> {
    let closest = -from_center.dot(direction) / d2;
    // From afar, the rounding of `closest` counts beside the radius.
    let span = radius * 1.0001 + 4.0 * f64::EPSILON * closest.abs() * d2.sqrt();
    // Behind and outside, or passing by: the closest point of the ray is outside the ball.
    let passing = from_center + direction * closest.max(0.0);
    if passing.length_squared() > span * span {
        return None;
    }
    Some((closest - span / d2.sqrt()).max(0.0))
}
