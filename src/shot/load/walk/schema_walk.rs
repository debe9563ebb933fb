//! The walk itself: values against their schema nodes.
//!
//! Where a value can take several forms (a number, or `{ from, to }`, or …), the form is chosen by
//! what the author wrote. The schema is finite, and so is the depth of the walk, whatever the file
//! holds.

use super::super::{schema, unsupported};
use super::key_path::{At, join};
use super::keyframes::{last_frame, mistaken_keys};
use super::node::{Node, list_of};
use super::value::{as_number, as_text, is_array_of_tables, kind_of, shown};
use crate::shot::names::{did_you_mean, nearest, short};
use crate::shot::{Mistake, Places};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::collections::HashMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Label of the table in which a required key is missing.
pub(in super::super) const MISSING: &str = "missing here";

/// Result of the walk: mistakes, and what the checks need to know of the file.
pub(in super::super) struct Walk<'a> {
    places: &'a Places,
    last_frame: Option<f64>,
    pub(in super::super) mistakes: Vec<Mistake>,
    /// The author's names in each table of names, also those of mistaken entries.
    pub(in super::super) names: HashMap<String, Vec<String>>,
    /// For each list that lost mistaken entries, the indices of those that are left.
    pub(in super::super) kept: HashMap<String, Vec<usize>>,
}

impl<'a> Walk<'a> {
    /// Walks a whole shot. The value lacks what is mistaken, but can be deserialized.
    pub(in super::super) fn shot(tree: &DeTable<'_>, places: &'a Places) -> (Value, Self) {
        let mut walk = Walk {
            places,
            last_frame: last_frame(tree),
            mistakes: Vec::new(),
            names: HashMap::new(),
            kept: HashMap::new(),
        };
        let (mut shot, _) = walk.table(tree, &Node::new(schema::shared()), &At::default());
        shot.entry("model")
            .or_insert_with(|| Value::Array(Vec::new()));
        shot.entry("camera")
            .or_insert_with(|| Value::Object(Map::new()));
        (Value::Object(shot), walk)
    }

    fn report(&mut self, at: &At, message: String, help: Option<String>) {
        self.mistakes
            .push(self.places.mistake(&at.path, message, help));
    }

    /// Checks a value against its schema. Returns it as JSON, or None if it is mistaken.
    fn value(&mut self, item: &Spanned<DeValue<'_>>, node: &Node<'_>, at: &At) -> Option<Value> {
        if let Some((message, help)) =
            unsupported::refusal(&at.pattern, &at.path, as_text(item.get_ref()))
        {
            self.report(at, message, Some(help));
            return None;
        }
        let forms = node.alternatives();
        let fitting: Vec<&Node<'_>> = forms
            .iter()
            .filter(|form| form.takes(kind_of(item.get_ref())))
            .collect();
        match fitting.as_slice() {
            [] => {
                self.wrong_type(item.get_ref(), &forms, at);
                None
            }
            [only] => self.form(item, only, at),
            several => self.best_form(item, several, at),
        }
    }

