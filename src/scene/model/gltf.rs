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

use super::{Model, ModelError, Warning};
use crate::shot::ModelFiles;
use buffers::Buffers;
use gltf_json::{Index, Root};
use indexmap::IndexSet;
use serde_json::Value;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// Accessor elements decoded for one file at most: shared accessors count each time.
const MAX_ELEMENTS: u64 = 1 << 27;

/// A glTF file taken apart, nothing in it checked but its shape.
struct Source<'a> {
    file: PathBuf,
    root: Root,
    /// The same JSON, for what `root` lacks or rounds.
    raw: Value,
    buffers: Buffers<'a>,
    elements_left: Cell<u64>,
}

/// Reads a glTF or glb file.
pub(super) fn read(bytes: &[u8], files: &mut ModelFiles) -> Result<Model, ModelError> {
    let container = container::split(bytes, &files.model)?;
    let mut model = Model::default();
    let (root, raw) = json::parse(container.json, &files.model, &mut model.warnings)?;
    let file = files.model.clone();
    let buffers = Buffers::new(root.buffers.len(), container.binary, files);
    let source = Source {
        file,
        root,
        raw,
        buffers,
        elements_left: Cell::new(MAX_ELEMENTS),
    };
    source.materials(&mut model)?;
    nodes::place(&source, &mut model)?;
    source.warn_of_the_rest(&mut model);
    Ok(model)
}

impl Source<'_> {
    /// An item by its index, or the error that says who asked for it.
    fn item<'a, T>(
        &self,
        list: &'a [T],
        index: Index<T>,
        what: &'static str,
        from: &str,
    ) -> Result<&'a T, ModelError> {
        let index = index.value();
        list.get(index)
            .ok_or_else(|| self.dangling(from, what, index, list.len()))
    }

    fn dangling(&self, from: &str, what: &'static str, index: usize, count: usize) -> ModelError {
        let (file, from) = (self.file.clone(), from.to_owned());
        ModelError::Dangling {
            file,
            from,
            what,
            index,
            count,
        }
    }

    fn invalid(&self, at: &str, problem: impl Into<String>) -> ModelError {
        invalid(&self.file, at, problem)
    }

    fn warn_of_the_rest(&self, model: &mut Model) {
        let used: IndexSet<usize> = model
            .meshes
            .iter()
            .filter_map(|mesh| mesh.material)
            .collect();
        for material in used {
            self.warn_of_material(material, model);
        }
        let animations = self.raw["animations"].as_array().map_or(0, Vec::len);
        if animations > 0 {
            model
                .warnings
                .push(Warning::Animations { count: animations });
        }
        let shown = self.shown_scene();
        let scenes = self.root.scenes.iter().enumerate();
        let others = scenes.filter(|(i, scene)| Some(*i) != shown && !scene.nodes.is_empty());
        let count = others.count();
        if count > 0 {
            model.warnings.push(Warning::OtherScenes { count });
        }
    }
}

fn invalid(file: &Path, at: &str, problem: impl Into<String>) -> ModelError {
    ModelError::Invalid {
        file: file.to_owned(),
        at: at.to_owned(),
        problem: problem.into(),
    }
}

/// An item's name as messages give it: its own, or its kind and index.
fn name_of(name: Option<&str>, kind: &str, index: usize) -> String {
    match name {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => format!("{kind} {index}"),
    }
}
