//! What a deck says about wear, as plain values.

use std::path::Path;

use super::diagnostic::{DeckError, Diagnostic};
use super::lexer::Span;
use super::note::Note;
use super::reader::Reader;

/// The wear materials of an input deck and what else there was in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The deck's name, as it appears in messages.
    pub source: String,
    /// Materials with a wear law, in the order of their first TB,WEAR.
    pub materials: Vec<WearMaterial>,
    /// What was passed over, in the order of first occurrence, then what was changed.
    pub notes: Vec<Note>,
}

/// The wear law of one material of a deck.
#[derive(Debug, Clone, PartialEq)]
pub struct WearMaterial {
    /// MATID.
    pub id: i64,
    /// Which law.
    pub option: LawOption,
    /// The constants, a row per point of time and temperature; one row without either for plain constants,
    /// none for a user-defined law without constants. Time runs slowest or fastest, as in the deck.
    pub tables: Vec<TableRow>,
    /// TB,WEAR with AUTS or CBCS, if there is one.
    pub scaling: Option<Scaling>,
    /// The TB,WEAR command of the law.
    pub span: Span,
}

/// ARCD or USER.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawOption {
    /// The Archard law: constants C1 to C4 are K, H, m, n; C5 to C8 are settings of the host.
    Archard,
    /// A law of the user's own.
    User {
        /// NPTS, or the highest constant given where NPTS is blank.
        constants: usize,
    },
}

/// Constants at one point of a table, in the deck's units.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRow {
    /// TBFIELD,TIME
    pub time: Option<f64>,
    /// TBFIELD,TEMP or TBTEMP
    pub temperature: Option<f64>,
    /// C1, C2, .. as far as they are given; `None` for a blank one.
    pub constants: Vec<Option<f64>>,
    /// The row's first TBDATA command.
    pub span: Span,
}

/// Scaling of the wear increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaling {
    /// AUTS or CBCS.
    pub kind: ScalingKind,
    /// C1, the factor of safety: more than 0, less than 1, by default 0.1.
    pub safety: f64,
    /// C2, the largest scale factor: at least 1, by default 1e5.
    pub maximum: f64,
}

/// How the wear increment is scaled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScalingKind {
    /// AUTS, automatic.
    Auto,
    /// CBCS, cycle by cycle.
    Cycle,
}

impl Deck {
    /// Reads the wear commands in `text`; `source` names the deck in messages.
    ///
    /// # Errors
    /// The first thing that is wrong with a wear command, with its line.
    pub fn parse(text: &str, source: &str) -> Result<Deck, DeckError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (materials, notes) =
            Reader::read(text).map_err(|fault| DeckError::Command(Box::new(Diagnostic::new(*fault, text, source))))?;
        Ok(Deck { source: source.to_owned(), materials, notes })
    }

    /// Reads the wear commands of a file, in any 8-bit encoding that contains ASCII: other bytes do no harm in
    /// comments and in what is passed over.
    ///
    /// # Errors
    /// The file cannot be read, or what [`Deck::parse`] finds.
    pub fn read(path: &Path) -> Result<Deck, DeckError> {
        let bytes = std::fs::read(path).map_err(|cause| DeckError::Read { path: path.to_owned(), cause })?;
        Deck::parse(&String::from_utf8_lossy(&bytes), &path.display().to_string())
    }

    /// The material with the number `chosen`, or the only one there is.
    ///
    /// # Errors
    /// There is no wear law, or several and none chosen, or none for the chosen number; the numbers are listed.
    pub fn material(&self, chosen: Option<i64>) -> Result<&WearMaterial, DeckError> {
        let source_name = self.source.clone();
        let mut found: Vec<i64> = self.materials.iter().map(|m| m.id).collect();
        found.sort_unstable();
        match (chosen, self.materials.as_slice()) {
            (_, []) => Err(DeckError::NoWear { source_name }),
            (None, [only]) => Ok(only),
            (None, _) => Err(DeckError::Several { source_name, found }),
            (Some(chosen), all) => {
                all.iter().find(|m| m.id == chosen).ok_or(DeckError::NoSuchMaterial { source_name, chosen, found })
            }
        }
    }
}
