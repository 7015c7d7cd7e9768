//! Operands: what they lead to, and what is refused.

use plc_isa::{
    AC_START, AIW_START, AQW_START, HC0, I_START, L_START, M_START, Op, Q_START, S_START, SM_START,
    T_BITS_START, pointer,
};

use crate::machine::{C5, End, Machine, SMB34, T5, V_LEN, at, at_accumulator, c, data, v};

const AI: u8 = pointer::ANALOG_INPUT;
const AQ: u8 = pointer::ANALOG_OUTPUT;
const I: u8 = 0x00;
const Q: u8 = 0x01;
const M: u8 = 0x05;
const SM: u8 = 0x06;
const S: u8 = 0x07;
const V: u8 = 0x08;
const T: u8 = 0x09;
const C: u8 = 0x0A;

/// Reads the word that a pointer leads to, and writes it.
fn words(machine: &mut Machine, area: u8, offset: u16, address: u16) {
    machine.set_double(0, pointer::to(area, offset));
    machine.memory.set_int(address, -1234);
    assert_eq!(
        (machine.run(Op::MovwAny, &[at(0), v(10)]), machine.words(10, 1)),
        (End::Good, vec![-1234]),
        "{area} {offset}"
    );
    assert_eq!(
        (machine.run(Op::MovwAny, &[c(77), at(0)]), machine.memory.int(address)),
        (End::Good, 77),
        "{area} {offset}"
    );
}

#[test]
fn pointers_lead_to_every_area() {
    let mut machine = Machine::new();
    for (area, offset, address) in [
        (Q, 14, Q_START + 14),
        (M, 30, M_START + 30),
        (SM, 30, SM_START + 30),
        (SM, 34, SMB34),
        (S, 0, S_START),
        (V, 20, plc_isa::ARENA_START + 20),
        (V, V_LEN - 2, plc_isa::ARENA_START + V_LEN - 2),
        (T, 10, T5),
        (C, 10, C5),
    ] {
        words(&mut machine, area, offset, address);
    }
}

#[test]
fn pointers_to_what_is_only_read_or_only_written() {
    let mut machine = Machine::new();
    for (area, offset, address) in
        [(AI, 0, AIW_START), (AI, 10, AIW_START + 10), (SM, 28, SM_START + 28)]
    {
        machine.set_double(0, pointer::to(area, offset));
        machine.memory.set_int(address, -1234);
        assert_eq!(
            (machine.run(Op::MovwAny, &[at(0), v(10)]), machine.words(10, 1)),
            (End::Good, vec![-1234]),
            "{area}"
        );
        assert_eq!(machine.run(Op::MovwAny, &[c(77), at(0)]), End::BadOperand, "{area}");
        assert_eq!(machine.memory.int(address), -1234);
    }
    machine.set_double(0, pointer::to(AQ, 2));
    assert_eq!(
        (machine.run(Op::MovwAny, &[c(77), at(0)]), machine.memory.int(AQW_START + 2)),
        (End::Good, 77)
    );
    assert_eq!(machine.run(Op::MovwAny, &[at(0), v(10)]), End::BadOperand);
}

#[test]
fn pointers_to_nothing_change_nothing() {
    let mut machine = Machine::new();
    for (area, offset) in [
        (I, 15),
        (Q, 15),
        (M, 31),
        (S, 32),
        (SM, 31),
        (SM, 33),
        (SM, 35),
        (SM, 600),
        (V, V_LEN - 1),
        (V, V_LEN),
        (V, 9000),
        (T, 11),
        (T, 8),
        (T, 522),
        (C, 9),
        (AI, 1),
        (AI, 12),
        (AQ, 1),
        (AQ, 4),
        (0x04, 0),
        (0x0B, 0),
        (0xFF, 0),
    ] {
        machine.set_double(0, pointer::to(area, offset));
        machine.set_words(10, &[5]);
        machine.set_sm1(0xFF);
        assert_eq!(machine.run(Op::AddIntAny, &[at(0), v(10)]), End::BadOperand, "{area} {offset}");
        assert_eq!(machine.run(Op::AddIntAny, &[v(10), at(0)]), End::BadOperand, "{area} {offset}");
        assert_eq!((machine.words(10, 1), machine.sm1()), (vec![5], 0xFF));
    }
    // The offset has 24 bits.
    machine.set_double(0, pointer::to(V, 0) | 0x1_0000);
    assert_eq!(machine.run(Op::MovwAny, &[at(0), v(10)]), End::BadOperand);
}

#[test]
fn the_length_of_the_value_counts() {
    let mut machine = Machine::new();
    for (op, len) in [(Op::MovbAny, 1), (Op::MovwAny, 2), (Op::Movd, 4)] {
        for (offset, end) in [(V_LEN - len, End::Good), (V_LEN - len + 1, End::BadOperand)] {
            machine.set_double(0, pointer::to(V, offset));
            assert_eq!(machine.run(op, &[at(0), v(10)]), end, "{op:?} {offset}");
        }
        // Current values are words.
        machine.set_double(0, pointer::to(T, 10));
        assert_eq!(
            machine.run(op, &[at(0), v(10)]),
            if len == 2 { End::Good } else { End::BadOperand },
            "{op:?}"
        );
    }
}

