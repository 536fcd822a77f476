//! TOML as a tree that remembers for every key and value where it was written.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::phrase::Entries;
use super::place::{Location, Source};

/// A span in one of the texts; text 0 is the file, text `i + 1` is override `i`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) text: usize,
    pub(super) span: Range<usize>,
}

/// A value and where it was written.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) place: Place,
}

#[derive(Debug, Clone)]
pub(super) enum Value {
    Text(String),
    Integer(i128),
    Float(f64),
    Boolean(bool),
    Datetime(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) place: Place,
    pub(super) node: Node,
}

impl Node {
    pub(super) fn from_toml(value: &Spanned<DeValue<'_>>, text: usize, shift: usize) -> Self {
        let span = value.span();
        let place = Place { text, span: span.start + shift..span.end + shift };
        let value = match value.get_ref() {
            DeValue::String(string) => Value::Text(string.to_string()),
            DeValue::Integer(integer) => integer_value(integer.as_str(), integer.radix()),
            DeValue::Float(float) => Value::Float(float.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(boolean) => Value::Boolean(*boolean),
            DeValue::Datetime(datetime) => Value::Datetime(datetime.to_string()),
            DeValue::Array(list) => Value::List(list.iter().map(|item| Self::from_toml(item, text, shift)).collect()),
            DeValue::Table(table) => Value::Table(entries(table, text, shift)),
        };
        Self { value, place }
    }

    pub(super) fn root(table: &Spanned<DeTable<'_>>) -> Self {
        Self { value: Value::Table(entries(table.get_ref(), 0, 0)), place: Place { text: 0, span: 0..0 } }
    }

    /// What a reader of the file would call this value, for messages.
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("the string {text:?}"),
            Value::Integer(integer) => format!("the integer {integer}"),
            Value::Float(float) => format!("the number {float:?}"),
            Value::Boolean(boolean) => format!("the boolean {boolean}"),
            Value::Datetime(datetime) => format!("the date {datetime}"),
            Value::List(list) => format!("a list of {}", Entries(list.len())),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

/// In written order, which is the order errors are looked for.
fn entries(table: &DeTable<'_>, text: usize, shift: usize) -> Vec<Entry> {
    let mut entries: Vec<Entry> = table
        .iter()
        .map(|(key, value)| {
            let span = key.span();
            Entry {
                key: key.get_ref().to_string(),
                place: Place { text, span: span.start + shift..span.end + shift },
                node: Node::from_toml(value, text, shift),
            }
        })
        .collect();
    entries.sort_by_key(|entry| entry.place.span.start);
    entries
}

/// An integer beyond 128 bits is kept as the nearest number, and the range check says what it thinks of it.
fn integer_value(digits: &str, radix: u32) -> Value {
    i128::from_str_radix(digits, radix)
        .map_or_else(|_| Value::Float(digits.parse().unwrap_or(f64::INFINITY)), Value::Integer)
}

/// The texts of a scene and where every key of it was written.
#[derive(Debug, Clone, Default)]
pub(super) struct Places {
    pub(super) texts: Vec<Arc<Source>>,
    keys: BTreeMap<String, Place>,
}

/// Where a thing was written is not part of what was asked: two scenes that ask the same are equal.
impl PartialEq for Places {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Places {
    pub(super) fn new(texts: Vec<Arc<Source>>) -> Self {
        Self { texts, keys: BTreeMap::new() }
    }

    /// Notes the place of a node and of everything below it.
    ///
    /// Scalars are marked by their value, sections by their key, entries of lists by themselves.
    pub(super) fn note(&mut self, path: &str, key: Option<&Place>, node: &Node) {
        let place = match (&node.value, key) {
            (Value::Table(_) | Value::List(_), Some(key)) => key,
            _ => &node.place,
        };
        self.keys.insert(path.to_owned(), place.clone());
        match &node.value {
            Value::List(list) => {
                for (index, item) in list.iter().enumerate() {
                    self.note(&join(path, &index.to_string()), None, item);
                }
            }
            Value::Table(entries) => {
                for entry in entries {
                    self.note(&join(path, &entry.key), Some(&entry.place), &entry.node);
                }
            }
            _ => {}
        }
    }

    /// Moves keys to other paths, all at once.
    pub(super) fn rename(&mut self, moved: &[(String, String)]) {
        let renamed = |key: String| {
            let target = moved.iter().find_map(|(from, to)| {
                let rest = key.strip_prefix(from.as_str())?;
                (rest.is_empty() || rest.starts_with('.')).then(|| format!("{to}{rest}"))
            });
            target.unwrap_or(key)
        };
        self.keys = std::mem::take(&mut self.keys).into_iter().map(|(key, place)| (renamed(key), place)).collect();
    }

    pub(super) fn location(&self, place: &Place, key: &str) -> Option<Location> {
        let source = self.texts.get(place.text)?.clone();
        Some(Location { source, span: place.span.clone(), key: key.to_owned() })
    }

    pub(super) fn locate(&self, key: &str) -> Option<Location> {
        self.location(self.keys.get(key)?, key)
    }
}

/// A dotted path one key longer.
pub(super) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}
