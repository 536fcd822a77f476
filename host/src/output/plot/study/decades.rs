//! Logarithmic axes: whole decades, a label at each or at every few, ticks between them.

use crate::output::plot::axis::superscript;

/// Most labels along an axis.
const LABELS: i32 = 9;

/// An axis of decades; positions are fractions of its length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Decades {
    low: f64,
    high: f64,
}

impl Decades {
    /// The axis that holds all values above zero, with a little room at both ends.
    pub(super) fn around(values: impl Iterator<Item = f64>) -> Self {
        let logs = values.filter(|value| *value > 0.0 && value.is_finite()).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), log| (a.min(log), b.max(log)));
        if low > high {
            return Self { low: -1.0, high: 0.0 };
        }
        let room = 0.04 * (high - low).max(1.0);
        let (low, high) = (low - room, high + room);
        // At least a decade, so that there is a label.
        let short = (1.0 - (high - low)).max(0.0) / 2.0;
        Self { low: low - short, high: high + short }
    }

    /// Where a value stands; outside of 0 to 1 where it is beyond the ends.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        (value.log10() - self.low) / (self.high - self.low)
    }

    /// Whether a value lies between the ends.
    pub(super) fn holds(&self, value: f64) -> bool {
        value > 0.0 && (0.0..=1.0).contains(&self.fraction(value))
    }

    /// Labelled decades as (fraction, label).
    pub(super) fn labels(&self) -> Vec<(f64, String)> {
        let (first, last) = (self.low.ceil() as i32, self.high.floor() as i32);
        let every = ((last - first) / LABELS + 1).max(1);
        let wanted = (first..=last).filter(|decade| decade.rem_euclid(every) == 0);
        wanted.map(|decade| (self.at(f64::from(decade)), format!("10{}", superscript(decade)))).collect()
    }

    /// Every decade, and twice to nine times each where there is room.
    pub(super) fn ticks(&self) -> Vec<(f64, bool)> {
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let between = last - first <= LABELS;
        let mut ticks = Vec::new();
        for decade in first..=last {
            for times in 1..=if between { 9 } else { 1 } {
                let at = self.at(f64::from(decade) + f64::from(times).log10());
                if (0.0..=1.0).contains(&at) {
                    ticks.push((at, times == 1));
                }
            }
        }
        ticks
    }

    fn at(&self, log: f64) -> f64 {
        (log - self.low) / (self.high - self.low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_have_labels_and_ticks_between() {
        let axis = Decades::around([3e-4, 2e-1, 0.0, f64::NAN, f64::INFINITY].into_iter());
        let labels: Vec<String> = axis.labels().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["10⁻³", "10⁻²", "10⁻¹"]);
        assert!((axis.fraction(1e-2) - axis.labels()[1].0).abs() < 1e-12);
        assert!(axis.ticks().len() > 20 && axis.ticks().iter().filter(|(_, whole)| *whole).count() == 3);
        assert!(axis.holds(1e-3) && !axis.holds(1e-9) && !axis.holds(0.0));
    }

    #[test]
    fn any_values_give_an_axis_with_a_label() {
        for values in [&[][..], &[0.5], &[3e-7, 3.1e-7], &[1e-300, 1e300], &[0.0]] {
            let axis = Decades::around(values.iter().copied());
            let labels = axis.labels();
            assert!((1..=10).contains(&labels.len()), "{values:?}: {labels:?}");
            assert!(axis.ticks().iter().all(|(at, _)| (0.0..=1.0).contains(at)));
        }
    }
}
