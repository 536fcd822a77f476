//! Splits a deck into statements and their fields, with the place of each in the file.
//!
//! Free format of the deck: a comma ends a field, blanks around it mean nothing, `!` starts a comment, `$`
//! separates commands on a line, `/COM` and `C***` lines are comments, case does not matter.

/// A place in a deck: the line and the bytes it covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// Line number, from 1.
    pub line: usize,
    /// First byte, counted from the start of the text (after a byte order mark).
    pub start: usize,
    /// The byte after the last one; equal to `start` for a blank field.
    pub end: usize,
}

/// Commands whose whole line is free text, in which `$` does not start another command.
const TEXT_COMMANDS: [&str; 5] = ["/TITLE", "/STITLE", "/TLABEL", "/SYS", "/SYP"];

/// What the beginning of a statement says it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// `NAME,field,..`
    Command,
    /// `NAME=value`
    Assignment,
    /// `NAME(index)=value`
    ArrayAssignment,
    /// Begins like a number or a format: a line of a data block.
    Data,
}

/// One command of a deck; its fields are split when asked for, since most statements are passed over.
#[derive(Debug, Clone, Copy)]
pub(super) struct Statement<'a> {
    pub kind: Kind,
    /// The command's or the parameter's name as written.
    pub name: &'a str,
    pub span: Span,
    /// After the name of a command, after the `=` of an assignment.
    pub rest: Field<'a>,
}

/// Text between two commas without the blanks around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<'a> {
    pub text: &'a str,
    pub span: Span,
}

impl<'a> Field<'a> {
    /// The part of `text` from `start` to `end`, without blanks at its ends.
    fn trimmed(text: &'a str, line: usize, start: usize, end: usize) -> Self {
        let piece = &text[start..end];
        let kept = piece.trim_start();
        let start = end - kept.len();
        let kept = kept.trim_end();
        let end = start + kept.len();
        Field { text: kept, span: Span { line, start, end } }
    }

    pub fn is_blank(&self) -> bool {
        self.text.is_empty()
    }
}

impl<'a> Statement<'a> {
    /// The name in capitals, by which notes count it.
    pub fn upper_name(&self) -> String {
        self.name.to_ascii_uppercase()
    }

    pub fn is(&self, name: &str) -> bool {
        self.kind == Kind::Command && self.name.eq_ignore_ascii_case(name)
    }

    /// Only the first four characters of an alphabetic command name count.
    pub fn begins(&self, four: &str) -> bool {
        let head = self.name.get(..four.len());
        self.kind == Kind::Command && head.is_some_and(|head| head.eq_ignore_ascii_case(four))
    }

    /// The fields after the name, or `None` if something other than a comma follows it.
    ///
    /// A comma inside parentheses belongs to its expression.
    pub fn fields(&self) -> Option<Vec<Field<'a>>> {
        let Field { text, span } = self.rest;
        if text.is_empty() {
            return Some(Vec::new());
        }
        let text = text.strip_prefix(',')?;
        let offset = span.start + 1;
        let mut fields = Vec::new();
        let mut depth = 0_usize;
        let mut begin = 0;
        let mut push = |begin: usize, end: usize| {
            let mut field = Field::trimmed(text, span.line, begin, end);
            field.span.start += offset;
            field.span.end += offset;
            fields.push(field);
        };
        for (at, byte) in text.bytes().enumerate() {
            match byte {
                b'(' => depth += 1,
                b')' => depth = depth.saturating_sub(1),
                b',' if depth == 0 => {
                    push(begin, at);
                    begin = at + 1;
                }
                _ => {}
            }
        }
        push(begin, text.len());
        Some(fields)
    }
}

/// All statements of a deck in order.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    Lines { text, next: 0, line: 0 }.flat_map(move |(line, start, end)| line_statements(text, line, start, end))
}

/// Line number, first byte and end of every line; a line ends with LF, CR LF or CR.
struct Lines<'a> {
    text: &'a str,
    next: usize,
    line: usize,
}

