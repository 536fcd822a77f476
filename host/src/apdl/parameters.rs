//! The parameters of a deck and what is known of their values.

use std::collections::BTreeMap;

use super::lexer::Span;
use super::problem::{Fault, nearest};

/// What a deck says of a parameter at some line.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Parameter {
    Value(f64),
    /// Its value comes from a command that is passed over.
    Unknown {
        command: String,
        line: usize,
    },
    /// Its expression is wrong, which matters once a wear command needs it.
    Faulty(Box<Fault>),
}

/// Names in capitals: case does not matter in a deck.
#[derive(Debug, Default)]
pub(super) struct Parameters {
    known: BTreeMap<String, Parameter>,
}

impl Parameters {
    pub fn set(&mut self, name: &str, parameter: Parameter) {
        self.known.insert(name.to_ascii_uppercase(), parameter);
    }

    pub fn set_unknown(&mut self, name: &str, command: &str, span: Span) {
        let command = command.to_owned();
        let line = span.line;
        self.set(name, Parameter::Unknown { command, line });
    }

    pub fn remove(&mut self, name: &str) {
        self.known.remove(&name.to_ascii_uppercase());
    }

    pub fn clear(&mut self) {
        self.known.clear();
    }

    pub fn get(&self, name: &str) -> Option<&Parameter> {
        self.known.get(&name.to_ascii_uppercase())
    }

    pub fn nearest(&self, name: &str) -> Option<String> {
        nearest(name, self.known.keys().map(String::as_str))
    }
}
