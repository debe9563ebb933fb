//! Materials: base color and emission factors; everything else that would be visible is a warning.
//!
//! An emission of 1 is 1 cd/m² (KHR_materials_emissive_strength), but in files by Blender radiance
//! as it is. Materials that no mesh in the image uses give no warnings.

use super::source::{Source, name_of};
use crate::model::{LUMENS_PER_WATT, Model, ModelError, ModelMaterial, Warning};
use ::gltf::json::Material;
use ::gltf::json::material::AlphaMode;
use ::gltf::json::validation::Checked;
use serde_json::Value;

/// The value of `asset.generator` in files by Blender's exporter, perhaps after the name of an
/// add-on.
const BLENDER: &str = "Khronos glTF Blender I/O";

/// The effects that an image lacks without an extension.
const EFFECTS: [(&str, &str); 11] = [
    ("transmission", "it is opaque, in its base color"),
    ("volume", "nothing is absorbed within it"),
    ("clearcoat", "it lacks the coat's highlight and reflections"),
    ("sheen", "it lacks its velvet edge"),
    (
        "specular",
        "its highlight is that of the shot, without this strength and tint",
    ),
    ("anisotropy", "its highlight is round"),
    ("iridescence", "it lacks its rainbow film"),
    ("dispersion", "it splits no light"),
    ("diffuse_transmission", "no light shines through it"),
    ("unlit", "it is lit like any other surface"),
    (
        "pbrSpecularGlossiness",
        "its color is that of its metallic-roughness form, or white",
    ),
];

impl Source<'_> {
    /// Reads all materials into the model.
    pub(super) fn materials(&self, model: &mut Model) -> Result<(), ModelError> {
        let generator = self.raw["asset"]["generator"].as_str().unwrap_or_default();
        let by_blender = generator.contains(BLENDER);
        for (index, material) in self.root.materials.iter().enumerate() {
            let pbr = &material.pbr_metallic_roughness;
            let [red, green, blue, _] = pbr.base_color_factor.0.map(f64::from);
            let strength = &self.extension(index, "emissive_strength")["emissiveStrength"];
            let strength = strength.as_f64().unwrap_or(1.0);
            let plain = ModelMaterial {
                name: name_of(material.name.as_deref(), "material", index),
                base_color: [red, green, blue],
                emissive: material
                    .emissive_factor
                    .0
                    .map(|factor| f64::from(factor) * strength),
                emissive_unit: if by_blender { LUMENS_PER_WATT } else { 1.0 },
                double_sided: material.double_sided,
            };
            model
                .materials
                .push(plain.checked(&self.file, &mut model.warnings)?);
        }
        Ok(())
    }

    /// Warns of the effects that a material in the image lacks.
    pub(super) fn warn_of_material(&self, index: usize, model: &mut Model) {
        let (Some(material), Some(plain)) =
            (self.root.materials.get(index), model.materials.get(index))
        else {
            return;
        };
        let name = || plain.name.clone();
        let warnings = &mut model.warnings;
        let textures = textures(material)
            .into_iter()
            .filter(|(is_there, _)| *is_there);
        warnings.extend(textures.map(|(_, what)| Warning::Texture {
            material: name(),
            what,
        }));
        let mode = match material.alpha_mode {
            Checked::Valid(AlphaMode::Mask) => Some("is cut out by its alpha"),
            Checked::Valid(AlphaMode::Blend) => Some("is see-through by its alpha"),
            _ => None,
        };
        warnings.extend(mode.map(|mode| Warning::Alpha {
            material: name(),
            mode,
        }));
        let pbr = &material.pbr_metallic_roughness;
        if pbr.metallic_factor.0 > 0.0 && pbr.metallic_roughness_texture.is_none() {
            warnings.push(Warning::Metal { material: name() });
        }
        for (short, effect) in EFFECTS {
            if self.shows(index, short) {
                let extension = format!("KHR_materials_{short}");
                warnings.push(Warning::MaterialExtension {
                    material: name(),
                    extension,
                    effect,
                });
            }
        }
    }

    /// Whether the material has the extension with an effect, not merely with a factor of 0.
    fn shows(&self, index: usize, short: &str) -> bool {
        let value = self.extension(index, short);
        let factor = value.get(format!("{short}Factor")).and_then(Value::as_f64);
        let needs_factor = ["transmission", "clearcoat"].contains(&short);
        match factor {
            Some(factor) => factor != 0.0,
            None => value.is_object() && !needs_factor,
        }
    }

    fn extension(&self, index: usize, short: &str) -> &Value {
        &self.raw["materials"][index]["extensions"][format!("KHR_materials_{short}")]
    }
}

fn textures(material: &Material) -> [(bool, &'static str); 5] {
    let pbr = &material.pbr_metallic_roughness;
    [
        (
            pbr.base_color_texture.is_some(),
            "color texture is not read; it is drawn in its base color factor alone",
        ),
        (
            pbr.metallic_roughness_texture.is_some(),
            "metallic-roughness texture is not read; it is drawn as matt paint",
        ),
        (
            material.normal_texture.is_some(),
            "normal map is not read; its surface is smooth",
        ),
        (
            material.occlusion_texture.is_some(),
            "occlusion texture is not read; its creases are not darkened",
        ),
        (
            material.emissive_texture.is_some(),
            "emission texture is not read; it glows evenly by its emissive factor alone",
        ),
    ]
}
