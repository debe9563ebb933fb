//! Mistakes in a shot, and their places in the file.
//!
//! A key path is written as `model[0].file`, `material.red.diffuse.weight` or
//! `worldline.rows.velocity.keys[2][1]`; names of the author's choice are not quoted in it.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The text of a shot file, and its path.
#[derive(Debug, Default)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: String,
}

/// The place in the shot file of the value of each key.
#[derive(Debug, Clone, Default)]
pub struct Places {
    source: Arc<Source>,
    spans: Arc<HashMap<String, Range<usize>>>,
}

impl Places {
    pub(super) fn new(
        path: &Path,
        text: &str,
        spans: impl FnOnce() -> HashMap<String, Range<usize>>,
    ) -> Self {
        let source = Source {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        Places {
            source: Arc::new(source),
            spans: Arc::new(spans()),
        }
    }

    /// The text of the shot file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Whether the author wrote this key.
    pub fn has(&self, key: &str) -> bool {
        self.spans.contains_key(key)
    }

    /// A mistake at the value of a key or, if the author left the key out, at the table around it.
    pub fn mistake(
        &self,
        key: &str,
        message: impl Into<String>,
        help: impl Into<Option<String>>,
    ) -> Mistake {
        Mistake {
            key: key.to_owned(),
            span: self.span(key),
            message: message.into(),
            label: String::new(),
            help: help.into(),
        }
    }

    /// The bytes of the value of a key, or of the innermost table or list around it that is written.
    fn span(&self, key: &str) -> Option<Range<usize>> {
        let mut rest = key;
        loop {
            if let Some(span) = self.spans.get(rest) {
                return Some(span.clone());
            }
            rest = &rest[..rest.rfind(['.', '['])?];
        }
    }
}

/// One mistake: its place, what is wrong, and a remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// Path of the key; empty if the mistake belongs to no key.
    pub key: String,
    /// The bytes of the file that are marked, if any.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub message: String,
    /// A few words under the marked bytes; may be empty.
    pub label: String,
    /// Remedy.
    pub help: Option<String>,
}

impl Mistake {
    /// The mistake with a few words under the marked bytes.
    #[must_use]
    pub fn with_label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }
}

/// All mistakes of one shot file, in the order of their places. `Display` is [`Mistakes::report`]
/// without colors.
#[derive(Debug, Clone)]
pub struct Mistakes {
    source: Arc<Source>,
    list: Vec<Mistake>,
}

impl Mistakes {
    /// Mistakes of the shot that `places` belongs to, in any order.
    pub fn new(places: &Places, mut list: Vec<Mistake>) -> Self {
        list.sort_by_key(|mistake| mistake.span.as_ref().map_or(0, |span| span.start));
        Mistakes {
            source: Arc::clone(&places.source),
            list,
        }
    }

    /// The single mistake of a file that could not be read as text.
    pub(super) fn unreadable(path: &Path, message: String, help: Option<String>) -> Self {
        let places = Places::new(path, "", HashMap::new);
        Mistakes::new(&places, vec![places.mistake("", message, help)])
    }

    /// The mistakes in order.
    pub fn iter(&self) -> impl Iterator<Item = &Mistake> {
        self.list.iter()
    }

    /// Number of mistakes.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there is no mistake.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Path of the shot file.
    pub fn path(&self) -> &Path {
        &self.source.path
    }

    pub(super) fn text(&self) -> &str {
        &self.source.text
    }
}

impl std::fmt::Display for Mistakes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.report(false))
    }
}

impl std::error::Error for Mistakes {}
