//! Which material each surface of a model has: the shot's, the file's, or one laid over the other.

use super::material::{Material, MaterialError};
use super::resolve::Resolver;
use super::spectra::Spectra;

impl Resolver<'_> {
    /// All materials, and for each model the indices of its own materials; past those, of what
    /// surfaces without material get.
    pub(super) fn materials(&mut self) -> (Vec<Material>, Vec<Vec<u32>>) {
        let mut materials = Vec::new();
        let of_models = (0..self.shot.model.len())
            .map(|index| self.model_materials(index, &mut materials))
            .collect();
        (materials, of_models)
    }

    fn model_materials(&mut self, index: usize, materials: &mut Vec<Material>) -> Vec<u32> {
        let model = &self.shot.model[index];
        let loaded = self.library.model(index);
        self.check_named(index);
        let mut numbers = Vec::new();
        for own in &loaded.file.materials {
            let name = model
                .material
                .as_ref()
                .or_else(|| model.materials.get(&own.name))
                .unwrap_or(&own.name);
            numbers.push(self.material(index, name, materials));
        }
        let bare = loaded.meshes.iter().any(|mesh| mesh.material.is_none());
        match (&model.material, bare) {
            (Some(name), _) => numbers.push(self.material(index, name, materials)),
            (None, false) => {}
            (None, true) => {
                let message = "some surfaces of this file have no material".to_owned();
                let help = "give `material = \"NAME\"` for all of them";
                self.mistake(&format!("model[{index}].file"), message, Some(help));
                numbers.push(0);
            }
        }
        numbers
    }

    /// Names of the file's materials that the shot maps must be there.
    fn check_named(&mut self, index: usize) {
        let own: Vec<&str> = self
            .library
            .model(index)
            .file
            .materials
            .iter()
            .map(|m| m.name.as_str())
            .collect();
        for name in self.shot.model[index].materials.keys() {
            if !own.contains(&name.as_str()) {
                let message = format!("the file has no material \"{name}\"");
                let help = format!("its materials: {}", own.join(", "));
                let key = format!("model[{index}].materials.{name}");
                self.mistake(&key, message, Some(&help));
            }
        }
    }

    /// The number of a material as one model sees it: the shot's, the file's, or the first laid
    /// over the second.
    fn material(&mut self, model: usize, name: &str, materials: &mut Vec<Material>) -> u32 {
        let spectra = Spectra {
            shot: self.shot,
            library: self.library,
            frame: self.frame,
        };
        let file = self
            .library
            .model(model)
            .file
            .materials
            .iter()
            .find(|m| m.name == name);
        // By what it is, not by what it looks like in this image: bodies keep their numbers.
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
        let made = imported.map_err(MaterialError::from).and_then(|below| {
            match self.shot.material.get(name) {
                Some(over) => below.overlaid(over, &spectra),
                None => Ok(below),
            }
        });
        match made {
            Ok(material) => {
                materials.push(material.pruned());
                let number = materials.len() as u32 - 1;
                self.numbers.insert(key, number);
                number
            }
            Err(error) => {
                let message = format!("material \"{name}\": {error}");
                self.mistake(
                    &format!("material.{name}{}", error.key()),
                    message,
                    Some(error.help()),
                );
                0
            }
        }
    }
}
