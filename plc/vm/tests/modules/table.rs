//! Tables and blocks.

use plc_isa::{Op, Relation, pointer};

use crate::machine::{End, Machine, V_LEN, at, c, relation, v};

const FULL: u8 = 1 << 4;
const EMPTY: u8 = 1 << 5;

#[test]
fn entries_are_added_up_to_the_length() {
    let mut machine = Machine::new();
    machine.set_words(200, &[3, 1, 11, 22, 33, 99]);
    for (data, end, table) in [
        (1234, End::Good, [3, 2, 11, 1234, 33, 99]),
        (-5, End::Good, [3, 3, 11, 1234, -5, 99]),
        (7, End::NoResult, [3, 3, 11, 1234, -5, 99]),
    ] {
        let full = if end == End::Good { 0 } else { FULL };
        for before in [0x00, 0xFF] {
            let memory = machine.memory.clone();
            machine.set_sm1(before);
            assert_eq!(machine.run(Op::Att, &[c(data), v(200)]), end);
            assert_eq!(
                (machine.words(200, 6), machine.sm1()),
                (table.to_vec(), before & !FULL | full)
            );
            if before == 0x00 {
                machine.memory = memory;
            }
        }
    }
}

#[test]
fn the_oldest_and_the_newest_are_taken() {
    for (op, taken, table) in
        [(Op::Fifo, 11, [4, 2, 22, 33, 33, 44]), (Op::Lifo, 33, [4, 2, 11, 22, 33, 44])]
    {
        let mut machine = Machine::new();
        machine.set_words(200, &[4, 3, 11, 22, 33, 44]);
        machine.set_sm1(0xFF);
        assert_eq!(machine.run(op, &[v(200), v(300)]), End::Good);
        assert_eq!(
            (machine.words(300, 1), machine.words(200, 6)),
            (vec![taken], table.to_vec()),
            "{op:?}"
        );
        assert_eq!(machine.sm1(), !EMPTY);
        machine.set_words(200, &[4, 0, 11]);
        machine.set_sm1(0);
        assert_eq!(machine.run(op, &[v(200), v(300)]), End::NoResult);
        assert_eq!(
            (machine.words(300, 1), machine.words(200, 3), machine.sm1()),
            (vec![taken], vec![4, 0, 11], EMPTY)
        );
    }
}

#[test]
fn tables_that_are_none() {
    let last = V_LEN - 2 * 102;
    for (byte, len, count) in
        [(0, 101, 0), (0, -1, 0), (0, 4, 5), (0, 4, -1), (last + 2, 100, 1), (V_LEN - 2, 0, 0)]
    {
        let mut machine = Machine::new();
        machine.set_words(byte, &[len]);
        if byte + 2 < V_LEN {
            machine.set_words(byte + 2, &[count]);
        }
        let before = machine.memory.clone();
        for op in [Op::Fifo, Op::Lifo] {
            assert_eq!(
                machine.run(op, &[v(byte), v(300)]),
                End::BadOperand,
                "{byte} {len} {count}"
            );
        }
        assert_eq!(machine.run(Op::Att, &[c(5), v(byte)]), End::BadOperand, "{byte} {len} {count}");
        let mut after = Machine::new();
        after.memory = before;
        assert_eq!(machine.bytes(0, V_LEN), after.bytes(0, V_LEN));
    }
    let mut machine = Machine::new();
    machine.set_words(last, &[100, 99]);
    assert_eq!(machine.run(Op::Att, &[c(5), v(last)]), End::Good);
    assert_eq!((machine.words(last, 2), machine.words(V_LEN - 2, 1)), (vec![100, 100], vec![5]));
}

