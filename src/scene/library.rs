//! All files that a shot names, read once: model files, measured spectra, skies, stars.

use super::sky::{SkyImage, Star, Stars, random_stars};
use crate::model::{self, Mesh, Model, Warning};
use crate::shot::{self, Mistake, Mistakes, SAVE_AS_UTF8, Shot};
use crate::spectrum::Sampled;
use crate::spectrum::csv::Measured;
use indexmap::IndexSet;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Size of the largest file of a measured spectrum or of stars, bytes.
const LARGEST_TABLE: u64 = 64 << 20;

/// The files of a shot.
#[derive(Debug, Default)]
pub struct Library {
    models: Vec<Arc<Loaded>>,
    tables: HashMap<PathBuf, Measured>,
    sky: Option<Arc<SkyImage>>,
    stars: Option<Arc<Stars>>,
}

/// A model file.
#[derive(Debug)]
pub(super) struct Loaded {
    pub(super) file: Model,
    /// Its meshes, shared with the scenes.
    pub(super) meshes: Vec<Arc<Mesh>>,
}

impl Loaded {
    /// Whether the file gives no material to some surfaces.
    pub(super) fn has_bare_surfaces(&self) -> bool {
        self.meshes.iter().any(|mesh| mesh.material.is_none())
    }

    /// The warning about those surfaces if the shot gives them no material either.
    fn of_bare_surfaces(&self) -> Option<Warning> {
        let placements = self.file.placements.iter();
        let bare = placements.filter(|p| self.meshes[p.mesh].material.is_none());
        let nodes: IndexSet<String> = bare.map(|p| p.node.clone()).collect();
        let nodes: Vec<String> = nodes.into_iter().collect();
        (!nodes.is_empty()).then_some(Warning::NoMaterial { nodes })
    }
}

impl Library {
    /// Reads all files that the shot names, each once.
    ///
    /// # Errors
    /// Every file that cannot be used, each at the key that names it.
    ///
    /// # Example
    /// ```
    /// use restframe::{scene::Library, shot};
    /// use std::path::Path;
    ///
    /// let shot = shot::load(Path::new("shots/mirror-ball.toml"))?;
    /// let library = Library::load(&shot)?;
    /// assert_eq!(library.warnings(&shot).count(), 0);
    /// # Ok::<(), shot::Mistakes>(())
    /// ```
    pub fn load(shot: &Shot) -> Result<Self, Mistakes> {
        let mut mistakes = Vec::new();
        let models = load_models(shot, &mut mistakes);
        let mut tables = HashMap::new();
        for (key, table) in shot.spectrum_tables() {
            if let Some(file) = &table.file {
                match read_table(&shot.beside(file)) {
                    Ok(curve) => {
                        tables.insert(file.clone(), curve);
                    }
                    Err(message) => {
                        mistakes.push(shot.places.mistake(&format!("{key}.file"), message, None))
                    }
                }
            }
        }
        let sky = shot.background.image.as_ref().and_then(|file| {
            let image = SkyImage::read(&shot.beside(file));
            let image = image.map_err(|e| (e.to_string(), e.remedy()));
            kept(shot, "background.image", image, &mut mistakes)
        });
        let stars = shot.background.stars.as_ref().and_then(|stars| {
            let help =
                "a row a star: azimuth and elevation in degrees, temperature in K, magnitude";
            let stars = load_stars(shot, stars).map_err(|message| (message, help));
            kept(shot, "background.stars.file", stars, &mut mistakes)
        });
        if mistakes.is_empty() {
            Ok(Self {
                models,
                tables,
                sky,
                stars,
            })
        } else {
            Err(Mistakes::new(&shot.places, mistakes))
        }
    }

