//! Projections: the direction in which an image point is seen, in camera space (x right, y up, z
//! back).
//!
//! Image points are in fractions of the image, from 0 at the left and top to 1; slightly outside of
//! it, where the pixel's filter reaches, the same formulas hold. Angles are in radians. The
//! equirectangular and the equidistant projection are those of Snyder, Map Projections: A Working
//! Manual (1987), pp. 90 and 191.

use crate::frame::Frame;
use crate::shot;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Horizontal field of view if the shot gives none, degrees.
const PERSPECTIVE_DEG: f64 = 90.0;
/// Angle across the shorter side if the shot gives none, degrees.
const FISHEYE_DEG: f64 = 180.0;

/// Map from image points to directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Straight lines stay straight.
    Perspective {
        /// Tangents of half the horizontal and vertical field of view.
        tan_half: [f64; 2],
    },
    /// Columns of equal yaw, rows of equal pitch.
    Equirectangular {
        /// Half the horizontal and vertical field of view, at most π and π/2.
        half: [f64; 2],
    },
    /// The angle from the axis is proportional to the distance from the image's center.
    Fisheye {
        /// That angle in the middle of the right and of the upper edge.
        edge: [f64; 2],
        /// Angle at which the circle ends, at most π; nothing is seen beyond.
        half: f64,
    },
}

impl Projection {
    /// The projection of a frame's camera.
    pub(super) fn new(frame: &Frame<'_>) -> Self {
        let camera = &frame.camera;
        let given = [camera.hfov_deg, camera.vfov_deg].map(|angle| angle.map(f64::to_radians));
        let size = frame.image.size.map(f64::from);
        match camera.projection {
            shot::Projection::Perspective => perspective(given, size),
            shot::Projection::Equirectangular => equirectangular(given, size),
            shot::Projection::Fisheye => fisheye(given, size),
        }
    }

    /// A vector, of any length above 0, in the direction in which `point` is seen; None where
    /// nothing is seen.
    #[inline(always)]
    pub(super) fn towards(&self, point: [f64; 2]) -> Option<DVec3> {
        // Measured from the center; 1 at the right and upper edge.
        let (right, up) = (2.0 * point[0] - 1.0, 1.0 - 2.0 * point[1]);
        match self {
            Self::Perspective { tan_half } => {
                Some(DVec3::new(right * tan_half[0], up * tan_half[1], -1.0))
            }
            Self::Equirectangular { half } => Some(by_yaw_and_pitch(right * half[0], up * half[1])),
            Self::Fisheye { edge, half } => off_axis(right * edge[0], up * edge[1], *half),
        }
    }

    /// The image point at which something in the direction of a vector is seen: the inverse of
    /// [`Projection::towards`], also outside of the image. None if there is none, as behind a
    /// perspective camera. Across the seam of a panorama, the point nearer to `near`.
    pub(super) fn point_of(&self, vector: DVec3, near: [f64; 2]) -> Option<[f64; 2]> {
        let DVec3 { x, y, z } = vector;
        let [right, up] = match self {
            Self::Perspective { tan_half } => {
                (z < 0.0).then(|| [x / -z / tan_half[0], y / -z / tan_half[1]])?
            }
            Self::Equirectangular { half } => {
                let (yaw, pitch) = (x.atan2(-z), y.atan2(x.hypot(z)));
                let turns = (((2.0 * near[0] - 1.0) * half[0] - yaw) / TAU).round();
                [(yaw + turns * TAU) / half[0], pitch / half[1]]
            }
            Self::Fisheye { edge, .. } => {
                let off = x.hypot(y);
                let angle = off.atan2(-z);
                let per_off = if off > 0.0 { angle / off } else { 1.0 };
                [x * per_off / edge[0], y * per_off / edge[1]]
            }
        };
        Some([(1.0 + right) / 2.0, (1.0 - up) / 2.0])
    }
}

/// The direction by yaw and pitch. Beyond a pole the cosine is negative, and the row continues on
/// the other side. Not inlined into the loop over rays, which would be slower for perspectives too.
#[inline(never)]
fn by_yaw_and_pitch(yaw: f64, pitch: f64) -> DVec3 {
    let (sin_yaw, cos_yaw) = yaw.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    DVec3::new(cos_pitch * sin_yaw, sin_pitch, -cos_pitch * cos_yaw)
}

/// The direction at the angle |(x, y)| from the axis, up to `half`; not inlined, for the same
/// reason.
#[inline(never)]
fn off_axis(x: f64, y: f64, half: f64) -> Option<DVec3> {
    let angle = x.hypot(y);
    let (sin, cos) = angle.sin_cos();
    let per_angle = if angle > 0.0 { sin / angle } else { 1.0 };
    (angle <= half).then(|| DVec3::new(x * per_angle, y * per_angle, -cos))
}

