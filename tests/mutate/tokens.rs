//! The tokens of a source of C, C++, Fortran or Rust, as far as a mutation has to know them.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A name or a keyword.
    Word,
    /// A number.
    Number,
    /// An operator or a bracket.
    Sign,
}

/// A token and where it stands in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// What it is.
    pub kind: Kind,
    /// Its text.
    pub text: &'a str,
    /// Byte at which it begins.
    pub start: usize,
}

impl Token<'_> {
    /// Byte behind it.
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// Signs of more than one character, longest first.
const LONG_SIGNS: [&str; 27] = [
    "<<=", ">>=", "...", "..=", "->", "=>", "::", "==", "!=", "/=", "<=", ">=", "&&", "||", "++", "--", "+=", "-=",
    "*=", "%=", "|=", "&=", "^=", "<<", ">>", "**", "//",
];

/// The tokens of a text, without comments, texts in quotes and lines of the preprocessor that only include.
pub fn tokens(text: &str, fortran: bool) -> Vec<Token<'_>> {
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text[at..];
        let here = bytes[at];
        let comment = if fortran { rest.starts_with('!') } else { rest.starts_with("//") };
        if comment || rest.starts_with("#include") {
            at += rest.find('\n').unwrap_or(rest.len());
        } else if !fortran && rest.starts_with("/*") {
            at += rest.find("*/").map_or(rest.len(), |end| end + 2);
        } else if here == b'"' || here == b'\'' && is_quote(rest, fortran) {
            at += quoted(rest);
        } else if here.is_ascii_digit() {
            let length = number(rest);
            found.push(Token { kind: Kind::Number, text: &text[at..at + length], start: at });
            at += length;
        } else if here.is_ascii_alphabetic() || here == b'_' {
            let length = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
            found.push(Token { kind: Kind::Word, text: &text[at..at + length], start: at });
            at += length;
        } else if here.is_ascii_whitespace() || !here.is_ascii() {
            at += 1;
        } else {
            let length = LONG_SIGNS.iter().find(|sign| rest.starts_with(**sign)).map_or(1, |sign| sign.len());
            found.push(Token { kind: Kind::Sign, text: &text[at..at + length], start: at });
            at += length;
        }
    }
    found
}

/// Whether a single quote begins a text (Fortran) or a character, and not a lifetime of Rust.
fn is_quote(rest: &str, fortran: bool) -> bool {
    fortran || rest.len() > 2 && (rest.as_bytes()[2] == b'\'' || rest.as_bytes()[1] == b'\\')
}

/// Bytes of a text in quotes.
fn quoted(rest: &str) -> usize {
    let (quote, mut at) = (rest.as_bytes()[0], 1);
    while at < rest.len() && rest.as_bytes()[at] != quote {
        at += if rest.as_bytes()[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(rest.len())
}

/// Bytes of a number: digits, a point with digits, an exponent, a suffix.
fn number(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let here = bytes[at];
        let in_exponent = at > 0 && matches!(bytes[at - 1], b'e' | b'E') && !rest.starts_with("0x");
        let signed = in_exponent && matches!(here, b'+' | b'-');
        // `0..n` and `1.max(..)` are not numbers with a point.
        let point = here == b'.' && bytes.get(at + 1).is_none_or(|next| next.is_ascii_digit());
        if !(here.is_ascii_alphanumeric() || here == b'_' || point || signed) {
            break;
        }
        at += 1;
    }
    at
}

#[test]
fn tokens_leave_out_comments_and_texts_and_keep_numbers_whole() {
    let texts = |text, fortran| tokens(text, fortran).iter().map(|token| token.text.to_owned()).collect::<Vec<_>>();
    assert_eq!(texts("a = -1.5e-3 * b[i]; // c\n", false), ["a", "=", "-", "1.5e-3", "*", "b", "[", "i", "]", ";"]);
    assert_eq!(texts("x->y /* no */ >= \"a + b\" 0..n", false), ["x", "->", "y", ">=", "0", ".", ".", "n"]);
    assert_eq!(
        texts("s(1) = 'it' ! no\nc%p /= 0.0_c_double", true),
        ["s", "(", "1", ")", "=", "c", "%", "p", "/=", "0.0_c_double"]
    );
    assert_eq!(texts("fn f<'a>(x: &'a str) -> char { 'x' }", false).len(), 18);
}
