//! Shows what is wrong with a deck: one sentence with file, line and column, or the line underlined.

use std::fmt;
use std::io;
use std::ops::Range;
use std::path::PathBuf;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use thiserror::Error;

use super::lexer::Span;
use super::problem::{Fault, Problem};

/// One wrong command of a deck, with the line it stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// What is wrong.
    pub problem: Problem,
    /// The deck's name, as given to `parse` or `read`.
    pub source: String,
    /// Line number, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    excerpt: Excerpt,
    related: Option<(Excerpt, &'static str)>,
}

/// A line of the deck and the bytes of it that are meant.
#[derive(Debug, Clone, PartialEq)]
struct Excerpt {
    line: usize,
    text: String,
    underline: Range<usize>,
}

impl Excerpt {
    fn of(text: &str, span: Span) -> Self {
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        let bytes = text.as_bytes();
        let begin = bytes[..span.start].iter().rposition(is_end).map_or(0, |at| at + 1);
        let end = bytes[span.start..].iter().position(is_end).map_or(text.len(), |at| span.start + at);
        Excerpt {
            line: span.line,
            text: text[begin..end].to_owned(),
            underline: span.start - begin..span.end.min(end) - begin,
        }
    }

    fn column(&self) -> usize {
        self.text[..self.underline.start].chars().count() + 1
    }
}

impl Diagnostic {
    pub(super) fn new(fault: Fault, text: &str, source: &str) -> Self {
        let excerpt = Excerpt::of(text, fault.span);
        Diagnostic {
            problem: fault.problem,
            source: source.to_owned(),
            line: excerpt.line,
            column: excerpt.column(),
            related: fault.related.map(|(span, label)| (Excerpt::of(text, span), label)),
            excerpt,
        }
    }

    /// The sentence with the deck's line below it, the wrong part underlined; plain text, several lines.
    pub fn render(&self) -> String {
        let message = self.problem.to_string();
        let mut group = Level::ERROR.primary_title(message).element(
            Snippet::source(&self.excerpt.text)
                .line_start(self.excerpt.line)
                .path(&self.source)
                .annotation(AnnotationKind::Primary.span(self.excerpt.underline.clone())),
        );
        if let Some((excerpt, label)) = &self.related {
            group = group.element(
                Snippet::source(&excerpt.text)
                    .line_start(excerpt.line)
                    .path(&self.source)
                    .annotation(AnnotationKind::Context.span(excerpt.underline.clone()).label(*label)),
            );
        }
        Renderer::plain().render(&[group])
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Diagnostic { source, line, column, problem, .. } = self;
        write!(f, "{source}:{line}:{column}: {problem}")
    }
}

impl std::error::Error for Diagnostic {}

/// Why a deck gives no wear material.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DeckError {
    /// A wear command is wrong.
    #[error(transparent)]
    Command(Box<Diagnostic>),
    /// The file cannot be read.
    #[error("cannot read {}: {cause}", .path.display())]
    Read {
        /// The deck's path.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// No material of the deck has a wear law.
    #[error("{source_name}: found no TB,WEAR with ARCD or USER, expected one")]
    NoWear {
        /// The deck's name.
        source_name: String,
    },
    /// Several materials have a wear law and none was chosen.
    #[error("{source_name}: materials {} have wear laws, expected a choice of one", list(.found))]
    Several {
        /// The deck's name.
        source_name: String,
        /// Their numbers, ascending.
        found: Vec<i64>,
    },
    /// The chosen material has no wear law.
    #[error("{source_name}: material {chosen} has no wear law, found one for {}", list(.found))]
    NoSuchMaterial {
        /// The deck's name.
        source_name: String,
        /// The number asked for.
        chosen: i64,
        /// The numbers with wear laws, ascending.
        found: Vec<i64>,
    },
}

impl DeckError {
    /// The message with the deck's line underlined where there is one, for a terminal; otherwise the sentence.
    pub fn render(&self) -> String {
        match self {
            DeckError::Command(diagnostic) => diagnostic.render(),
            other => other.to_string(),
        }
    }
}

fn list(numbers: &[i64]) -> String {
    let words: Vec<String> = numbers.iter().map(i64::to_string).collect();
    words.join(", ")
}
