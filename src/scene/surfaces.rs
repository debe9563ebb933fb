//! The material of each surface of a model: the shot's, the file's, or the shot's laid over the
//! file's.

use super::material::{Material, MaterialError};
use super::resolve::Resolver;
use super::spectra::Spectra;
use crate::model::ModelMaterial;

/// The material of surfaces to which neither file nor shot gives one: glTF's default, white (glTF
/// 2.0, section 5.19).
static NO_MATERIAL: ModelMaterial = ModelMaterial {
    name: String::new(),
    base_color: [1.0; 3],
    emissive: [0.0; 3],
    emissive_unit: 1.0,
    double_sided: true,
};

/// Name of the shot's material that is laid over every material of the files, below one of its own
/// name.
const EVERY: &str = "*";

impl Resolver<'_> {
    /// All materials, and for each model the indices of its materials; after these, that of
    /// surfaces without material.
    pub(super) fn materials(&mut self) -> (Vec<Material>, Vec<Vec<u32>>) {
        let mut materials = Vec::new();
        let of_models = (0..self.frame.models.len())
            .map(|index| self.model_materials(index, &mut materials))
            .collect();
        (materials, of_models)
    }

    fn model_materials(&mut self, index: usize, materials: &mut Vec<Material>) -> Vec<u32> {
        let model = &self.frame.models[index];
        let loaded = self.library.model(index);
        self.check_named(index);
        let mut numbers = Vec::new();
        for own in &loaded.file.materials {
            let name = model.given_material(&own.name).unwrap_or(&own.name);
            numbers.push(self.material(index, name, materials));
        }
        if loaded.has_bare_surfaces() {
            numbers.push(match model.given_material("") {
                Some(name) => self.material(index, name, materials),
                None => self.laid_over(Some(&NO_MATERIAL), "", materials),
            });
        }
        numbers
    }

    /// Checks that the file's materials that the shot maps exist; surfaces without material have
    /// the empty name.
    fn check_named(&mut self, index: usize) {
        let loaded = self.library.model(index);
        let own = loaded.file.materials.iter().map(|m| m.name.as_str());
        let own: Vec<&str> = own.collect();
        for name in self.frame.models[index].materials.keys() {
            let is_there =
                own.contains(&name.as_str()) || name.is_empty() && loaded.has_bare_surfaces();
            if !is_there {
                let message = match name.as_str() {
                    "" => "the file has no surface without material".to_owned(),
                    name => format!("the file has no material \"{name}\""),
                };
                let help = format!("its materials: {}", own.join(", "));
                let key = format!("model[{index}].materials.{name}");
                self.mistake(&key, message, Some(&help));
            }
        }
    }

    /// The index of a material as one model sees it: the shot's, the file's, or the first laid over
    /// the second.
    fn material(&mut self, model: usize, name: &str, materials: &mut Vec<Material>) -> u32 {
        let own = &self.library.model(model).file.materials;
        self.laid_over(own.iter().find(|m| m.name == name), name, materials)
    }

    /// The index of the shot's material of this name laid over the one for all, and that over the
    /// file's.
    fn laid_over(
        &mut self,
        file: Option<&ModelMaterial>,
        name: &str,
        materials: &mut Vec<Material>,
    ) -> u32 {
        let spectra = Spectra {
            library: self.library,
        };
        // By identity, not by appearance in this image: bodies keep their numbers.
        let key = (file.map(std::ptr::from_ref), name.to_owned());
        if let Some(&number) = self.numbers.get(&key) {
            return number;
        }
        let imported = file.map_or_else(
            || {
                Ok(Material {
                    name: name.to_owned(),
                    ..Material::default()
                })
            },
            Material::imported,
        );
        let made = imported.map_err(|error| (name, MaterialError::from(error)));
        let made = [EVERY, name].into_iter().fold(made, |below, over| {
            let terms = self.frame.materials.get(over);
            match (below, terms) {
                (Ok(below), Some(terms)) => {
                    let laid = below.overlaid(terms, &spectra);
                    laid.map_err(|error| (over, error))
                }
                (below, _) => below,
            }
        });
        match made {
            Ok(material) => {
                materials.push(material.pruned());
                let number = materials.len() as u32 - 1;
                self.numbers.insert(key, number);
                number
            }
            Err((over, error)) => {
                let message = format!("material \"{over}\": {error}");
                self.mistake(
                    &format!("material.{over}{}", error.key()),
                    message,
                    Some(error.help()),
                );
                0
            }
        }
    }
}
