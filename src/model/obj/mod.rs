//! Wavefront OBJ: one mesh for each object or group and material, with polygons cut into triangles.
//!
//! The text is checked line by line and reduced to what is read, so that errors have line numbers
//! and tobj gets nothing that it would misread or panic at (names are replaced by numbers); tobj
//! makes the meshes. Smoothing groups are ignored: without `vn` lines a mesh is flat.

mod library;
mod number;
mod read;
mod scan;

pub(super) use read::read;