/// The projection from the given angles, across an image of `size` pixels.
fn perspective(given: [Option<f64>; 2], [width, height]: [f64; 2]) -> Projection {
    let tan = |angle: f64| (angle / 2.0).tan();
    let tan_half = match given {
        [None, Some(vfov)] => [tan(vfov) * width / height, tan(vfov)],
        [hfov, _] => {
            let horizontal = tan(hfov.unwrap_or(PERSPECTIVE_DEG.to_radians()));
            [horizontal, horizontal * height / width]
        }
    };
    Projection::Perspective { tan_half }
}

/// As [`perspective`]. No side spans more than the sphere.
fn equirectangular(given: [Option<f64>; 2], [width, height]: [f64; 2]) -> Projection {
    let [across, down] = match given {
        [None, None] => [TAU, PI],
        [None, Some(vfov)] => [(vfov * width / height).min(TAU), vfov],
        [Some(hfov), _] => [hfov, (hfov * height / width).min(PI)],
    };
    Projection::Equirectangular {
        half: [across / 2.0, down / 2.0],
    }
}

/// As [`perspective`].
fn fisheye(given: [Option<f64>; 2], [width, height]: [f64; 2]) -> Projection {
    let (field, diameter) = match given {
        [None, None] => (FISHEYE_DEG.to_radians(), width.min(height)),
        [None, Some(vfov)] => (vfov, height),
        [Some(hfov), _] => (hfov, width),
    };
    let half = field / 2.0;
    Projection::Fisheye {
        edge: [half * (width / diameter), half * (height / diameter)],
        half,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: [f64; 2] = [1280.0, 720.0];

    fn seen(projection: Projection, point: [f64; 2]) -> DVec3 {
        let towards = projection.towards(point).unwrap();
        assert!((towards.length() - 1.0).abs() < 4e-16, "{towards}");
        towards
    }

    fn near(found: DVec3, expected: DVec3) {
        assert!((found - expected).length() < 1e-15, "{found} {expected}");
    }

    #[test]
    fn a_panorama_holds_the_whole_sphere_whatever_its_shape() {
        for size in [WIDE, [10.0, 700.0]] {
            let sphere = equirectangular([None, None], size);
            near(seen(sphere, [0.5, 0.5]), DVec3::NEG_Z);
            near(seen(sphere, [0.75, 0.5]), DVec3::X);
            near(seen(sphere, [0.25, 0.5]), DVec3::NEG_X);
            // The seam is behind the camera, at both edges.
            near(seen(sphere, [0.0, 0.5]), DVec3::Z);
            near(seen(sphere, [1.0, 0.5]), DVec3::Z);
            // All of the uppermost row's edge is one pole.
            for x in [0.0, 0.1, 0.5, 1.0] {
                near(seen(sphere, [x, 0.0]), DVec3::Y);
                near(seen(sphere, [x, 1.0]), DVec3::NEG_Y);
            }
            let diagonal = DVec3::new(0.5, 0.5_f64.sqrt(), -0.5);
            near(seen(sphere, [0.625, 0.25]), diagonal);
        }
    }

    #[test]
    fn beyond_a_pole_or_the_seam_a_panorama_goes_on_upon_the_other_side() {
        let sphere = equirectangular([None, None], WIDE);
        near(seen(sphere, [0.25, -0.01]), seen(sphere, [0.75, 0.01]));
        near(seen(sphere, [0.6, 1.02]), seen(sphere, [0.1, 0.98]));
        near(seen(sphere, [1.03, 0.4]), seen(sphere, [0.03, 0.4]));
    }

    #[test]
    fn a_panorama_of_one_given_angle_has_square_pixels_up_to_the_sphere() {
        let half = |given: [Option<f64>; 2], size| match equirectangular(given, size) {
            Projection::Equirectangular { half } => half.map(f64::to_degrees),
            other => panic!("{other:?}"),
        };
        let close = |found: [f64; 2], expected: [f64; 2]| {
            assert!(
                (0..2).all(|i| (found[i] - expected[i]).abs() < 1e-13),
                "{found:?}"
            );
        };
        let degrees = |angle: f64| Some(angle.to_radians());
        close(half([degrees(160.0), None], WIDE), [80.0, 45.0]);
        close(half([None, degrees(90.0)], WIDE), [80.0, 45.0]);
        close(half([degrees(360.0), None], WIDE), [180.0, 90.0]);
        close(half([None, degrees(180.0)], [300.0, 100.0]), [180.0, 90.0]);
    }

    #[test]
    fn a_fisheye_of_half_the_sphere_spans_the_shorter_side() {
        let dome = fisheye([None, None], [200.0, 100.0]);
        near(seen(dome, [0.5, 0.5]), DVec3::NEG_Z);
        near(seen(dome, [0.75, 0.5]), DVec3::X);
        near(seen(dome, [0.5, 0.0]), DVec3::Y);
        near(seen(dome, [0.5, 1.0]), DVec3::NEG_Y);
        // Half way out in the picture is half the angle, in every direction.
        let eighth = 0.25 * 0.5_f64.sqrt();
        near(
            seen(dome, [0.5 - eighth / 2.0, 0.5 - eighth]),
            DVec3::new(-0.5, 0.5, -0.5_f64.sqrt()),
        );
        for outside in [
            [0.7501, 0.5],
            [0.5, -0.0001],
            [0.7, 0.1],
            [0.0, 0.0],
            [1.0, 1.0],
        ] {
            assert_eq!(dome.towards(outside), None, "{outside:?}");
        }
    }

    #[test]
    fn a_given_angle_of_a_fisheye_spans_its_own_side() {
        let size = [200.0, 100.0];
        let across = fisheye([Some(PI), None], size);
        near(seen(across, [1.0, 0.5]), DVec3::X);
        near(
            seen(across, [0.5, 0.0]),
            DVec3::new(0.0, 0.5_f64.sqrt(), -0.5_f64.sqrt()),
        );
        assert_eq!(across.towards([0.0, 0.0]), None);
        // A full turn: what lies behind the camera is the circle itself.
        let down = fisheye([None, Some(TAU)], size);
        for edge in [[0.5, 0.0], [0.5, 1.0], [0.25, 0.5], [0.75, 0.5]] {
            near(seen(down, edge), DVec3::Z);
        }
        near(seen(down, [0.625, 0.5]), DVec3::X);
    }

    #[test]
    fn next_to_the_centre_a_fisheye_looks_along_the_axis() {
        let dome = fisheye([Some(1e-300), None], WIDE);
        for x in [0.5, 0.5 + 1e-16, 0.500001, 1.0] {
            near(seen(dome, [x, 0.5]), DVec3::NEG_Z);
        }
    }
    #[test]
    fn every_projection_shows_what_it_sees_where_it_saw_it() {
        let round = |projection: Projection, point: [f64; 2]| {
            let Some(seen) = projection.towards(point) else {
                return;
            };
            // Of any length.
            let found = projection.point_of(seen * 7.0, point).unwrap();
            let off = (found[0] - point[0]).hypot(found[1] - point[1]);
            // At the rim of a full turn and at the poles the inverse is that ill-conditioned.
            assert!(off < 1e-12, "{projection:?} {point:?} {found:?}");
        };
        let degrees = |angle: f64| Some(angle.to_radians());
        for size in [WIDE, [10.0, 700.0]] {
            for projection in [
                perspective([None, None], size),
                perspective([degrees(170.0), None], size),
                perspective([None, degrees(1e-3)], size),
                equirectangular([None, None], size),
                equirectangular([None, degrees(40.0)], size),
                fisheye([None, None], size),
                fisheye([degrees(360.0), None], size),
                fisheye([None, degrees(30.0)], size),
            ] {
                for i in 0..=40 {
                    for j in 0..=40 {
                        let at = |i: i32| (f64::from(i) + 0.5) / 41.0;
                        round(projection, [at(i), at(j)]);
                    }
                }
                round(projection, [0.5, 0.5]);
            }
        }
    }

    #[test]
    fn across_the_seam_of_a_panorama_the_nearer_point_is_meant() {
        let sphere = equirectangular([None, None], WIDE);
        let behind = sphere.towards([0.999, 0.4]).unwrap();
        for (near, expected) in [(0.9, 0.999), (0.001, -0.001)] {
            let [x, y] = sphere.point_of(behind, [near, 0.4]).unwrap();
            assert!((x - expected).abs() < 1e-14 && (y - 0.4).abs() < 1e-14);
        }
    }

    #[test]
    fn nothing_behind_a_perspective_has_a_point() {
        let view = perspective([None, None], WIDE);
        for vector in [DVec3::Z, DVec3::X, DVec3::new(1.0, 2.0, 0.1), DVec3::NAN] {
            assert_eq!(view.point_of(vector, [0.5; 2]), None, "{vector}");
        }
    }
}
