//! Distance of two numbers in units in the last place.

/// Distance of two numbers in units in the last place; the largest number if one is NaN.
pub fn ulps(one: f64, other: f64) -> u64 {
    let place = |number: f64| {
        let size = (number.to_bits() & !(1 << 63)).cast_signed();
        if number.is_sign_negative() { -size } else { size }
    };
    if one.is_nan() || other.is_nan() { u64::MAX } else { place(one).abs_diff(place(other)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_the_last_place_count_across_zero() {
        assert_eq!(ulps(1.0, 1.0_f64.next_up()), 1);
        assert_eq!(ulps(0.0, -0.0), 0);
        assert_eq!(ulps(-5e-324, 5e-324), 2);
        assert_eq!(ulps(1.0, f64::NAN), u64::MAX);
    }
}
