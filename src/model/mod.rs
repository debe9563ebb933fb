//! Model files as plain values: meshes, where they stand, materials and lamps.
//!
//! In: a path to an OBJ, glTF or glb file and the folders it may read from. Out: a [`Model`] in
//! which every index is checked and every number finite, or one [`ModelError`] that says what to
//! mend. Right-handed, y up, metres, radians; colours are linear RGB triples as in the file, which
//! the scene turns into spectra. What a file asks for and the picture will not show is a
//! [`Warning`]. No file, however broken, makes this module panic.
//!
//! Out of scope: cameras, animation (the pose is the file's own), skins, morph targets, textures.
//!
//! Source: Khronos glTF 2.0 specification (2021), KHR_lights_punctual, KHR_materials_*, KHR_node_visibility,
//! EXT_mesh_gpu_instancing; Wavefront OBJ and MTL as Blender 4 and 5 write them.

mod error;
mod gltf;
mod material;
mod measure;
mod mesh;
mod obj;
mod polygon;
mod warning;

use crate::shot::ModelFiles;
use ::glam::{DAffine3, DVec3, Vec3};
use std::path::Path;

pub use error::ModelError;
pub use warning::Warning;

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
pub(super) const LUMENS_PER_WATT: f64 = 683.0;

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

/// Reads a model file: OBJ by its extension, glTF and glb by extension and content.
///
/// A file that the model names (buffers, material libraries) must lie in the model's own folder or
/// one of `may_read`, or below, links resolved; the model file itself may lie anywhere.
///
/// # Errors
/// A file that is missing, broken, empty, too large or in need of something not supported.
pub fn load(path: &Path, may_read: &[&Path]) -> Result<Model, ModelError> {
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_ascii_lowercase();
    if !["obj", "gltf", "glb"].contains(&extension.as_str()) {
        return Err(ModelError::UnknownKind {
            file: path.to_owned(),
        });
    }
    let (mut files, opened) = ModelFiles::open(path, may_read)?;
    let bytes = opened.bytes()?;
    let model = match extension.as_str() {
        "obj" => obj::read(bytes, &mut files),
        _ => gltf::read(&bytes, &mut files),
    }?;
    if model.placements.is_empty() && model.lamps.is_empty() {
        return Err(ModelError::Empty {
            file: path.to_owned(),
        });
    }
    Ok(model)
}
