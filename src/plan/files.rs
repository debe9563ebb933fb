//! Hashes of the files that a shot reads: models with all that they name, spectra, skies, stars.

use crate::shot::{Mistakes, Shot};
use std::path::Path;

/// BLAKE3 of every file that a shot reads, by the path that it is named by.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Digests(Vec<(String, String)>);

impl Digests {
    /// Reads the files of a shot and hashes them; no mesh is built.
    ///
    /// # Errors
    /// A file that cannot be read, at the key that names it.
    pub fn read(shot: &Shot) -> Result<Self, Mistakes> {
        let folder = shot.path.parent().unwrap_or(Path::new(""));
        let mut digests = Vec::new();
        for (i, model) in shot.model.iter().enumerate() {
            let bytes = std::fs::read(folder.join(&model.file)).map_err(|error| {
                let key = format!("model[{i}].file");
                let mistake = shot.places.mistake(&key, error.to_string(), None);
                Mistakes::new(&shot.places, vec![mistake])
            })?;
            let digest = blake3::hash(&bytes).to_hex().to_string();
            digests.push((model.file.display().to_string(), digest));
        }
        Ok(Self(digests))
    }

    /// Paths and hexadecimal hashes.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0
            .iter()
            .map(|(path, hash)| (path.as_str(), hash.as_str()))
    }
}
