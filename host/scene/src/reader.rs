//! From a tree to typed values: every mistake of type, range, spelling and model is found here, with its place.

use std::path::PathBuf;

use super::bound::{Bound, LARGEST_COUNT};
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::place::Located;
use super::tree::{Entry, Node, Place, Places, Value, join};

/// A set of words that a key may say; the first is not special.
pub(super) trait Word: Copy + 'static {
    const ALL: &'static [(&'static str, Self)];

    fn word(self) -> &'static str
    where
        Self: PartialEq,
    {
        Self::ALL.iter().find(|(_, value)| *value == self).map_or("", |(word, _)| word)
    }
}

/// A key of a section and the models it belongs to; none listed: all.
pub(super) type Key = (&'static str, &'static [ModelKind]);

/// A table being read.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    places: &'a Places,
    path: &'a str,
    place: &'a Place,
    entries: &'a [Entry],
}

/// A value being read.
#[derive(Clone)]
pub(super) struct Item<'a> {
    places: &'a Places,
    pub(super) path: String,
    /// Where its section begins, for what it lacks.
    header: &'a Place,
    pub(super) node: &'a Node,
}

/// An error at a place.
pub(super) fn at(places: &Places, place: &Place, key: &str, problem: Problem) -> SceneError {
    Located::new(problem, places.location(place, key))
}

impl<'a> Section<'a> {
    /// The whole scene.
    pub(super) fn root(places: &'a Places, node: &'a Node) -> Self {
        let entries = match &node.value {
            Value::Table(entries) => entries.as_slice(),
            _ => &[],
        };
        Self { places, path: "", place: &node.place, entries }
    }

    /// Refuses keys that are unknown here or belong to another model.
    pub(super) fn keys(&self, keys: &[Key], model: ModelKind) -> Result<(), SceneError> {
        for entry in self.entries {
            let path = join(self.path, &entry.key);
            let Some((_, models)) = keys.iter().find(|(key, _)| *key == entry.key) else {
                let here: Vec<&str> =
                    keys.iter().filter(|(_, m)| m.is_empty() || m.contains(&model)).map(|(k, _)| *k).collect();
                let problem = Problem::UnknownKey {
                    key: entry.key.clone(),
                    section: self.named(),
                    nearest: nearest(&entry.key, &here),
                    valid: here.iter().map(|&key| key.to_owned()).collect(),
                };
                return Err(at(self.places, &entry.place, &path, problem));
            };
            if !models.is_empty() && !models.contains(&model) {
                let problem = Problem::OtherModel { key: path.clone(), model, models: models.to_vec() };
                return Err(at(self.places, &entry.place, &path, problem));
            }
        }
        Ok(())
    }

    /// Refuses keys that are known but do not go with what `setting` says; `owners` names for each such key what it goes with.
    pub(super) fn only_with(&self, setting: &str, found: &str, owners: &[(&str, &[&str])]) -> Result<(), SceneError> {
        for entry in self.entries {
            let Some((_, with)) = owners.iter().find(|(key, with)| *key == entry.key && !with.contains(&found)) else {
                continue;
            };
            let problem = Problem::OtherSetting {
                key: join(self.path, &entry.key),
                setting: join(self.path, setting),
                found: found.to_owned(),
                expected: with.iter().map(|&word| word.to_owned()).collect(),
            };
            return Err(at(self.places, &entry.place, &join(self.path, &entry.key), problem));
        }
        Ok(())
    }

    /// Refuses a second key of a set that excludes one another.
    pub(super) fn at_most_one(&self, keys: &[&str]) -> Result<(), SceneError> {
        let mut given = self.entries.iter().filter(|entry| keys.contains(&entry.key.as_str()));
        if let (Some(first), Some(second)) = (given.next(), given.next()) {
            let path = join(self.path, &second.key);
            let problem = Problem::Both { first: join(self.path, &first.key), second: path.clone() };
            return Err(at(self.places, &second.place, &path, problem));
        }
        Ok(())
    }

    pub(super) fn get(&self, key: &str) -> Option<Item<'a>> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(Item { places: self.places, path: join(self.path, key), header: &entry.place, node: &entry.node })
    }

    pub(super) fn need(&self, key: &'static str) -> Result<Item<'a>, SceneError> {
        self.get(key).ok_or_else(|| self.missing(key, ""))
    }

    /// The error for a key that is not there, at the header of the section.
    pub(super) fn missing(&self, key: &str, reason: &'static str) -> SceneError {
        let problem = Problem::Missing { key: key.to_owned(), section: self.named(), reason };
        at(self.places, self.place, self.path, problem)
    }

    /// An error at a key of this section, or at its header where the key is not there.
    pub(super) fn error(&self, key: &str, problem: Problem) -> SceneError {
        let place = self.entries.iter().find(|entry| entry.key == key).map_or(self.place, |entry| &entry.place);
        at(self.places, place, &join(self.path, key), problem)
    }

    /// All keys with their values, for tables whose keys are not known beforehand.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&'a str, Item<'a>)> {
        let (places, path) = (self.places, self.path);
        self.entries.iter().map(move |entry| {
            let path = join(path, &entry.key);
            (entry.key.as_str(), Item { places, path, header: &entry.place, node: &entry.node })
        })
    }

    fn named(&self) -> String {
        if self.path.is_empty() { "the scene".to_owned() } else { format!("`{}`", self.path) }
    }
}

