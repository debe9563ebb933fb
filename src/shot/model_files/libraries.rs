//! The material libraries that an `mtllib` line of an OBJ file names, found as far as may be.
//!
//! Names may hold blanks and a line may hold names, bare or in quotes. A name is tried as it is
//! written, with `/` for `\`, and in the letter case that the disk has. Of an absolute path, which
//! is that of the author's machine, the file's name is tried beside the model.

use super::super::names::nearest;
use super::super::obj_lines::before_comment;
use super::{FileError, MAX_LIBRARIES, ModelFile, ModelFiles, is_absolute};
use indexmap::IndexSet;
use std::path::{Component, Path};

/// A material library.
#[derive(Debug)]
pub struct Library {
    /// As the line has it.
    pub asked: String,
    /// Of an absolute path, the name that was tried beside the model.
    pub beside: Option<String>,
    /// Its name from the model's folder, and the file; `None` where it is not there.
    pub found: Option<(String, ModelFile)>,
    /// Of one that is not there, the file that was perhaps meant.
    pub near: Option<String>,
}

impl ModelFiles {
    /// Finds the material libraries that an `mtllib` line names: the file that all of it names or,
    /// where there is none, those of its words.
    ///
    /// # Errors
    /// When the model may not read one, or one is too large, or there are too many.
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
            // Another word that is not there may be a remark.
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

    /// Counts names against the most that are looked for.
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

    /// None where there is no file of that name.
    fn if_there(&mut self, name: &str) -> Result<Option<(String, ModelFile)>, FileError> {
        match self.part(name) {
            Err(FileError::NotAFile { .. }) => Ok(None),
            part => Ok(part?.map(|part| (name.to_owned(), part))),
        }
    }

    /// The one path that differs from `name` in letter case alone.
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

    /// The library that was perhaps meant by a name: one spelt much like it, or like the model.
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

    /// The names in a folder that may be read, in order.
    fn names_in(&self, folder: &str) -> Option<Vec<String>> {
        let folder = self.folder.join(folder).canonicalize().ok()?;
        if !self.allows(&folder) {
            return None;
        }
        let entries = folder.read_dir().ok()?.flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut names: Vec<_> = names.collect();
        names.sort();
        Some(names)
    }
}

fn join(folder: &str, name: &str) -> String {
    let slash = if folder.is_empty() { "" } else { "/" };
    format!("{folder}{slash}{name}")
}

/// The name of a library without its extension; `None` of other files.
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

/// The names on a line: what stands in quotes, and the words outside.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('"').enumerate();
    let names = parts.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    names.collect()
}
