//! Units and numbers as people write them.

/// Units with a name of their own: exponents of metre, kilogram, second, kelvin.
const NAMED: &[([f64; 4], &str)] = &[
    ([0.0, 0.0, 0.0, 0.0], "-"),
    ([1.0, 1.0, -2.0, 0.0], "N"),
    ([2.0, 1.0, -2.0, 0.0], "J"),
    ([2.0, 1.0, -3.0, 0.0], "W"),
    ([-1.0, 1.0, -2.0, 0.0], "Pa"),
    ([1.0, -1.0, 2.0, 0.0], "1/Pa"),
    ([-1.0, 1.0, -2.0, -1.0], "Pa/K"),
    ([-1.0, 1.0, -1.0, 0.0], "Pa s"),
    ([0.0, 1.0, -2.0, 0.0], "J/m^2"),
    ([0.0, 1.0, -3.0, 0.0], "W/m^2"),
    ([1.0, 1.0, -3.0, -1.0], "W/(m K)"),
    ([2.0, 0.0, -2.0, 0.0], "J/kg"),
    ([2.0, 0.0, -2.0, -1.0], "J/(kg K)"),
];

/// The unit of these SI exponents: `Pa`, `m/s`, `1/K`, or in the worst case `m^1.5 kg^-1`.
pub(super) fn unit(exponents: [f64; 4]) -> String {
    if let Some((_, name)) = NAMED.iter().find(|(known, _)| *known == exponents) {
        return (*name).to_owned();
    }
    let parts = |sign: f64| {
        let named = ["m", "kg", "s", "K"].into_iter().zip(exponents).filter(move |(_, power)| power * sign > 0.0);
        let part = named.map(|(name, power)| match power.abs() {
            1.0 => name.to_owned(),
            power => format!("{name}^{power}"),
        });
        part.collect::<Vec<_>>()
    };
    let (above, below) = (parts(1.0), parts(-1.0));
    let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
    match below.as_slice() {
        [] => above,
        [one] => format!("{above}/{one}"),
        several => format!("{above}/({})", several.join(" ")),
    }
}

/// A number in the fewest digits that give it back, with a power of ten where that is easier to read.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) || !value.is_finite() {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// A number with `digits` significant digits: `7.3227993251e-6`.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if (1e-3..1e5).contains(&size) {
        let before = size.log10().floor() as i32 + 1;
        let after = usize::try_from(digits as i32 - before).unwrap_or(0);
        return format!("{value:.after$}");
    }
    format!("{value:.*e}", digits.saturating_sub(1))
}

/// A time that passed on the clock: `340 us`, `3.2 ms`, `2.51 s`, `2 min 5 s`.
pub(super) fn elapsed(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} us", s * 1e6),
        s if s < 1.0 => format!("{} ms", significant(s * 1e3, 3)),
        s if s < 100.0 => format!("{} s", significant(s, 3)),
        s => format!("{:.0} min {:.0} s", (s / 60.0).floor(), s % 60.0),
    }
}

/// A number of bytes: `640 bytes`, `16.4 KiB`.
pub(super) fn bytes(count: u64) -> String {
    let units = [(1_u64 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB")];
    match units.iter().find(|(size, _)| count >= *size) {
        Some((size, name)) => format!("{:.1} {name}", count as f64 / *size as f64),
        None => format!("{count} bytes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_the_names_that_people_use() {
        assert_eq!(unit([1.0, -1.0, 2.0, 0.0]), "1/Pa");
        assert_eq!(unit([1.0, 0.0, -1.0, 0.0]), "m/s");
        assert_eq!(unit([0.0, 0.0, 0.0, -1.0]), "1/K");
        assert_eq!(unit([-3.0, 1.0, 0.0, 0.0]), "kg/m^3");
        assert_eq!(unit([1.5, 0.0, -2.0, -1.0]), "m^1.5/(s^2 K)");
        assert_eq!(unit([0.0; 4]), "-");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            ["0", "1e9", "0.25", "1e-14", "inf"].map(|n| number(n.parse().unwrap())),
            ["0", "1e9", "0.25", "1e-14", "inf"]
        );
        assert_eq!(significant(7.322_799_325_1e-6, 11), "7.3227993251e-6");
        assert_eq!((significant(123.456, 4), significant(0.0, 3)), ("123.5".to_owned(), "0".to_owned()));
        assert_eq!((elapsed(0.0032), elapsed(125.0)), ("3.20 ms".to_owned(), "2 min 5 s".to_owned()));
        assert_eq!((bytes(640), bytes(16_794)), ("640 bytes".to_owned(), "16.4 KiB".to_owned()));
    }
}
