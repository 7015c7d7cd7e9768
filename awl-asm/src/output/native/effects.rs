//! Which bytes of data memory a bytecode instruction reads and writes when the firmware executes
//! it.

use std::ops::Range;

use plc_isa::{
    C_BITS_START, DATA_END, DATA_START, Decoded, ENO, Group, Kind, L_START, Many, Op, Operand,
    Plan, ProgramMemory, Referent, Role, SM_START, T_BITS_START, Type,
};

/// SMB1, where arithmetic leaves its results' properties.
pub const STATUS: u16 = SM_START + 1;

/// SMB4, where interrupts and errors leave their marks.
const ERRORS: u16 = SM_START + 4;

/// All of data memory.
const EVERYTHING: Range<u16> = DATA_START..DATA_END;

/// Bytes that 255 bits can touch.
const RANGE_BYTES_MAX: u16 = 33;

/// Data addresses that are read and written.
#[derive(Debug, Clone, Default)]
pub struct Effects {
    reads: Vec<Range<u16>>,
    writes: Vec<Range<u16>>,
}

impl Effects {
    /// Of the routine of a timer or counter: its slot and the byte with its bit.
    pub fn of_slot(slot: Range<u16>, bit_address: u16) -> Effects {
        let ranges = vec![slot, bit_address..bit_address + 1];
        Effects { reads: ranges.clone(), writes: ranges }
    }

    /// Of a bytecode instruction.
    pub fn of<P: ProgramMemory>(decoded: &Decoded, plan: &Plan<P>) -> Effects {
        let mut effects = Effects::default();
        if decoded.op.instruction().module().is_some() {
            return Effects::of_module(decoded);
        }
        let len = bits_len(decoded);
        for (kind, operand) in decoded.operands() {
            let range = match (kind, operand) {
                (_, Operand::Bit(bit)) => bit.address..bit.address + len,
                (kind, Operand::Memory(address)) => address..address + kind.value_len(),
                _ => continue,
            };
            effects.reads.push(range.clone());
            if kind.is_output() {
                effects.writes.push(range);
            }
        }
        if decoded.op.instruction().flags != 0 {
            effects.writes.push(STATUS..STATUS + 1);
        }
        match decoded.op {
            // A timer of 1 ms brings the others up to date.
            Op::Refresh | Op::ResetTimers | Op::Ton | Op::Tof | Op::Tonr => {
                effects.writes.extend([T_BITS_START..C_BITS_START, slots(plan)]);
            }
            Op::Atch | Op::Dtch | Op::Cevnt | Op::Eni | Op::Disi => {
                effects = Effects { reads: only(EVERYTHING), writes: only(ERRORS..ERRORS + 1) };
            }
            Op::ResetCounters => effects.writes.extend([C_BITS_START..L_START, slots(plan)]),
            _ => {}
        }
        effects
    }

    /// Of an instruction of a module.
    fn of_module(decoded: &Decoded) -> Effects {
        let group = decoded.op.instruction().group;
        let mut effects = Effects { reads: Vec::new(), writes: only(ENO..ENO + 1) };
        if decoded.op.instruction().rung.is_contact() {
            // A comparison by an illegal pointer leaves the program.
            if group == Group::Compare {
                effects.reads.push(EVERYTHING);
            }
            return effects;
        }
        let computes =
            [Group::Math, Group::Logic, Group::Shift, Group::Conversion, Group::Real, Group::Move];
        if !computes.contains(&group) {
            return Effects::everything();
        }
        for ((kind, operand), &role) in decoded.operands().zip(decoded.op.instruction().roles) {
            let (Some(len), Operand::Reference(reference)) = (value_len(kind, role), operand)
            else {
                return Effects::everything();
            };
            match reference.place() {
                Some(Referent::Direct(address)) => {
                    let list =
                        if kind.is_output() { &mut effects.writes } else { &mut effects.reads };
                    list.push(address..address + len);
                }
                Some(Referent::Constant(_) | Referent::Pool(_)) => {}
                _ => return Effects::everything(),
            }
        }
        effects.writes.extend([STATUS..STATUS + 1, ERRORS..ERRORS + 1]);
        effects
    }

    fn everything() -> Effects {
        Effects { reads: only(EVERYTHING), writes: only(EVERYTHING) }
    }

    /// And those of another instruction.
    pub fn add(&mut self, other: Effects) {
        self.reads.extend(other.reads);
        self.writes.extend(other.writes);
    }

    /// Whether the byte must be in memory before.
    pub fn touches(&self, address: u16) -> bool {
        self.writes(address) || self.reads.iter().any(|range| range.contains(&address))
    }

    /// Whether the byte may be another one afterwards.
    pub fn writes(&self, address: u16) -> bool {
        self.writes.iter().any(|range| range.contains(&address))
    }
}

fn only(range: Range<u16>) -> Vec<Range<u16>> {
    std::iter::once(range).collect()
}

/// Bytes of the value that a module's instruction reads or writes; `None` for texts, tables and
/// what is no value.
fn value_len(kind: Kind, role: Role) -> Option<u16> {
    match kind.value_type()? {
        of @ (Type::Byte | Type::Word | Type::Double | Type::Real) if role.many == Many::One => {
            Some(of.bytes())
        }
        _ => None,
    }
}

/// Bytes that the bits of the instruction's operand lie in, at most.
fn bits_len(decoded: &Decoded) -> u16 {
    let mut len = 1;
    for (kind, operand) in decoded.operands() {
        match (kind, operand) {
            (Kind::Count, Operand::Constant(count)) => len = (count + 7).div_ceil(8),
            (Kind::Byte, _) if matches!(decoded.op, Op::Set | Op::Reset) => len = RANGE_BYTES_MAX,
            _ => {}
        }
    }
    len
}

/// Where the timers and counters of the plan live.
pub fn slots<P: ProgramMemory>(plan: &Plan<P>) -> Range<u16> {
    plan.timer(0).address..plan.edge(0).address
}
