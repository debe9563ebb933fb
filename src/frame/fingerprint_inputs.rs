//! The values that reach a frame's pixels, each by the key that its author would change.

use super::fingerprint::Resolution;
use crate::shot::{Exposure, Format, Layer, Shot};
use indexmap::IndexMap;
use serde_json::{Map, Value, json};

/// Values by key: a short one as it stands in JSON, a long one by its hash.
pub(super) type FingerprintInputs = IndexMap<String, String>;

/// Longest value that is kept as it stands, bytes.
const LONGEST: usize = 40;

/// Which pixels are asked about.
#[derive(Clone, Copy)]
pub(super) enum For<'a> {
    /// Those of the small render that exposure is metered on.
    Metering,
    /// Those of the frame's files.
    Output {
        /// Their size and samples.
        picture: Resolution,
        /// The parts of the frame that exposure is metered on, hashed; None where it is authored.
        metered: Option<&'a str>,
    },
}

/// What the pixels of a shot of one frame are made of, its files aside.
pub(super) fn inputs(still: &Shot, pixels: For<'_>) -> FingerprintInputs {
    let mut parts = FingerprintInputs::new();
    let Value::Object(mut sections) = still.to_json() else {
        return parts;
    };
    for unseen in ["sequence", "output", "inset"] {
        sections.shift_remove(unseen);
    }
    remove(&mut sections, "shot", &["title", "frames", "fps"]);
    remove(&mut sections, "image", &["size", "samples"]);
    remove(&mut sections, "sensor", &["exposure"]);
    for light in sections
        .get_mut("light")
        .and_then(Value::as_array_mut)
        .into_iter()
        .flatten()
    {
        light
            .as_object_mut()
            .map(|light| light.shift_remove("name"));
    }
    let used = still.used_spectra();
    if let Some(Value::Object(spectra)) = sections.get_mut("spectrum") {
        spectra.retain(|name, _| used.contains(name.as_str()));
        if spectra.is_empty() {
            sections.shift_remove("spectrum");
        }
    }
    if let Some(image) = sections.get_mut("image") {
        image["aspect"] = json!(aspect(still.image.size));
    }
    match pixels {
        For::Metering => remove(&mut sections, "sensor", &["tone"]),
        For::Output { picture, metered } => {
            parts.insert("size".to_owned(), json!(picture.size).to_string());
            parts.insert("samples".to_owned(), picture.samples.to_string());
            written(still, &mut sections);
            if let Some(metered) = metered {
                let key = "frame 1, on which exposure is metered";
                parts.insert(key.to_owned(), metered.to_owned());
            }
        }
    }
    add(&Value::Object(sections), &mut String::new(), &mut parts);
    parts
}

/// Adds what only files show: exposure where it is authored, layers, insets.
fn written(still: &Shot, sections: &mut Map<String, Value>) {
    let output = &still.output;
    let mut put = |section: &str, key: &str, value: Value| {
        let section = sections.entry(section).or_insert_with(|| json!({}));
        section[key] = value;
    };
    if let Exposure::Stops(stops) = &still.sensor.exposure {
        put("sensor", "exposure", json!(stops));
    }
    if output.formats.contains(&Format::Exr) {
        put("output", "depth", json!(output.depth));
        put("output", "layers", json!(output.layers));
        if output.layers.contains(&Layer::Worldline) {
            // The layer has their numbers.
            let names: Vec<&String> = still.worldline.keys().collect();
            put("output", "worldlines", json!(names));
        }
    }
    if output.formats.contains(&Format::Png) && !still.inset.is_empty() {
        // Their pixels are those of an image of the full size.
        put("image", "size", json!(still.image.size));
        sections.insert("inset".to_owned(), json!(still.inset));
    }
}

/// Width to height in lowest terms: all that a camera reads of the full size.
pub(super) fn aspect([width, height]: [u32; 2]) -> [u32; 2] {
    let (mut a, mut b) = (width, height);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    [width / a.max(1), height / a.max(1)]
}

fn remove(sections: &mut Map<String, Value>, section: &str, keys: &[&str]) {
    if let Some(Value::Object(section)) = sections.get_mut(section) {
        for key in keys {
            section.shift_remove(*key);
        }
    }
}

/// Adds the leaves of a value; lists are leaves but for those of tables.
fn add(value: &Value, key: &mut String, parts: &mut FingerprintInputs) {
    let length = key.len();
    match value {
        Value::Object(object) => {
            for (name, value) in object {
                if length > 0 {
                    key.push('.');
                }
                key.push_str(name);
                add(value, key, parts);
                key.truncate(length);
            }
            // A name is worth a part, also of what has no keys: a material without terms is black.
            if object.is_empty() {
                parts.insert(key.clone(), "{}".to_owned());
            }
        }
        Value::Array(items) if items.first().is_some_and(Value::is_object) => {
            for (i, item) in items.iter().enumerate() {
                key.push_str(&format!("[{i}]"));
                add(item, key, parts);
                key.truncate(length);
            }
        }
        leaf => {
            let text = leaf.to_string();
            let short = if text.len() <= LONGEST {
                text
            } else {
                short_hash(text.as_bytes())
            };
            parts.insert(key.clone(), short);
        }
    }
}

/// `#` and 16 hexadecimal digits of a hash.
pub(super) fn short_hash(bytes: &[u8]) -> String {
    format!("#{}", &blake3::hash(bytes).to_hex()[..16])
}

/// BLAKE3 of parts, in whatever order their author wrote them.
pub(super) fn hash(parts: &FingerprintInputs) -> blake3::Hash {
    let mut sorted: Vec<(&String, &String)> = parts.iter().collect();
    sorted.sort_unstable();
    let mut hasher = blake3::Hasher::new();
    for text in sorted.into_iter().flat_map(|(key, value)| [key, value]) {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.finalize()
}
