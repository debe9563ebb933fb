//! Triangulation of a polygon with any number of corners, including concave ones.
//!
//! A quad is cut from its first to its third corner, or the other way if that would turn a triangle
//! over. One that is not planar may be cut the other way by another program: the file does not
//! define it. More corners are cut by ear clipping in the plane of Newell's normal (Sutherland,
//! Sproull & Schumacker 1974, p. 21), so that the result depends on the corners alone and has the
//! polygon's winding.

use ::glam::{DVec2, DVec3};
use earcut::Earcut;

/// Number of corners that a face may have. More would be an error, and would take the triangulator
/// minutes.
pub(super) const MAX_CORNERS: usize = 1 << 20;

/// A triangle without area, the result for a face that has none.
const NOTHING: [usize; 3] = [0, 0, 0];

/// A triangulator whose memory is reused from face to face.
#[derive(Default)]
pub(super) struct Triangulator {
    ears: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    cut: Vec<u32>,
}

impl Triangulator {
    /// Calls `each` with the corners of every triangle of the polygon.
    pub(super) fn cut(&mut self, corners: &[DVec3], mut each: impl FnMut([usize; 3])) {
        match *corners {
            [] | [_] | [_, _] => {}
            [_, _, _] => each([0, 1, 2]),
            [a, b, c, d] => {
                let first = (b - a).cross(c - a);
                let second = (c - a).cross(d - a);
                if first.dot(second) < 0.0 {
                    each([0, 1, 3]);
                    each([1, 2, 3]);
                } else {
                    each([0, 1, 2]);
                    each([0, 2, 3]);
                }
            }
            _ => self.clip(corners, each),
        }
    }

    fn clip(&mut self, corners: &[DVec3], mut each: impl FnMut([usize; 3])) {
        let Some(normal) = newell(corners).try_normalize() else {
            return each(NOTHING);
        };
        let x = normal.any_orthonormal_vector();
        let y = normal.cross(x);
        let origin = corners[0];
        self.flat.clear();
        self.flat.extend(
            corners
                .iter()
                .map(|p| [(p - origin).dot(x), (p - origin).dot(y)]),
        );
        if !self.flat.iter().flatten().all(|v| v.is_finite()) {
            return each(NOTHING);
        }
        self.ears.earcut_slice(&self.flat, &[], &mut self.cut);
        if self.cut.is_empty() {
            each(NOTHING);
        }
        for triangle in self.cut.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(|i| i as usize);
            let point = |i: usize| DVec2::from(self.flat[i]);
            let is_turned = (point(b) - point(a)).perp_dot(point(c) - point(a)) < 0.0;
            each(if is_turned { [a, c, b] } else { [a, b, c] });
        }
    }
}

/// Twice the polygon's area times its normal, about the first corner so that distance from the
/// origin costs no digits.
fn newell(corners: &[DVec3]) -> DVec3 {
    let origin = corners[0];
    corners
        .windows(2)
        .map(|pair| (pair[0] - origin).cross(pair[1] - origin))
        .sum()
}
