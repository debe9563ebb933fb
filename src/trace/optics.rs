//! Ideal mirrors and glass, in the rest frame of their surface.

use glam::DVec3;

/// The direction of a ray of unit direction `d` reflected by a plane of unit normal `n`.
pub(super) fn reflected(d: DVec3, n: DVec3) -> DVec3 {
    (d - n * (2.0 * d.dot(n))).normalize_or(n)
}

/// What a boundary between two media does with a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Boundary {
    /// Nothing passes: total reflection.
    Total,
    /// Some of it passes.
    Passing {
        /// Unit direction beyond.
        direction: DVec3,
        /// Share of unpolarised light that is reflected, from 0 to 1.
        reflected: f64,
    },
}

/// A ray of unit direction `d` at a boundary of unit normal `n` against it (d·n < 0); `ratio` is
/// the index of refraction on the ray's side over the one beyond.
///
/// Snell's law and Fresnel's equations for light without polarisation (Born & Wolf 1999 §1.5.2,
/// eqs. 20 and 21a). The sine comes from the cross product, so grazing light keeps its digits.
pub(super) fn boundary(d: DVec3, n: DVec3, ratio: f64) -> Boundary {
    let cos_here = -d.dot(n);
    let sin_beyond = ratio * d.cross(n).length();
    if sin_beyond >= 1.0 {
        return Boundary::Total;
    }
    let cos_beyond = ((1.0 - sin_beyond) * (1.0 + sin_beyond)).sqrt();
    let across = (ratio * cos_here - cos_beyond) / (ratio * cos_here + cos_beyond);
    let along = (cos_here - ratio * cos_beyond) / (cos_here + ratio * cos_beyond);
    Boundary::Passing {
        direction: (d * ratio + n * (ratio * cos_here - cos_beyond)).normalize_or(d),
        reflected: (0.5 * (across * across + along * along)).clamp(0.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(degrees: f64) -> DVec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        DVec3::new(sin, 0.0, -cos)
    }

    fn passing(d: DVec3, ratio: f64) -> (DVec3, f64) {
        match boundary(d, DVec3::Z, ratio) {
            Boundary::Passing {
                direction,
                reflected,
            } => (direction, reflected),
            Boundary::Total => (DVec3::NAN, 1.0),
        }
    }

    #[test]
    fn glass_reflects_four_per_cent_head_on_and_everything_at_grazing_incidence() {
        let (straight, share) = passing(at(0.0), 1.0 / 1.5);
        assert!((share - 0.04).abs() < 1e-15);
        assert_eq!(straight, DVec3::NEG_Z);
        assert!(passing(at(90.0 - 1e-9), 1.0 / 1.5).1 > 1.0 - 1e-9);
    }

    #[test]
    fn at_brewsters_angle_half_of_the_across_part_alone_is_reflected() {
        // tan θ = 1.5; there the reflected share is ((n²−1)/(n²+1))²/2.
        let (_, share) = passing(at(1.5_f64.atan().to_degrees()), 1.0 / 1.5);
        assert!((share - (1.25_f64 / 3.25).powi(2) / 2.0).abs() < 1e-15);
    }

    #[test]
    fn from_within_glass_reflection_is_total_beyond_the_critical_angle() {
        let critical = (1.0 / 1.5_f64).asin();
        for (off, total) in [(-1e-12, false), (1e-12, true)] {
            let d = DVec3::new((critical + off).sin(), 0.0, -(critical + off).cos());
            assert_eq!(boundary(d, DVec3::Z, 1.5) == Boundary::Total, total);
        }
    }

    proptest! {
        /// Snell's law, and the way back: the same angle and the same share.
        #[test]
        fn a_refracted_ray_turns_back_into_its_own(degrees in 0.0..89.9_f64, index in 1.0..4.0_f64) {
            let d = at(degrees);
            let (beyond, share) = passing(d, 1.0 / index);
            prop_assert!((beyond.x * index - d.x).abs() < 1e-14);
            let (again, share_back) = passing(beyond, index);
            prop_assert!((again - d).length() < 1e-11, "{again} {d}");
            prop_assert!((share - share_back).abs() < 1e-11);
        }

        #[test]
        fn a_mirror_keeps_the_angle(degrees in 0.0..90.0_f64) {
            let d = at(degrees);
            prop_assert!((reflected(d, DVec3::Z) - DVec3::new(d.x, 0.0, -d.z)).length() < 1e-15);
        }
    }
}
