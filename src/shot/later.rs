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
    /// If it is a number other than this one.
    NumberOtherThan(f64),
    /// If it is an ascending pair other than this one.
    WindowOtherThan([f64; 2]),
    /// If it is a material's term whose weight is not the constant 0.
    Weighted,
}
use When::{Always, NumberOtherThan, Weighted, WindowOtherThan, Word};

/// Pattern of the key path (`*` a name, `[]` an index), when it is refused, what to do.
#[rustfmt::skip] // a line each
const LATER: &[(&str, When, &str)] = &[
    ("inset", Always, "leave out [[inset]]"),
    ("sequence", Always, "leave out [sequence]"),
    ("model[].node", Always, "give the nodes model files of their own"),
    ("model[].clips", Always, "leave it out: models stand as their file's nodes do"),
    ("model[].motion", Always, "leave it out: models stand as their file's nodes do"),
    ("model[].light_units", Always, "leave it out: lamps are read as \"standard\""),
    ("material.*.mirror", Weighted, "leave it out or give it the weight 0"),
    ("material.*.refraction", Weighted, "leave it out or give it the weight 0"),
    ("background.image", Always, "give the background a `spectrum`"),
    ("camera.model", Always, "place the camera with `position` and `look_at`"),
    ("camera.node", Always, "place the camera with `position` and `look_at`"),
    ("effects.bounces", NumberOtherThan(4.0), "leave it out: nothing is mirrored or refracted"),
    ("splice[].effects.bounces", Always, "leave it out: nothing is mirrored or refracted"),
    ("sensor.window", WindowOtherThan([360.0, 830.0]), "leave it out or write [360, 830]"),
    ("sensor.color", Word("bands"), "use \"cie1931\""),
    ("sensor.tone", Word("filmic"), "use \"clip\""),
    ("accuracy.spectra", Word("lines"), "use \"grid\" or \"spline\""),
    ("accuracy.spectra", Word("rgb"), "use \"grid\", and doppler = \"off\" for no shift"),
];

/// Message and help if a value is not supported yet.
pub(super) fn refusal(pattern: &str, path: &str, value: &DeValue<'_>) -> Option<(String, String)> {
    let (_, when, instead) = LATER
        .iter()
        .find(|(key, when, _)| *key == pattern && when.refuses(value))?;
    let path = short(path);
    let message = match when {
        Always => format!("`{path}` is not supported yet"),
        Weighted => format!("`{path}` of non-zero weight is not supported yet"),
        Word(word) => format!("`{path}` = {word:?} is not supported yet"),
        NumberOtherThan(number) => format!("`{path}` other than {number} is not supported yet"),
        WindowOtherThan(window) => format!("`{path}` other than {window:?} is not supported yet"),
    };
    Some((message, (*instead).to_owned()))
}

impl When {
    fn refuses(&self, value: &DeValue<'_>) -> bool {
        match self {
            Always => true,
            Word(word) => walk::text(value) == Some(word),
            NumberOtherThan(only) => {
                value.is_integer() && walk::number(value).is_some_and(|number| number != *only)
            }
            WindowOtherThan(only) => pair(value).is_some_and(|pair| {
                0.0 < pair[0] && pair[0] < pair[1] && pair[1].is_finite() && pair != *only
            }),
            Weighted => value.as_table().is_some_and(|term| {
                term.get("weight")
                    .and_then(|weight| walk::number(weight.get_ref()))
                    != Some(0.0)
            }),
        }
    }
}

fn pair(value: &DeValue<'_>) -> Option<[f64; 2]> {
    match &value.as_array()?[..] {
        [low, high] => Some([walk::number(low.get_ref())?, walk::number(high.get_ref())?]),
        _ => None,
    }
}
