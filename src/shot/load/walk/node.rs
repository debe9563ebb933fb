//! One node of the JSON schema with its references followed: which values it takes, and how a message
//! describes them.

use super::super::schema;
use crate::shot::names::nearest;
use serde_json::{Map, Value};

/// Number of allowed words that a message lists at most.
const MAX_WORDS: usize = 6;

/// The range of a number: the four bounds of JSON schema.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Bounds {
    minimum: Option<f64>,
    maximum: Option<f64>,
    above: Option<f64>,
    below: Option<f64>,
}

impl Bounds {
    /// The bounds at a schema node; those that it does not set are those of `outer`.
    fn at(object: &Map<String, Value>, outer: Bounds) -> Bounds {
        let read =
            |key: &str, outer: Option<f64>| object.get(key).and_then(Value::as_f64).or(outer);
        Bounds {
            minimum: read("minimum", outer.minimum),
            maximum: read("maximum", outer.maximum),
            above: read("exclusiveMinimum", outer.above),
            below: read("exclusiveMaximum", outer.below),
        }
    }

    /// The bound that a value violates, in words.
    pub(super) fn broken_by(&self, value: f64) -> Option<String> {
        let words = [
            self.minimum
                .filter(|bound| value < *bound)
                .map(|bound| format!("at least {}", written(bound))),
            self.above
                .filter(|bound| value <= *bound)
                .map(|bound| format!("above {bound}")),
            self.maximum
                .filter(|bound| value > *bound)
                .map(|bound| format!("at most {}", written(bound))),
            self.below
                .filter(|bound| value >= *bound)
                .map(|bound| format!("below {bound}")),
        ];
        words.into_iter().flatten().next()
    }
}

/// A schema node. Its bounds hold for every number inside: those of a key hold for its ramp too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node<'a> {
    object: Option<&'a Map<String, Value>>,
    bounds: Bounds,
    help: Option<&'a str>,
}

impl<'a> Node<'a> {
    pub(super) fn new(schema: &'a Value) -> Self {
        Node {
            object: None,
            bounds: Bounds::default(),
            help: None,
        }
        .child(schema)
    }

    /// The node that `schema` describes inside this one.
    fn child(&self, schema: &'a Value) -> Self {
        let mut node = Node {
            object: schema.as_object(),
            ..*self
        };
        while let Some(object) = node.object {
            node.bounds = Bounds::at(object, node.bounds);
            node.help = node
                .help
                .or(object.get("description").and_then(Value::as_str));
            let target = object.get("$ref").and_then(Value::as_str).map(referred);
            match target.or_else(|| object.get("allOf").map(|all| &all[0])) {
                Some(target) => node.object = target.as_object(),
                None => break,
            }
        }
        node
    }

    fn get(&self, key: &str) -> Option<&'a Value> {
        self.object?.get(key)
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The doc comment of the key, which messages quote as help.
    pub(super) fn help(&self) -> Option<String> {
        self.help
            .map(|help| help.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// All forms that the value can take, each without alternatives of its own.
    pub(super) fn alternatives(&self) -> Vec<Node<'a>> {
        match self.get("anyOf").and_then(Value::as_array) {
            Some(forms) => forms
                .iter()
                .flat_map(|form| self.child(form).alternatives())
                .collect(),
            None => vec![*self],
        }
    }

    /// Whether it is of this JSON type.
    pub(super) fn is(&self, kind: &str) -> bool {
        self.get("type").is_some_and(|name| name == kind)
    }

    /// Whether it can be a value of this JSON type.
    pub(super) fn takes(&self, kind: &str) -> bool {
        match kind {
            "integer" => self.is("integer") || self.is("number"),
            "string" => self.is("string") || !self.words().is_empty(),
            _ => self.is(kind),
        }
    }

    /// The words to choose from; empty if the node is not a choice of words.
    pub(super) fn words(&self) -> Vec<&'a str> {
        let listed = self
            .get("enum")
            .and_then(Value::as_array)
            .into_iter()
            .flatten();
        let described = self
            .get("oneOf")
            .and_then(Value::as_array)
            .into_iter()
            .flatten();
        let described = described.flat_map(|word| {
            let several = word
                .get("enum")
                .and_then(Value::as_array)
                .into_iter()
                .flatten();
            word.get("const").into_iter().chain(several)
        });
        let own = self.get("const").into_iter();
        listed
            .chain(described)
            .chain(own)
            .filter_map(Value::as_str)
            .collect()
    }

