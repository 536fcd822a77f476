//! `--set key=value`: changes to a scene that are made before it is typed, so that their errors are as clear as the file's.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use toml::de::DeValue;

use super::error::{Problem, SceneError};
use super::place::{Located, Location, Source};
use super::tree::{Entry, Node, Place, Value};

/// A change to a scene, as typed: `step.0.load=5`.
///
/// The key is a dotted path in which numbers count the entries of lists from 0; a part with dots in it stands in quotes.
/// The value is TOML; a bare word is a string. The key may be new, an entry of a list must exist. Of keys that exclude one another
/// (`tolerance` and `substeps`) the override takes the place of what the file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Override(pub String);

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<&str> for Override {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

/// Sets of keys that exclude one another: an override of one removes the others, with all that is in them.
const EXCLUSIVE: &[(&str, &[&str], &[&str])] = &[
    ("integrator", &["tolerance"], &["substeps"]),
    ("integrator", &["substeps"], &["tolerance"]),
    ("contact", &["modulus"], &["bodies"]),
    ("contact", &["bodies"], &["modulus"]),
    ("law", &["constants"], &["table", "apdl", "material"]),
    ("law", &["table"], &["constants", "apdl", "material"]),
    ("law", &["apdl"], &["constants", "table"]),
    ("output", &["every"], &["times"]),
    ("output", &["times"], &["every"]),
    ("reference", &["kind"], &["file"]),
    ("reference", &["file"], &["kind"]),
    ("step", &["load"], &["approach"]),
    ("step", &["approach"], &["load"]),
    ("step", &["velocity"], &["stroke", "frequency"]),
    ("step", &["stroke", "frequency"], &["velocity"]),
];

/// Parts of a key path beyond which it is no key of a scene, and recursion over it would be a risk.
const DEEPEST: usize = 16;

/// One part of a key path with its place in the override.
struct Part {
    name: String,
    span: Range<usize>,
}

/// An override while it is applied.
struct Change<'a> {
    source: &'a Arc<Source>,
    text: usize,
    parts: Vec<Part>,
}

impl Override {
    pub(super) fn source(&self) -> Arc<Source> {
        Arc::new(Source { name: format!("--set {}", self.0), text: self.0.clone(), file: false })
    }

    /// Makes the change; `text` is the number under which the override's own text is known.
    pub(super) fn apply(&self, root: &mut Node, text: usize, source: &Arc<Source>) -> Result<(), SceneError> {
        let form = || {
            let location = Location { source: source.clone(), span: 0..self.0.len(), key: String::new() };
            Located::new(Problem::OverrideForm { text: self.0.clone() }, Some(location))
        };
        let (parts, equals) = split(&self.0).ok_or_else(form)?;
        if self.0[equals + 1..].trim().is_empty() {
            return Err(form());
        }
        let change = Change { source, text, parts };
        let value = change.value(&self.0, equals + 1)?;
        change.put(root, 0, value)
    }
}

