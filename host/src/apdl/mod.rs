//! Reads the wear commands of a finite-element input deck (TB, TBDATA, TBFIELD, TBTEMP) into plain values.
//! Text becomes statements (`lexer`), numbers (`expression`, `parameters`), commands (`command`), tables
//! (`wear_table`), materials (`deck`), the law section of a scene (`lower`); what is wrong is said by `diagnostic`.
//! Not here: every other command of a deck (passed over with a note) and what a scene does with the values.

mod command;
mod deck;
mod diagnostic;
mod expression;
mod lexer;
mod lower;
mod note;
mod parameters;
mod problem;
mod reader;
mod row;
mod wear_table;

#[cfg(test)]
mod tests;

pub use deck::{Deck, LawOption, Scaling, ScalingKind, TableRow, WearMaterial};
pub use diagnostic::{DeckError, Diagnostic};
pub use expression::ExpressionError;
pub use lexer::Span;
pub use lower::{LowerError, to_toml};
pub use note::Note;
pub use problem::Problem;