    fn wrong_type(&mut self, found: &DeValue<'_>, forms: &[Node<'_>], at: &At) {
        let wanted = list_of(forms.iter().map(Node::wanted));
        let message = format!(
            "`{}` must be {wanted}, not {}",
            short(&at.path),
            shown(found)
        );
        let single = !at.path.contains(['.', '[']);
        let help = match found {
            DeValue::Table(_) if single && forms.iter().any(|form| form.takes("array")) => {
                Some(format!("write [[{0}]] in place of [{0}]", at.path))
            }
            DeValue::Array(_) if single && is_array_of_tables(found) => Some(format!(
                "there is one only: write [{0}] in place of [[{0}]]",
                at.path
            )),
            _ => forms.first().and_then(Node::help),
        };
        self.report(at, message, help);
    }

    /// Chooses among several forms of the same type the one that shares most keys with the value and,
    /// among these, the one with the fewest mistakes.
    fn best_form(
        &mut self,
        item: &Spanned<DeValue<'_>>,
        forms: &[&Node<'_>],
        at: &At,
    ) -> Option<Value> {
        let likeness = |form: &Node<'_>| match item.get_ref() {
            DeValue::Table(table) => table.keys().map(|key| form.likeness(key.get_ref())).sum(),
            _ => 1,
        };
        let best = forms.iter().map(|form| likeness(form)).max().unwrap_or(0);
        if best == 0 {
            let wanted = list_of(forms.iter().map(|form| form.wanted()));
            let message = format!(
                "`{}` must be {wanted}: this table is none of them",
                short(&at.path)
            );
            self.report(at, message, forms.first().and_then(|form| form.help()));
            return None;
        }
        let earlier = std::mem::take(&mut self.mistakes);
        let trials = forms
            .iter()
            .filter(|form| likeness(form) == best)
            .map(|form| {
                let value = self.form(item, form, at);
                (std::mem::take(&mut self.mistakes), value)
            });
        let least = trials.min_by_key(|(mistakes, _)| mistakes.len());
        self.mistakes = earlier;
        let (mistakes, value) = least?;
        self.mistakes.extend(mistakes);
        value
    }

    fn form(&mut self, item: &Spanned<DeValue<'_>>, form: &Node<'_>, at: &At) -> Option<Value> {
        match item.get_ref() {
            DeValue::String(text) => self.word(text, form, at),
            DeValue::Integer(_) | DeValue::Float(_) => self.number(item.get_ref(), form, at),
            DeValue::Boolean(value) => Some(Value::Bool(*value)),
            DeValue::Array(items) => self.array(items, form, at),
            DeValue::Table(table) => {
                let (object, whole) = self.table(table, form, at);
                whole.then_some(Value::Object(object))
            }
            DeValue::Datetime(_) => None,
        }
    }

    fn word(&mut self, text: &str, form: &Node<'_>, at: &At) -> Option<Value> {
        let words = form.words();
        if words.is_empty() || words.contains(&text) {
            return Some(Value::String(text.to_owned()));
        }
        let message = format!("`{}` cannot be {:?}", short(&at.path), short(text));
        let help = did_you_mean(text, words.into_iter(), "one of");
        self.report(at, message, help);
        None
    }

    fn number(&mut self, item: &DeValue<'_>, form: &Node<'_>, at: &At) -> Option<Value> {
        let value = as_number(item)?;
        if !value.is_finite() {
            let message = format!(
                "`{}` must be a finite number, not {}",
                short(&at.path),
                shown(item)
            );
            self.report(at, message, form.help());
            return None;
        }
        if let Some(bound) = form.bounds().broken_by(value) {
            let message = format!("`{}` must be {bound}, not {}", short(&at.path), shown(item));
            self.report(at, message, form.help());
            return None;
        }
        // Whole numbers are bounded to 32 bits, which f64 holds exactly.
        if form.is("integer") {
            Some(Value::from(value as i64))
        } else {
            Some(Value::from(value))
        }
    }

    fn array(&mut self, items: &[Spanned<DeValue<'_>>], form: &Node<'_>, at: &At) -> Option<Value> {
        if let Some(wanted) = form.wrong_length(items.len()) {
            let message = format!(
                "`{}` must have {wanted}, not {}",
                short(&at.path),
                items.len()
            );
            self.report(at, message, form.help());
            return None;
        }
        let values: Vec<Option<Value>> = items
            .iter()
            .enumerate()
            .map(|(i, item)| self.value(item, &form.item(i), &at.index(i)))
            .collect();
        let whole = values.iter().all(Option::is_some);
        if whole || at.path.contains(['.', '[']) || form.is_fixed() {
            return values
                .into_iter()
                .collect::<Option<Vec<_>>>()
                .map(Value::Array);
        }
        let (indices, values) = values
            .into_iter()
            .enumerate()
            .filter_map(|(i, value)| Some((i, value?)))
            .unzip();
        self.kept.insert(at.path.clone(), indices);
        Some(Value::Array(values))
    }

    /// A table as JSON without mistaken values, and whether it has all required keys.
    fn table(
        &mut self,
        table: &DeTable<'_>,
        form: &Node<'_>,
        at: &At,
    ) -> (Map<String, Value>, bool) {
        let mut object = Map::new();
        let mut meant = Vec::new();
        for (key, item) in in_file_order(table) {
            let name = key.get_ref().as_ref();
            let (child, below) = match (form.property(name), form.entries()) {
                (Some(child), _) => (child, at.key(name)),
                (None, Some(child)) => (child, at.name(name)),
                (None, None) => {
                    meant.extend(self.unknown(key, item.get_ref(), form, at));
                    continue;
                }
            };
            if let Some(value) = self.value(item, &child, &below) {
                object.insert(name.to_owned(), value);
            }
        }
        if form.entries().is_some() {
            let names = table.keys().map(|key| key.get_ref().to_string()).collect();
            self.names.insert(at.path.clone(), names);
        }
        if form.is_track() {
            for mistaken in mistaken_keys(table, self.last_frame) {
                let here = at.key("keys").index(mistaken.index).index(0);
                self.report(&here, mistaken.message, Some(mistaken.help.to_owned()));
            }
        }
        for key in form
            .required()
            .filter(|key| !table.contains_key(*key) && !meant.contains(key))
        {
            self.missing(key, form, at);
        }
        let whole = form.required().all(|key| object.contains_key(key));
        (object, whole)
    }

    fn missing(&mut self, key: &str, form: &Node<'_>, at: &At) {
        let child = form.property(key);
        let help = child.and_then(|child| child.help());
        let shown = match child {
            Some(child) if at.path.is_empty() && child.is("array") => format!("[[{key}]]"),
            Some(_) if at.path.is_empty() => format!("[{key}]"),
            _ => format!("`{key}`"),
        };
        let message = format!("{} needs {shown}", at.holder());
        let mistake = self
            .places
            .mistake(&at.path, message, help)
            .with_label(MISSING);
        self.mistakes.push(Mistake {
            key: join(&at.path, key),
            ..mistake
        });
    }

    /// Reports an unknown key. Returns the key that was perhaps meant.
    fn unknown<'n>(
        &mut self,
        key: &Spanned<Cow<'_, str>>,
        item: &DeValue<'_>,
        form: &Node<'n>,
        at: &At,
    ) -> Option<&'n str> {
        let name = key.get_ref().as_ref();
        let below = at.key(name);
        let mut mistake = match unsupported::refusal(&below.pattern, &below.path, as_text(item)) {
            Some((message, help)) => self.places.mistake(&below.path, message, help),
            None => self.places.mistake(
                &below.path,
                format!("unknown key `{}` in {}", short(name), at.holder()),
                did_you_mean(name, form.keys(), "there are"),
            ),
        };
        mistake.span = Some(key.span());
        self.mistakes.push(mistake);
        nearest(name, form.keys())
    }
}

type Entry<'t, 'i> = (&'t Spanned<Cow<'i, str>>, &'t Spanned<DeValue<'i>>);

/// The entries of a table as its author ordered them; the parser sorts them by name.
fn in_file_order<'t, 'i>(table: &'t DeTable<'i>) -> Vec<Entry<'t, 'i>> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries
}
