//! What came of a run of checks, as text for people, as JSON and as JUnit for other programs.

mod json;
mod junit;
mod list;
mod text;

pub use json::json;
pub use junit::junit;
pub use list::{list_json, list_text, page};
pub use text::{EVIDENCE, WORDS, line, quiet, summary, text};
