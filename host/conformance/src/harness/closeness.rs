//! Whether two answers are the same, and how far they are apart if not.

pub(crate) use super::answer::AtPoint;
use super::call::{Answers, good};
use super::points::number_text;
use super::ulps::ulps;

/// Units in the last place that answers of a law may differ by that does not claim to be deterministic.
pub(crate) const ULPS: u64 = 4;
/// Components of unit vectors and numbers that cancel: this far in units of one.
const COMPONENT: f64 = 4.0 * f64::EPSILON;

impl Answers {
    /// The numbers of one point.
    pub(crate) fn at(&self, point: usize) -> AtPoint {
        let count = self.increment.len();
        let part = |values: &[f64]| {
            let width = values.len() / count;
            values[point * width..(point + 1) * width].to_vec()
        };
        AtPoint {
            increment: self.increment[point],
            direction: part(&self.direction),
            state: part(&self.state),
            d_pressure: self.d_pressure.get(point).copied(),
        }
    }

    /// The numbers of all points.
    pub(crate) fn each(&self) -> Vec<AtPoint> {
        (0..self.increment.len()).map(|point| self.at(point)).collect()
    }

    /// True if the values at that point are meant to be used; without statuses the call's own counts.
    pub(crate) fn is_good_at(&self, point: usize) -> bool {
        self.point_status.get(point).map_or(self.is_good(), |status| good(*status))
    }
}

/// A difference between two answers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Difference {
    /// Which number: `increment`, `direction` ..
    pub(crate) item: &'static str,
    pub(crate) one: f64,
    pub(crate) other: f64,
    /// Units in the last place.
    pub(crate) ulps: u64,
    /// Small enough for a law that does not claim to be deterministic.
    pub(crate) small: bool,
}

impl Difference {
    /// As a sentence's end: `increment 1 and 2, 4503599627370496 units in the last place apart`.
    pub(crate) fn words(&self) -> String {
        let Self { item, one, other, ulps, .. } = self;
        let apart = match *ulps {
            u64::MAX => String::new(),
            1 => ", one unit in the last place apart".to_owned(),
            _ => format!(", {ulps} units in the last place apart"),
        };
        format!("{item} {} and {}{apart}", number_text(*one), number_text(*other))
    }
}

impl AtPoint {
    /// The largest difference to another point's numbers, of those that both have; none if they are the same to the bit.
    pub(crate) fn difference(&self, other: &AtPoint) -> Option<Difference> {
        let mut found: Option<Difference> = None;
        let mut compare = |item: &'static str, one: f64, other: f64| {
            if one.to_bits() == other.to_bits() {
                return;
            }
            let ulps = ulps(one, other);
            let small = ulps <= ULPS || item == "direction" && (one - other).abs() <= COMPONENT;
            let worse = found.as_ref().is_none_or(|f| (f.small && !small) || (f.small == small && ulps > f.ulps));
            if worse {
                found = Some(Difference { item, one, other, ulps, small });
            }
        };
        compare("increment", self.increment, other.increment);
        self.direction.iter().zip(&other.direction).for_each(|(a, b)| compare("direction", *a, *b));
        self.state.iter().zip(&other.state).for_each(|(a, b)| compare("state", *a, *b));
        if let (Some(one), Some(other)) = (self.d_pressure, other.d_pressure) {
            compare("d_pressure", one, other);
        }
        found
    }

    /// The numbers of another process, as many as these, from what its [`AtPoint::bits`] were.
    pub(crate) fn like(&self, bits: &mut impl Iterator<Item = u64>) -> Self {
        let mut next = || bits.next().map_or(f64::NAN, f64::from_bits);
        Self {
            increment: next(),
            direction: self.direction.iter().map(|_| next()).collect(),
            state: self.state.iter().map(|_| next()).collect(),
            d_pressure: self.d_pressure.map(|_| next()),
        }
    }

    /// All numbers, for another process.
    pub(crate) fn bits(&self) -> Vec<u64> {
        let all = [self.increment].into_iter().chain(self.direction.iter().copied());
        let all = all.chain(self.state.iter().copied()).chain(self.d_pressure);
        all.map(f64::to_bits).collect()
    }
}

/// True if two numbers agree to `tolerance` of the larger one.
pub(crate) fn agree(one: f64, other: f64, tolerance: f64) -> bool {
    one == other || (one - other).abs() <= tolerance * one.abs().max(other.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_agree_to_a_tolerance_and_nothing_agrees_with_nan() {
        assert!(agree(1.0, 1.0 + 1e-12, 1e-11) && !agree(1.0, 1.0 + 1e-10, 1e-11) && !agree(1.0, f64::NAN, 1.0));
    }

    #[test]
    fn the_worst_difference_is_told() {
        let one = AtPoint { increment: 1.0, direction: vec![0.0, 0.0, -1.0], state: vec![2.0], d_pressure: None };
        assert_eq!(one.difference(&one), None);
        let mut other = one.clone();
        other.direction[0] = 1e-17;
        other.increment = 1.0_f64.next_up();
        let found = one.difference(&other).unwrap();
        assert!(found.small);
        other.state[0] = 2.1;
        let found = one.difference(&other).unwrap();
        assert!(!found.small && found.item == "state", "{found:?}");
        assert!(found.words().starts_with("state 2 and 2.1"), "{}", found.words());
    }
}
