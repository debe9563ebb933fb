//! The bytes at which each key's value stands.

use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// No key of the format lies deeper; what does is unknown, and its holder is marked.
const MAX_DEPTH: usize = 16;

/// The spans of all values of a file by key path.
pub(in super::super) fn spans(tree: &DeTable<'_>) -> HashMap<String, Range<usize>> {
    let mut spans = HashMap::from([(String::new(), 0..0)]);
    table(tree, "", 0, &mut spans);
    spans
}

fn table(tree: &DeTable<'_>, path: &str, depth: usize, spans: &mut HashMap<String, Range<usize>>) {
    for (key, item) in tree {
        value(item, super::join(path, key.get_ref()), depth + 1, spans);
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
