//! Decks with known values, and decks with one thing wrong whose message and place are checked.

mod errors;
mod expressions;
mod format;
mod materials;
mod robustness;
mod samples;
mod tables;
mod toml_text;

use super::{Deck, DeckError, Diagnostic, Problem, WearMaterial};

fn deck(text: &str) -> Deck {
    Deck::parse(text, "deck.inp").unwrap_or_else(|error| panic!("{}", error.render()))
}

fn only(text: &str) -> WearMaterial {
    deck(text).material(None).expect("one material").clone()
}

/// The constants of the first row, which must all be given.
fn constants(text: &str) -> Vec<f64> {
    let row = &only(text).tables[0];
    row.constants.iter().map(|c| c.expect("given")).collect()
}

fn diagnostic(text: &str) -> Diagnostic {
    match Deck::parse(text, "deck.inp") {
        Err(DeckError::Command(diagnostic)) => *diagnostic,
        other => panic!("expected a wrong command, found {other:?}"),
    }
}

/// The message, its place and what is underlined there.
#[track_caller]
fn wrong(text: &str, line: usize, column: usize, underlined: &str, message: &str) -> Problem {
    let found = diagnostic(text);
    let expected = format!("deck.inp:{line}:{column}: {message}");
    assert_eq!(found.to_string(), expected);
    let picture = found.render();
    assert!(picture.contains(&format!("deck.inp:{line}:{column}")), "{picture}");
    let width = underlined.chars().count().max(1);
    let marks = picture.chars().filter(|c| *c == '^').count();
    assert_eq!(marks, width, "{picture}");
    let source = text.split('\n').nth(line - 1).unwrap();
    let at: String = source.chars().skip(column - 1).collect();
    assert!(at.starts_with(underlined), "{at} does not start with {underlined}");
    found.problem
}
