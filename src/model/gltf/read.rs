//! From the bytes of a glTF or glb file to a [`Model`].

use super::accessor::MAX_ELEMENTS;
use super::buffers::Buffers;
use super::source::{Source, split};
use super::{json, nodes};
use crate::model::{Model, ModelError, Warning};
use crate::shot::ModelFiles;
use indexmap::IndexSet;
use std::cell::Cell;

/// Reads a glTF or glb file.
pub(in crate::model) fn read(bytes: &[u8], files: &mut ModelFiles) -> Result<Model, ModelError> {
    let container = split(bytes, &files.model)?;
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
