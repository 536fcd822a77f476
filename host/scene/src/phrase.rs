//! Parts of messages: lists, guesses, reasons.

use std::fmt;

use super::bound::LARGEST_COUNT;

/// "did you mean" where something is near, the list of all where nothing is.
pub(super) struct Hint<'a>(pub(super) &'a Option<String>, pub(super) &'a [String]);

impl fmt::Display for Hint<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0, self.1) {
            (Some(nearest), _) => write!(f, ", did you mean `{nearest}`?"),
            (None, []) => Ok(()),
            (None, valid) => write!(f, ", expected {}", List(valid)),
        }
    }
}

/// All of them, the last after "or".
pub(super) struct List<'a, T>(pub(super) &'a [T]);

impl<T: fmt::Display> fmt::Display for List<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, item) in self.0.iter().enumerate() {
            let between = match index {
                0 => "",
                _ if index + 1 == self.0.len() => " or ",
                _ => ", ",
            };
            write!(f, "{between}`{item}`")?;
        }
        Ok(())
    }
}

/// A reason after a space, if there is one.
pub(super) struct Because<'a>(pub(super) &'a str);

impl fmt::Display for Because<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() { Ok(()) } else { write!(f, " {}", self.0) }
    }
}

/// A character that does not belong, if there is one.
pub(super) struct Stranger<'a>(pub(super) &'a Option<char>);

impl fmt::Display for Stranger<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |stranger| write!(f, " with {stranger:?} among them"))
    }
}

/// A point of a table.
pub(super) struct Point<'a>(pub(super) &'a Option<f64>, pub(super) &'a Option<f64>);

impl fmt::Display for Point<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0, self.1) {
            (Some(time), Some(temperature)) => {
                write!(f, "time {time:?}, temperature {temperature:?}")
            }
            (Some(time), None) => write!(f, "time {time:?}"),
            (None, Some(temperature)) => write!(f, "temperature {temperature:?}"),
            (None, None) => write!(f, "no point"),
        }
    }
}

/// An upper end, where it is one that anybody could reach.
pub(super) struct Most(pub(super) u64);

impl fmt::Display for Most {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 < LARGEST_COUNT { write!(f, " and not above {}", self.0) } else { Ok(()) }
    }
}

/// So many entries of a list.
pub(super) struct Entries(pub(super) usize);

impl fmt::Display for Entries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.0, if self.0 == 1 { "entry" } else { "entries" })
    }
}
