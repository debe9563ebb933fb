//! The files that a model consists of: which of them may be read, their lines, their JSON.
//!
//! The importers (`model`) and the fingerprints (`frame`), which hash the same files without
//! importing them, both read through this folder, so that they always agree on which files these are.

mod gltf_json;
mod libraries;
mod model_files;
mod obj_lines;

pub use gltf_json::{GltfJson, TextFault};
pub use libraries::Library;
pub use model_files::{FileError, MODEL_BYTES, ModelFile, ModelFiles};
pub use obj_lines::{OBJ_KEYWORDS, before_comment, each_obj_line, keyword_and_rest};