impl<'a> Item<'a> {
    pub(super) fn error(&self, problem: Problem) -> SceneError {
        at(self.places, &self.node.place, &self.path, problem)
    }

    pub(super) fn wrong(&self, expected: &'static str) -> SceneError {
        self.error(Problem::WrongType { key: self.path.clone(), found: self.node.describe(), expected })
    }

    pub(super) fn section(&self) -> Result<Section<'_>, SceneError> {
        match &self.node.value {
            Value::Table(entries) => Ok(Section { places: self.places, path: &self.path, place: self.header, entries }),
            _ => Err(self.wrong("a table")),
        }
    }

    pub(super) fn number(&self, bound: Bound) -> Result<f64, SceneError> {
        let found = match self.node.value {
            Value::Integer(integer) => integer as f64,
            Value::Float(float) => float,
            _ => return Err(self.wrong("a number")),
        };
        if !found.is_finite() {
            return Err(self.error(Problem::NotFinite { key: self.path.clone(), found }));
        }
        if !bound.holds(found) {
            return Err(self.error(Problem::OutOfRange { key: self.path.clone(), found, bound }));
        }
        Ok(found)
    }

    /// A whole number; `1e6` counts as one, because nobody likes to count zeros.
    pub(super) fn count(&self, least: u64, most: u64) -> Result<u64, SceneError> {
        let found = match self.node.value {
            Value::Integer(integer) => integer,
            Value::Float(float) if float.fract() == 0.0 && float.abs() <= LARGEST_COUNT as f64 => float as i128,
            _ => return Err(self.wrong("a whole number")),
        };
        match u64::try_from(found) {
            Ok(count) if (least..=most).contains(&count) => Ok(count),
            _ => Err(self.error(Problem::CountOutOfRange { key: self.path.clone(), found, least, most })),
        }
    }

    pub(super) fn boolean(&self) -> Result<bool, SceneError> {
        match self.node.value {
            Value::Boolean(boolean) => Ok(boolean),
            _ => Err(self.wrong("true or false")),
        }
    }

    /// A string, empty or not.
    pub(super) fn text(&self) -> Result<String, SceneError> {
        match &self.node.value {
            Value::Text(text) => Ok(text.clone()),
            _ => Err(self.wrong("a string")),
        }
    }

    /// A string that says something; `expected` in words.
    pub(super) fn name(&self, expected: &'static str) -> Result<String, SceneError> {
        let text = self.text()?;
        if text.trim().is_empty() {
            return Err(self.error(Problem::EmptyText { key: self.path.clone(), expected }));
        }
        Ok(text)
    }

    pub(super) fn path(&self) -> Result<PathBuf, SceneError> {
        self.name("the path of a file").map(PathBuf::from)
    }

    pub(super) fn word<W: Word>(&self) -> Result<W, SceneError> {
        let Value::Text(found) = &self.node.value else {
            return Err(self.wrong("a word in quotes"));
        };
        if let Some((_, value)) = W::ALL.iter().find(|(word, _)| word == found) {
            return Ok(*value);
        }
        let words: Vec<&str> = W::ALL.iter().map(|(word, _)| *word).collect();
        Err(self.unknown_word(found, &words))
    }

    pub(super) fn unknown_word(&self, found: &str, words: &[&str]) -> SceneError {
        self.error(Problem::UnknownWord {
            key: self.path.clone(),
            found: found.to_owned(),
            nearest: nearest(found, words),
            words: words.iter().map(|&word| word.to_owned()).collect(),
        })
    }

    /// Labels are too short for a guess to be worth much, so all of them are listed.
    pub(super) fn unknown_label(&self, found: &str, labels: &[&str]) -> SceneError {
        self.error(Problem::UnknownWord {
            key: self.path.clone(),
            found: found.to_owned(),
            nearest: None,
            words: labels.iter().map(|&label| label.to_owned()).collect(),
        })
    }

    pub(super) fn list(&self, expected: &'static str) -> Result<Vec<Item<'a>>, SceneError> {
        let Value::List(list) = &self.node.value else {
            return Err(self.wrong(expected));
        };
        let item = |(index, node): (usize, &'a Node)| Item {
            places: self.places,
            path: join(&self.path, &index.to_string()),
            header: &node.place,
            node,
        };
        Ok(list.iter().enumerate().map(item).collect())
    }

    pub(super) fn numbers(&self, bound: Bound) -> Result<Vec<f64>, SceneError> {
        self.list("a list of numbers")?.iter().map(|item| item.number(bound)).collect()
    }

    /// The error for a list of `found` entries where `expected` belong.
    pub(super) fn length(&self, found: usize, expected: usize, reason: &'static str) -> SceneError {
        self.error(Problem::WrongLength { key: self.path.clone(), found, expected, reason })
    }
}

/// The nearest of `words`, if any is near enough to be a slip: the distance counts swaps of neighbours as one.
pub(super) fn nearest(found: &str, words: &[&str]) -> Option<String> {
    let lower = found.to_lowercase();
    words
        .iter()
        .map(|word| (strsim::damerau_levenshtein(&lower, word), *word))
        .filter(|(distance, word)| *distance <= 1 + word.chars().count().max(lower.chars().count()) / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word.to_owned())
}
