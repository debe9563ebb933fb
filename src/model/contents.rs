//! What a model file holds, as plain values.

use super::Warning;
use ::glam::{DAffine3, DVec3, Vec3};

/// What a model file holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// Meshes, each in its own coordinates.
    pub meshes: Vec<Mesh>,
    /// Where the meshes stand: every instance of every mesh.
    pub placements: Vec<Placement>,
    /// Materials that meshes refer to by index.
    pub materials: Vec<ModelMaterial>,
    /// Lamps.
    pub lamps: Vec<Lamp>,
    /// What of the file the picture will not show.
    pub warnings: Vec<Warning>,
}

/// Triangles of one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Corners, metres. Finite, and each used by a triangle.
    pub positions: Vec<DVec3>,
    /// One unit normal a position, or `None`: the triangles are flat.
    pub normals: Option<Vec<Vec3>>,
    /// Indices into `positions`, counter-clockwise seen from outside. None is of zero area.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`Model::materials`].
    pub material: Option<usize>,
}

/// One instance of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Index into [`Model::meshes`].
    pub mesh: usize,
    /// The model's space from the mesh's. Invertible; mirrors where its determinant is negative.
    pub world: DAffine3,
    /// Name of the glTF node, or of the OBJ object or group.
    pub node: String,
}

/// A surface as the file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelMaterial {
    /// Name in the file.
    pub name: String,
    /// Linear RGB reflectance, 0 to 1.
    pub base_color: [f64; 3],
    /// Linear RGB of the light it gives off, factor × strength, in units of `emissive_unit`.
    pub emissive: [f64; 3],
    /// Luminance of an emissive white of 1, cd/m²: 683 in files by Blender, else 1.
    pub emissive_unit: f64,
    /// Whether the back is seen as well as the front.
    pub double_sided: bool,
}

/// Lumens in a watt as Blender's exporters count them for lamps, whatever the light. Emission they
/// leave in watts, which are worth as much, so that one exposure serves both.
pub(crate) const LUMENS_PER_WATT: f64 = 683.0;

/// A lamp, which looks along the negative z axis of its own coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamp {
    /// Name in the file: the node's.
    pub name: String,
    /// Its kind.
    pub kind: LampKind,
    /// As in the file: cd for point and spot, lx for sun, unless it was written in other units.
    pub intensity: f64,
    /// Linear RGB.
    pub color: [f64; 3],
    /// The model's space from the lamp's: a rotation and a translation, never a scale.
    pub world: DAffine3,
}

/// How a lamp shines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LampKind {
    /// From a point, alike in all directions.
    Point,
    /// From infinitely far, along one direction.
    Sun,
    /// From a point into a cone.
    Spot {
        /// Half angle up to which it shines in full, radians.
        inner: f64,
        /// Half angle beyond which it is dark, radians. At least `inner`, and may equal it.
        outer: f64,
    },
}
