//! Strings.

use plc_isa::Op;

use crate::machine::{End, Machine, V_LEN, c, v};

#[test]
fn length() {
    let mut machine = Machine::new();
    let long = "x".repeat(254);
    for text in ["", "abc", &long] {
        machine.set_text(0, text);
        assert_eq!(machine.run(Op::Slen, &[v(0), v(300)]), End::Good);
        assert_eq!(usize::from(machine.bytes(300, 1)[0]), text.len());
    }
    let constant = machine.text("HELLO");
    assert_eq!(
        (machine.run(Op::Slen, &[constant, v(300)]), machine.bytes(300, 1)),
        (End::Good, vec![5])
    );
    // 255 is no length, and the string must end in its area.
    for (byte, len) in [(0, 255), (V_LEN - 5, 5)] {
        machine.set_bytes(byte, &[len]);
        assert_eq!(
            (machine.run(Op::Slen, &[v(byte), v(300)]), machine.bytes(300, 1)),
            (End::BadOperand, vec![5])
        );
    }
}

#[test]
fn copies() {
    let mut machine = Machine::new();
    let constant = machine.text("HELLO");
    machine.set_text(10, "-------");
    assert_eq!(
        (machine.run(Op::Scpy, &[constant, v(10)]), machine.bytes(10, 8)),
        (End::Good, b"\x05HELLO--".to_vec())
    );
    assert_eq!(
        (machine.run(Op::Scpy, &[v(10), v(11)]), machine.text_at(11)),
        (End::Good, "HELLO".into())
    );
    assert_eq!(
        (machine.run(Op::Scpy, &[v(11), v(10)]), machine.text_at(10)),
        (End::Good, "HELLO".into())
    );
    assert_eq!(
        (machine.run(Op::Scpy, &[v(10), v(V_LEN - 6)]), machine.text_at(V_LEN - 6)),
        (End::Good, "HELLO".into())
    );
    machine.set_bytes(V_LEN - 5, &[3, 1, 2, 3, 4]);
    assert_eq!(machine.run(Op::Scpy, &[v(10), v(V_LEN - 5)]), End::BadOperand);
    assert_eq!(machine.bytes(V_LEN - 5, 5), [3, 1, 2, 3, 4]);
}

#[test]
fn appends() {
    let mut machine = Machine::new();
    let world = machine.text(" WORLD");
    machine.set_text(10, "HELLO");
    assert_eq!(
        (machine.run(Op::Scat, &[world, v(10)]), machine.text_at(10)),
        (End::Good, "HELLO WORLD".into())
    );
    assert_eq!(
        (machine.run(Op::Scat, &[v(10), v(10)]), machine.text_at(10)),
        (End::Good, "HELLO WORLDHELLO WORLD".into())
    );
    machine.set_text(100, &"x".repeat(248));
    assert_eq!(
        (machine.run(Op::Scat, &[world, v(100)]), machine.bytes(100, 1)),
        (End::Good, vec![254])
    );
    let before = machine.bytes(0, V_LEN);
    let letter = machine.text("y");
    assert_eq!(machine.run(Op::Scat, &[letter, v(100)]), End::BadOperand, "255 characters");
    assert_eq!(machine.bytes(0, V_LEN), before);
    machine.set_text(V_LEN - 4, "ab");
    assert_eq!(machine.run(Op::Scat, &[letter, v(V_LEN - 4)]), End::Good);
    assert_eq!(machine.run(Op::Scat, &[letter, v(V_LEN - 4)]), End::BadOperand);
    assert_eq!(machine.text_at(V_LEN - 4), "aby");
}

#[test]
fn parts() {
    let mut machine = Machine::new();
    machine.set_text(0, "HELLO WORLD");
    for (position, count, part) in
        [(7, 5, "WORLD"), (1, 11, "HELLO WORLD"), (11, 1, "D"), (4, 0, "")]
    {
        machine.set_text(20, "old");
        assert_eq!(machine.run(Op::Sscpy, &[v(0), c(position), c(count), v(20)]), End::Good);
        assert_eq!(machine.text_at(20), part);
    }
    for (position, count) in [(0, 1), (12, 0), (12, 1), (7, 6), (1, 255)] {
        machine.set_text(20, "old");
        assert_eq!(
            machine.run(Op::Sscpy, &[v(0), c(position), c(count), v(20)]),
            End::BadOperand,
            "{position} {count}"
        );
        assert_eq!(machine.text_at(20), "old");
    }
    assert_eq!(
        (machine.run(Op::Sscpy, &[v(0), c(2), c(4), v(0)]), machine.text_at(0)),
        (End::Good, "ELLO".into())
    );
}

/// Searches from a position on; what is there afterwards.
fn found(op: Op, text: &str, sought: &str, from: u8) -> (End, u8) {
    let mut machine = Machine::new();
    let sought = machine.text(sought);
    machine.set_text(0, text);
    machine.set_bytes(300, &[from]);
    let end = machine.run(op, &[v(0), sought, v(300)]);
    (end, machine.bytes(300, 1)[0])
}

#[test]
fn strings_are_found_in_strings() {
    for (sought, from, position) in [
        ("abc", 1, 1),
        ("abc", 2, 4),
        ("abc", 5, 0),
        ("c", 6, 6),
        ("cc", 1, 0),
        ("abcabcd", 1, 0),
        ("", 1, 0),
    ] {
        assert_eq!(
            found(Op::Sfnd, "abcabc", sought, from),
            (End::Good, position),
            "{sought} {from}"
        );
    }
    for op in [Op::Sfnd, Op::Cfnd] {
        assert_eq!(found(op, "abcabc", "a", 0), (End::BadOperand, 0));
        assert_eq!(found(op, "abcabc", "a", 7), (End::Good, 0), "after the end");
        assert_eq!(found(op, "", "a", 1), (End::Good, 0));
    }
}

#[test]
fn characters_are_found_in_strings() {
    for (sought, from, position) in [
        ("1234567890", 1, 7),
        ("1234567890", 8, 8),
        ("1234567890", 10, 0),
        ("T ", 1, 1),
        ("T ", 2, 6),
        ("", 1, 0),
    ] {
        assert_eq!(found(Op::Cfnd, "Temp  98.6F", sought, from).0, End::Good);
        assert_eq!(
            found(Op::Cfnd, "Temp_ 98_F", sought, from),
            (End::Good, position),
            "{sought} {from}"
        );
    }
}
