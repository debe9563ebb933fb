//! Keys and words of the format that are announced but not supported yet, and are refused.
//!
//! Each has one line of [`UNSUPPORTED`]. To support it, delete the line and, if the author's types
//! lack the key or word, add it there.

use crate::shot::names::short;

/// The values for which a key is refused.
enum When {
    /// All values.
    Always,
    /// This word.
    Word(&'static str),
}
use When::{Always, Word};

/// Pattern of the key path (`*` a name, `[]` an index), values refused, remedy.
#[rustfmt::skip] // one line each
const UNSUPPORTED: &[(&str, When, &str)] = &[
    ("model[].node", Always, "give the nodes model files of their own"),
    ("model[].clips", Always, "leave it out: models stand as their file's nodes do"),
    ("model[].motion", Always, "leave it out: models stand as their file's nodes do"),
    ("camera.model", Always, "place the camera with `position` and `look_at`"),
    ("camera.node", Always, "place the camera with `position` and `look_at`"),
    ("accuracy.tracing", Word("f32"), "use \"f64\""),
    ("sensor.tone", Word("filmic"), "use \"clip\""),
];

/// Message and remedy if a value is not supported yet. `word` is the value if it is text.
pub(super) fn refusal(pattern: &str, path: &str, word: Option<&str>) -> Option<(String, String)> {
    let (_, when, instead) = UNSUPPORTED
        .iter()
        .find(|(key, when, _)| *key == pattern && when.refuses(word))?;
    let path = short(path);
    let message = match when {
        Always => format!("`{path}` is not supported yet"),
        Word(word) => format!("`{path}` = {word:?} is not supported yet"),
    };
    Some((message, (*instead).to_owned()))
}

impl When {
    fn refuses(&self, found: Option<&str>) -> bool {
        match self {
            Always => true,
            Word(word) => found == Some(word),
        }
    }
}
