//! SQRT SIN COS TAN LN EXP of a real, in integer steps that the board repeats one by one
//! (firmware/modules/function.s).
//!
//! SQRT is correctly rounded. The others are off by at most 0.6 ulp, SIN COS TAN for operands up to
//! 10,000: farther out their error grows, but up to 2^30 it stays below 2^-31. Changing a constant
//! or a step here means changing it there.
//!
//! Fractions are unsigned: a `u32` counts 2^-32, an angle or exponent in a `u64` counts 2^-62.

/// An operand that is not zero: ± `mantissa` / 2^31 * 2^`exponent`, the top bit of the mantissa
/// set.
struct Parts {
    negative: bool,
    mantissa: u32,
    exponent: i32,
}

/// `fraction` / 2^32 * 2^`exponent`.
struct Scaled {
    fraction: u32,
    exponent: i32,
}

/// |x| as so many quarter turns plus the rest, or minus the rest when `folded`.
struct Angle {
    /// Modulo 2^32.
    quarters: i32,
    rest: u64,
    folded: bool,
}

/// A quarter turn in 2^-62.
const QUARTER: u64 = 0x6487_ED51_10B4_611A;
/// ln 2 in 2^-62.
const LN_2: u64 = 0x2C5C_85FD_F473_DE6B;
/// From here on, an eighth of a turn roughly, the distance to the next quarter is taken.
const FOLD: u64 = 0x32 << 56;
/// Below 2^this, SIN x = TAN x = x and COS x = EXP x = 1.
const TINY_EXPONENT: i32 = -26;

/// Half of each function as a polynomial with alternating signs, the constant term first.
const SIN: [u32; 4] = [0x7FFF_FFF9, 0x1555_53F3, 0x0111_05F3, 0x0006_63CE];
const COS: [u32; 5] = [0x8000_0000, 0x3FFF_FFF7, 0x0555_54E7, 0x002D_80E6, 0x0000_CC7A];
const EXP: [u32; 7] =
    [0x7FFF_FFFD, 0x7FFF_FE5D, 0x3FFF_DA03, 0x1554_096D, 0x054F_E69F, 0x0105_39E9, 0x0020_4D5E];
const LN: [u32; 10] = [
    0x7FFF_FFFF,
    0x3FFF_FF09,
    0x2AAA_ABA2,
    0x2000_847C,
    0x1999_EB00,
    0x1542_3CB6,
    0x122C_BD19,
    0x10FA_BDB5,
    0x1065_BC87,
    0x098B_EC59,
];

/// SQRT: correctly rounded, -0.0 of -0.0. `None` for less.
pub fn sqrt(x: f32) -> Option<f32> {
    let x = finite(x)?;
    let Some(parts) = parts(x) else { return Some(x) };
    if parts.negative {
        return None;
    }
    let odd = parts.exponent & 1;
    // 25 bits: the last one rounds. It is never half-way, as the square of an odd number of 25 bits
    // has more than 24.
    let root = (u64::from(parts.mantissa) << (17 + odd)).isqrt() as u32;
    let exponent = (parts.exponent - odd) / 2;
    pack(false, root << 7 | 1, exponent + 1)
}

/// SIN of an angle in radians.
pub fn sin(x: f32) -> Option<f32> {
    let Some(angle) = angle(x)? else { return Some(x) };
    angle.sine(x.is_sign_negative())
}

/// COS of an angle in radians.
pub fn cos(x: f32) -> Option<f32> {
    let Some(angle) = angle(x)? else { return Some(1.0) };
    Angle { quarters: angle.quarters.wrapping_add(1), ..angle }.sine(false)
}

