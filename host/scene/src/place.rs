//! Where a thing was written: a place in the scene file or in an override, and an error tied to it.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// A text that scenes are read from: the file, or one `--set key=value`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Source {
    /// The file as it was named, or `--set key=value`.
    pub(super) name: String,
    /// The whole text; of an override, what follows `--set `.
    pub(super) text: String,
    /// Whether the text has lines worth counting.
    pub(super) file: bool,
}

/// A place in a scene file or in an override, with the key that stands there.
///
/// It holds the text it points into, so it can be kept and shown after the scene is gone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Location {
    pub(super) source: Arc<Source>,
    pub(super) span: Range<usize>,
    pub(super) key: String,
}

impl Location {
    /// The scene file as it was named, or `--set key=value` for an override.
    pub fn file(&self) -> &str {
        &self.source.name
    }

    /// Whether the place is in an override, where line and column say little.
    pub fn in_override(&self) -> bool {
        !self.source.file
    }

    /// Line, counted from 1.
    pub fn line(&self) -> usize {
        self.before().matches('\n').count() + 1
    }

    /// Column in characters, counted from 1.
    pub fn column(&self) -> usize {
        let before = self.before();
        let line = before.rfind('\n').map_or(0, |newline| newline + 1);
        before[line..].chars().count() + 1
    }

    /// The bytes of the text that are meant.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Dotted path of the key from the root of the scene (`step.0.load`); empty for the root.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// The source line underlined below `title`, with `label` beside the line; `color` for terminals.
    pub fn render(&self, title: &str, label: &str, color: bool) -> String {
        let mark = AnnotationKind::Primary.span(self.visible());
        let mark = if label.is_empty() { mark } else { mark.label(label) };
        let snippet = Snippet::source(self.source.text.as_str()).path(self.source.name.as_str()).annotation(mark);
        let report = [Level::ERROR.primary_title(title).element(snippet)];
        renderer(color).render(&report)
    }

    /// The text before the place, cut at a character boundary.
    fn before(&self) -> &str {
        &self.source.text[..floor(&self.source.text, self.span.start)]
    }

    /// The span on character boundaries and no longer than its first line, so that a section is marked by its header.
    fn visible(&self) -> Range<usize> {
        let text = &self.source.text;
        let start = floor(text, self.span.start);
        let end = floor(text, self.span.end).max(start);
        let line = text[start..end].find(['\n', '\r']).map_or(end, |newline| start + newline);
        start..line
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.source.file {
            write!(f, "{}:{}:{}", self.source.name, self.line(), self.column())
        } else {
            write!(f, "{}", self.source.name)
        }
    }
}

/// An error of any module together with the place in the scene that caused it.
///
/// Its `Display` is one sentence (what was found, what was expected, where); [`Located::render`] underlines the source.
#[derive(Debug, Clone, PartialEq)]
pub struct Located<E> {
    /// What is wrong.
    pub problem: Box<E>,
    /// Where; `None` only where there is no text to point into (the file could not be read).
    pub location: Option<Location>,
}

impl<E> Located<E> {
    /// Ties a problem to a place.
    pub fn new(problem: E, location: Option<Location>) -> Self {
        Self { problem: Box::new(problem), location }
    }
}

impl<E: fmt::Display> Located<E> {
    /// The error with the source line it is about, underlined; plain text unless `color`.
    pub fn render(&self, color: bool) -> String {
        let title = self.problem.to_string();
        match &self.location {
            Some(location) if says(&title, location.key()) => location.render(&title, "", color),
            Some(location) => location.render(&title, location.key(), color),
            None => renderer(color).render(&[Group::with_title(Level::ERROR.primary_title(title))]),
        }
    }
}

impl<E: fmt::Display> fmt::Display for Located<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let problem = self.problem.to_string();
        f.write_str(&problem)?;
        match &self.location {
            Some(location) if says(&problem, location.key()) => write!(f, ", at {location}"),
            Some(location) => write!(f, ", at {location} (`{}`)", location.key),
            None => Ok(()),
        }
    }
}

impl<E: std::error::Error + 'static> std::error::Error for Located<E> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.problem.source()
    }
}

/// Whether a message names the key already, so that it need not be named twice.
fn says(message: &str, key: &str) -> bool {
    key.is_empty() || message.contains(&format!("`{key}`"))
}

fn renderer(color: bool) -> Renderer {
    if color { Renderer::styled() } else { Renderer::plain() }
}

/// The largest character boundary that is not above `index`.
fn floor(text: &str, index: usize) -> usize {
    let mut index = index.min(text.len());
    while !text.is_char_boundary(index) {
        index -= 1;
    }
    index
}