    pub(super) fn keys(&self) -> impl Iterator<Item = &'a str> + Clone {
        self.get("properties")
            .and_then(Value::as_object)
            .into_iter()
            .flat_map(|p| p.keys().map(String::as_str))
    }

    pub(super) fn required(&self) -> impl Iterator<Item = &'a str> {
        self.get("required")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
    }

    /// The node of a key. Values of a ramp inherit its bounds and help; keys of a table do not.
    pub(super) fn property(&self, key: &str) -> Option<Node<'a>> {
        let schema = self.get("properties")?.get(key)?;
        if self.is_track() {
            Some(self.child(schema))
        } else {
            Some(Node::new(schema))
        }
    }

    /// The node of the entries of a table whose keys are names of the author's choice.
    pub(super) fn entries(&self) -> Option<Node<'a>> {
        self.get("additionalProperties")
            .filter(|schema| schema.is_object())
            .map(Node::new)
    }

    /// Whether the node is a ramp or keys.
    pub(super) fn is_track(&self) -> bool {
        let mut keys = self.keys();
        keys.clone().any(|key| key == "from") || keys.any(|key| key == "ease")
    }

    /// The node of the item at index `i`. In a `[frame, value]` pair the bounds hold for the value only.
    pub(super) fn item(&self, i: usize) -> Node<'a> {
        match self.get("items") {
            Some(Value::Array(items)) if i + 1 < items.len() => Node::new(&items[i]),
            Some(Value::Array(items)) => items.last().map_or(*self, |last| self.child(last)),
            Some(items) => self.child(items),
            None => *self,
        }
    }

    fn length(&self, key: &str) -> Option<usize> {
        self.get(key)
            .and_then(Value::as_u64)
            .and_then(|length| usize::try_from(length).ok())
    }

    /// Whether the node is a list of bounded length, such as a vector.
    pub(super) fn is_fixed(&self) -> bool {
        self.length("maxItems").is_some()
    }

    /// The allowed lengths of a list in words; None if `length` is one of them.
    pub(super) fn wrong_length(&self, length: usize) -> Option<String> {
        let (least, most) = (self.length("minItems"), self.length("maxItems"));
        if least.is_none_or(|least| length >= least) && most.is_none_or(|most| length <= most) {
            return None;
        }
        match (least, most) {
            (Some(least), Some(most)) if least == most => Some(format!("{least} entries")),
            (Some(1), None) => Some("at least one entry".into()),
            (Some(least), None) => Some(format!("at least {least} entries")),
            (_, most) => Some(format!("at most {} entries", most.unwrap_or(0))),
        }
    }

    /// How well a key fits this form: 2 if it is one of its keys, 1 if it is close to one, else 0.
    pub(super) fn likeness(&self, key: &str) -> u32 {
        match (
            self.property(key),
            nearest(key, self.keys()),
            self.entries(),
        ) {
            (Some(_), ..) => 2,
            (None, Some(_), _) | (_, _, Some(_)) => 1,
            _ => 0,
        }
    }

    /// The values that the node takes, in words.
    pub(super) fn wanted(&self) -> String {
        let words = self.words();
        let kind = self.get("type").and_then(Value::as_str).unwrap_or_default();
        match kind {
            _ if !words.is_empty() => {
                list_of(words.iter().take(MAX_WORDS).map(|word| format!("{word:?}")))
            }
            "integer" => "a whole number".into(),
            "number" => "a number".into(),
            "string" => "a string".into(),
            "boolean" => "true or false".into(),
            "array" if self.is_fixed() && self.item(0).is("number") => {
                format!(
                    "a vector of {} numbers",
                    self.length("maxItems").unwrap_or(0)
                )
            }
            "array" => "a list".into(),
            _ => match self.required().collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => "a table".into(),
                keys => format!("{{ {keys} }}"),
            },
        }
    }
}

/// The definition that a reference such as `#/definitions/Track` names.
fn referred(reference: &str) -> &'static Value {
    schema::shared()
        .pointer(reference.trim_start_matches('#'))
        .unwrap_or(&Value::Null)
}

/// A list in words, "a, b or c", without repetitions.
pub(super) fn list_of(items: impl Iterator<Item = String>) -> String {
    let mut list: Vec<String> = Vec::new();
    for item in items {
        if !list.contains(&item) {
            list.push(item);
        }
    }
    match list.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::new(),
    }
}

/// A bound as an author would write it, with exponents for large and small numbers.
fn written(bound: f64) -> String {
    if bound.abs() >= 1e7 || (bound != 0.0 && bound.abs() < 1e-4) {
        format!("{bound:e}")
    } else {
        bound.to_string()
    }
}
