//! Integer arithmetic with its SM1 bits (docs/s7-200.md 1.4 and docs/decisions.md).

use crate::memory::Memory;
use crate::special::{DIVISION_BY_ZERO, NEGATIVE, OVERFLOW, ZERO};

/// Writes a result, or leaves OUT as it is when there is none because it does not fit.
pub(crate) fn write_result(memory: &mut Memory, out: u16, result: Option<i16>) {
    if let Some(value) = result {
        memory.set_int(out, value);
    }
    write_status(memory, result.unwrap_or(1), result.is_none());
}

/// Writes a result that wrapped around, or did not.
pub(crate) fn write_wrapped(memory: &mut Memory, out: u16, (value, overflow): (i16, bool)) {
    memory.set_int(out, value);
    write_status(memory, value, overflow);
}

/// SM1.0 and SM1.2 of a value, SM1.1 when it overflowed.
pub(crate) fn write_status(memory: &mut Memory, value: i16, overflow: bool) {
    memory.set_bit(ZERO, value == 0);
    memory.set_bit(OVERFLOW, overflow);
    memory.set_bit(NEGATIVE, value < 0);
}

/// *I and /I: SM1.3 belongs to them.
pub(crate) fn write_product(memory: &mut Memory, out: u16, result: Option<i16>) {
    write_result(memory, out, result);
    memory.set_bit(DIVISION_BY_ZERO, false);
}

/// /I: a zero divisor sets SM1.3 and changes nothing else.
pub(crate) fn divide(memory: &mut Memory, out: u16, divisor: i16) {
    if divisor == 0 {
        memory.set_bit(DIVISION_BY_ZERO, true);
    } else {
        let quotient = memory.int(out).checked_div(divisor);
        write_product(memory, out, quotient);
    }
}
