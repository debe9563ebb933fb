//! The JSON of a glTF file as a tree.
//!
//! Violations of JSON whose meaning is clear are repaired: zero bytes after the end, letters that are
//! not UTF-8, raw line breaks in strings, whole numbers written as `1.0`.

use crate::shot::text::is_utf16;
use serde::de::Error;
use serde_json::Value;

/// 2⁵³: up to here every whole number has a float of its own.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// The JSON of a glTF file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GltfJson {
    /// The tree; every whole number from 0 to 2⁵³ is an integer.
    pub value: Value,
    /// Faults of the text that were repaired.
    pub faults: Vec<TextFault>,
}

/// A fault of the text that does not keep it from being read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextFault {
    /// Letters in another encoding than UTF-8, each read as U+FFFD.
    NotUtf8 {
        /// Line number of the first, from 1.
        line: usize,
    },
    /// Raw control characters, such as line breaks, within strings, read as blanks.
    ControlCharacters,
}

impl GltfJson {
    /// Parses the text of a .gltf file or of the JSON chunk of a .glb file.
    ///
    /// # Errors
    /// The error of the JSON parser.
    pub fn parse(text: &[u8]) -> Result<Self, serde_json::Error> {
        let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        if is_utf16(text) {
            return Err(Error::custom("it is UTF-16: save it as UTF-8"));
        }
        let end = text.iter().rposition(|&byte| byte != 0);
        let text = &text[..end.map_or(0, |end| end + 1)];
        let mut json = match serde_json::from_slice(text) {
            Ok(value) => Self {
                value,
                faults: Vec::new(),
            },
            Err(_) => Self::repaired(text)?,
        };
        make_whole(&mut json.value);
        Ok(json)
    }

    fn repaired(text: &[u8]) -> Result<Self, serde_json::Error> {
        let mut faults = Vec::new();
        if let Err(error) = std::str::from_utf8(text) {
            let before = &text[..error.valid_up_to()];
            let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
            faults.push(TextFault::NotUtf8 { line });
        }
        let readings = [lossy(text), without_second_halves(text)];
        let error = match serde_json::from_str(&readings[0]) {
            Ok(value) => return Ok(Self { value, faults }),
            Err(error) => error,
        };
        if let Ok(value) = serde_json::from_str(&readings[1]) {
            return Ok(Self { value, faults });
        }
        faults.push(TextFault::ControlCharacters);
        let blanked = |text: &String| text.replace(|c| ('\u{1}'..' ').contains(&c), " ");
        let mut blanked = readings.iter().map(blanked);
        let value = blanked.find_map(|text| serde_json::from_str(&text).ok());
        value.map(|value| Self { value, faults }).ok_or(error)
    }
}

fn lossy(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

/// The text without the backslashes that are second bytes of letters in Shift-JIS, Big5 and GBK, as
/// in `"表"`, 95 5C. JSON would take them for the beginning of an escape.
fn without_second_halves(text: &[u8]) -> String {
    let mut legible = String::with_capacity(text.len());
    let mut after_half = false;
    for chunk in text.utf8_chunks() {
        let valid = chunk.valid();
        let skipped = valid.strip_prefix('\\').filter(|_| after_half);
        legible.push_str(skipped.unwrap_or(valid));
        after_half = !chunk.invalid().is_empty();
        if after_half {
            legible.push(char::REPLACEMENT_CHARACTER);
        }
    }
    legible
}

/// Turns whole numbers written as floats into integers.
fn make_whole(value: &mut Value) {
    match value {
        Value::Number(number) => {
            let float = number.as_f64().filter(|_| number.is_f64());
            let whole = float.filter(|v| v.is_sign_positive() && *v <= EXACT && v.fract() == 0.0);
            if let Some(whole) = whole {
                *value = Value::from(whole as u64);
            }
        }
        Value::Array(list) => list.iter_mut().for_each(make_whole),
        Value::Object(map) => map.values_mut().for_each(make_whole),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &[u8]) -> Value {
        GltfJson::parse(text).unwrap_or_default().value
    }

    #[test]
    fn whole_numbers_are_integers_however_they_are_written() {
        for (text, is_whole) in [
            ("3", true),
            ("3.0", true),
            ("3e2", true),
            ("0.0", true),
            ("9007199254740992.0", true),
            ("0.5", false),
            ("-0.0", false),
            ("1e17", false),
        ] {
            assert_eq!(value(text.as_bytes()).is_u64(), is_whole, "{text}");
        }
        assert_eq!(value(b"[{\"a\": 4.0}]")[0]["a"], Value::from(4));
    }

    #[test]
    fn names_in_any_encoding_leave_the_rest_legible() {
        for (name, line) in [
            (&b"T\xFCr"[..], 2),
            (b"\x95\x5C", 2),
            (b"\x83\x5C\x83\x67", 2),
            (b"\xE9\\\"x", 2),
            (b"\xE0\xA4", 2),
        ] {
            let text = [b"{\n\"name\": \"", name, b"\", \"mesh\": 7}\0\0"].concat();
            let json = GltfJson::parse(&text).unwrap_or_default();
            assert_eq!(json.value["mesh"], 7, "{name:?}");
            assert_eq!(json.faults, [TextFault::NotUtf8 { line }]);
        }
    }

    #[test]
    fn raw_line_breaks_in_text_are_blanks_and_zeros_within_are_a_fault() {
        let json = GltfJson::parse(b"{\r\n\"uri\": \"AB\r\nC\"}").unwrap_or_default();
        assert_eq!(json.value["uri"], "AB  C");
        assert_eq!(json.faults, [TextFault::ControlCharacters]);
        assert!(GltfJson::parse(b"{\"uri\": \"A\0B\"}").is_err());
        assert!(GltfJson::parse(b"{\"uri\": 1} 2").is_err());
    }

    #[test]
    fn utf_16_is_named() {
        let text: Vec<u8> = "{}".encode_utf16().flat_map(u16::to_le_bytes).collect();
        for text in [text.clone(), [&[0xFF, 0xFE][..], &text].concat()] {
            let error = GltfJson::parse(&text)
                .map(|_| ())
                .map_err(|e| e.to_string());
            assert!(error.is_err_and(|e| e.contains("UTF-16")));
        }
    }
}
