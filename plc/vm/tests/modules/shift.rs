//! Shifts, rotations, the shift register.

use plc_isa::{ARENA_START, M_START, Op};

use crate::machine::{End, Machine, OVERFLOW, V_LEN, ZERO, bit, c, v};

/// Shifts by hand, bit by bit: the pattern and the bit that was moved last.
fn by_hand(mut pattern: u32, bits: u32, count: u32, left: bool, rotate: bool) -> (u32, bool) {
    let mut last = false;
    for _ in 0..count {
        let end = if left { bits - 1 } else { 0 };
        last = pattern >> end & 1 != 0;
        pattern = if left { pattern << 1 } else { pattern >> 1 } & u32::MAX >> (32 - bits);
        if rotate && last {
            pattern |= 1 << (bits - 1 - end);
        }
    }
    (pattern, last)
}

#[test]
fn every_count_in_every_width() {
    let ops = [
        (true, false, [Op::Slb, Op::Slw, Op::Sld]),
        (false, false, [Op::Srb, Op::Srw, Op::Srd]),
        (true, true, [Op::Rlb, Op::Rlw, Op::Rld]),
        (false, true, [Op::Rrb, Op::Rrw, Op::Rrd]),
    ];
    for (left, rotate, ops) in ops {
        for (op, bytes) in ops.into_iter().zip([1_u16, 2, 4]) {
            let bits = 8 * u32::from(bytes);
            for (count, pattern) in
                (0..=35).chain([64, 255]).flat_map(|count| [(count, 0x9234_5681_u32), (count, 0)])
            {
                let pattern = pattern >> (32 - bits);
                for before in [0x00, 0xFF] {
                    let mut machine = Machine::new();
                    machine.set_double(10, pattern << (32 - bits));
                    machine.set_sm1(before);
                    assert_eq!(machine.run(op, &[v(10), c(count)]), End::Good);
                    let moved = if rotate { count as u32 % bits } else { (count as u32).min(bits) };
                    let (result, last) = by_hand(pattern, bits, moved, left, rotate);
                    let overflow =
                        if moved == 0 { before & OVERFLOW } else { u8::from(last) * OVERFLOW };
                    let zero = u8::from(result == 0) * ZERO;
                    assert_eq!(
                        machine.double(10) as u32,
                        result << (32 - bits),
                        "{op:?} {pattern:X}, {count}"
                    );
                    assert_eq!(
                        machine.sm1(),
                        before & !(ZERO | OVERFLOW) | zero | overflow,
                        "{op:?} {pattern:X}, {count}"
                    );
                }
            }
        }
    }
}

#[test]
fn shift_register() {
    for (n, data, before, after, left) in [
        (14, true, 0b0010_0000_0000_0001_u32, 0b0000_0000_0000_0011_u32, true),
        (14, false, 0b0001_0000_0000_0001, 0b0010_0000_0000_0010, false),
        (-14, true, 0b0000_0000_0000_0011, 0b0010_0000_0000_0001, true),
        (-14, false, 0b0000_0000_0000_0010, 0b0000_0000_0000_0001, false),
        (1, true, 0, 1, false),
        (-1, false, 1, 0, true),
    ] {
        // From V33.4 on: V35.1 is the last of 14.
        let mut machine = Machine::new();
        let around = 0xF << 28 | 0b1111 | if n == 14 || n == -14 { 0xFFC_0000 } else { 0 };
        machine.set_bytes(33, &(before << 4 | around).to_le_bytes());
        machine.memory.set_bit(plc_isa::Bit { address: M_START, bit: 3 }, data);
        machine.set_sm1(!OVERFLOW | (u8::from(!left) * OVERFLOW));
        assert_eq!(
            machine.run(Op::Shrb, &[bit(M_START, 3), bit(ARENA_START + 33, 4), c(n)]),
            End::Good
        );
        assert_eq!(machine.bytes(33, 4), (after << 4 | around).to_le_bytes(), "{n}");
        assert_eq!(machine.sm1(), !OVERFLOW | (u8::from(left) * OVERFLOW), "{n}");
    }
}

#[test]
fn shift_register_of_64_bits_and_its_limits() {
    let mut machine = Machine::new();
    machine.set_bytes(0, &[0x80, 0, 0, 0, 0, 0, 0, 0x80, 0x55]);
    let shrb = |machine: &mut Machine, byte, place, n| {
        machine.run(Op::Shrb, &[bit(M_START, 0), bit(ARENA_START + byte, place), c(n)])
    };
    assert_eq!(shrb(&mut machine, 0, 0, 64), End::Good);
    assert_eq!(
        (machine.bytes(0, 9), machine.sm1()),
        (vec![0, 1, 0, 0, 0, 0, 0, 0, 0x55], OVERFLOW)
    );
    let before = machine.memory.clone();
    for n in [65, -65, -128] {
        assert_eq!(shrb(&mut machine, 0, 0, n), End::BadOperand, "{n}");
    }
    assert_eq!(shrb(&mut machine, V_LEN - 1, 4, 5), End::BadOperand);
    assert_eq!(shrb(&mut machine, 0, 0, 0), End::Good, "nothing happens");
    assert_eq!(machine.bytes(0, 400), {
        let mut old = Machine::new();
        old.memory = before;
        old.bytes(0, 400)
    });
    assert_eq!(shrb(&mut machine, V_LEN - 1, 4, -4), End::Good);
}