#[test]
fn pointers_are_held_by_accumulators_and_local_memory_too() {
    let mut machine = Machine::new();
    machine.set_words(20, &[4321]);
    for (number, address) in [(1, AC_START + 4), (2, AC_START + 8), (3, AC_START + 12)] {
        let pointer = pointer::to(V, 20).to_be_bytes();
        (address..).zip(pointer).for_each(|(address, byte)| machine.memory.set_byte(address, byte));
        machine.set_words(10, &[0]);
        assert_eq!(machine.run(Op::MovwAny, &[at_accumulator(number), v(10)]), End::Good);
        assert_eq!(machine.words(10, 1), [4321]);
    }
    let pointer = pointer::to(V, 20).to_be_bytes();
    (L_START + 60..)
        .zip(pointer)
        .for_each(|(address, byte)| machine.memory.set_byte(address, byte));
    let local = plc_isa::Reference::to(plc_isa::Referent::Indirect(L_START + 60));
    assert_eq!(machine.run(Op::IncwAny, &[plc_isa::Operand::Reference(local)]), End::Good);
    assert_eq!(machine.words(20, 1), [4322]);
}

#[test]
fn direct_addresses_of_every_area() {
    let mut machine = Machine::new();
    for (address, out) in [
        (I_START, true),
        (AIW_START, false),
        (AC_START + 2, true),
        (AC_START + 14, true),
        (T5, true),
        (C5, true),
        (M_START + 30, true),
        (L_START, true),
        (SMB34, true),
    ] {
        machine.memory.set_int(address, -77);
        assert_eq!(
            (machine.run(Op::MovwAny, &[data(address), v(10)]), machine.words(10, 1)),
            (End::Good, vec![-77])
        );
        if out {
            assert_eq!(
                (machine.run(Op::MovwAny, &[c(5), data(address)]), machine.memory.int(address)),
                (End::Good, 5)
            );
        }
    }
    assert_eq!(machine.run(Op::Movd, &[data(HC0), v(10)]), End::Good);
    // A byte of an accumulator is its lowest; the others keep their values.
    assert_eq!(machine.run(Op::Movd, &[c(-1), data(AC_START)]), End::Good);
    assert_eq!(machine.run(Op::MovbAny, &[c(0x12), data(AC_START + 3)]), End::Good);
    assert_eq!(
        (machine.memory.word(AC_START), machine.memory.word(AC_START + 2)),
        (0xFFFF, 0xFF12)
    );
}

#[test]
fn constants_of_the_pool_are_as_long_as_the_operand() {
    let mut machine = Machine::new();
    let (byte, word, double) = (
        machine.pool(&[200]),
        machine.pool(&[0x80, 0x01]),
        machine.pool(&[0x89, 0xAB, 0xCD, 0xEF]),
    );
    assert_eq!(
        (machine.run(Op::MovbAny, &[byte, v(0)]), machine.bytes(0, 2)),
        (End::Good, vec![200, 0])
    );
    assert_eq!(
        (machine.run(Op::MovwAny, &[word, v(0)]), machine.words(0, 1)),
        (End::Good, vec![-32767])
    );
    assert_eq!(
        (machine.run(Op::Movd, &[double, v(0)]), machine.double(0) as u32),
        (End::Good, 0x89AB_CDEF)
    );
    assert_eq!((machine.run(Op::Itd, &[word, v(0)]), machine.double(0)), (End::Good, -32767));
}

#[test]
fn values_behind_one_another_stay_in_their_area() {
    let mut machine = Machine::new();
    let fill = |machine: &mut Machine, address, count| {
        machine.run(Op::Fill, &[c(7), data(address), c(count)])
    };
    for (address, most) in [
        (plc_isa::ARENA_START + V_LEN - 6, 3),
        (SMB34, 1),
        (T5, 1),
        (C5, 1),
        (AC_START + 2, 1),
        (AQW_START, 2),
        (AQW_START + 2, 1),
        (M_START, 16),
        (Q_START + 11, 2),
        (L_START + 60, 2),
    ] {
        let before = machine.memory.clone();
        assert_eq!(fill(&mut machine, address, most + 1), End::BadOperand, "{address:X}");
        assert_eq!(machine.memory.word(address), before.word(address));
        assert_eq!(fill(&mut machine, address, most), End::Good, "{address:X}");
    }
    for (address, most) in [(AIW_START, 6), (AIW_START + 10, 1), (AIW_START + 12, 6), (I_START, 8)]
    {
        let copy =
            |machine: &mut Machine, count| machine.run(Op::Bmw, &[data(address), v(0), c(count)]);
        assert_eq!(
            (copy(&mut machine, most), copy(&mut machine, most + 1)),
            (End::Good, End::BadOperand),
            "{address:X}"
        );
    }
    assert_eq!(machine.memory.byte(T_BITS_START), 0);
}
