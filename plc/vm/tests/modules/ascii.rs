//! Numbers as characters and back.

use plc_isa::Op;

use crate::machine::{End, Machine, OVERFLOW, V_LEN, c, v};

const INVALID_ASCII: u8 = 1 << 7;

#[test]
fn characters_to_hex() {
    for (text, len, end, out) in [
        ("3EA", 3, End::Good, [0x3E, 0xA5, 0xA5]),
        ("09AF", 4, End::Good, [0x09, 0xAF, 0xA5]),
        ("1", 0, End::Good, [0xA5; 3]),
        ("1a", 2, End::NoResult, [0xA5; 3]),
        ("12G", 3, End::NoResult, [0xA5; 3]),
        ("/:", 1, End::NoResult, [0xA5; 3]),
        ("@", 1, End::NoResult, [0xA5; 3]),
    ] {
        for before in [0x00, 0xFF] {
            let mut machine = Machine::new();
            machine.set_bytes(0, text.as_bytes());
            machine.set_bytes(40, &[0xA5; 3]);
            machine.set_sm1(before);
            assert_eq!(
                (machine.run(Op::Ath, &[v(0), v(40), c(len)]), machine.bytes(40, 3)),
                (end, out.to_vec()),
                "{text}"
            );
            let sm1 = if end == End::NoResult { INVALID_ASCII } else { 0 };
            let touched = if len == 0 { 0 } else { INVALID_ASCII };
            assert_eq!(machine.sm1(), before & !touched | sm1, "{text}");
        }
    }
    let mut machine = Machine::new();
    machine.set_bytes(0, &[b'7'; 255]);
    assert_eq!(
        machine.run(Op::Ath, &[v(0), v(1), c(255)]),
        End::BadOperand,
        "what is written would be read again"
    );
    assert_eq!(
        (machine.run(Op::Ath, &[v(0), v(0), c(255)]), machine.bytes(0, 129)),
        (End::Good, [vec![0x77; 128], vec![b'7']].concat())
    );
    assert_eq!(machine.run(Op::Ath, &[v(V_LEN - 4), v(0), c(5)]), End::BadOperand);
    assert_eq!(machine.run(Op::Ath, &[v(0), v(V_LEN - 1), c(3)]), End::BadOperand);
}

#[test]
fn hex_to_characters() {
    let mut machine = Machine::new();
    machine.set_bytes(0, &[0x3E, 0xA9]);
    machine.set_sm1(0x5A);
    assert_eq!(
        (machine.run(Op::Hta, &[v(0), v(40), c(3)]), machine.bytes(40, 4)),
        (End::Good, b"3EA\0".to_vec())
    );
    assert_eq!(
        (machine.run(Op::Hta, &[v(0), v(1), c(4)]), machine.bytes(0, 5)),
        (End::Good, b"\x3E3EA9".to_vec())
    );
    assert_eq!(
        (machine.run(Op::Hta, &[v(100), v(100), c(255)]), machine.bytes(100, 255)),
        (End::Good, vec![b'0'; 255])
    );
    assert_eq!(machine.run(Op::Hta, &[v(0), v(V_LEN - 3), c(4)]), End::BadOperand);
    assert_eq!(
        (machine.run(Op::Hta, &[v(0), v(V_LEN - 3), c(0)]), machine.bytes(V_LEN - 3, 3)),
        (End::Good, vec![0; 3])
    );
    assert_eq!(machine.sm1(), 0x5A);
}

/// The characters that an instruction makes of the value at VB0, with a dot after them to see
/// their end.
fn characters(op: Op, value: &[u8], fmt: i16) -> (End, String) {
    let mut machine = Machine::new();
    machine.set_bytes(0, value);
    machine.set_bytes(40, &[b'.'; 16]);
    machine.set_sm1(0x5A);
    let is_text = matches!(op, Op::Its | Op::Dts | Op::Rts);
    let operands = if is_text { [v(0), c(fmt), v(40)] } else { [v(0), v(40), c(fmt)] };
    let end = machine.run(op, &operands);
    assert_eq!(machine.sm1(), 0x5A);
    let bytes = machine.bytes(40, 17);
    let written =
        if is_text && bytes[0] != b'.' { format!("{} ", bytes[0]) } else { String::new() };
    let rest = &bytes[usize::from(!written.is_empty())..];
    let text = String::from_utf8_lossy(rest).trim_end_matches(['.', '\0']).to_string();
    (end, written + &text)
}

#[test]
fn integers_to_characters() {
    for (value, fmt, text) in [
        (12_i16, 3, "   0.012"),
        (-123, 3, "  -0.123"),
        (-12345, 3, " -12.345"),
        (-12345, 8 + 3, " -12,345"),
        (-32768, 0, "  -32768"),
        (0, 0, "       0"),
        (0, 5, " 0.00000"),
    ] {
        assert_eq!(characters(Op::Ita, &value.to_be_bytes(), fmt), (End::Good, text.into()));
        assert_eq!(
            characters(Op::Its, &value.to_be_bytes(), fmt),
            (End::Good, format!("8 {text}"))
        );
        let double = i32::from(value).to_be_bytes();
        assert_eq!(characters(Op::Dta, &double, fmt), (End::Good, format!("    {text}")));
        assert_eq!(characters(Op::Dts, &double, fmt), (End::Good, format!("12     {text}")));
    }
    assert_eq!(characters(Op::Dta, &i32::MIN.to_be_bytes(), 4), (End::Good, "-214748.3648".into()));
    // Too many decimals, or bits of the upper half.
    for fmt in [6, 7, 0x10, 0x83] {
        assert_eq!(characters(Op::Ita, &[0, 1], fmt), (End::BadOperand, " ".repeat(8)));
        assert_eq!(characters(Op::Dta, &[0, 1], fmt), (End::BadOperand, " ".repeat(12)));
        assert_eq!(
            characters(Op::Its, &[0, 1], fmt),
            (End::BadOperand, format!("8 {}", " ".repeat(8)))
        );
        assert_eq!(
            characters(Op::Dts, &[0, 1], fmt),
            (End::BadOperand, format!("12 {}", " ".repeat(12)))
        );
    }
}

