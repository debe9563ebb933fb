//! Inputs of a fingerprint in the making: tables and values by key.

use super::super::at::At;
use crate::shot::{Blend, Track};
use indexmap::IndexMap;
use serde::Serialize;

/// Values by key: a short one as it stands in JSON, a long one by its hash.
pub(super) type FingerprintInputs = IndexMap<String, String>;

/// Longest value that is kept as it stands, bytes.
const LONGEST: usize = 40;

/// `#` and 16 hexadecimal digits of a hash.
fn short_hash(bytes: &[u8]) -> String {
    format!("#{}", &blake3::hash(bytes).to_hex()[..16])
}

/// BLAKE3 of inputs, in whatever order their author wrote them.
pub(super) fn hash(inputs: &FingerprintInputs) -> blake3::Hash {
    let mut sorted: Vec<(&String, &String)> = inputs.iter().collect();
    sorted.sort_unstable();
    let mut hasher = blake3::Hasher::new();
    for text in sorted.into_iter().flat_map(|(key, value)| [key, value]) {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.finalize()
}

/// Inputs in the making.
pub(super) struct List<'a> {
    pub(super) at: At<'a>,
    /// The key of the table that is being listed.
    key: String,
    pub(super) inputs: FingerprintInputs,
}

impl<'a> List<'a> {
    pub(super) fn new(at: At<'a>) -> Self {
        Self {
            at,
            key: String::new(),
            inputs: FingerprintInputs::new(),
        }
    }

    /// Lists a table. Its name is worth an input also where it has no keys: a material without terms
    /// is black.
    pub(super) fn table(&mut self, name: &str, keys: impl FnOnce(&mut Self)) {
        let (length, before) = (self.key.len(), self.inputs.len());
        self.enter(name);
        keys(self);
        if self.inputs.len() == before {
            self.inputs.insert(self.key.clone(), "{}".to_owned());
        }
        self.key.truncate(length);
    }

    fn enter(&mut self, name: &str) {
        if !self.key.is_empty() {
            self.key.push('.');
        }
        self.key.push_str(name);
    }

    /// Lists tables one after the other.
    pub(super) fn tables<'t, T: 't>(
        &mut self,
        name: &str,
        items: impl IntoIterator<Item = &'t T>,
        keys: impl Fn(&mut Self, &T),
    ) {
        for (place, item) in items.into_iter().enumerate() {
            self.table(&format!("{name}[{place}]"), |list| keys(list, item));
        }
    }

    /// Lists tables by name.
    pub(super) fn named<'t, T: 't>(
        &mut self,
        name: &str,
        items: impl IntoIterator<Item = (&'t String, &'t T)>,
        keys: impl Fn(&mut Self, &T),
    ) {
        for (own, item) in items {
            self.table(&format!("{name}.{own}"), |list| keys(list, item));
        }
    }

    /// Lists a value.
    pub(super) fn leaf(&mut self, name: &str, value: &impl Serialize) {
        let length = self.key.len();
        self.enter(name);
        let text = serde_json::to_string(value).expect("values are text, numbers and lists");
        let short = match text.len() <= LONGEST {
            true => text,
            false => short_hash(text.as_bytes()),
        };
        self.inputs.insert(self.key.clone(), short);
        self.key.truncate(length);
    }

    /// Lists a value that its author may have left out.
    pub(super) fn given(&mut self, name: &str, value: &Option<impl Serialize>) {
        if let Some(value) = value {
            self.leaf(name, value);
        }
    }

    /// Lists a track's value at the frame.
    pub(super) fn track<T: Blend + Serialize>(&mut self, name: &str, track: &Track<T>) {
        self.leaf(name, &self.at.value(track));
    }

    pub(super) fn given_track<T: Blend + Serialize>(
        &mut self,
        name: &str,
        track: &Option<Track<T>>,
    ) {
        self.given(name, &self.at.given(track));
    }
}
