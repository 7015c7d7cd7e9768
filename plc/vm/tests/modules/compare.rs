//! Comparisons.

use plc_isa::{Op, Relation};
use plc_vm::Fault;

use crate::machine::{End, Machine, at, c, relation, v};

/// What `a` and `b`, which are in this order, make of the relations.
fn holds(relation: Relation, ordering: std::cmp::Ordering) -> bool {
    match relation {
        Relation::Equal => ordering.is_eq(),
        Relation::NotEqual => ordering.is_ne(),
        Relation::Less => ordering.is_lt(),
        Relation::Greater => ordering.is_gt(),
        Relation::LessOrEqual => ordering.is_le(),
        Relation::GreaterOrEqual => ordering.is_ge(),
    }
}

/// Checks the values at VB0 and VB100 with all relations, and how LD, A and O combine the result
/// with 0 and 1.
fn check(machine: &mut Machine, ops: [Op; 3], ordering: std::cmp::Ordering) {
    for each in Relation::ALL {
        let (operands, result) = ([relation(each), v(0), v(100)], holds(each, ordering));
        machine.set_sm1(0x5A);
        for power in [false, true] {
            let (before, now) = (u16::from(power), u16::from(result));
            let results = ops.map(|op| {
                let end = if power {
                    machine.run(op, &operands)
                } else {
                    machine.run_without_power(op, &operands)
                };
                assert_eq!(end, End::NoBox);
                machine.stack()
            });
            assert_eq!(
                results,
                [before << 1 | now, before & now, before | now],
                "{ops:?} {each:?} {ordering:?}"
            );
        }
        assert_eq!(machine.sm1(), 0x5A);
    }
}

#[test]
fn bytes_without_sign() {
    let mut machine = Machine::new();
    for (a, b) in [(5, 5), (200, 100), (100, 200)] {
        machine.set_bytes(0, &[a]);
        machine.set_bytes(100, &[b]);
        check(&mut machine, [Op::LoadByteAny, Op::AndByteAny, Op::OrByteAny], a.cmp(&b));
    }
}

#[test]
fn words_and_double_words_with_sign() {
    let mut machine = Machine::new();
    for (a, b) in [(-1, -1), (-1, 1), (1, -1), (0x7FFF_0000, -0x8000_0000), (255, 256)] {
        machine.set_double(0, a as u32);
        machine.set_double(100, b as u32);
        check(&mut machine, [Op::LoadDouble, Op::AndDouble, Op::OrDouble], a.cmp(&b));
        let (a, b) = ((a >> 16) as i16, (b >> 16) as i16);
        check(&mut machine, [Op::LoadWordAny, Op::AndWordAny, Op::OrWordAny], a.cmp(&b));
    }
}

#[test]
fn reals() {
    let mut machine = Machine::new();
    let ops = [Op::LoadReal, Op::AndReal, Op::OrReal];
    for (a, b) in
        [(1.5_f32, 1.5), (-0.0, 0.0), (-2.0, 1.0), (1.0, -2.0), (-1.0, -2.0), (1e-40, 0.0)]
    {
        machine.set_real(0, a);
        machine.set_real(100, b);
        check(&mut machine, ops, a.partial_cmp(&b).unwrap_or_else(|| unreachable!()));
    }
    for (a, b) in [(f32::NAN, 0.0), (0.0, f32::NAN)] {
        machine.set_real(0, a);
        machine.set_real(100, b);
        for op in ops {
            let end = machine.run(op, &[relation(Relation::NotEqual), v(0), v(100)]);
            assert!(matches!(end, End::Faulted(Fault::ComparedReal { .. })), "{op:?} {end:?}");
        }
    }
}

#[test]
fn texts() {
    let mut machine = Machine::new();
    for (a, b) in
        [("", ""), ("abc", "abc"), ("abc", "abd"), ("ab", "abc"), ("abc", "ab"), ("b", "abc")]
    {
        machine.set_text(0, a);
        machine.set_text(100, b);
        check(&mut machine, [Op::LoadText, Op::AndText, Op::OrText], a.cmp(b));
    }
    let text = machine.text("ab");
    machine.set_text(100, "ab");
    machine.run(Op::LoadText, &[relation(Relation::Equal), text, v(100)]);
    assert_eq!(machine.stack(), 3);
    // No string has 255 characters, and none ends after its area.
    for (byte, len) in [(0, 255), (390, 10)] {
        machine.set_bytes(byte, &[len]);
        let end = machine.run(Op::LoadText, &[relation(Relation::Equal), v(byte), v(100)]);
        assert!(matches!(end, End::Faulted(Fault::ComparedPointer { .. })), "{byte} {end:?}");
    }
}

#[test]
fn an_illegal_pointer_is_fatal() {
    let mut machine = Machine::new();
    machine.set_double(0, 0xFF00_0000);
    for op in [Op::LoadByteAny, Op::AndWordAny, Op::OrDouble] {
        let end = machine.run(op, &[relation(Relation::Equal), c(0), at(0)]);
        assert!(
            matches!(end, End::Faulted(Fault::ComparedPointer { at }) if at > 0),
            "{op:?} {end:?}"
        );
    }
}
