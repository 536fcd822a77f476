//! Numbers and simple expressions in the fields of a deck.
//!
//! Order of evaluation as the deck's solver documents it: parentheses, exponentiation (from right to left),
//! multiplication and division (from left to right), signs, addition and subtraction. `-2**2` is -4.

use thiserror::Error;

use super::lexer::{Field, Span};
use super::parameters::{Parameter, Parameters};
use super::problem::{Fault, Problem, suggestion};

/// Deepest nesting of parentheses, signs and exponents; decks use four, and the limit keeps the stack bounded.
const DEEPEST: usize = 64;

/// A function of one argument and its name.
type Function = (&'static str, fn(f64) -> f64);

/// The functions that are read; sines are not, since `*AFUN` may have changed their unit.
const FUNCTIONS: [Function; 5] =
    [("SQRT", f64::sqrt), ("ABS", f64::abs), ("EXP", f64::exp), ("LOG", f64::ln), ("LOG10", f64::log10)];

/// Why a field has no value.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the message of each variant names its fields")]
pub enum ExpressionError {
    #[error("`{name}` is neither a number nor a parameter defined above{}", suggestion(.nearest))]
    Undefined { name: String, nearest: Option<String> },
    #[error(
        "parameter `{name}` is set by {command} on line {line}, which is not evaluated: expected `{name}=` and a number"
    )]
    NotEvaluated { name: String, command: String, line: usize },
    #[error("`{text}` is not a number")]
    Malformed { text: String },
    #[error("`{text}` is beyond what a 64-bit number holds")]
    OutOfRange { text: String },
    #[error("unknown function `{name}`: expected SQRT, ABS, EXP, LOG or LOG10 (array elements are not read)")]
    UnknownFunction { name: String },
    #[error("found `{}`, expected {expected}", .found.escape_debug())]
    Unexpected { found: char, expected: &'static str },
    #[error("the expression ends where {expected} was expected")]
    Incomplete { expected: &'static str },
    #[error("the result is not finite")]
    NotFinite,
    #[error("parentheses, signs and exponents are nested more than {DEEPEST} deep")]
    TooDeep,
    #[error("a blank before `*` makes the rest of the line a comment for the solver: expected no blank, or `!`")]
    BlankBeforeStar,
}

/// The value of a field; `what` names the field in messages.
///
/// # Errors
/// The part of the field that is wrong, or the definition of a parameter it uses.
pub(super) fn evaluate(field: &Field<'_>, what: &str, parameters: &Parameters) -> Result<f64, Box<Fault>> {
    let mut parser = Parser { text: field.text, at: 0, depth: 0, field: field.span, what, parameters };
    let value = parser.sum()?;
    match parser.peek() {
        None => Ok(value),
        Some(found) => {
            let expected = "an operator or the end of the field";
            let end = parser.at + found.len_utf8();
            let error = ExpressionError::Unexpected { found, expected };
            Err(parser.fault(error, parser.at, end))
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    field: Span,
    what: &'a str,
    parameters: &'a Parameters,
}

impl Parser<'_> {
    fn fault(&self, error: ExpressionError, start: usize, end: usize) -> Box<Fault> {
        let span = self.span(start, end);
        let what = self.what.to_owned();
        Fault::new(Problem::Expression { what, error }, span)
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span { line: self.field.line, start: self.field.start + start, end: self.field.start + end }
    }

    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at = self.text.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, symbol: &str) -> bool {
        self.peek();
        let found = self.text[self.at..].starts_with(symbol);
        if found {
            self.at += symbol.len();
        }
        found
    }

    /// Whether a `*` comes next; after a blank it would be a comment to the solver, so that reading on would give another value.
    fn star_ahead(&mut self) -> Result<bool, Box<Fault>> {
        let before = self.at;
        let ahead = self.peek() == Some('*');
        if ahead && self.at > before {
            return Err(self.fault(ExpressionError::BlankBeforeStar, self.at, self.text.len()));
        }
        Ok(ahead)
    }

    fn finite(&self, value: f64, start: usize) -> Result<f64, Box<Fault>> {
        if value.is_finite() { Ok(value) } else { Err(self.fault(ExpressionError::NotFinite, start, self.at)) }
    }

    fn sum(&mut self) -> Result<f64, Box<Fault>> {
        self.peek();
        let start = self.at;
        let mut value = self.product()?;
        loop {
            let next = if self.take("+") {
                value + self.product()?
            } else if self.take("-") {
                value - self.product()?
            } else {
                return Ok(value);
            };
            value = self.finite(next, start)?;
        }
    }

    fn product(&mut self) -> Result<f64, Box<Fault>> {
        self.peek();
        let start = self.at;
        let mut value = self.signed()?;
        loop {
            let next = if self.star_ahead()? {
                self.take("*");
                value * self.signed()?
            } else if self.take("/") {
                value / self.signed()?
            } else {
                return Ok(value);
            };
            value = self.finite(next, start)?;
        }
    }

    fn signed(&mut self) -> Result<f64, Box<Fault>> {
        self.peek();
        let start = self.at;
        if self.depth == DEEPEST {
            return Err(self.fault(ExpressionError::TooDeep, start, self.text.len()));
        }
        self.depth += 1;
        let mut negative = false;
        loop {
            if self.take("-") {
                negative = !negative;
            } else if !self.take("+") {
                break;
            }
        }
        let value = self.power()?;
        self.depth -= 1;
        Ok(if negative { -value } else { value })
    }

    fn power(&mut self) -> Result<f64, Box<Fault>> {
        self.peek();
        let start = self.at;
        let base = self.operand()?;
        if self.star_ahead()? && self.take("**") {
            let exponent = self.signed()?;
            return self.finite(base.powf(exponent), start);
        }
        Ok(base)
    }

    fn operand(&mut self) -> Result<f64, Box<Fault>> {
        let expected = "a number, a parameter or `(`";
        match self.peek() {
            Some('(') => {
                self.at += 1;
                self.parenthesised()
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_ascii_alphabetic() || c == '_' => self.named(),
            Some(found) => {
                let end = self.at + found.len_utf8();
                let error = ExpressionError::Unexpected { found, expected };
                Err(self.fault(error, self.at, end))
            }
            None => Err(self.fault(ExpressionError::Incomplete { expected }, self.at, self.at)),
        }
    }

    /// What follows a `(`, up to and with its `)`.
    fn parenthesised(&mut self) -> Result<f64, Box<Fault>> {
        let value = self.sum()?;
        if self.take(")") {
            return Ok(value);
        }
        let expected = "`)`";
        let error = match self.peek() {
            Some(found) => ExpressionError::Unexpected { found, expected },
            None => ExpressionError::Incomplete { expected },
        };
        let end = self.text[self.at..].chars().next();
        let end = self.at + end.map_or(0, char::len_utf8);
        Err(self.fault(error, self.at, end))
    }

    fn named(&mut self) -> Result<f64, Box<Fault>> {
        let start = self.at;
        let length = self.text[start..]
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .unwrap_or(self.text.len() - start);
        self.at += length;
        let name = &self.text[start..self.at];
        let end = self.at;
        if self.take("(") {
            let function = FUNCTIONS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
            let Some((_, function)) = function else {
                let name = name.to_owned();
                return Err(self.fault(ExpressionError::UnknownFunction { name }, start, end));
            };
            let value = function(self.parenthesised()?);
            return self.finite(value, start);
        }
        let name = name.to_owned();
        match self.parameters.get(&name) {
            Some(Parameter::Value(value)) => Ok(*value),
            Some(Parameter::Unknown { command, line }) => {
                let (command, line) = (command.clone(), *line);
                let error = ExpressionError::NotEvaluated { name, command, line };
                Err(self.fault(error, start, end))
            }
            Some(Parameter::Faulty(fault)) => Err(fault.clone().beside(self.span(start, end), "needed here")),
            None => {
                let nearest = self.parameters.nearest(&name);
                Err(self.fault(ExpressionError::Undefined { name, nearest }, start, end))
            }
        }
    }

    /// Digits, a point, an exponent after E or D.
    fn number(&mut self) -> Result<f64, Box<Fault>> {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let mut end = digits(start);
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        let mantissa = &self.text[start..end];
        if matches!(bytes.get(end), Some(b'e' | b'E' | b'd' | b'D')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let exponent = digits(end + 1 + sign);
            if exponent > end + 1 + sign {
                end = exponent;
            }
        }
        let tail = self.text[end..].find(|c: char| !c.is_alphanumeric() && !matches!(c, '.' | '_'));
        let tail = tail.unwrap_or(self.text.len() - end);
        self.at = end + tail;
        let text = self.text[start..self.at].to_owned();
        let value = text.replace(['d', 'D'], "e").parse::<f64>();
        let error = match value {
            Ok(value) if tail == 0 && value.is_finite() => {
                let written_as_zero = !mantissa.bytes().any(|b| matches!(b, b'1'..=b'9'));
                if value != 0.0 || written_as_zero {
                    return Ok(value);
                }
                ExpressionError::OutOfRange { text }
            }
            Ok(_) if tail == 0 => ExpressionError::OutOfRange { text },
            _ => ExpressionError::Malformed { text },
        };
        Err(self.fault(error, start, self.at))
    }
}
