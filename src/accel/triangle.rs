//! Watertight ray–triangle intersection.
//!
//! After Woop, Benthin & Wald 2013: the triangle is sheared along the ray into a plane, where
//! each vertex becomes one point whichever triangle it belongs to, and the signs of three edge
//! functions decide. Triangles that share an edge compute its function from the same numbers,
//! with opposite signs; where rounding could turn a sign the function is computed again with one
//! final rounding. So no ray slips between two triangles of a closed mesh.

use crate::relativity::difference_of_products;

/// A ray prepared for many triangles, in the coordinates of their vertices.
pub(super) struct ShearedRay {
    origin: [f64; 3],
    axes: [usize; 3],
    shear: [f64; 3],
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// In multiples of the ray's direction vector.
    pub(super) t: f64,
    /// Barycentric weights of the three vertices; they sum to 1.
    pub(super) weights: [f64; 3],
    /// Whether the triangle's vertices run anticlockwise as the ray sees them.
    pub(super) front: bool,
}

impl ShearedRay {
    /// A ray of non-zero direction (any length).
    pub(super) fn new(origin: [f64; 3], direction: [f64; 3]) -> Self {
        let size = direction.map(f64::abs);
        let z = if size[0] > size[1] {
            if size[0] > size[2] { 0 } else { 2 }
        } else if size[1] > size[2] {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y); // keeps the winding
        }
        let inverse = 1.0 / direction[z];
        Self {
            origin,
            axes: [x, y, z],
            shear: [direction[x] * inverse, direction[y] * inverse, inverse],
        }
    }

    /// The crossing with a triangle, from in front or behind. A ray in the triangle's plane
    /// misses it.
    #[inline(always)]
    pub(super) fn crossing(&self, triangle: &[[f64; 3]; 3]) -> Option<Crossing> {
        let [a, b, c] = [
            self.seen(&triangle[0]),
            self.seen(&triangle[1]),
            self.seen(&triangle[2]),
        ];
        let edges = [edge(c, b), edge(a, c), edge(b, a)];
        if edges.iter().any(|&e| e < 0.0) && edges.iter().any(|&e| e > 0.0) {
            return None;
        }
        let area = edges[0] + edges[1] + edges[2];
        if area == 0.0 {
            return None;
        }
        let scale = 1.0 / area;
        let weights = edges.map(|e| e * scale);
        let depth = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
        Some(Crossing {
            t: depth * self.shear[2],
            weights,
            front: area > 0.0,
        })
    }

    /// A vertex relative to the ray: across it in two coordinates, along it in the third.
    #[inline(always)]
    fn seen(&self, vertex: &[f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes;
        let depth = vertex[z] - self.origin[z];
        [
            vertex[x] - self.origin[x] - self.shear[0] * depth,
            vertex[y] - self.origin[y] - self.shear[1] * depth,
            depth,
        ]
    }
}

/// Twice the signed area of (0, p, q) in the sheared plane, its sign exact.
#[inline(always)]
fn edge(p: [f64; 3], q: [f64; 3]) -> f64 {
    let (left, right) = (p[0] * q[1], p[1] * q[0]);
    let area = left - right;
    if area.abs() <= 4.0 * f64::EPSILON * left.abs().max(right.abs()) {
        return difference_of_products(p[0], q[1], p[1], q[0]);
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn a_ray_down_z_crosses_at_its_weights() {
        let ray = ShearedRay::new([0.25, 0.5, 3.0], [0.0, 0.0, -2.0]);
        let hit = ray.crossing(&TRIANGLE).unwrap();
        assert_eq!(
            (hit.t, hit.weights, hit.front),
            (1.5, [0.25, 0.25, 0.5], true)
        );
    }

    #[test]
    fn the_back_is_crossed_too_and_known_as_the_back() {
        let ray = ShearedRay::new([0.25, 0.5, -3.0], [0.0, 0.0, 1.0]);
        assert!(!ray.crossing(&TRIANGLE).unwrap().front);
    }

    #[test]
    fn a_ray_in_the_plane_misses() {
        let ray = ShearedRay::new([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]);
        assert_eq!(ray.crossing(&TRIANGLE), None);
    }

    #[test]
    fn rays_at_shared_edges_and_corners_of_a_fan_never_slip_through() {
        // Eight triangles around the z axis; every ray aims at the hub or at a point of a spoke.
        let rim: Vec<[f64; 3]> = (0..8)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::FRAC_PI_4 + 0.1;
                [angle.cos(), angle.sin(), 0.3 * (angle * 3.0).sin()]
            })
            .collect();
        for step in 0..4000 {
            let aim = rim[step % 8].map(|x| x * (step as f64 / 4001.0));
            let eye = [0.3 - step as f64 * 1e-5, 0.2, 5.0];
            let ray = ShearedRay::new(eye, [aim[0] - eye[0], aim[1] - eye[1], aim[2] - eye[2]]);
            let hits = (0..8).filter(|&i| {
                ray.crossing(&[[0.0; 3], rim[i], rim[(i + 1) % 8]])
                    .is_some()
            });
            assert!(hits.count() >= 1, "step {step}");
        }
    }
}