/// TAN of an angle in radians.
pub fn tan(x: f32) -> Option<f32> {
    let Some(angle) = angle(x)? else { return Some(x) };
    let (sine, cosine) = (angle.rest_sine(), angle.rest_cosine());
    let odd = angle.quarters & 1 != 0;
    let (dividend, divisor) = if odd { (cosine, sine) } else { (sine, cosine) };
    // A quarter of the quotient is less than 1, however the two are scaled.
    let quarter =
        (u64::from(dividend.fraction) << 30).checked_div(u64::from(divisor.fraction))? as u32;
    pack(
        x.is_sign_negative() ^ angle.folded ^ odd,
        quarter,
        dividend.exponent - divisor.exponent + 2,
    )
}

/// EXP: e to the power of x. `None` above 88.72; 0.0 below -103.97.
pub fn exp(x: f32) -> Option<f32> {
    let Some(x) = parts(finite(x)?).filter(|parts| parts.exponent >= TINY_EXPONENT) else {
        return Some(1.0);
    };
    if x.exponent >= 7 {
        return if x.negative { Some(0.0) } else { None };
    }
    // x = twos * ln 2 - rest
    let (mut twos, mut rest) = divide_with_rest(&x, LN_2);
    if x.negative {
        twos = -twos;
    } else {
        twos += 1;
        rest = LN_2 - rest;
    }
    pack(false, polynomial(&EXP, fraction(rest), true), twos + 1)
}

/// LN: the natural logarithm. `None` for zero and less.
pub fn ln(x: f32) -> Option<f32> {
    let Parts { negative, mantissa, mut exponent } = parts(finite(x)?)?;
    if negative {
        return None;
    }
    // x = 2^exponent * (1 + distance), the distance from -0.293 to 0.414
    let (mut distance, mut below) = (mantissa << 1, false);
    if mantissa >= 0xB500_0000 {
        (distance, below) = (mantissa.wrapping_neg(), true);
        exponent += 1;
    }
    let (leading, places) = normalize(u64::from(distance) << 32);
    let part = multiply(leading, polynomial(&LN, distance, !below));
    if exponent == 0 {
        return pack(below, part, 1 - places);
    }
    let part = i64::from(part.checked_shr((places - 1) as u32).unwrap_or(0));
    let whole = i64::from(exponent.unsigned_abs()) * (LN_2 >> 30) as i64;
    let (sum, places) =
        normalize((if below == (exponent < 0) { whole + part } else { whole - part }) as u64);
    pack(exponent < 0, sum, 32 - places)
}

/// Takes an angle apart; `Some(None)` when it is tiny.
fn angle(x: f32) -> Option<Option<Angle>> {
    let Some(x) = parts(finite(x)?).filter(|parts| parts.exponent >= TINY_EXPONENT) else {
        return Some(None);
    };
    let (quarters, rest) = divide_with_rest(&x, QUARTER);
    Some(Some(if rest >= FOLD {
        Angle { quarters: quarters.wrapping_add(1), rest: QUARTER - rest, folded: true }
    } else {
        Angle { quarters, rest, folded: false }
    }))
}

impl Angle {
    /// The sine, or its negative.
    fn sine(&self, negative: bool) -> Option<f32> {
        let odd = self.quarters & 1 != 0;
        let Scaled { fraction, exponent } = if odd { self.rest_cosine() } else { self.rest_sine() };
        pack(negative ^ (self.quarters & 2 != 0) ^ (self.folded && !odd), fraction, exponent)
    }

    fn rest_sine(&self) -> Scaled {
        let (leading, places) = normalize(self.rest);
        Scaled {
            fraction: multiply(leading, polynomial(&SIN, self.square(), true)),
            exponent: 3 - places,
        }
    }

    fn rest_cosine(&self) -> Scaled {
        Scaled { fraction: polynomial(&COS, self.square(), true), exponent: 1 }
    }

    fn square(&self) -> u32 {
        multiply(fraction(self.rest), fraction(self.rest))
    }
}