impl Iterator for Lines<'_> {
    type Item = (usize, usize, usize);

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.next;
        if start >= self.text.len() {
            return None;
        }
        let bytes = self.text.as_bytes();
        let end = bytes[start..].iter().position(|b| matches!(b, b'\n' | b'\r')).map_or(bytes.len(), |at| start + at);
        self.next = match bytes.get(end..) {
            Some([b'\r', b'\n', ..]) => end + 2,
            _ => end + 1,
        };
        self.line += 1;
        Some((self.line, start, end))
    }
}

fn line_statements(text: &str, line: usize, start: usize, end: usize) -> Vec<Statement<'_>> {
    let end = text[start..end].find('!').map_or(end, |at| start + at);
    let whole = Field::trimmed(text, line, start, end);
    let mut found = Vec::new();
    if begins_with_any(whole.text, &TEXT_COMMANDS) {
        found.extend(statement(text, whole));
        return found;
    }
    let mut begin = whole.span.start;
    loop {
        let limit = begin + separator(&text[begin..whole.span.end]);
        let piece = Field::trimmed(text, line, begin, limit);
        if is_comment(piece.text) {
            break;
        }
        found.extend(statement(text, piece));
        if limit >= whole.span.end {
            break;
        }
        begin = limit + 1;
    }
    found
}

/// Where the command ends: at a `$` that does not stand between two quotes.
fn separator(text: &str) -> usize {
    let mut from = 0;
    while let Some(at) = text[from..].find(['$', '\'']).map(|at| from + at) {
        if text.as_bytes()[at] == b'$' {
            return at;
        }
        from = match text[at + 1..].find('\'') {
            Some(close) => at + 1 + close + 1,
            None => at + 1,
        };
    }
    text.len()
}

fn begins_with_any(text: &str, names: &[&str]) -> bool {
    names.iter().any(|name| {
        let head = text.get(..name.len());
        head.is_some_and(|head| head.eq_ignore_ascii_case(name))
    })
}

/// `/COM`, `C***`, and a lone `*`, which the solver reads as the start of a comment.
fn is_comment(text: &str) -> bool {
    let lone_star = text
        .strip_prefix('*')
        .is_some_and(|after| after.is_empty() || after.starts_with('*') || after.starts_with(char::is_whitespace));
    lone_star || begins_with_any(text, &["/COM", "C***"])
}

fn statement<'a>(text: &'a str, piece: Field<'a>) -> Option<Statement<'a>> {
    let first = piece.text.chars().next()?;
    let make = |kind, name_length: usize, rest_from: usize| {
        let Span { line, start, end } = piece.span;
        Statement {
            kind,
            name: &piece.text[..name_length],
            span: piece.span,
            rest: Field::trimmed(text, line, start + rest_from, end),
        }
    };
    let named = first.is_alphabetic() || matches!(first, '_' | '/' | '*' | '~' | ':');
    if !named {
        return Some(make(Kind::Data, 0, 0));
    }
    let name_length =
        piece.text.find(|c: char| matches!(c, ',' | '=' | '(') || c.is_whitespace()).unwrap_or(piece.text.len());
    let after = &piece.text[name_length..];
    let gap = after.len() - after.trim_start().len();
    let follows = after.trim_start();
    if is_parameter_name(&piece.text[..name_length]) {
        if follows.starts_with('=') {
            return Some(make(Kind::Assignment, name_length, name_length + gap + 1));
        }
        if follows.starts_with('(')
            && let Some(close) = follows.find(')')
            && let Some(value) = follows[close + 1..].trim_start().strip_prefix('=')
        {
            let rest_from = piece.text.len() - value.len();
            return Some(make(Kind::ArrayAssignment, name_length, rest_from));
        }
    }
    Some(make(Kind::Command, name_length, name_length))
}

/// A letter or underscore, then letters, digits and underscores.
pub(super) fn is_parameter_name(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
}