#[test]
fn find() {
    // EC, then the entries.
    let entries = [6, 3133, 4042, 3130, 3030, 3130, 4541];
    for (relation_, pattern, start, found) in [
        (Relation::Equal, 3130, 0, 2),
        (Relation::Equal, 3130, 2, 2),
        (Relation::Equal, 3130, 3, 4),
        (Relation::Equal, 3130, 5, 6),
        (Relation::Equal, 3130, 6, 6),
        (Relation::NotEqual, 3133, 0, 1),
        (Relation::Less, 3130, 0, 3),
        (Relation::Greater, 4042, 0, 5),
        (Relation::Greater, -4096, 0, 0),
    ] {
        let mut machine = Machine::new();
        machine.set_words(202, &entries);
        machine.set_words(300, &[start]);
        machine.set_sm1(0x5A);
        let end = machine.run(Op::Fnd, &[relation(relation_), v(202), c(pattern), v(300)]);
        assert_eq!(
            (end, machine.words(300, 1), machine.sm1()),
            (End::Good, vec![found], 0x5A),
            "{relation_:?} {pattern}"
        );
    }
    for (byte, count, start) in [(0, 101, 0), (0, -1, 0), (0, 3, 4), (0, 3, -1), (V_LEN - 4, 2, 0)]
    {
        let mut machine = Machine::new();
        machine.set_words(byte, &[count]);
        machine.set_words(300, &[start]);
        let end = machine.run(Op::Fnd, &[relation(Relation::Equal), v(byte), c(7), v(300)]);
        assert_eq!(
            (end, machine.words(300, 1)),
            (End::BadOperand, vec![start]),
            "{byte} {count} {start}"
        );
    }
}

#[test]
fn fill() {
    let mut machine = Machine::new();
    machine.set_words(50, &[1, 2, 3, 4]);
    assert_eq!(machine.run(Op::Fill, &[c(-2), v(50), c(3)]), End::Good);
    assert_eq!(machine.words(50, 4), [-2, -2, -2, 4]);
    assert_eq!(machine.run(Op::Fill, &[c(9), v(50), c(0)]), End::Good);
    assert_eq!(machine.words(50, 4), [-2, -2, -2, 4]);
    assert_eq!(machine.run(Op::Fill, &[c(9), v(0), c(200)]), End::Good);
    assert_eq!(machine.words(0, 200), [9; 200]);
    assert_eq!(machine.run(Op::Fill, &[c(8), v(2), c(200)]), End::BadOperand);
    assert_eq!(machine.words(0, 200), [9; 200]);
}

#[test]
fn blocks() {
    let bytes: Vec<u8> = (0..60).collect();
    for (op, len) in [(Op::Bmb, 1), (Op::Bmw, 2), (Op::Bmd, 4)] {
        // Apart, overlapping upwards and downwards, onto itself.
        for (from, to) in [(0, 100), (10, 13), (13, 10), (20, 20)] {
            let mut machine = Machine::new();
            machine.set_bytes(0, &bytes);
            assert_eq!(machine.run(op, &[v(from), v(to), c(5)]), End::Good);
            let copied = machine.bytes(to, 5 * len);
            assert_eq!(
                copied,
                bytes[usize::from(from)..usize::from(from + 5 * len)],
                "{op:?} {from} {to}"
            );
            assert_eq!(
                machine.bytes(to + 5 * len, 1),
                if to == 100 { [0] } else { [(to + 5 * len) as u8] },
                "{op:?}"
            );
        }
        let mut machine = Machine::new();
        machine.set_bytes(0, &bytes);
        assert_eq!(machine.run(op, &[v(0), v(V_LEN - 4 * len), c(5)]), End::BadOperand);
        assert_eq!(machine.run(op, &[v(V_LEN - 4 * len), v(0), c(5)]), End::BadOperand);
        assert_eq!(machine.bytes(0, 60), bytes);
        assert_eq!(machine.run(op, &[v(0), v(V_LEN - 5 * len), c(5)]), End::Good);
        // The same by pointers.
        machine.set_double(80, pointer::to(0x08, 0));
        machine.set_double(84, pointer::to(0x08, 120));
        assert_eq!(machine.run(op, &[at(80), at(84), c(5)]), End::Good);
        assert_eq!(machine.bytes(120, 5 * len), bytes[..usize::from(5 * len)]);
    }
}
