//! Conversions between bytes, words, double words, reals and BCD (docs/s7-200.md 1.6).

use plc_isa::{Bit, Op, ProgramMemory};

use super::INVALID_BCD;
use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::real;
use crate::references::Width;
use crate::special::OVERFLOW;

/// The segments for the digits 0 to F: bit 0 is a, bit 6 is g.
const SEGMENTS: [u8; 16] = [
    0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07, 0x7F, 0x67, 0x77, 0x7C, 0x39, 0x5E, 0x79, 0x71,
];

/// Digits of a BCD number.
const BCD_DIGITS: u32 = 4;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn convert(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Bti => self.map(Width::Byte, Width::Word, |byte| byte),
            Op::Itd => self.map(Width::Word, Width::Double, |word| word),
            Op::Itb => self.narrow(Width::Word, Width::Byte),
            Op::Dti => self.narrow(Width::Double, Width::Word),
            Op::Bcdi => self.map_word(of_bcd),
            Op::Ibcd => self.map_word(to_bcd),
            Op::Deco => self.map(Width::Byte, Width::Word, |number| 1 << (number & 15)),
            Op::Enco => {
                self.map(Width::Word, Width::Byte, |word| i64::from(word.trailing_zeros() & 15))
            }
            Op::Seg => self
                .map(Width::Byte, Width::Byte, |digit| i64::from(SEGMENTS[(digit & 15) as usize])),
            Op::Dtr => self.map(Width::Double, Width::Double, |value| {
                i64::from(real::from_double(value as i32).to_bits())
            }),
            Op::Round => self.real_to_double(real::round),
            Op::Trunc => self.real_to_double(real::truncate),
            _ => Err(Failure::Undefined),
        }
    }

    fn map(&mut self, from: Width, to: Width, convert: fn(i64) -> i64) -> Result<(), Failure> {
        let (value, out) = (self.read(0, from)?, self.target(1, to, 1)?);
        self.put(out, to, convert(value));
        Ok(())
    }

    fn narrow(&mut self, from: Width, to: Width) -> Result<(), Failure> {
        let (value, out) = (self.read(0, from)?, self.target(1, to, 1)?);
        self.put_if(out, to, to.holds(value).then_some(value), OVERFLOW)
    }

    fn map_word(&mut self, convert: fn(i64) -> Option<i64>) -> Result<(), Failure> {
        let out = self.target(0, Width::Word, 1)?;
        let value = convert(self.get(out, Width::Word));
        self.put_if(out, Width::Word, value, INVALID_BCD)
    }

    fn real_to_double(&mut self, convert: fn(f32) -> Option<i32>) -> Result<(), Failure> {
        let (value, out) = (self.read_real(0)?, self.target(1, Width::Double, 1)?);
        self.put_if(out, Width::Double, convert(value).map(i64::from), OVERFLOW)
    }

    /// Writes a value if there is one, and sets a bit of SMB1 if there is none.
    pub(super) fn put_if(
        &mut self,
        out: u16,
        width: Width,
        value: Option<i64>,
        none: Bit,
    ) -> Result<(), Failure> {
        self.interpreter.memory.set_bit(none, value.is_none());
        self.put(out, width, value.ok_or(Failure::Result)?);
        Ok(())
    }
}

fn of_bcd(bcd: i64) -> Option<i64> {
    (0..BCD_DIGITS).rev().try_fold(0, |number, place| {
        let digit = bcd >> (4 * place) & 15;
        (digit < 10).then_some(10 * number + digit)
    })
}

fn to_bcd(number: i64) -> Option<i64> {
    let digit = |place| number / 10_i64.pow(place) % 10;
    (0..10_i64.pow(BCD_DIGITS))
        .contains(&number)
        .then(|| (0..BCD_DIGITS).fold(0, |bcd, place| bcd | digit(place) << (4 * place)))
}

#[cfg(test)]
mod tests {
    use super::{of_bcd, to_bcd};

    #[test]
    fn every_bcd_number_comes_back() {
        for number in 0..10_000 {
            assert_eq!(to_bcd(number).and_then(of_bcd), Some(number));
        }
        assert_eq!((to_bcd(1234), to_bcd(-1), to_bcd(10_000)), (Some(0x1234), None, None));
        assert_eq!(
            (of_bcd(0x000A), of_bcd(-1), of_bcd(0x9999 - 0x10000)),
            (None, None, Some(9999))
        );
    }
}
