//! Everything a shot reads from other files, read once: model files and measured spectra.

use super::model::{self, Mesh, Model, Warning};
use crate::shot::{Mistake, Mistakes, Shot, SpectrumTable, SpectrumValue};
use crate::spectrum::Sampled;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Longest file of a measured spectrum, bytes.
const LARGEST_TABLE: u64 = 64 << 20;

/// The files of a shot.
#[derive(Debug, Default)]
pub struct Library {
    models: Vec<Arc<Loaded>>,
    tables: HashMap<PathBuf, Sampled>,
}

/// A model file.
#[derive(Debug)]
pub(super) struct Loaded {
    pub(super) file: Model,
    /// Its meshes, to be shared.
    pub(super) meshes: Vec<Arc<Mesh>>,
}

impl Library {
    /// Reads all files that the shot names, each once.
    ///
    /// # Errors
    /// Every file that cannot be used, each at the key that names it.
    pub fn load(shot: &Shot) -> Result<Self, Mistakes> {
        let mut mistakes = Vec::new();
        let models = load_models(shot, &mut mistakes);
        let mut tables = HashMap::new();
        for (key, table) in named_tables(shot) {
            if let Some(file) = &table.file {
                match read_table(&beside(shot, file)) {
                    Ok(curve) => {
                        tables.insert(file.clone(), curve);
                    }
                    Err(message) => mistakes.push(shot.places.mistake(&key, message, None)),
                }
            }
        }
        if mistakes.is_empty() {
            Ok(Self { models, tables })
        } else {
            Err(Mistakes::new(&shot.places, mistakes))
        }
    }

    /// What of the model files the picture will not show, with the file's name.
    pub fn warnings<'a>(&'a self, shot: &'a Shot) -> impl Iterator<Item = (&'a Path, &'a Warning)> {
        let mut seen: Vec<*const Loaded> = Vec::new();
        shot.model
            .iter()
            .zip(&self.models)
            .filter(move |(_, loaded)| {
                let known = seen.contains(&Arc::as_ptr(loaded));
                seen.push(Arc::as_ptr(loaded));
                !known
            })
            .flat_map(|(model, loaded)| {
                loaded
                    .file
                    .warnings
                    .iter()
                    .map(|w| (model.file.as_path(), w))
            })
    }

    pub(super) fn model(&self, index: usize) -> &Loaded {
        &self.models[index]
    }

    pub(super) fn table(&self, file: &Path) -> Option<&Sampled> {
        self.tables.get(file)
    }
}

fn load_models(shot: &Shot, mistakes: &mut Vec<Mistake>) -> Vec<Arc<Loaded>> {
    let folder = shot.path.parent().unwrap_or(Path::new("."));
    let mut known: HashMap<&Path, Option<Arc<Loaded>>> = HashMap::new();
    let mut models = Vec::new();
    for (index, model) in shot.model.iter().enumerate() {
        let loaded = known.entry(&model.file).or_insert_with(|| {
            match model::load(&beside(shot, &model.file), &[folder]) {
                Ok(mut file) => {
                    let meshes = std::mem::take(&mut file.meshes)
                        .into_iter()
                        .map(Arc::new)
                        .collect();
                    Some(Arc::new(Loaded { file, meshes }))
                }
                Err(error) => {
                    let key = format!("model[{index}].file");
                    mistakes.push(shot.places.mistake(&key, error.to_string(), None));
                    None
                }
            }
        });
        models.extend(loaded.clone());
    }
    models
}

/// A path of the shot, which is relative to the shot file.
pub(super) fn beside(shot: &Shot, file: &Path) -> PathBuf {
    shot.path
        .parent()
        .map_or_else(|| file.to_owned(), |folder| folder.join(file))
}

fn read_table(path: &Path) -> Result<Sampled, String> {
    let length = fs::metadata(path).map_err(|e| e.to_string())?.len();
    if length > LARGEST_TABLE {
        return Err(format!(
            "a spectrum of {length} bytes is more than {LARGEST_TABLE}"
        ));
    }
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    Sampled::from_csv(&text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Every spectrum table of a shot, with its key.
fn named_tables(shot: &Shot) -> Vec<(String, &SpectrumTable)> {
    let mut values: Vec<(String, &Option<SpectrumValue>)> = Vec::new();
    for (name, material) in &shot.material {
        let mut add = |term: &str, value| values.push((format!("material.{name}.{term}"), value));
        material
            .diffuse
            .iter()
            .for_each(|t| add("diffuse.spectrum", &t.spectrum));
        material
            .highlight
            .iter()
            .for_each(|t| add("highlight.spectrum", &t.spectrum));
        material
            .emission
            .iter()
            .for_each(|t| add("emission.spectrum", &t.spectrum));
        material
            .thermal
            .iter()
            .for_each(|t| add("thermal.emissivity", &t.emissivity));
    }
    for (i, light) in shot.light.iter().enumerate() {
        values.push((format!("light[{i}].spectrum"), &light.spectrum));
    }
    values.push(("background.spectrum".to_owned(), &shot.background.spectrum));
    let inline = values.into_iter().filter_map(|(key, value)| match value {
        Some(SpectrumValue::Table(table)) => Some((key, &**table)),
        _ => None,
    });
    let named = shot
        .spectrum
        .iter()
        .map(|(name, table)| (format!("spectrum.{name}"), table));
    inline
        .chain(named)
        .map(|(key, table)| (format!("{key}.file"), table))
        .collect()
}
