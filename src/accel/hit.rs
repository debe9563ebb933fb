//! The record of where a ray meets a triangle.

/// What a ray meets first among the bodies of one worldline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Length along the ray, in metres of the rest frame.
    pub t: f64,
    /// Number of the instance, in the order in which instances were given.
    pub instance: u32,
    /// Number of the triangle in its mesh.
    pub triangle: u32,
    /// Barycentric weights of the triangle's vertices.
    pub weights: [f64; 3],
    /// Whether the mesh's front is seen.
    pub front: bool,
}

impl Hit {
    /// Nearest first; at the same place the body and the triangle that were given first, so that
    /// the picture does not depend on the order of traversal.
    pub(super) fn precedes(&self, other: &Self) -> bool {
        (self.t, self.instance, self.triangle) < (other.t, other.instance, other.triangle)
    }

    /// The same hit of a ray that starts earlier by `way` metres.
    #[inline(always)]
    pub(super) fn after(self, way: f64) -> Self {
        Self {
            t: way + self.t,
            ..self
        }
    }
}
