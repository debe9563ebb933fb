//! Paths of keys, and the bytes of the file at which the value of each key stands.

use crate::shot::names::short;
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Nesting depth to which spans are recorded. No key of the format lies deeper; a deeper one is
/// unknown, and the table that holds it is marked.
const MAX_DEPTH: usize = 16;

/// The path of a key, such as `material.red.diffuse`, and its pattern, `material.*.diffuse`, with `*`
/// for a name of the author's choice and `[]` for an index.
#[derive(Clone, Default)]
pub(super) struct At {
    pub(super) path: String,
    pub(super) pattern: String,
}

impl At {
    pub(super) fn key(&self, key: &str) -> At {
        At {
            path: join(&self.path, key),
            pattern: join(&self.pattern, key),
        }
    }

    pub(super) fn name(&self, name: &str) -> At {
        At {
            path: join(&self.path, name),
            pattern: join(&self.pattern, "*"),
        }
    }

    pub(super) fn index(&self, i: usize) -> At {
        At {
            path: format!("{}[{i}]", self.path),
            pattern: format!("{}[]", self.pattern),
        }
    }

    /// The table that holds the key, as a message names it.
    pub(super) fn holder(&self) -> String {
        if self.path.is_empty() {
            "a shot".into()
        } else {
            format!("`{}`", short(&self.path))
        }
    }
}

pub(super) fn join(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

/// The spans of all values of a file by key path.
pub(in super::super) fn spans(tree: &DeTable<'_>) -> HashMap<String, Range<usize>> {
    let mut spans = HashMap::from([(String::new(), 0..0)]);
    table(tree, "", 0, &mut spans);
    spans
}

fn table(tree: &DeTable<'_>, path: &str, depth: usize, spans: &mut HashMap<String, Range<usize>>) {
    for (key, item) in tree {
        value(item, join(path, key.get_ref()), depth + 1, spans);
    }
}

fn value(
    item: &Spanned<DeValue<'_>>,
    path: String,
    depth: usize,
    spans: &mut HashMap<String, Range<usize>>,
) {
    if depth <= MAX_DEPTH {
        match item.get_ref() {
            DeValue::Table(tree) => table(tree, &path, depth, spans),
            DeValue::Array(items) => items
                .iter()
                .enumerate()
                .for_each(|(i, item)| value(item, format!("{path}[{i}]"), depth + 1, spans)),
            _ => {}
        }
    }
    spans.insert(path, item.span());
}
