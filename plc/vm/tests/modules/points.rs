//! Immediate inputs and outputs, intervals.

use plc_isa::{ARENA_START, I_START, M_START, Op, Q_START, pointer};

use crate::machine::{End, Machine, V_LEN, at, bit, c, data, v};

#[test]
fn contacts() {
    for on in [false, true] {
        let mut machine = Machine::new();
        machine.memory.set_byte(I_START, u8::from(on) << 5);
        let (on, off) = (u16::from(on), u16::from(!on));
        for power in [0, 1] {
            for (op, stack) in [
                (Op::Ldi, power << 1 | on),
                (Op::Ldni, power << 1 | off),
                (Op::Ai, power & on),
                (Op::Ani, power & off),
                (Op::Oi, power | on),
                (Op::Oni, power | off),
            ] {
                let operands = [bit(I_START, 5)];
                let end = if power == 1 {
                    machine.run(op, &operands)
                } else {
                    machine.run_without_power(op, &operands)
                };
                assert_eq!((end, machine.stack()), (End::NoBox, stack), "{op:?} {on} {power}");
            }
        }
    }
}

#[test]
fn coils() {
    let mut machine = Machine::new();
    assert_eq!(
        (machine.run(Op::AssignImmediate, &[bit(Q_START, 3)]), machine.memory.byte(Q_START)),
        (End::NoBox, 8)
    );
    assert_eq!(machine.run(Op::SetImmediate, &[bit(Q_START, 6), c(4)]), End::Good);
    assert_eq!((machine.memory.byte(Q_START), machine.memory.byte(Q_START + 1)), (0xC8, 3));
    assert_eq!(machine.run(Op::ResetImmediate, &[bit(Q_START, 0), c(7)]), End::Good);
    assert_eq!((machine.memory.byte(Q_START), machine.memory.byte(Q_START + 1)), (0x80, 3));
    assert_eq!(machine.run(Op::SetImmediate, &[bit(Q_START, 0), c(0)]), End::Good);
    assert_eq!(
        machine.run_without_power(Op::SetImmediate, &[bit(Q_START, 0), c(3)]),
        End::NoResult
    );
    assert_eq!(machine.run(Op::SetImmediate, &[bit(Q_START, 1), c(128)]), End::BadOperand);
    assert_eq!(machine.memory.byte(Q_START), 0x80);
    assert_eq!(machine.run(Op::SetImmediate, &[bit(Q_START, 0), c(128)]), End::Good);
    assert_eq!((machine.memory.byte(Q_START + 15), machine.memory.byte(M_START)), (0xFF, 0));
    assert_eq!(machine.run_without_power(Op::AssignImmediate, &[bit(Q_START, 3)]), End::NoBox);
    assert_eq!(machine.memory.byte(Q_START), 0xF7);
}

#[test]
fn bits_with_a_count_that_is_read() {
    let mut machine = Machine::new();
    let last = ARENA_START + V_LEN - 1;
    machine.set_bytes(300, &[11]);
    for (address, place) in [(M_START, 6), (last - 1, 5)] {
        assert_eq!(machine.run(Op::SetAny, &[bit(address, place), v(300)]), End::Good);
        assert_eq!(
            (machine.memory.byte(address), machine.memory.byte(address + 1)),
            (0xFF << place, 0xFF)
        );
        assert_eq!(
            machine.run(Op::ResetAny, &[bit(address, place + 1), v(300)]),
            if address == M_START { End::Good } else { End::BadOperand }
        );
    }
    assert_eq!((machine.memory.word(M_START), machine.memory.byte(M_START + 2)), (0x4000, 0));
    assert_eq!(
        machine.memory.word(last - 1),
        0xE0FF,
        "a range that leaves its area writes nothing"
    );
    machine.set_bytes(300, &[0]);
    assert_eq!(machine.run(Op::ResetAny, &[bit(M_START, 6), v(300)]), End::Good);
    assert_eq!(machine.run_without_power(Op::ResetAny, &[bit(M_START, 6), c(1)]), End::NoResult);
    assert_eq!(machine.memory.byte(M_START), 0x40);
}

#[test]
fn bytes_of_points() {
    let mut machine = Machine::new();
    machine.memory.set_byte(I_START, 0x2A);
    assert_eq!(
        (machine.run(Op::Bir, &[data(I_START), v(10)]), machine.bytes(10, 1)),
        (End::Good, vec![0x2A])
    );
    assert_eq!(
        (machine.run(Op::Biw, &[v(10), data(Q_START)]), machine.memory.byte(Q_START)),
        (End::Good, 0x2A)
    );
    machine.set_double(0, pointer::to(0x00, 0));
    assert_eq!(machine.run(Op::Bir, &[at(0), v(11)]), End::Good);
    // Points only.
    machine.set_double(0, pointer::to(0x05, 0));
    assert_eq!(machine.run(Op::Bir, &[at(0), v(11)]), End::BadOperand);
    assert_eq!(machine.run(Op::Biw, &[v(10), at(0)]), End::BadOperand);
    assert_eq!(machine.memory.byte(M_START), 0);
}

#[test]
fn intervals_pass_the_end_of_the_clock() {
    let mut machine = Machine::new();
    machine.set_time(u32::MAX - 4);
    assert_eq!((machine.run(Op::Bitim, &[v(0)]), machine.double(0)), (End::Good, -5));
    machine.set_time(95);
    assert_eq!((machine.run(Op::Citim, &[v(0), v(4)]), machine.double(4)), (End::Good, 100));
}
