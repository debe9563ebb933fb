//! A glTF file split into its parts.

use super::buffers::Buffers;
use crate::model::ModelError;
use ::gltf::json::{Index, Root};
use serde_json::Value;
use std::cell::Cell;
use std::path::PathBuf;

/// A glTF file split into its parts; only its structure has been checked.
pub(super) struct Source<'a> {
    pub(super) file: PathBuf,
    pub(super) root: Root,
    /// The same JSON, for values that `root` lacks or rounds.
    pub(super) raw: Value,
    pub(super) buffers: Buffers<'a>,
    pub(super) elements_left: Cell<u64>,
}

impl Source<'_> {
    /// An item by its index, or the error that names the item that refers to it.
    pub(super) fn item<'a, T>(
        &self,
        list: &'a [T],
        index: Index<T>,
        what: &'static str,
        from: &str,
    ) -> Result<&'a T, ModelError> {
        let index = index.value();
        list.get(index)
            .ok_or_else(|| self.dangling(from, what, index, list.len()))
    }

    pub(super) fn dangling(
        &self,
        from: &str,
        what: &'static str,
        index: usize,
        count: usize,
    ) -> ModelError {
        let (file, from) = (self.file.clone(), from.to_owned());
        ModelError::Dangling {
            file,
            from,
            what,
            index,
            count,
        }
    }

    pub(super) fn invalid(&self, at: &str, problem: impl Into<String>) -> ModelError {
        ModelError::invalid(&self.file, at, problem)
    }
}

/// An item's name for messages: its own, or its kind and index.
pub(super) fn name_of(name: Option<&str>, kind: &str, index: usize) -> String {
    match name {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => format!("{kind} {index}"),
    }
}
