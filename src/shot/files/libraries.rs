//! The material libraries that an `mtllib` line of an OBJ file names.
//!
//! Names may contain blanks, and a line may have several names, bare or in quotes. A name is tried as
//! it is written, with `/` for `\`, and in another letter case. Of an absolute path, which is valid on
//! the author's machine only, the file name is tried beside the model.

use super::model_files::{FileError, MAX_LIBRARIES, ModelFile, ModelFiles, is_absolute};
use super::obj_lines::before_comment;
use crate::shot::names::names_in;
use crate::shot::names::nearest;
use indexmap::IndexSet;
use std::path::{Component, Path};

/// A material library.
#[derive(Debug)]
pub struct Library {
    /// Its name, as the line has it.
    pub asked: String,
    /// The name that was tried beside the model, if the line has an absolute path.
    pub beside: Option<String>,
    /// Its name from the model's folder, and the file; None if it does not exist.
    pub found: Option<(String, ModelFile)>,
    /// The file that was perhaps meant, if this one does not exist.
    pub near: Option<String>,
}

impl ModelFiles {
    /// Finds the material libraries that an `mtllib` line names: the file named by the whole line or,
    /// if there is none, those named by its words.
    ///
    /// # Errors
    /// If the model may not read one, or one is too large, or there are too many.
    pub fn libraries(&mut self, line: &str) -> Result<Vec<Library>, FileError> {
        let named = before_comment("mtllib", line);
        if named.is_empty() {
            return Ok(Vec::new());
        }
        self.count(1)?;
        let mut missing = None;
        for whole in IndexSet::from([line, named]) {
            if !is_absolute(unquoted(whole)) {
                let library = self.library(whole)?;
                if library.found.is_some() {
                    return Ok(vec![library]);
                }
                missing = (whole == named).then_some(library);
            }
        }
        let words = words(named);
        self.count(words.len().saturating_sub(1))?;
        let mut libraries = Vec::new();
        for word in words {
            if missing.is_none() || word != unquoted(named) {
                libraries.push(self.library(word)?);
            }
        }
        if libraries.iter().all(|library| library.found.is_none()) {
            libraries = vec![match missing {
                Some(library) => library,
                None => self.library(named)?,
            }];
        } else {
            // Another word that names no file may be a remark.
            libraries.retain(|library| {
                library.found.is_some() || library.asked.to_lowercase().ends_with(".mtl")
            });
        }
        for library in &mut libraries {
            if library.found.is_none() {
                let name = library.beside.as_ref().unwrap_or(&library.asked);
                library.near = self.near(&name.replace('\\', "/"));
            }
        }
        Ok(libraries)
    }

    /// Counts names against [`MAX_LIBRARIES`].
    fn count(&mut self, names: usize) -> Result<(), FileError> {
        let left = self.libraries_left.checked_sub(names);
        self.libraries_left = left.ok_or_else(|| FileError::Libraries {
            file: self.model.clone(),
            limit: MAX_LIBRARIES,
        })?;
        Ok(())
    }

    fn library(&mut self, asked: &str) -> Result<Library, FileError> {
        let asked = unquoted(asked);
        let beside = if is_absolute(asked) {
            asked.rsplit(['/', '\\', ':']).next()
        } else {
            None
        };
        let name = beside.unwrap_or(asked);
        let slashed = name.replace('\\', "/");
        let mut found = self.if_there(name)?;
        if found.is_none() {
            found = self.if_there(&slashed)?;
        }
        if found.is_none()
            && let Some(name) = self.in_other_case(&slashed)
        {
            found = self.if_there(&name)?;
        }
        Ok(Library {
            asked: asked.to_owned(),
            beside: beside.map(str::to_owned),
            found,
            near: None,
        })
    }

    /// The file of that name; None if there is none.
    fn if_there(&mut self, name: &str) -> Result<Option<(String, ModelFile)>, FileError> {
        match self.part(name) {
            Err(FileError::NotAFile { .. }) => Ok(None),
            part => Ok(part?.map(|part| (name.to_owned(), part))),
        }
    }

    /// The path that differs from `name` only in letter case, if there is exactly one.
    fn in_other_case(&self, name: &str) -> Option<String> {
        let mut real = String::new();
        for part in Path::new(name).components() {
            let part = match part {
                Component::Normal(part) => part.to_str()?,
                Component::ParentDir => "..",
                _ => continue,
            };
            let names = self.names_in(&real)?;
            let is_same = |known: &&String| known.to_lowercase() == part.to_lowercase();
            let part = if part == ".." || names.iter().any(|known| known == part) {
                part
            } else {
                let mut same = names.iter().filter(is_same);
                same.next().filter(|_| same.next().is_none())?
            };
            real = join(&real, part);
        }
        Some(real)
    }

    /// The library that was perhaps meant: one with a similar name, or with the name of the model.
    fn near(&self, name: &str) -> Option<String> {
        let (folder, file) = name.rsplit_once('/').unwrap_or(("", name));
        let wanted = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let model = self.model.file_stem()?.to_str()?;
        [folder, ""].into_iter().find_map(|folder| {
            let names = self.names_in(folder)?;
            let stems = || names.iter().filter_map(|name| stem(name));
            let near = nearest(wanted, stems()).or_else(|| stems().find(|stem| *stem == model))?;
            let name = names.iter().find(|name| stem(name) == Some(near))?;
            Some(join(folder, name))
        })
    }

    /// The names in a folder that may be read, sorted.
    fn names_in(&self, folder: &str) -> Option<Vec<String>> {
        let folder = self.folder.join(folder).canonicalize().ok()?;
        self.allows(&folder).then(|| names_in(&folder))?
    }
}

fn join(folder: &str, name: &str) -> String {
    let slash = if folder.is_empty() { "" } else { "/" };
    format!("{folder}{slash}{name}")
}

/// The name of a library without its extension; None for other files.
fn stem(name: &str) -> Option<&str> {
    let (stem, extension) = name.rsplit_once('.')?;
    extension.eq_ignore_ascii_case("mtl").then_some(stem)
}

fn unquoted(name: &str) -> &str {
    let inside = |quote: char| {
        let inside = name.strip_prefix(quote)?.strip_suffix(quote)?;
        (!inside.contains(quote)).then_some(inside)
    };
    inside('"').or_else(|| inside('\'')).unwrap_or(name)
}

/// The names on a line: quoted parts, and the words outside quotes.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('"').enumerate();
    let names = parts.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    names.collect()
}
