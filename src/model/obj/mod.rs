//! Wavefront OBJ: one mesh for each object or group and material, polygons cut into triangles.
//!
//! The text is checked line by line and reduced to what is read, so that mistakes carry their line
//! and tobj meets nothing that it would misread or panic at (names are numbers to it); tobj makes the meshes. Smoothing
//! groups are not interpreted: without `vn` lines a mesh is flat.

mod library;
mod number;
mod read;
mod scan;

pub(super) use read::read;
