//! Reals: how results are written. The values themselves are tested where they are computed.

use plc_isa::{EDGES_MAX, M_START, Op, Operand};

use crate::machine::{BY_ZERO, End, Machine, NEGATIVE, OVERFLOW, V_LEN, ZERO, bit, v};

const STATUS: u8 = ZERO | OVERFLOW | NEGATIVE;

/// `op` on IN in VD0 and OUT in VD10: the result, or that there is none; SMB1 from all bits 0 and
/// from all 1.
fn check(op: Op, input: f32, out: f32, result: Option<f32>, set: u8, touched: u8) {
    for before in [0x00, 0xFF] {
        let mut machine = Machine::new();
        machine.set_real(0, input);
        machine.set_real(10, out);
        machine.set_sm1(before);
        let end = machine.run(op, &[v(0), v(10)]);
        assert_eq!(
            end,
            if result.is_some() { End::Good } else { End::NoResult },
            "{op:?} {input} {out}"
        );
        assert_eq!(
            machine.real_at(10).to_bits(),
            result.unwrap_or(out).to_bits(),
            "{op:?} {input} {out}"
        );
        assert_eq!(machine.sm1(), before & !touched | set, "{op:?} {input} {out}");
    }
}

#[test]
fn arithmetic() {
    check(Op::AddReal, 1.5, 2.25, Some(3.75), 0, STATUS);
    check(Op::AddReal, -1.5, 1.5, Some(0.0), ZERO, STATUS);
    check(Op::AddReal, f32::MAX, f32::MAX, None, OVERFLOW, STATUS);
    check(Op::AddReal, f32::NAN, 1.0, None, OVERFLOW, STATUS);
    check(Op::SubReal, 1.5, 1.0, Some(-0.5), NEGATIVE, STATUS);
    check(Op::SubReal, 1.0, f32::INFINITY, None, OVERFLOW, STATUS);
    check(Op::MulReal, -0.0, 2.0, Some(-0.0), ZERO, STATUS | BY_ZERO);
    check(Op::MulReal, 1e30, 1e30, None, OVERFLOW, STATUS | BY_ZERO);
    check(Op::DivReal, 4.0, -1.0, Some(-0.25), NEGATIVE, STATUS | BY_ZERO);
    check(Op::DivReal, 1e-30, 1e30, None, OVERFLOW, STATUS | BY_ZERO);
    for zero in [0.0, -0.0] {
        check(Op::DivReal, zero, 5.0, None, BY_ZERO, BY_ZERO);
    }
}

#[test]
fn functions() {
    check(Op::Sqrt, 6.25, 0.0, Some(2.5), 0, STATUS);
    check(Op::Sqrt, -1.0, 7.0, None, OVERFLOW, STATUS);
    check(Op::Sin, -1.0, 0.0, plc_vm::function::sin(-1.0), NEGATIVE, STATUS);
    check(Op::Cos, 3.0, 0.0, plc_vm::function::cos(3.0), NEGATIVE, STATUS);
    check(Op::Tan, 1.0, 0.0, plc_vm::function::tan(1.0), 0, STATUS);
    check(Op::Tan, f32::INFINITY, 7.0, None, OVERFLOW, STATUS);
    check(Op::Ln, 1.0, 7.0, Some(0.0), ZERO, STATUS);
    check(Op::Ln, 0.0, 7.0, None, OVERFLOW, STATUS);
    check(Op::Exp, 1.0, 0.0, plc_vm::function::exp(1.0), 0, STATUS);
    check(Op::Exp, 100.0, 7.0, None, OVERFLOW, STATUS);
}

/// PV, SP, Mn, Kc, Ts, Ti, Td, MX, PVn-1: proportional only.
const TABLE: [f32; 9] = [0.5, 0.75, 0.25, 1.0, 1.0, 0.0, 0.0, 0.125, 0.5];
const HISTORY: Operand = Operand::Number(2);

fn set_table(machine: &mut Machine) {
    (0..).step_by(4).zip(TABLE).for_each(|(byte, value)| machine.set_real(byte, value));
}

#[test]
fn pid_computes_its_table() {
    const { assert!(EDGES_MAX > 2) };
    let mut machine = Machine::new();
    set_table(&mut machine);
    machine.set_sm1(0xFF);
    assert_eq!(machine.run(Op::Pid, &[v(0), Operand::Number(7), HISTORY]), End::Good);
    assert_eq!((machine.real_at(8), machine.real_at(4), machine.sm1()), (0.375, 0.75, !OVERFLOW));
    machine.set_real(0, f32::NAN);
    let before = machine.bytes(0, 36);
    assert_eq!(machine.run(Op::Pid, &[v(0), Operand::Number(0), HISTORY]), End::NoResult);
    assert_eq!((machine.bytes(0, 36), machine.sm1()), (before, 0xFF));
    assert_eq!(
        machine.run(Op::Pid, &[v(V_LEN - 35), Operand::Number(0), HISTORY]),
        End::BadOperand
    );
    assert_eq!(
        machine.run_without_power(Op::Pid, &[v(0), Operand::Number(0), HISTORY]),
        End::NoResult
    );
}

#[test]
fn pid_starts_without_a_jump_but_not_at_the_first_execution() {
    let mut machine = Machine::new();
    let power = bit(M_START, 0);
    let pid: &[Operand] = &[v(0), Operand::Number(0), HISTORY];
    machine.load(&[(Op::Ld, &[power]), (Op::Pid, pid)]);
    let mut scan = |power: u8, end: End, setpoint: f32| {
        set_table(&mut machine);
        machine.memory.set_byte(M_START, power);
        assert_eq!((machine.scan(), machine.real_at(4)), (end, setpoint));
    };
    scan(1, End::Good, 0.75);
    scan(1, End::Good, 0.75);
    scan(0, End::NoResult, 0.75);
    scan(1, End::Good, 0.5);
    scan(1, End::Good, 0.75);
    // After a change to RUN the first execution sees no transition, whatever was before.
    let mut machine = Machine::new();
    set_table(&mut machine);
    machine.run_without_power(Op::Pid, pid);
    assert_eq!((machine.run(Op::Pid, pid), machine.real_at(4)), (End::Good, 0.75));
}
