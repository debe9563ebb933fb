//! The JSON schema of the shot format (draft-07), generated from the author's types. Editors,
//! `restframe schema` and the walk that finds mistakes all use this one.

use crate::shot::Shot;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::sync::LazyLock;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let mut schema = SchemaSettings::draft07()
        .into_generator()
        .into_root_schema_for::<Shot>()
        .to_value();
    drop_null(&mut schema);
    schema
});

/// The JSON schema of a shot file, the same bytes in every run.
pub fn schema() -> Value {
    SCHEMA.clone()
}

/// The schema without a copy.
pub(super) fn shared() -> &'static Value {
    &SCHEMA
}

/// Removes null from a schema: TOML has none, and an optional key is left out instead.
fn drop_null(schema: &mut Value) {
    match schema {
        Value::Array(items) => items.iter_mut().for_each(drop_null),
        Value::Object(object) => {
            object.retain(|key, value| !(key == "default" && value.is_null()));
            drop_null_type(object);
            drop_null_alternative(object);
            object.values_mut().for_each(drop_null);
        }
        _ => {}
    }
}

fn drop_null_type(object: &mut Map<String, Value>) {
    let Some(Value::Array(types)) = object.get_mut("type") else {
        return;
    };
    types.retain(|kind| kind != "null");
    if let [only] = types.as_slice() {
        let only = only.clone();
        object.insert("type".into(), only);
    }
}

fn drop_null_alternative(object: &mut Map<String, Value>) {
    let Some(Value::Array(alternatives)) = object.get_mut("anyOf") else {
        return;
    };
    alternatives.retain(|alternative| alternative.get("type").is_none_or(|kind| kind != "null"));
    if alternatives.len() == 1
        && let Some(only) = object.remove("anyOf")
    {
        object.insert("allOf".into(), only);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schema_is_draft_07_and_forbids_unknown_keys() {
        let schema = schema();
        assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
        assert_eq!(schema["additionalProperties"], false);
    }

    #[test]
    fn every_key_says_what_it_is() {
        fn check(schema: &Value, at: &str) {
            if let Some(keys) = schema["properties"].as_object() {
                for (key, property) in keys {
                    assert!(
                        property["description"].is_string(),
                        "{at}.{key} is not described"
                    );
                }
            }
            match schema {
                Value::Object(object) => object
                    .iter()
                    .for_each(|(key, value)| check(value, &format!("{at}.{key}"))),
                Value::Array(items) => items.iter().for_each(|item| check(item, at)),
                _ => {}
            }
        }
        check(&schema(), "");
    }

    #[test]
    fn moving_values_are_defined_once_under_names_of_their_own() {
        let schema = schema();
        let names: Vec<&String> = schema["definitions"].as_object().unwrap().keys().collect();
        let tracks: Vec<_> = names
            .iter()
            .filter(|name| name.starts_with("Track"))
            .collect();
        assert_eq!(tracks.len(), 2, "{tracks:?}");
    }

    #[test]
    fn null_is_nowhere_in_it() {
        assert!(!schema().to_string().contains("null"));
    }
}
