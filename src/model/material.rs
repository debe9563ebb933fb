//! Checks shared by the materials of both formats.

use super::{ModelError, ModelMaterial, Warning};
use std::path::Path;

impl ModelMaterial {
    /// The material with its reflectance clamped to 0..1, with a warning. Emission that is negative
    /// or not finite is an error.
    pub(super) fn checked(
        mut self,
        file: &Path,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, ModelError> {
        let bad = self
            .base_color
            .iter()
            .chain(&self.emissive)
            .find(|v| !v.is_finite());
        if let Some(found) = bad {
            return Err(ModelError::NotFinite {
                file: file.to_owned(),
                at: format!("a color of material `{}`", self.name),
                found: found.to_string(),
            });
        }
        if let Some(found) = self.emissive.iter().find(|&&v| v < 0.0) {
            return Err(ModelError::Invalid {
                file: file.to_owned(),
                at: format!("material `{}`", self.name),
                problem: format!("gives off light of {found}, expected 0 or more"),
            });
        }
        let clamped = self.base_color.map(|v| v.clamp(0.0, 1.0));
        if clamped != self.base_color {
            warnings.push(Warning::Clamped {
                material: self.name.clone(),
            });
            self.base_color = clamped;
        }
        Ok(self)
    }
}
