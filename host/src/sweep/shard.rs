//! A part of a sweep, for arrays of jobs.

use super::SweepError;

/// Shard `index` of `count`, counted from 1: every `count`th case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// The whole of it.
    pub const WHOLE: Shard = Shard { index: 1, count: 1 };

    /// Reads `I/N`.
    ///
    /// # Errors
    /// Text of another form, a shard beyond the last.
    pub fn parse(text: &str) -> Result<Shard, SweepError> {
        let parts = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Shard { index, count }),
            _ => Err(SweepError::Shard { text: text.to_owned() }),
        }
    }

    /// Whether a case, counted from 1, belongs to it.
    #[must_use]
    pub fn has(&self, case: usize) -> bool {
        (case - 1) % self.count == self.index - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_belongs_to_one_shard() {
        for count in 1..8 {
            for case in 1..30 {
                let shards = (1..=count).filter(|index| Shard::parse(&format!("{index}/{count}")).unwrap().has(case));
                assert_eq!(shards.count(), 1);
            }
        }
        assert!((1..9).all(|case| Shard::WHOLE.has(case)));
        for text in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/2"] {
            assert!(Shard::parse(text).is_err(), "{text}");
        }
    }
}