#[test]
fn reals_to_characters() {
    for (value, fmt, text) in [
        (1234.5_f32, 0x61, "1234.5"),
        (-0.0004, 0x61, "   0.0"),
        (-3.67526, 0x61, "  -3.7"),
        (1.95, 0x69, "   2,0"),
        (2.5, 0x30, "  3"),
        (16777216.0, 0xF5, " 16777216.00000"),
        (1e14, 0xF0, "100000000376832"),
    ] {
        assert_eq!(characters(Op::Rta, &value.to_be_bytes(), fmt), (End::Good, text.into()));
        assert_eq!(
            characters(Op::Rts, &value.to_be_bytes(), fmt),
            (End::Good, format!("{} {text}", text.len()))
        );
    }
    for (value, fmt) in [
        (12345.6_f32, 0x61),
        (2e15, 0xF0),
        (1.0, 0x66),
        (f32::NAN, 0x50),
        (f32::INFINITY, 0x50),
        (1e30, 0x50),
    ] {
        let spaces = " ".repeat(usize::from(fmt as u8 >> 4));
        assert_eq!(
            characters(Op::Rta, &value.to_be_bytes(), fmt),
            (End::BadOperand, spaces.clone()),
            "{value} {fmt:X}"
        );
        assert_eq!(
            characters(Op::Rts, &value.to_be_bytes(), fmt),
            (End::BadOperand, format!("{} {spaces}", spaces.len()))
        );
    }
    for fmt in [0x00, 0x11, 0x20] {
        assert_eq!(
            characters(Op::Rta, &1_f32.to_be_bytes(), fmt),
            (End::BadOperand, String::new())
        );
        assert_eq!(
            characters(Op::Rts, &1_f32.to_be_bytes(), fmt),
            (End::BadOperand, String::new())
        );
    }
}

#[test]
fn results_need_room() {
    let mut machine = Machine::new();
    let real = machine.real(1.0);
    for (op, operands, len) in [
        (Op::Ita, [c(1), v(V_LEN - 7), c(0)], 8),
        (Op::Its, [c(1), c(0), v(V_LEN - 8)], 9),
        (Op::Dta, [c(1), v(V_LEN - 11), c(0)], 12),
        (Op::Dts, [c(1), c(0), v(V_LEN - 12)], 13),
        (Op::Rta, [real, v(V_LEN - 4), c(0x51)], 5),
        (Op::Rts, [real, c(0x51), v(V_LEN - 5)], 6),
    ] {
        assert_eq!(machine.run(op, &operands), End::BadOperand, "{op:?}");
        assert_eq!(machine.bytes(V_LEN - 20, 20), [0; 20]);
        let shifted = operands
            .map(|operand| if operand == v(V_LEN - len + 1) { v(V_LEN - len) } else { operand });
        assert_eq!(machine.run(op, &shifted), End::Good, "{op:?}");
        machine.set_bytes(V_LEN - 20, &[0; 20]);
    }
}

#[test]
fn characters_to_numbers() {
    for (text, index, word, double, real) in [
        ("Temperature: 77.8", 13, Some(77), Some(77), Some(77.8_f32)),
        ("  -32768", 1, Some(-32768), Some(-32768), Some(-32768.0)),
        ("32768", 1, None, Some(32768), Some(32768.0)),
        ("-2147483649", 1, None, None, Some(-2147483648.0)),
        ("1.234E6", 1, Some(1), Some(1), Some(1.234)),
        ("+5,25", 1, Some(5), Some(5), Some(5.25)),
        (".5", 1, None, None, Some(0.5)),
        ("A123", 1, None, None, None),
        ("A123", 2, Some(123), Some(123), Some(123.0)),
        ("1e9", 3, Some(9), Some(9), Some(9.0)),
    ] {
        let cases = [
            (Op::Sti, word.map(|value: i32| (value as u32) << 16)),
            (Op::Std, double.map(|value: i32| value as u32)),
            (Op::Str, real.map(f32::to_bits)),
        ];
        for (op, result) in cases {
            for before in [0x00, 0xFF] {
                let mut machine = Machine::new();
                machine.set_text(0, text);
                machine.set_double(40, if op == Op::Sti { 0xA5A5_0000 } else { 0xA5A5_A5A5 });
                let untouched = machine.double(40) as u32;
                machine.set_sm1(before);
                let end = machine.run(op, &[v(0), c(index), v(40)]);
                assert_eq!(
                    end,
                    if result.is_some() { End::Good } else { End::NoResult },
                    "{op:?} {text}"
                );
                assert_eq!(machine.double(40) as u32, result.unwrap_or(untouched), "{op:?} {text}");
                assert_eq!(
                    machine.sm1(),
                    before & !OVERFLOW | if result.is_some() { 0 } else { OVERFLOW }
                );
            }
        }
    }
    for (text, index) in [("123", 0), ("123", 4), ("", 1)] {
        let mut machine = Machine::new();
        machine.set_text(0, text);
        for op in [Op::Sti, Op::Std, Op::Str] {
            assert_eq!(
                machine.run(op, &[v(0), c(index), v(40)]),
                End::BadOperand,
                "{text} {index}"
            );
        }
    }
}
