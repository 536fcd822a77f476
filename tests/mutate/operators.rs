//! The mistakes that mutants are made of.

use super::subjects::Subject;
use super::tokens::{Kind, Token, tokens};

/// One change of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The whole text of the file with the change.
    pub text: String,
    /// Line of the change, from 1.
    pub line: usize,
    /// The line before and after.
    pub lines: (String, String),
}

impl Mutant {
    fn new(text: &str, from: usize, to: usize, with: &str) -> Self {
        let changed = [&text[..from], with, &text[to..]].concat();
        let line_start = text[..from].rfind('\n').map_or(0, |at| at + 1);
        let line_of = |text: &str, behind: usize| {
            let end = text[behind..].find('\n').map_or(text.len(), |at| behind + at);
            text[line_start..end].split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let lines = (line_of(text, to), line_of(&changed, from + with.len()));
        Self { line: text[..from].matches('\n').count() + 1, text: changed, lines }
    }

    /// The change as one line.
    pub fn change(&self) -> String {
        format!("`{}` -> `{}`", self.lines.0, self.lines.1)
    }
}

/// Signs and what they become.
const SIGNS: [(&str, &str); 12] = [
    ("<", ">="),
    (">", "<="),
    ("<=", ">"),
    (">=", "<"),
    ("==", "!="),
    ("&&", "||"),
    ("||", "&&"),
    ("+=", "-="),
    ("-=", "+="),
    ("*=", "/="),
    ("**", "*"),
    ("%=", "*="),
];

/// Functions and what they become: another one, or nothing but their argument.
const FUNCTIONS: [(&str, &str); 9] = [
    ("fabs", ""),
    ("abs", ""),
    ("exp", "expm1"),
    ("expm1", "exp"),
    ("sqrt", ""),
    ("max", "min"),
    ("min", "max"),
    ("isfinite", "!isnan"),
    ("mul_add", "max"),
];

/// All mutants of the regions of a file that hold a law's arithmetic.
pub fn mutants(subject: &Subject) -> Vec<Mutant> {
    let text = &subject.text;
    let all = tokens(text, subject.is_fortran());
    let inside = |at: usize| subject.regions.iter().any(|region| region.contains(&at));
    let declared = |at: usize| subject.declarations.iter().any(|region| region.contains(&at));
    let wanted = |at: usize| {
        let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
        let line = text[start..].lines().next().unwrap_or_default();
        // What a refusal says is no arithmetic.
        let words = ["REFUSE", "refuse(", "%text", ".text", "say(", "assert"].iter().any(|word| line.contains(word));
        !words
            && subject.lines_with.is_none_or(|word| line.contains(word))
            && !subject.not_run.iter().any(|word| line.contains(word))
    };
    let mut found = Vec::new();
    for index in 0..all.len() {
        let at = all[index].start;
        if inside(at) && wanted(at) {
            at_token(subject, &all, index, &mut found);
        } else if declared(at) && all[index].kind == Kind::Word {
            other_name(subject, all[index], &mut found);
        }
    }
    found.retain(|mutant| mutant.text != *text);
    found.dedup();
    found
}

/// Whether a token ends an operand.
fn ends_operand(token: &Token<'_>) -> bool {
    let keyword = ["return", "if", "else", "in", "mut", "let", "then", "while", "match"].contains(&token.text);
    token.kind == Kind::Number || token.kind == Kind::Word && !keyword || [")", "]"].contains(&token.text)
}

fn at_token(subject: &Subject, all: &[Token<'_>], index: usize, found: &mut Vec<Mutant>) {
    let text = &subject.text;
    let token = all[index];
    let binary = index > 0 && ends_operand(&all[index - 1]);
    let spaced = text[..token.start].ends_with(' ') && text[token.end()..].starts_with(' ');
    let mut put = |from: usize, to: usize, with: &str| found.push(Mutant::new(text, from, to, with));
    match (token.kind, token.text) {
        (Kind::Sign, "+" | "-") if binary => {
            put(token.start, token.end(), if token.text == "+" { "-" } else { "+" });
            if let Some(end) = term(all, index + 1, &["+", "-"]) {
                put(token.start, end, "");
            }
        }
        (Kind::Sign, "-") => put(token.start, token.end(), ""),
        (Kind::Sign, "*" | "/") if binary && spaced => {
            put(token.start, token.end(), if token.text == "*" { "/" } else { "*" });
            if let Some(end) = term(all, index + 1, &["+", "-", "*", "/"]) {
                put(token.start, end, "");
            }
        }
        (Kind::Sign, sign) if spaced => {
            let change = SIGNS.iter().find(|(before, _)| *before == sign);
            if let Some((_, after)) = change.filter(|_| !(subject.is_fortran() && sign == "/=")) {
                put(token.start, token.end(), after);
            }
        }
        (Kind::Number, number) => {
            let digits = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
            // Shifts and hexadecimal masks are bits, not arithmetic.
            if let Ok(whole) = number[..digits].parse::<u32>()
                && digits <= 3
                && !number.starts_with("0x")
            {
                put(token.start, token.start + digits, &(whole + 1).to_string());
            }
        }
        (Kind::Word, word) => at_word(subject, all, index, word, found),
        _ => {}
    }
}

fn at_word(subject: &Subject, all: &[Token<'_>], index: usize, word: &str, found: &mut Vec<Mutant>) {
    let text = &subject.text;
    let token = all[index];
    let called = all.get(index + 1).is_some_and(|next| next.text == "(");
    if let Some((_, other)) = FUNCTIONS.iter().find(|(name, _)| *name == word).filter(|_| called) {
        found.push(Mutant::new(text, token.start, token.end(), other));
    }
    if called && let Some((first, second)) = two_arguments(all, index + 1) {
        let swapped = [&text[second.0..second.1], &text[first.1..second.0], &text[first.0..first.1]].concat();
        found.push(Mutant::new(text, first.0, second.1, &swapped));
    }
    other_name(subject, token, found);
    // A statement that writes an answer is forgotten.
    let line_start = text[..token.start].rfind('\n').map_or(0, |at| at + 1);
    let starts_line = text[line_start..token.start].trim().is_empty();
    let line = text[line_start..].lines().next().unwrap_or_default();
    let whole = if subject.is_fortran() { !line.trim_end().ends_with('&') } else { line.trim_end().ends_with(';') };
    if starts_line && whole && line.contains(" = ") && ["out", "s", "answer"].contains(&word) {
        found.push(Mutant::new(
            text,
            token.start,
            line_start + line.len(),
            if subject.is_fortran() { "" } else { ";" },
        ));
    }
}

/// A name of one meaning for the next one.
fn other_name(subject: &Subject, token: Token<'_>, found: &mut Vec<Mutant>) {
    for names in &subject.names {
        if let Some(at) = names.iter().position(|name| *name == token.text) {
            found.push(Mutant::new(&subject.text, token.start, token.end(), names[(at + 1) % names.len()]));
        }
    }
}

/// Byte behind the operand that begins at token `from`: up to one of `ends`, or what closes or separates it.
fn term(all: &[Token<'_>], from: usize, ends: &[&str]) -> Option<usize> {
    let mut depth = 0_i32;
    let mut end = None;
    for token in &all[from..] {
        let stops = [";", ",", ")", "]", "}", "{", "?", ":", "=", "<", ">", "<=", ">=", "==", "&&", "||", "&"];
        if depth == 0 && end.is_some() && (ends.contains(&token.text) || stops.contains(&token.text)) {
            return end;
        }
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth < 0 {
            return None;
        }
        end = Some(token.end());
    }
    None
}

/// Where the first two arguments of a call stand, given the token of its opening bracket.
fn two_arguments(all: &[Token<'_>], open: usize) -> Option<((usize, usize), (usize, usize))> {
    let (mut depth, mut parts, mut start) = (0_i32, Vec::new(), all.get(open + 1)?.start);
    for pair in all[open..].windows(2) {
        let (token, next) = (pair[0], pair[1]);
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 1 && [",", ")"].contains(&next.text) {
            parts.push((start, token.end()));
            if parts.len() == 2 {
                let ordered = parts[0].0 < parts[0].1 && parts[0].1 <= parts[1].0 && parts[1].0 < parts[1].1;
                return ordered.then(|| (parts[0], parts[1]));
            }
            if next.text == ")" {
                return None;
            }
        }
        if depth == 1 && token.text == "," {
            start = next.start;
        }
        if depth == 0 {
            return None;
        }
    }
    None
}

#[test]
fn a_formula_has_the_mutants_that_one_expects() {
    let subject = Subject::of_text("law.c", "out->x = f(a, b) * c->K - fabs(p + 1);\n", &[&["K", "H"]]);
    let changed: Vec<String> = mutants(&subject).into_iter().map(|mutant| mutant.lines.1).collect();
    for expected in [
        ";",
        "out->x = f(b, a) * c->K - fabs(p + 1);",
        "out->x = f(a, b) / c->K - fabs(p + 1);",
        "out->x = f(a, b) - fabs(p + 1);",
        "out->x = f(a, b) * c->H - fabs(p + 1);",
        "out->x = f(a, b) * c->K + fabs(p + 1);",
        "out->x = f(a, b) * c->K ;",
        "out->x = f(a, b) * c->K - (p + 1);",
        "out->x = f(a, b) * c->K - fabs(p - 1);",
        "out->x = f(a, b) * c->K - fabs(p );",
        "out->x = f(a, b) * c->K - fabs(p + 2);",
    ] {
        assert!(changed.iter().any(|found| found == expected), "{expected} not in {changed:#?}");
    }
}
