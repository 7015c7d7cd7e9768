//! Integer arithmetic.

use plc_isa::{Op, Operand};

use crate::machine::{BY_ZERO, End, Machine, NEGATIVE, OVERFLOW, ZERO, v};

/// SM bits that an instruction sets and those that it touches.
#[derive(Debug, Clone, Copy)]
struct Status {
    set: u8,
    touched: u8,
}

/// +, - and the steps.
const fn status(set: u8) -> Status {
    Status { set, touched: ZERO | OVERFLOW | NEGATIVE }
}

/// *, / and what goes with them.
const fn product(set: u8) -> Status {
    Status { set, touched: ZERO | OVERFLOW | NEGATIVE | BY_ZERO }
}

const DIVIDED_BY_ZERO: Status = Status { set: BY_ZERO, touched: BY_ZERO };

type Case = (Op, i32, i32, i32, Status);

/// `op` on IN1 in VB0 and OUT in VB10, whose lengths in bytes are given: the result and SMB1, from
/// all bits 0 and all 1.
fn check(&(op, in1, out, result, status): &Case, in1_len: usize, out_len: usize) {
    for before in [0x00, 0xFF] {
        let mut machine = Machine::new();
        machine.set_bytes(0, &in1.to_be_bytes()[4 - in1_len..]);
        machine.set_bytes(10, &out.to_be_bytes()[4 - out_len..]);
        machine.set_bytes(14, &[0xA5]);
        machine.set_sm1(before);
        let operands: &[Operand] = if in1_len == 0 { &[v(10)] } else { &[v(0), v(10)] };
        let failed = status.set & (OVERFLOW | BY_ZERO) != 0;
        let name = format!("{op:?} {in1}, {out}");
        assert_eq!(
            machine.run(op, operands),
            if failed { End::NoResult } else { End::Good },
            "{name}"
        );
        assert_eq!(
            machine.bytes(10, out_len as u16),
            result.to_be_bytes()[4 - out_len..],
            "{name}"
        );
        assert_eq!(
            machine.sm1(),
            before & !status.touched | status.set,
            "{name} from {before:02X}"
        );
        assert_eq!(machine.bytes(14, 1), [0xA5]);

        machine.set_bytes(10, &out.to_be_bytes()[4 - out_len..]);
        machine.set_sm1(before);
        assert_eq!(machine.run_without_power(op, operands), End::NoResult, "{name}");
        assert_eq!(
            (machine.bytes(10, out_len as u16), machine.sm1()),
            (out.to_be_bytes()[4 - out_len..].to_vec(), before)
        );
    }
}

#[test]
fn words() {
    const LEAST: i32 = i16::MIN as i32;
    let cases: &[Case] = &[
        (Op::AddIntAny, 3, 4, 7, status(0)),
        (Op::AddIntAny, -4, 4, 0, status(ZERO)),
        (Op::AddIntAny, -5, 4, -1, status(NEGATIVE)),
        (Op::AddIntAny, 1, 32767, 32767, status(OVERFLOW)),
        (Op::SubIntAny, 3, 10, 7, status(0)),
        (Op::SubIntAny, 1, LEAST, LEAST, status(OVERFLOW)),
        (Op::MulIntAny, -3, 5, -15, product(NEGATIVE)),
        (Op::MulIntAny, 256, 128, 128, product(OVERFLOW)),
        (Op::MulIntAny, -256, 128, LEAST, product(NEGATIVE)),
        (Op::DivIntAny, 3, -7, -2, product(NEGATIVE)),
        (Op::DivIntAny, 8, 7, 0, product(ZERO)),
        (Op::DivIntAny, -1, LEAST, LEAST, product(OVERFLOW)),
        (Op::DivIntAny, 0, 7, 7, DIVIDED_BY_ZERO),
    ];
    cases.iter().for_each(|case| check(case, 2, 2));
}

#[test]
fn double_words() {
    let cases: &[Case] = &[
        (Op::AddDouble, 70_000, -30_000, 40_000, status(0)),
        (Op::AddDouble, 1, -1, 0, status(ZERO)),
        (Op::AddDouble, i32::MAX, 1, 1, status(OVERFLOW)),
        (Op::SubDouble, 70_000, 1, -69_999, status(NEGATIVE)),
        (Op::SubDouble, 1, i32::MIN, i32::MIN, status(OVERFLOW)),
        (Op::MulDouble, -70_000, 30_000, -2_100_000_000, product(NEGATIVE)),
        (Op::MulDouble, 65_536, 32_768, 32_768, product(OVERFLOW)),
        (Op::MulDouble, i32::MIN, i32::MIN, i32::MIN, product(OVERFLOW)),
        (Op::DivDouble, -3, 1_000_000, -333_333, product(NEGATIVE)),
        (Op::DivDouble, -1, i32::MIN, i32::MIN, product(OVERFLOW)),
        (Op::DivDouble, 0, 0, 0, DIVIDED_BY_ZERO),
    ];
    cases.iter().for_each(|case| check(case, 4, 4));
}

#[test]
fn words_to_a_double_word() {
    const fn pair(high: i16, low: i16) -> i32 {
        (high as i32) << 16 | low as u16 as i32
    }
    let cases: &[Case] = &[
        (Op::Mul, 300, pair(0x7FFF, 400), 120_000, product(0)),
        (Op::Mul, -32768, pair(0, -32768), 1 << 30, product(0)),
        (Op::Mul, -1, pair(5, 7), -7, product(NEGATIVE)),
        (Op::Mul, 0, 7, 0, product(ZERO)),
        (Op::Div, 7, pair(99, 100), pair(2, 14), product(0)),
        (Op::Div, 7, pair(99, -100), pair(-2, -14), product(NEGATIVE)),
        (Op::Div, 7, 5, pair(5, 0), product(ZERO)),
        (Op::Div, -1, pair(3, -32768), pair(3, -32768), product(OVERFLOW)),
        (Op::Div, 0, pair(3, 4), pair(3, 4), DIVIDED_BY_ZERO),
    ];
    cases.iter().for_each(|case| check(case, 2, 4));
}

#[test]
fn steps() {
    const fn byte(set: u8) -> Status {
        Status { set, touched: ZERO | OVERFLOW }
    }
    let bytes: &[Case] = &[
        (Op::Incb, 0, 127, 128, byte(0)),
        (Op::Incb, 0, 255, 0, byte(ZERO | OVERFLOW)),
        (Op::Decb, 0, 1, 0, byte(ZERO)),
        (Op::Decb, 0, 0, 255, byte(OVERFLOW)),
    ];
    let words: &[Case] = &[
        (Op::IncwAny, 0, -1, 0, status(ZERO)),
        (Op::IncwAny, 0, 32767, -32768, status(OVERFLOW | NEGATIVE)),
        (Op::DecwAny, 0, 0, -1, status(NEGATIVE)),
        (Op::DecwAny, 0, -32768, 32767, status(OVERFLOW)),
    ];
    let doubles: &[Case] = &[
        (Op::Incd, 0, 0xFFFF, 0x1_0000, status(0)),
        (Op::Incd, 0, i32::MAX, i32::MIN, status(OVERFLOW | NEGATIVE)),
        (Op::Decd, 0, 1, 0, status(ZERO)),
        (Op::Decd, 0, i32::MIN, i32::MAX, status(OVERFLOW)),
    ];
    for (cases, len) in [(bytes, 1), (words, 2), (doubles, 4)] {
        cases.iter().for_each(|case| check(case, 0, len));
    }
}
