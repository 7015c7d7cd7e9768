//! Arithmetic, comparison and conversion of reals: IEEE single, rounded to nearest even, denormals
//! included.
//!
//! An operand or a result that is infinite or not a number is an error: `None`. The SM1 bits, the
//! division by zero and OUT belong to the caller. The board's twin is firmware/modules/real.s.

use core::cmp::Ordering;

/// +R: the sum.
pub fn add(a: f32, b: f32) -> Option<f32> {
    checked(a, b, a + b)
}

/// -R: `a` minus `b`.
pub fn subtract(a: f32, b: f32) -> Option<f32> {
    checked(a, b, a - b)
}

/// *R: the product.
pub fn multiply(a: f32, b: f32) -> Option<f32> {
    checked(a, b, a * b)
}

/// /R: `a` divided by `b`. A divisor of zero is `None` too: /R looks for it first, because it sets
/// another bit.
pub fn divide(a: f32, b: f32) -> Option<f32> {
    checked(a, b, a / b)
}

fn checked(a: f32, b: f32, result: f32) -> Option<f32> {
    (a.is_finite() && b.is_finite() && result.is_finite()).then_some(result)
}

/// How `a` compares with `b`; -0.0 equals 0.0, infinities are ordered. `None` when one is not a
/// number.
pub fn compare(a: f32, b: f32) -> Option<Ordering> {
    a.partial_cmp(&b)
}

/// DTR: the real nearest to a double integer, the even one of two.
pub fn from_double(value: i32) -> f32 {
    value as f32
}

/// ROUND: the nearest double integer, halves away from zero. `None` when there is none.
pub fn round(x: f32) -> Option<i32> {
    let wide = f64::from(x);
    // Exact: a half and 31 bits before the point fit a double.
    to_double(wide + 0.5_f64.copysign(wide))
}

/// TRUNC: the double integer that is left without the fraction. `None` when it does not fit.
pub fn truncate(x: f32) -> Option<i32> {
    to_double(f64::from(x))
}

fn to_double(x: f64) -> Option<i32> {
    if x.is_finite() { i32::try_from(x as i64).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_infinity_is_an_error_as_operand_and_as_result() {
        assert_eq!(add(1.5, 2.25), Some(3.75));
        assert_eq!(multiply(f32::MAX, 2.0), None);
        assert_eq!(divide(1.0, f32::INFINITY), None);
        assert_eq!(divide(1.0, 0.0), None);
        assert_eq!(subtract(f32::NAN, 0.0), None);
        assert_eq!(multiply(f32::MIN_POSITIVE, 0.5), Some(f32::MIN_POSITIVE / 2.0));
    }

    #[test]
    fn round_goes_away_from_zero_and_truncate_towards_it() {
        let pairs = [
            (0.5, 1, 0),
            (-0.5, -1, 0),
            (2.5, 3, 2),
            (-2.4, -2, -2),
            (0.49999997, 0, 0),
            (8388609.0, 8388609, 8388609),
        ];
        for (x, rounded, truncated) in pairs {
            assert_eq!((round(x), truncate(x)), (Some(rounded), Some(truncated)), "{x}");
        }
        assert_eq!(
            (round(-2147483648.0), truncate(-2147483648.0)),
            (Some(i32::MIN), Some(i32::MIN))
        );
        for x in [2147483648.0, -2147483904.0, f32::NAN, f32::INFINITY] {
            assert_eq!((round(x), truncate(x)), (None, None), "{x}");
        }
    }

    #[test]
    fn only_numbers_compare() {
        assert_eq!(compare(-0.0, 0.0), Some(Ordering::Equal));
        assert_eq!(compare(f32::NEG_INFINITY, f32::MIN), Some(Ordering::Less));
        assert_eq!(compare(f32::NAN, f32::NAN), None);
        assert_eq!(from_double(16_777_217), 16_777_216.0);
    }
}
