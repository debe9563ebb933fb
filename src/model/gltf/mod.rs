//! glTF 2.0, as JSON with side files or as one glb.
//!
//! The container, the JSON's extensions, the buffers and every accessor are checked here, since the
//! `gltf` crate loses files for one unknown channel, shows one of many instances and panics at
//! indices out of range; its types give what is read of the JSON its shape. Node transforms and
//! lamps are read from the JSON in f64, which the crate would round to f32.

mod accessor;
mod buffers;
mod container;
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
