//! Conversions.

use plc_isa::Op;

use crate::machine::{End, Machine, OVERFLOW, c, v};

const INVALID_BCD: u8 = 1 << 6;

/// `op` from VD0 to VB10; the first bytes of the result, and SMB1 from all bits 0 and from all 1.
/// `error`: the SM bit of a value without result, which leaves OUT as it is.
fn check(op: Op, input: &[u8], result: Option<&[u8]>, error: u8) {
    for before in [0x00, 0xFF] {
        let mut machine = Machine::new();
        machine.set_bytes(0, input);
        machine.set_bytes(10, &[0xA5; 8]);
        machine.set_sm1(before);
        let end = machine.run(op, &[v(0), v(10)]);
        let sm1 = before & !error | if result.is_some() { 0 } else { error };
        assert_eq!(
            (end, machine.sm1()),
            (if result.is_some() { End::Good } else { End::NoResult }, sm1),
            "{op:?} {input:X?}"
        );
        let mut out = [0xA5; 8];
        result.iter().for_each(|bytes| out[..bytes.len()].copy_from_slice(bytes));
        assert_eq!(machine.bytes(10, 8), out, "{op:?} {input:X?}");
    }
}

#[test]
fn widths() {
    check(Op::Bti, &[200], Some(&[0, 200]), 0);
    check(Op::Itd, &[0xFF, 0xFE], Some(&[0xFF, 0xFF, 0xFF, 0xFE]), 0);
    check(Op::Itd, &[0x7F, 0xFF], Some(&[0, 0, 0x7F, 0xFF]), 0);
    for value in [0, 1, 255, 256, -1, i16::MIN] {
        let result = u8::try_from(value).ok().map(|value| [value]);
        check(Op::Itb, &value.to_be_bytes(), result.as_ref().map(|bytes| &bytes[..]), OVERFLOW);
    }
    for value in [0, -1, 32767, 32768, -32768, -32769, i32::MIN] {
        let result = i16::try_from(value).ok().map(i16::to_be_bytes);
        check(Op::Dti, &value.to_be_bytes(), result.as_ref().map(|bytes| &bytes[..]), OVERFLOW);
    }
}

#[test]
fn reals() {
    for value in [0_i32, -1, 16_777_217, i32::MIN, i32::MAX] {
        check(Op::Dtr, &value.to_be_bytes(), Some(&(value as f32).to_be_bytes()), 0);
    }
    let cases = [
        (2.5_f32, Some(3), Some(2)),
        (-2.5, Some(-3), Some(-2)),
        (-2147483648.0, Some(i32::MIN), Some(i32::MIN)),
        (2147483648.0, None, None),
        (f32::NAN, None, None),
    ];
    for (value, rounded, truncated) in cases {
        for (op, result) in [(Op::Round, rounded), (Op::Trunc, truncated)] {
            let result = result.map(i32::to_be_bytes);
            check(op, &value.to_be_bytes(), result.as_ref().map(|bytes| &bytes[..]), OVERFLOW);
        }
    }
}

#[test]
fn patterns() {
    check(Op::Deco, &[3], Some(&[0, 8]), 0);
    check(Op::Deco, &[0xFF], Some(&[0x80, 0]), 0);
    check(Op::Enco, &[0x82, 0x00], Some(&[9]), 0);
    check(Op::Enco, &[0x80, 0x00], Some(&[15]), 0);
    check(Op::Enco, &[0, 0], Some(&[0]), 0);
    let segments = [
        0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07, 0x7F, 0x67, 0x77, 0x7C, 0x39, 0x5E, 0x79,
        0x71,
    ];
    for (digit, pattern) in (0x50..).zip(segments) {
        check(Op::Seg, &[digit], Some(&[pattern]), 0);
    }
}

#[test]
fn bcd() {
    let cases = [
        (Op::Bcdi, 0x9999_u16, Some(9999_u16)),
        (Op::Bcdi, 0x1230, Some(1230)),
        (Op::Bcdi, 0x000A, None),
        (Op::Bcdi, 0xA000, None),
        (Op::Ibcd, 9999, Some(0x9999)),
        (Op::Ibcd, 42, Some(0x42)),
        (Op::Ibcd, 10_000, None),
        (Op::Ibcd, 0xFFFF, None),
    ];
    for (op, value, result) in cases {
        for before in [0x00, 0xFF] {
            let mut machine = Machine::new();
            machine.set_bytes(0, &value.to_be_bytes());
            machine.set_sm1(before);
            assert_eq!(
                machine.run(op, &[v(0)]),
                if result.is_some() { End::Good } else { End::NoResult }
            );
            assert_eq!(
                machine.bytes(0, 2),
                result.unwrap_or(value).to_be_bytes(),
                "{op:?} {value:X}"
            );
            assert_eq!(
                machine.sm1(),
                before & !INVALID_BCD | if result.is_some() { 0 } else { INVALID_BCD }
            );
        }
    }
}

#[test]
fn constants_are_converted_too() {
    let mut machine = Machine::new();
    assert_eq!((machine.run(Op::Itd, &[c(-4096), v(0)]), machine.double(0)), (End::Good, -4096));
    let large = machine.pool(&70_000_i32.to_be_bytes());
    assert_eq!((machine.run(Op::Dtr, &[large, v(0)]), machine.real_at(0)), (End::Good, 70_000.0));
}
