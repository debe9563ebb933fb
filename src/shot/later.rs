//! Keys and words of the format that are known and refused because nothing renders them yet.
//!
//! Each stands in one line of [`LATER`]; supporting it means deleting that line (and, for a
//! key or word that the author's types lack, adding it there).

use super::names::short;
use super::walk;
use toml::de::DeValue;

/// When a key is refused.
enum When {
    /// Whatever its value.
    Always,
    /// If it is this word.
    Word(&'static str),
}
use When::{Always, Word};

/// Pattern of the key path (`*` a name, `[]` an index), when it is refused, what to do.
#[rustfmt::skip] // a line each
const LATER: &[(&str, When, &str)] = &[
    ("model[].node", Always, "give the nodes model files of their own"),
    ("model[].clips", Always, "leave it out: models stand as their file's nodes do"),
    ("model[].motion", Always, "leave it out: models stand as their file's nodes do"),
    ("camera.model", Always, "place the camera with `position` and `look_at`"),
    ("camera.node", Always, "place the camera with `position` and `look_at`"),
    ("accuracy.tracing", Word("f32"), "use \"f64\""),
    ("sensor.tone", Word("filmic"), "use \"clip\""),
];

/// Message and help if a value is not supported yet.
pub(super) fn refusal(pattern: &str, path: &str, value: &DeValue<'_>) -> Option<(String, String)> {
    let (_, when, instead) = LATER
        .iter()
        .find(|(key, when, _)| *key == pattern && when.refuses(value))?;
    let path = short(path);
    let message = match when {
        Always => format!("`{path}` is not supported yet"),
        Word(word) => format!("`{path}` = {word:?} is not supported yet"),
    };
    Some((message, (*instead).to_owned()))
}

impl When {
    fn refuses(&self, value: &DeValue<'_>) -> bool {
        match self {
            Always => true,
            Word(word) => walk::text(value) == Some(word),
        }
    }
}
