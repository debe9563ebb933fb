//! What tests of several subjects set up.

pub(crate) mod desk;

/// The square |x|, |y| ≤ 1 at z = 0 that faces +z, as an OBJ file.
pub(crate) const WALL: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
