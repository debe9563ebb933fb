//! glTF 2.0, as JSON with side files or as one glb.
//!
//! Container, extensions, buffers and every accessor are checked here, because the `gltf` crate
//! rejects files for one unknown channel, shows only one of many instances, and panics at indices
//! out of range. Its types are used only for the structure of the JSON. Node transforms and lamps
//! are read from the JSON in f64; the crate would round them to f32.

mod accessor;
mod buffers;
mod extensions;
mod flat;
mod json;
mod lamp;
mod material;
mod nodes;
mod primitive;
mod read;
mod source;

pub(super) use read::read;
