//! Root mean squares of values that may be beyond the root of what a double holds.

/// A root mean square that is being gathered.
#[derive(Clone, Copy, Debug, Default)]
pub struct RootMean {
    squares: f64,
    count: f64,
    largest: f64,
}

impl RootMean {
    /// Takes in a value.
    #[inline]
    pub fn add(&mut self, value: f64) {
        self.squares += value * value;
        self.count += 1.0;
        self.largest = self.largest.max(value.abs());
    }

    /// Of these values and those of another one.
    #[must_use]
    pub fn with(self, other: RootMean) -> RootMean {
        RootMean {
            squares: self.squares + other.squares,
            count: self.count + other.count,
            largest: self.largest.max(other.largest),
        }
    }

    /// The root of the mean; 0 of no values, the largest where no double holds the squares.
    #[must_use]
    pub fn value(self) -> f64 {
        match self.count > 0.0 {
            false => 0.0,
            true if self.squares.is_finite() => (self.squares / self.count).sqrt(),
            true => self.largest,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::RootMean;

    #[test]
    fn parts_give_the_whole_and_nothing_overflows() {
        let of = |values: &[f64]| {
            let mut mean = RootMean::default();
            values.iter().for_each(|value| mean.add(*value));
            mean
        };
        assert_eq!(of(&[]).value(), 0.0);
        assert_eq!(of(&[3.0]).with(of(&[-4.0, 0.0, 0.0])).value(), 2.5);
        assert_eq!(of(&[1e200, -2e200]).value(), 2e200);
    }
}