/// How often the divisor, in 2^-62 and from 0.5 to 2, fits |x|, modulo 2^32, and what is left of x,
/// in 2^-62.
fn divide_with_rest(x: &Parts, divisor: u64) -> (i32, u64) {
    let mut rest = u64::from(x.mantissa) << 30;
    let steps = x.exponent + 1;
    if steps < 0 {
        rest >>= -steps;
    }
    let mut count = i32::from(rest >= divisor);
    rest -= if rest >= divisor { divisor } else { 0 };
    for _ in 0..steps {
        rest <<= 1;
        count <<= 1;
        if rest >= divisor {
            rest -= divisor;
            count |= 1;
        }
    }
    (count, rest)
}

/// The first 32 bits of what counts 2^-62.
fn fraction(rest: u64) -> u32 {
    (rest >> 30) as u32
}

/// c0 ± x (c1 ± x (c2 ± ...)), minus throughout when `alternating`. A difference is 2^-32 too
/// small.
fn polynomial(coefficients: &[u32], x: u32, alternating: bool) -> u32 {
    let step = |sum: u32, coefficient: &u32| {
        let product = multiply(sum, x);
        coefficient.wrapping_add(if alternating { !product } else { product })
    };
    let mut coefficients = coefficients.iter().rev();
    let last = coefficients.next().copied().unwrap_or(0);
    coefficients.fold(last, step)
}

/// The product of two fractions, cut off.
fn multiply(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b)) >> 32) as u32
}

/// The first 32 bits from the first one that is set, and the number of zeros in front of it.
fn normalize(value: u64) -> (u32, i32) {
    let places = value.leading_zeros();
    ((value.checked_shl(places).unwrap_or(0) >> 32) as u32, places as i32)
}

/// An operand that is a number.
fn finite(x: f32) -> Option<f32> {
    x.is_finite().then_some(x)
}

/// Takes a finite number apart; `None` for zero.
fn parts(x: f32) -> Option<Parts> {
    let bits = x.to_bits();
    let (field, fraction) = ((bits >> 23 & 0xFF) as i32, bits & 0x7F_FFFF);
    let significand = if field == 0 { fraction } else { fraction | 0x80_0000 };
    let (mantissa, places) = normalize(u64::from(significand) << 40);
    (mantissa != 0).then(|| Parts {
        negative: x.is_sign_negative(),
        mantissa,
        exponent: field.max(1) - 127 - places,
    })
}

/// ± `fraction` / 2^32 * 2^`exponent`, rounded to nearest even. `None` when too large; 0.0 when too
/// small.
fn pack(negative: bool, fraction: u32, exponent: i32) -> Option<f32> {
    // Exact in double precision, so that it is rounded once.
    let unit = f64::from_bits(((1023 + exponent - 32) as u64) << 52);
    let magnitude = (f64::from(fraction) * unit) as f32;
    magnitude.is_finite().then_some(if negative { -magnitude } else { magnitude })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_ends_of_the_range() {
        assert_eq!((exp(88.72283), exp(88.72284)), (Some(3.4027985e38), None));
        assert_eq!(
            (exp(-103.97), exp(-104.0), exp(-500.0)),
            (Some(f32::from_bits(1)), Some(0.0), Some(0.0))
        );
        assert_eq!((ln(f32::from_bits(1)), ln(f32::MAX)), (Some(-103.27893), Some(88.72284)));
        assert_eq!((ln(0.0), ln(-0.0), ln(-1.0), sqrt(-1.0)), (None, None, None, None));
        assert_eq!((sin(f32::NAN), cos(f32::INFINITY), tan(f32::NEG_INFINITY)), (None, None, None));
    }

    #[test]
    fn exact_where_the_function_is() {
        for zero in [0.0_f32, -0.0] {
            for (result, function) in [(sin(zero), "SIN"), (tan(zero), "TAN"), (sqrt(zero), "SQRT")]
            {
                assert_eq!(result.map(f32::to_bits), Some(zero.to_bits()), "{function} {zero:?}");
            }
            assert_eq!((cos(zero), exp(zero)), (Some(1.0), Some(1.0)));
        }
        assert_eq!(
            (ln(1.0), sqrt(6.25), sqrt(f32::from_bits(4))),
            (Some(0.0), Some(2.5), Some(7.486784e-23))
        );
    }
}
