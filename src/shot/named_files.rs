//! The files that a shot names, other than the files that models name in turn.

use super::load::with_slashes;
use super::{Shot, SpectrumTable, SpectrumValue, Stars};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

impl Shot {
    /// The path of a file that the shot names: relative paths start at the shot's folder.
    pub fn beside(&self, file: &Path) -> PathBuf {
        self.path
            .parent()
            .map_or_else(|| file.to_owned(), |folder| folder.join(file))
    }

    /// Replaces `\\` by `/` in file names that only then lead to a file.
    pub(super) fn normalize_file_names(&mut self) {
        let folder = self.path.parent().unwrap_or(Path::new("")).to_owned();
        for file in self.files_mut() {
            if let Some(slashed) = with_slashes(&folder, file) {
                *file = slashed;
            }
        }
    }

    /// The names of all files, used or not, mutable.
    fn files_mut(&mut self) -> Vec<&mut PathBuf> {
        let sky = &mut self.background;
        let terms = self.material.values_mut().flat_map(|m| m.spectra_mut());
        let lamps = self.light.iter_mut().map(|light| &mut light.spectrum);
        let values = terms.map(|(_, value)| value).chain(lamps);
        let inline = values.chain([&mut sky.spectrum]);
        let inline = inline.filter_map(|value| match value {
            Some(SpectrumValue::Table(table)) => Some(&mut **table),
            Some(SpectrumValue::Number(_) | SpectrumValue::Name(_)) | None => None,
        });
        let tables = inline.chain(self.spectrum.values_mut());
        let spectra = tables.filter_map(|table| table.file.as_mut());
        let stars = match &mut sky.stars {
            Some(Stars::Catalogue(stars)) => Some(&mut stars.file),
            Some(Stars::Random(_)) | None => None,
        };
        let models = self.model.iter_mut().map(|model| &mut model.file);
        let of_sky = sky.image.as_mut().into_iter().chain(stars);
        models.chain(spectra).chain(of_sky).collect()
    }

    /// The names of `[spectrum.NAME]` tables that materials, lamps and the background use.
    pub fn used_spectra(&self) -> HashSet<&str> {
        let values = self.spectrum_values().into_iter();
        let named = values.filter_map(|(_, value)| match value {
            SpectrumValue::Name(name) => Some(name.as_str()),
            SpectrumValue::Number(_) | SpectrumValue::Table(_) => None,
        });
        named.collect()
    }

    /// Every use of a spectrum, with its key.
    fn spectrum_values(&self) -> Vec<(String, &SpectrumValue)> {
        let mut values: Vec<(String, &Option<SpectrumValue>)> = Vec::new();
        for (name, material) in &self.material {
            let terms = material.spectra();
            values.extend(terms.map(|(term, value)| (format!("material.{name}.{term}"), value)));
        }
        for (i, light) in self.light.iter().enumerate() {
            values.push((format!("light[{i}].spectrum"), &light.spectrum));
        }
        values.push(("background.spectrum".to_owned(), &self.background.spectrum));
        let given = values.into_iter();
        given
            .filter_map(|(key, value)| Some((key, value.as_ref()?)))
            .collect()
    }

    /// Every spectrum table, inline or named, with its key. The library reads their files.
    pub fn spectrum_tables(&self) -> Vec<(String, &SpectrumTable)> {
        let values = self.spectrum_values().into_iter();
        let inline = values.filter_map(|(key, value)| match value {
            SpectrumValue::Table(table) => Some((key, &**table)),
            SpectrumValue::Number(_) | SpectrumValue::Name(_) => None,
        });
        let named = self
            .spectrum
            .iter()
            .map(|(name, table)| (format!("spectrum.{name}"), table));
        inline.chain(named).collect()
    }

    /// The files of used spectra, sky image and stars, each with its key; models are not included.
    pub fn data_files(&self) -> Vec<(String, &Path)> {
        let used = self.used_spectra();
        let is_used = |key: &str| {
            let named = key.strip_prefix("spectrum.");
            named.is_none_or(|name| used.contains(name))
        };
        let tables = self.spectrum_tables().into_iter();
        let tables = tables.filter(|(key, _)| is_used(key));
        let tables =
            tables.filter_map(|(key, table)| Some((format!("{key}.file"), table.file.as_deref()?)));
        let image = self.background.image.as_deref();
        let image = image.map(|file| ("background.image".to_owned(), file));
        let stars = match &self.background.stars {
            Some(Stars::Catalogue(stars)) => {
                Some(("background.stars.file".to_owned(), stars.file.as_path()))
            }
            Some(Stars::Random(_)) | None => None,
        };
        tables.chain(image).chain(stars).collect()
    }
}
