//! Numbers rounded to eight digits: what searches go by, so that copies of a run that are moved, turned or scaled,
//! which differ in their last digits, take the same course.

const FINENESS: f64 = 1.0 / (1u64 << 26) as f64;

/// The nearest multiple of 2⁻²⁶.
pub(crate) fn fixed(number: f64) -> f64 {
    (number / FINENESS).round() * FINENESS
}

/// The nearest number of 26 bits after the first; as it is where it is too small to have them.
pub(crate) fn floating(number: f64) -> f64 {
    let unit = power_of_two(number) * FINENESS;
    if unit > 0.0 && unit.is_finite() { (number / unit).round() * unit } else { number }
}

/// The largest power of two that isn't above a number's absolute value; 0 if that is below 10⁻³⁰⁷, infinite for what
/// is not a finite number.
pub(crate) fn power_of_two(number: f64) -> f64 {
    f64::from_bits(number.to_bits() & f64::INFINITY.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_found_to_the_last_bit() {
        for exponent in [-1022, -300, -1, 0, 1, 52, 1023] {
            let power = 2f64.powi(exponent);
            for (number, known) in [(power, power), (-power, power), (power * 1.999, power)] {
                assert_eq!(power_of_two(number), known);
            }
            assert_eq!(power_of_two(power.next_up()), power);
            if exponent > -1022 {
                assert_eq!(power_of_two(power.next_down()), power / 2.0);
            }
        }
        assert_eq!(power_of_two(0.0), 0.0);
        assert_eq!(power_of_two(f64::NAN), f64::INFINITY);
    }

    #[test]
    fn rounding_keeps_eight_digits() {
        for number in [1e-300, 3.3e-5, 0.1, 1.0, 7.7e9, 1e300] {
            let off = (floating(number) / number - 1.0).abs();
            assert!(off <= 1.0 / (1u64 << 27) as f64 && floating(-number) == -floating(number));
        }
        assert_eq!(floating(floating(0.1)), floating(0.1));
        assert_eq!(floating(5e-324), 5e-324);
        assert_eq!((fixed(0.5), fixed(1e-9)), (0.5, 0.0));
    }
}
