//! Axes: what they span, where their ticks stand, and what their caption says.

/// Numbers from here on up, or below `SMALL`, are shown with a power of ten in the caption.
const LARGE: f64 = 1e4;
const SMALL: f64 = 1e-2;
/// Below this the largest number of an axis is drawn as zero; powers of ten would leave the range.
const NOTHING: f64 = 1e-290;

/// The quantity that has no fractions.
pub(super) const COUNT: &str = "Point number";

/// One axis; positions are fractions of its length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    /// Quantity, power of ten and unit.
    pub caption: String,
    /// Ticks as (fraction of the length, label).
    pub ticks: Vec<(f64, String)>,
    low: f64,
    high: f64,
    factor: f64,
}

impl Axis {
    /// An axis from the smallest to the largest of `values`, with about `wanted` ticks.
    pub fn spanning((quantity, unit): (&str, &str), values: impl Iterator<Item = f64>, wanted: usize) -> Self {
        let (low, high) = extent(values);
        Self::new((quantity, unit), low, high, wanted)
    }

    /// An axis that shows zero, so that heights can be compared, with room above the largest.
    pub fn from_zero((quantity, unit): (&str, &str), values: impl Iterator<Item = f64>, wanted: usize) -> Self {
        let (low, high) = extent(values);
        let (low, high) = (low.min(0.0), high.max(0.0));
        let room = 0.06 * (high / 2.0 - low / 2.0) * 2.0;
        let below = if low < 0.0 { low - room } else { 0.0 };
        Self::new((quantity, unit), below, if high > 0.0 { high + room } else { high }, wanted)
    }

    fn new((quantity, unit): (&str, &str), low: f64, high: f64, wanted: usize) -> Self {
        let largest = low.abs().max(high.abs()).min(1e300);
        let exponent = if largest < NOTHING || (SMALL..LARGE).contains(&largest) {
            0
        } else {
            3 * (largest.log10() / 3.0).floor() as i32
        };
        let factor = 10_f64.powi(exponent);
        let (mut low, mut high) = (low.max(-1e300) / factor, high.min(1e300) / factor);
        if largest < NOTHING {
            (low, high) = (0.0, 1.0);
        } else if high - low <= 1e-9 * (largest / factor) {
            // A single value: an axis from zero says more than one of no length.
            (low, high) = (low.min(0.0), high.max(0.0));
        }
        let (mut step, mut decimals) = tick_step((high - low) / wanted as f64);
        if quantity == COUNT && step * factor < 1.0 {
            (step, decimals) = (1.0 / factor, 0);
        }
        let (first, last) = ((low / step - 1e-6).ceil() as i64, (high / step + 1e-6).floor() as i64);
        let ticks = (first..=last)
            .map(|i| {
                let at = i as f64 * step;
                ((at - low) / (high - low), format!("{at:.decimals$}").replace('-', "−"))
            })
            .collect();
        Self { caption: caption(quantity, unit, exponent), ticks, low, high, factor }
    }

    /// Where a value stands, as a fraction of the length.
    pub fn fraction(&self, value: f64) -> f64 {
        (value / self.factor - self.low) / (self.high - self.low)
    }
}

/// Smallest and largest finite value; zeros when there is none.
fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low <= high { (low, high) } else { (0.0, 0.0) }
}

/// The step of 1, 2 or 5 times a power of ten next to `rough`, and the decimals its labels need.
fn tick_step(rough: f64) -> (f64, usize) {
    let power = rough.log10().floor() as i32;
    let base = 10_f64.powi(power);
    let (times, up) = match rough / base {
        r if r < 1.5 => (1.0, 0),
        r if r < 3.5 => (2.0, 0),
        r if r < 7.5 => (5.0, 0),
        _ => (10.0, 1),
    };
    (times * base, (-(power + up)).max(0) as usize)
}