    /// Warnings about content of the files that the image will not show as it is, with the file's
    /// name.
    pub fn warnings<'a>(&'a self, shot: &'a Shot) -> impl Iterator<Item = (&'a Path, String)> {
        let mut seen: Vec<*const Loaded> = Vec::new();
        let models = shot
            .model
            .iter()
            .zip(&self.models)
            .filter(move |(_, loaded)| {
                let known = seen.contains(&Arc::as_ptr(loaded));
                seen.push(Arc::as_ptr(loaded));
                !known
            });
        let of_models = models.flat_map(|(model, loaded)| {
            let warnings = loaded.file.warnings.iter();
            warnings.map(|w| (model.file.as_path(), w.to_string()))
        });
        let not_given = shot.model.iter().zip(&self.models);
        let not_given = not_given.filter(|(model, _)| model.given_material("").is_none());
        let bare: IndexSet<(&Path, String)> = not_given
            .filter_map(|(model, loaded)| {
                let warning = loaded.of_bare_surfaces()?;
                Some((model.file.as_path(), warning.to_string()))
            })
            .collect();
        let tables = shot.spectrum_tables().into_iter();
        let of_tables = tables.filter_map(|(_, table)| {
            let file = table.file.as_deref()?;
            Some((file, self.tables.get(file)?.warnings(shot.sensor.window)))
        });
        let of_tables = of_tables.flat_map(|(file, warnings)| {
            let warnings = warnings.into_iter();
            warnings.map(move |w| (file, w.to_string()))
        });
        let of_sky = shot.background.image.iter().zip(&self.sky);
        of_models
            .chain(bare)
            .chain(of_tables)
            .chain(of_sky.flat_map(|(file, sky)| {
                let warnings = sky.warnings().iter();
                warnings.map(|w| (file.as_path(), w.to_string()))
            }))
    }

    pub(super) fn sky(&self) -> Option<Arc<SkyImage>> {
        self.sky.clone()
    }

    pub(super) fn stars(&self) -> Option<Arc<Stars>> {
        self.stars.clone()
    }

    pub(super) fn model(&self, index: usize) -> &Loaded {
        &self.models[index]
    }

    pub(super) fn table(&self, file: &Path) -> Option<&Sampled> {
        self.tables.get(file).map(|table| &table.curve)
    }
}

fn load_models(shot: &Shot, mistakes: &mut Vec<Mistake>) -> Vec<Arc<Loaded>> {
    let folder = shot.path.parent().unwrap_or(Path::new("."));
    let mut known: HashMap<&Path, Option<Arc<Loaded>>> = HashMap::new();
    let mut models = Vec::new();
    for (index, model) in shot.model.iter().enumerate() {
        let loaded = known.entry(&model.file).or_insert_with(|| {
            match model::load(&shot.beside(&model.file), &[folder]) {
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

/// The value, or None after recording the mistake.
fn kept<T>(
    shot: &Shot,
    key: &str,
    read: Result<T, (String, &str)>,
    mistakes: &mut Vec<Mistake>,
) -> Option<Arc<T>> {
    read.map(Arc::new)
        .map_err(|(message, help)| {
            let help = Some(help.to_owned());
            mistakes.push(shot.places.mistake(key, message, help));
        })
        .ok()
}

fn load_stars(shot: &Shot, stars: &shot::Stars) -> Result<Stars, String> {
    let list = match stars {
        shot::Stars::Random(keys) => random_stars(keys),
        shot::Stars::Catalogue(keys) => {
            let path = shot.beside(&keys.file);
            Star::from_csv(&read_text(&path)?).map_err(|e| format!("{}: {e}", path.display()))?
        }
    };
    Ok(Stars::new(&list, stars.size()))
}

fn read_table(path: &Path) -> Result<Measured, String> {
    Measured::from_csv(&read_text(path)?).map_err(|e| format!("{}: {e}", path.display()))
}

fn read_text(path: &Path) -> Result<String, String> {
    let length = fs::metadata(path).map_err(|e| e.to_string())?.len();
    if length > LARGEST_TABLE {
        return Err(format!(
            "a table of {length} bytes is more than {LARGEST_TABLE}"
        ));
    }
    let bytes = fs::read(path).map_err(|e| e.to_string())?;
    shot::text_of(bytes).map_err(|e| format!("{}: {e}: {SAVE_AS_UTF8}", path.display()))
}
