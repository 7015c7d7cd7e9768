//! Logic operations and moves.

use plc_isa::Op;

use crate::machine::{End, Machine, ZERO, c, v};

#[test]
fn every_operation_in_every_width() {
    let (in1, out) = (0xF0F0_CCAA_u32, 0xFF00_AA0F_u32);
    type Compute = fn(u32, u32) -> u32;
    let cases: [([Op; 3], Compute); 3] = [
        ([Op::Andb, Op::Andw, Op::Andd], |out, in1| out & in1),
        ([Op::Orb, Op::Orw, Op::Ord], |out, in1| out | in1),
        ([Op::Xorb, Op::Xorw, Op::Xord], |out, in1| out ^ in1),
    ];
    for (ops, compute) in cases {
        for (op, len) in ops.into_iter().zip([1, 2, 4]) {
            for equal in [false, true] {
                let in1 = if equal { out } else { in1 };
                let mut machine = Machine::new();
                machine.set_double(0, in1);
                machine.set_double(10, out);
                machine.set_sm1(!ZERO);
                assert_eq!(machine.run(op, &[v(4 - len), v(14 - len)]), End::Good);
                let mask = u32::MAX >> (32 - 8 * len);
                assert_eq!(
                    machine.double(10) as u32,
                    compute(out, in1) & mask | out & !mask,
                    "{op:?}"
                );
                let is_zero = compute(out, in1) & mask == 0;
                assert_eq!(machine.sm1(), !ZERO | u8::from(is_zero), "{op:?}");
            }
        }
    }
}

#[test]
fn inversion() {
    for (op, len, result) in [
        (Op::Invb, 1, 0x1234_56FF),
        (Op::Invw, 2, 0x1234_A9FF_u32 as i32),
        (Op::Invd, 4, 0xEDCB_A9FF_u32 as i32),
    ] {
        let mut machine = Machine::new();
        machine.set_double(10, 0x1234_5600);
        machine.set_sm1(ZERO);
        assert_eq!(
            (machine.run(op, &[v(14 - len)]), machine.double(10), machine.sm1()),
            (End::Good, result, 0),
            "{op:?}"
        );
        machine.set_double(10, u32::MAX);
        machine.run(op, &[v(14 - len)]);
        assert_eq!(
            (machine.bytes(14 - len, len), machine.sm1()),
            (vec![0; usize::from(len)], ZERO),
            "{op:?}"
        );
    }
}

#[test]
fn moves() {
    let mut machine = Machine::new();
    machine.set_sm1(0xFF);
    machine.set_double(0, 0x89AB_CDEF);
    for (op, len) in [(Op::MovbAny, 1), (Op::MovwAny, 2), (Op::Movd, 4), (Op::Movr, 4)] {
        machine.set_double(10, 0);
        assert_eq!(machine.run(op, &[v(0), v(10)]), End::Good, "{op:?}");
        assert_eq!(machine.double(10) as u32, 0x89AB_CDEF & u32::MAX << (32 - 8 * len), "{op:?}");
    }
    for (op, result) in
        [(Op::MovbAny, 0xFE00_0000_u32), (Op::MovwAny, 0xFFFE_0000), (Op::Movd, 0xFFFF_FFFE)]
    {
        machine.set_double(10, 0);
        assert_eq!(
            (machine.run(op, &[c(-2), v(10)]), machine.double(10) as u32),
            (End::Good, result),
            "{op:?}"
        );
    }
    machine.set_double(10, 0x1234_5678);
    assert_eq!((machine.run(Op::Swap, &[v(11)]), machine.double(10)), (End::Good, 0x1256_3478));
    assert_eq!(machine.sm1(), 0xFF, "moves touch no SM bit");
}
