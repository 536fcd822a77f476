//! What a reader of a deck should know although nothing is wrong.

use std::fmt;

/// Something that was passed over or changed while reading a deck.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// Commands without a bearing on wear.
    PassedOver {
        /// The command's name in capitals, or a word for lines that are no command.
        command: String,
        /// How often it occurs.
        count: usize,
        /// The line of its first occurrence, from 1.
        first_line: usize,
    },
    /// C6 to C8 were not of length 1 and are used scaled to it.
    DirectionScaled {
        /// The material's number.
        material: i64,
        /// The line of the table's TB command, from 1.
        line: usize,
        /// C6, C7, C8 as they stand in the deck.
        given: [f64; 3],
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::PassedOver { command, count, first_line } => {
                let command = command.escape_debug();
                let times = if *count == 1 { "time" } else { "times" };
                write!(f, "passed over {command}: {count} {times}, first on line {first_line}")
            }
            Note::DirectionScaled { material, line, given: [x, y, z] } => write!(
                f,
                "material {material} (line {line}): C6 to C8 ({x}, {y}, {z}) are not of length 1 and are used scaled to it"
            ),
        }
    }
}
