//! What the text of a Fortran source says of one subroutine: its arguments, and which of them it mentions.
//!
//! No parser: statements without comments, texts and continuations, and the words in them. That is enough to find out what
//! is mentioned, and errs towards too much.

use std::path::Path;

/// A subroutine as its source has it; all in lower case.
pub(super) struct Procedure {
    /// Its arguments in their order.
    pub(super) arguments: Vec<String>,
    /// Its statements that are no declarations.
    statements: Vec<String>,
    /// Whether something of it lasts from call to call.
    pub(super) remembers: bool,
}

impl Procedure {
    /// Whether a statement has the word in it.
    pub(super) fn mentions(&self, word: &str) -> bool {
        self.statements.iter().any(|statement| words(statement).any(|found| found == word))
    }

    /// The greatest number that stands as the index of an array; `None` where an index is something else.
    pub(super) fn greatest_index(&self, array: &str) -> Option<usize> {
        let mut greatest = 0;
        for statement in &self.statements {
            let mut rest = statement.as_str();
            while let Some(at) = rest.find(array) {
                let before = rest[..at].chars().next_back().is_none_or(|c| !is_word(c));
                rest = &rest[at + array.len()..];
                let Some(index) = rest.trim_start().strip_prefix('(') else { continue };
                if before {
                    greatest = greatest.max(index.split(')').next()?.trim().parse().ok()?);
                }
            }
        }
        Some(greatest).filter(|greatest| *greatest > 0)
    }
}

/// Whether a file of this name is in fixed form.
pub(super) fn is_fixed(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    matches!(ending.as_deref(), Some("f" | "for"))
}

/// Finds a subroutine.
pub(super) fn procedure(text: &str, fixed: bool, name: &str) -> Result<Procedure, String> {
    let statements = statements(text, fixed);
    let heads = |statement: &str| {
        let rest = statement.strip_prefix("subroutine")?.trim_start().strip_prefix(name)?.trim_start();
        rest.strip_prefix('(')?.strip_suffix(')').map(str::to_owned)
    };
    let found = statements.iter().enumerate().find_map(|(index, statement)| Some((index, heads(statement)?)));
    let Some((begin, list)) = found else {
        return Err(format!("found no `subroutine {name}(..)`, expected one"));
    };
    let arguments: Vec<String> = list.split(',').map(|one| one.trim().to_owned()).collect();
    let mut own = Procedure { arguments, statements: Vec::new(), remembers: false };
    for statement in &statements[begin + 1..] {
        let first = words(statement).next().unwrap_or_default();
        if statement == "end" || statement.starts_with("end subroutine") || statement.starts_with("endsubroutine") {
            break;
        }
        own.remembers |=
            matches!(first, "save" | "common" | "data" | "use" | "include") || declares_saved(statement, first);
        if !DECLARATIONS.contains(&first) {
            own.statements.push(statement.clone());
        }
    }
    Ok(own)
}

/// First words of statements that only declare.
const DECLARATIONS: [&str; 16] = [
    "real",
    "integer",
    "double",
    "logical",
    "character",
    "complex",
    "dimension",
    "implicit",
    "parameter",
    "external",
    "intrinsic",
    "save",
    "common",
    "data",
    "use",
    "include",
];

/// Whether a declaration makes a variable that lasts: one with `save`, or with a value at its beginning.
fn declares_saved(statement: &str, first: &str) -> bool {
    let is_parameter = words(statement).any(|word| word == "parameter");
    DECLARATIONS[..6].contains(&first)
        && !is_parameter
        && (words(statement).any(|word| word == "save") || (statement.contains("::") && statement.contains('=')))
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn words(statement: &str) -> impl Iterator<Item = &str> {
    statement.split(|c| !is_word(c)).filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
}

/// The statements in lower case, without comments, texts, labels and continuations.
fn statements(text: &str, fixed: bool) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut open = false;
    for line in text.lines() {
        let line = line.to_lowercase();
        let first = line.chars().next().unwrap_or(' ');
        if fixed && matches!(first, 'c' | '*' | '!') || line.trim_start().starts_with('#') {
            continue;
        }
        let mut line = without_texts(&line.replace('\t', "      "));
        let continues = if fixed {
            // The sixth column, and no more than 72 of them.
            line = line.chars().take(72).collect();
            line.chars().nth(5).is_some_and(|c| c != ' ' && c != '0')
        } else {
            open
        };
        let body = if fixed { line.chars().skip(6).collect::<String>() } else { line };
        let body = body.trim();
        let body = if fixed { body } else { body.trim_start_matches('&') };
        open = body.ends_with('&');
        let body = body.trim_end_matches('&').trim();
        if body.is_empty() {
            continue;
        }
        match all.last_mut().filter(|_| continues) {
            Some(last) => {
                last.push(' ');
                last.push_str(body);
            }
            None => all.extend(body.split(';').map(|one| one.trim().to_owned())),
        }
    }
    all
}

/// A line without what stands in quotes and behind an exclamation mark.
fn without_texts(line: &str) -> String {
    let mut quote = None;
    let mut kept = String::new();
    for c in line.chars() {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None if c == '!' => break,
            None if c == '"' || c == '\'' => quote = Some(c),
            None => kept.push(c),
        }
    }
    kept
}
