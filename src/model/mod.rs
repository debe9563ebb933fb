//! Model files as plain values: meshes, their placement, materials and lamps.
//!
//! In: a path to an OBJ, glTF or glb file, and the folders from which it may read. Out: a [`Model`]
//! in which every index is checked and every number finite, or one [`ModelError`] with a remedy.
//! Right-handed, y up, meters, radians; colors are linear RGB triples as in the file, which the
//! scene turns into spectra. Content that the image will not show is a [`Warning`]. No file,
//! however broken, causes a panic here.
//!
//! Out of scope: cameras, animation (the pose is the file's own), skins, morph targets, textures.
//!
//! Source: Khronos glTF 2.0 specification (2021), KHR_lights_punctual, KHR_materials_*,
//! KHR_node_visibility, EXT_mesh_gpu_instancing; Wavefront OBJ and MTL as Blender 4 and 5 write
//! them.

mod contents;
mod error;
mod gltf;
mod load;
mod material;
mod mesh;
mod obj;
mod polygon;
mod warning;

pub(crate) use contents::LUMENS_PER_WATT;
pub use contents::{Lamp, LampKind, Mesh, Model, ModelMaterial, Placement};
pub use error::ModelError;
pub use load::load;
pub use warning::Warning;