impl Change<'_> {
    fn error(&self, span: Range<usize>, depth: usize, problem: Problem) -> SceneError {
        let location = Location { source: self.source.clone(), span, key: self.path(depth + 1) };
        Located::new(problem, Some(location))
    }

    fn path(&self, depth: usize) -> String {
        self.parts.iter().take(depth).map(|part| part.name.as_str()).collect::<Vec<_>>().join(".")
    }

    /// The value as TOML. What cannot be meant as anything else is a string: it does not begin like a TOML string, list
    /// or table.
    fn value(&self, text: &str, start: usize) -> Result<Node, SceneError> {
        let shift = start + text[start..].len() - text[start..].trim_start().len();
        let written = text[start..].trim();
        let place = Place { text: self.text, span: shift..shift + written.len() };
        match DeValue::parse(written) {
            Ok(value) => {
                let node = Node::from_toml(&value, self.text, shift);
                Ok(Node { place, ..node })
            }
            Err(error) if written.starts_with(['"', '\'', '[', '{']) => {
                let span = error.span().map_or(place.span, |span| span.start + shift..span.end + shift);
                let problem = Problem::Syntax { message: one_line(error.message()) };
                Err(self.error(span, self.parts.len(), problem))
            }
            Err(_) => Ok(Node { value: Value::Text(written.to_owned()), place }),
        }
    }

    /// Puts `value` under the parts from `depth` on; sections on the way are made, entries of lists are not.
    fn put(&self, node: &mut Node, depth: usize, value: Node) -> Result<(), SceneError> {
        let part = &self.parts[depth];
        let here = Place { text: self.text, span: part.span.clone() };
        let last = depth + 1 == self.parts.len();
        let found = node.describe();
        let next = match &mut node.value {
            Value::Table(entries) => {
                self.make_room(entries, depth);
                let index = match entries.iter().position(|entry| entry.key == part.name) {
                    Some(index) => index,
                    None => {
                        let empty = Node { value: Value::Table(Vec::new()), place: here.clone() };
                        // A number under a key that is not there can only be meant as an entry of a list.
                        let list = self.parts.get(depth + 1).is_some_and(|next| next.name.parse::<usize>().is_ok());
                        let node = if list && !is_constants(self, depth) {
                            Node { value: Value::List(Vec::new()), ..empty }
                        } else {
                            empty
                        };
                        entries.push(Entry { key: part.name.clone(), place: here.clone(), node });
                        entries.len() - 1
                    }
                };
                if last {
                    entries[index].place = here;
                }
                &mut entries[index].node
            }
            Value::List(list) => {
                let count = list.len();
                let Ok(index) = part.name.parse::<usize>() else {
                    let problem = Problem::EntryNeeded { list: self.path(depth), key: part.name.clone() };
                    return Err(self.error(part.span.clone(), depth, problem));
                };
                list.get_mut(index).ok_or_else(|| {
                    let problem = Problem::NoSuchEntry { list: self.path(depth), index: part.name.clone(), count };
                    self.error(part.span.clone(), depth, problem)
                })?
            }
            _ => {
                let problem = Problem::NotASection { key: part.name.clone(), parent: self.path(depth), found };
                return Err(self.error(part.span.clone(), depth, problem));
            }
        };
        if last {
            *next = value;
            return Ok(());
        }
        self.put(next, depth + 1, value)
    }

    /// Removes what the file says under keys that exclude the one at `depth`; other overrides stay, and are judged.
    fn make_room(&self, entries: &mut Vec<Entry>, depth: usize) {
        let section = self.parts[..depth].iter().rev().find(|part| part.name.parse::<usize>().is_err());
        let Some(section) = section.map(|part| part.name.as_str()) else {
            return;
        };
        let name = self.parts[depth].name.as_str();
        for (place, keys, rivals) in EXCLUSIVE {
            if *place == section && keys.contains(&name) {
                entries.retain(|entry| entry.place.text != 0 || !rivals.contains(&entry.key.as_str()));
            }
        }
    }
}

/// Names of constants are the law's and may be numbers.
fn is_constants(change: &Change<'_>, depth: usize) -> bool {
    change.parts[depth].name == "constants"
}

/// The parts of the key and the place of the equals sign; `None` where the text has no such form.
fn split(text: &str) -> Option<(Vec<Part>, usize)> {
    let mut parts = Vec::new();
    let mut rest = 0;
    loop {
        let start = rest + text[rest..].len() - text[rest..].trim_start().len();
        let quote = text[start..].chars().next().filter(|first| matches!(first, '"' | '\''));
        let (span, after) = match quote {
            Some(quote) => {
                let end = start + 1 + text[start + 1..].find(quote)?;
                (start + 1..end, end + 1)
            }
            None => {
                let end = start + text[start..].find(['.', '='])?;
                (start..start + text[start..end].trim_end().len(), end)
            }
        };
        if span.is_empty() && quote.is_none() {
            return None;
        }
        if parts.len() == DEEPEST {
            return None;
        }
        parts.push(Part { name: text[span.clone()].to_owned(), span });
        let next = after + text[after..].find(|character: char| !character.is_whitespace())?;
        match text[next..].chars().next() {
            Some('.') => rest = next + 1,
            Some('=') => return Some((parts, next)),
            _ => return None,
        }
    }
}

/// A parser's message on one line, without the stop that ends a sentence.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