fn caption(quantity: &str, unit: &str, exponent: i32) -> String {
    let power = if exponent == 0 { String::new() } else { format!("10{}", superscript(exponent)) };
    match (power.as_str(), unit) {
        ("", "") => quantity.to_owned(),
        (only, "") | ("", only) => format!("{quantity} ({only})"),
        (power, unit) => format!("{quantity} ({power} {unit})"),
    }
}

/// A number for running text: four digits, with a power of ten where it is large or small.
pub(in crate::output) fn number(value: f64) -> String {
    rounded(value, 4)
}

/// A number in so many digits, at least four, with a power of ten where it is large or small.
pub(in crate::output) fn rounded(value: f64, digits: usize) -> String {
    let size = value.abs();
    if size == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.*e}", digits - 1);
    let (shown, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-2..4).contains(&exponent) {
        trimmed(&format!("{value:.*}", (digits as i32 - 1 - exponent) as usize))
    } else {
        format!("{}×10{}", trimmed(shown), superscript(exponent))
    };
    text.replace('-', "−")
}

fn trimmed(digits: &str) -> String {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.').to_owned() } else { digits.to_owned() }
}

pub(super) fn superscript(exponent: i32) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| digits[digit as usize]);
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn small_numbers_have_their_power_in_the_caption() {
        let axis = Axis::from_zero(("Wear depth", "m"), [0.0, 7.3e-6].into_iter(), 5);
        assert_eq!(axis.caption, "Wear depth (10⁻⁶ m)");
        assert_eq!(labels(&axis), ["0", "2", "4", "6"]);
        assert_eq!(axis.fraction(0.0), 0.0);
        assert!((axis.fraction(7.3e-6) - 1.0 / 1.06).abs() < 1e-12);
        let tiny = Axis::from_zero(("Wear depth", "m"), [1e-12].into_iter(), 5);
        assert_eq!(tiny.caption, "Wear depth (10⁻¹² m)");
        assert_eq!(labels(&tiny), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn any_values_give_an_axis_with_ticks_in_range() {
        let cases: [&[f64]; 9] = [
            &[],
            &[0.0],
            &[3.0],
            &[-2.0],
            &[f64::NAN, f64::INFINITY],
            &[f64::MIN_POSITIVE],
            &[-f64::MAX, f64::MAX],
            &[1e6, 1e6 + 1.0],
            &[-1e-4, 3e-5],
        ];
        for values in cases {
            let many = values.iter().copied();
            for axis in [Axis::spanning(("q", ""), many.clone(), 5), Axis::from_zero(("q", ""), many.clone(), 5)] {
                assert!((2..=12).contains(&axis.ticks.len()), "{values:?}: {axis:?}");
                for (at, _) in &axis.ticks {
                    assert!((-1e-5..=1.0 + 1e-5).contains(at), "{values:?}: {axis:?}");
                }
                for value in values.iter().filter(|v| v.is_finite() && v.abs() < 1e299) {
                    let at = axis.fraction(*value);
                    assert!((-1e-9..=1.0 + 1e-9).contains(&at), "{values:?}: {axis:?}");
                }
            }
        }
        let both = Axis::spanning(("q", "m"), [-1e-4, 3e-5].into_iter(), 5);
        assert_eq!(labels(&both), ["−100", "−80", "−60", "−40", "−20", "0", "20"]);
    }

    #[test]
    fn point_numbers_have_no_fractions() {
        let axis = Axis::spanning((COUNT, ""), [1.0, 3.0].into_iter(), 5);
        assert_eq!(labels(&axis), ["1", "2", "3"]);
    }

    #[test]
    fn numbers_in_text_have_four_digits() {
        let cases = [
            (0.0, "0"),
            (3.5, "3.5"),
            (1000.0, "1000"),
            (0.012_345_67, "0.01235"),
            (7.322_799e-6, "7.323×10⁻⁶"),
            (-1.0e12, "−1×10¹²"),
            (9999.96, "1×10⁴"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
