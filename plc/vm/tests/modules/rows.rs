//! The columns of the instruction table against what instructions do: which operands they read and
//! write, how many elements, which flags. Every instruction is executed with many memories; what
//! changes must be in its row, and what is in its row must change.

use std::collections::BTreeSet;

use plc_isa::{
    ARENA_START, ENO, Group, INSTRUCTIONS, Instruction, Kind, Many, Op, Operand, Relation, Role,
    Rung, SM_START, Takes, Type, Written,
};

use crate::machine::{Machine, bit, relation, v};

/// Memories that each instruction is executed with.
const MEMORIES: u32 = 150;
/// V bytes between the operands.
const STEP: u16 = 90;
/// The bytes that an operand can have.
const ROOM: u16 = 80;
/// The bit that bit operands name in their byte.
const BIT: u8 = 3;

/// Random numbers, the same in every run.
struct Random(u32);

impl Random {
    fn below(&mut self, limit: u32) -> u32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 16) % limit
    }
}

/// Why an instruction is not executed here: it works with more than the memory its operands name.
fn is_apart(instruction: &Instruction) -> bool {
    match instruction.group {
        Group::Timer | Group::Counter | Group::Control | Group::Call => true,
        Group::Sequence | Group::Interrupt | Group::Hidden => true,
        Group::Communication | Group::InputOutput => true,
        Group::Contact | Group::Coil | Group::Stack | Group::Compare | Group::Math => false,
        Group::Move | Group::Logic | Group::Shift | Group::Conversion => false,
        // PID remembers what it did.
        Group::Real => instruction.forms.iter().any(|form| form.kinds.contains(&Kind::Loop)),
        Group::Text | Group::Table => false,
    }
}

/// The operands of a form in V memory, each at its place; `None` for what is in no memory.
fn operand(kind: Kind, index: u16, random: &mut Random, known: &[Relation]) -> Option<Operand> {
    let at = index * STEP;
    match (kind.value_type(), kind.written()) {
        (Some(_), Written::Input | Written::Output) => None,
        (Some(Type::Bit), _) => Some(bit(ARENA_START + at, BIT)),
        (Some(_), _) if kind.is_reference() => Some(v(at)),
        (Some(_), _) => Some(Operand::Memory(ARENA_START + at)),
        (None, Written::Constant(..)) => Some(Operand::Constant(3)),
        (None, Written::Hidden) if !known.is_empty() => {
            Some(relation(known[random.below(known.len() as u32) as usize]))
        }
        (None, _) => None,
    }
}

/// The operands in the text with their roles, by their places.
fn written(instruction: &Instruction, kinds: &[Kind]) -> Vec<(u16, Kind, Role)> {
    let all = (0..).zip(kinds.iter().copied()).zip(instruction.roles.iter().copied());
    all.map(|((index, kind), role)| (index, kind, role))
        .filter(|(_, kind, _)| kind.is_written())
        .collect()
}

/// Memory that the instruction makes sense of, now and then not.
fn fill(machine: &mut Machine, written: &[(u16, Kind, Role)], random: &mut Random) {
    let small = |random: &mut Random| random.below(7) as u8;
    for byte in 0..400 {
        let value = [random.below(256) as u8, random.below(4) as u8][random.below(2) as usize];
        machine.set_bytes(byte, &[value]);
    }
    machine.set_sm1(random.below(256) as u8);
    for &(index, kind, role) in written {
        let at = index * STEP;
        match role.takes {
            Takes::Format => machine.set_bytes(at, &[random.below(6) as u8 | 8]),
            Takes::RealFormat => {
                let len = 8 + random.below(8) as u8;
                machine.set_bytes(at, &[len << 4 | random.below(6) as u8]);
            }
            Takes::Count(_) | Takes::Length | Takes::Memory => {
                machine.set_bytes(at, &[1 + small(random)]);
            }
            Takes::Position => machine.set_bytes(at, &[1 + random.below(3) as u8]),
            Takes::Shift => {
                let count = random.below(17) as i8 - 8;
                machine.set_bytes(at, &[count as u8]);
            }
            _ => {}
        }
        match (kind.value_type(), role.many) {
            (Some(Type::Text), _) => {
                let texts = ["12", "-7.5", "AB12", "B", "1234", "2A"];
                machine.set_text(at, texts[random.below(6) as usize]);
            }
            (_, Many::Table) => machine.set_words(at, &[8, random.below(9) as i16]),
            (_, Many::Entries) => machine.set_words(at, &[2 + random.below(6) as i16]),
            (Some(Type::Real), Many::One) => {
                machine.set_real(at, random.below(4000) as f32 / 256.0 - 3.0);
            }
            (Some(Type::Word), Many::One) if random.below(3) > 0 => {
                machine.set_words(at, &[random.below(9) as i16 - 2]);
            }
            (Some(Type::Double), Many::One) if random.below(3) > 0 => {
                machine.set_double(at, random.below(9));
            }
            (Some(Type::Byte), Many::One) if role.takes == Takes::Any && random.below(3) > 0 => {
                machine.set_bytes(at, &[small(random)]);
            }
            (_, Many::Counted(_)) if random.below(2) > 0 => {
                machine.set_bytes(at, b"1A0Fb38C");
            }
            _ => {}
        }
    }
}

/// Bytes that an operand stands for in a memory, by its row.
fn extent(machine: &Machine, written: &[(u16, Kind, Role)], kind: Kind, place: u16) -> u16 {
    let Some((_, _, role)) = written.iter().find(|(index, ..)| *index == place) else { return 0 };
    let value = |nth: u8| {
        let (index, kind, _) = written[usize::from(nth)];
        if kind.value_type().is_none() {
            return 3;
        }
        u16::from(machine.bytes(index * STEP, 1)[0])
    };
    let is_bit = kind.value_type() == Some(Type::Bit);
    let count = match role.many {
        Many::One => 1,
        Many::Elements(count) => count,
        Many::Counted(nth) if is_bit => return (u16::from(BIT) + value(nth)).div_ceil(8),
        Many::Counted(nth) => value(nth),
        Many::Halved(nth) => value(nth).div_ceil(2),
        Many::Register(nth) => {
            let bits = u16::from((value(nth) as i8).unsigned_abs());
            return (u16::from(BIT) + bits).div_ceil(8);
        }
        Many::Formatted(nth, more) => more + (value(nth) >> 4),
        Many::Text => 1 + u16::from(machine.bytes(place * STEP, 1)[0]),
        Many::Copied(nth) => 1 + value(nth),
        Many::Characters(nth) => 1 + value(nth),
        Many::Table | Many::Entries | Many::Open => ROOM / kind.value_len(),
    };
    (count * kind.value_len()).min(ROOM)
}

/// Everything that an instruction can change: V memory, SMB1, the top of the stack, ENO.
fn state(machine: &Machine) -> Vec<u8> {
    let mut bytes = machine.bytes(0, 400);
    bytes.push(machine.sm1());
    bytes
}

/// What the stack and errors are after an instruction.
fn outcome(machine: &Machine) -> [u16; 3] {
    [
        machine.stack(),
        u16::from(machine.memory.byte(ENO)),
        u16::from(machine.memory.byte(SM_START + 4)),
    ]
}

/// What was seen of an instruction.
#[derive(Default)]
struct Seen {
    reads: [bool; 4],
    writes: [bool; 4],
    flags: u8,
    faults: BTreeSet<String>,
}

/// What becomes of a memory: V memory with SMB1, and stack and errors.
type After = (Vec<u8>, [u16; 3]);

/// An instruction with its operands, and a memory for it.
struct Trial<'a> {
    row: &'a Instruction,
    written: Vec<(u16, Kind, Role)>,
    operands: Vec<Operand>,
    is_off: bool,
    before: Vec<u8>,
    /// Bytes that each operand in the text stands for in this memory.
    extents: Vec<u16>,
}

impl<'a> Trial<'a> {
    fn new(row: &'a Instruction, kinds: &[Kind], random: &mut Random) -> Trial<'a> {
        let written = written(row, kinds);
        let operands: Option<Vec<Operand>> = (0..)
            .zip(kinds)
            .map(|(index, &kind)| operand(kind, index, random, row.relations()))
            .collect();
        let operands = operands.unwrap_or_else(|| panic!("{:?} {kinds:?}: no operands", row.op));
        let mut machine = Machine::new();
        fill(&mut machine, &written, random);
        let extents = written
            .iter()
            .map(|&(index, kind, _)| extent(&machine, &written, kind, index))
            .collect();
        // A box needs power flow; contacts combine with both.
        let is_off = row.rung != Rung::Boxed && random.below(2) == 0;
        Trial { row, written, operands, is_off, before: state(&machine), extents }
    }

    /// Executes it in a memory.
    fn run(&self, memory: &[u8]) -> After {
        let mut machine = Machine::new();
        machine.set_bytes(0, &memory[..400]);
        machine.set_sm1(memory[400]);
        let first: &[Operand] = &[bit(SM_START, 0)];
        let top = if self.is_off { Op::Ldn } else { Op::Ld };
        machine.load(&[
            (Op::Ldn, first),
            (Op::Ld, first),
            (top, first),
            (self.row.op, &self.operands),
        ]);
        machine.scan();
        (state(&machine), outcome(&machine))
    }

    /// Notes what it writes.
    fn writes(&self, after: &After, seen: &mut Seen) {
        seen.flags |= self.before[400] ^ after.0[400];
        for byte in (0..400).filter(|&byte| self.before[byte] != after.0[byte]) {
            let (place, offset) = (byte as u16 / STEP, byte as u16 % STEP);
            let nth = self.written.iter().position(|&(index, ..)| index == place);
            if nth.is_some_and(|nth| self.written[nth].2.writes() && offset < self.extents[nth]) {
                seen.writes[usize::from(place)] = true;
            } else {
                let name = format!("{:?} {:?}", self.row.op, self.operands);
                seen.faults.insert(format!("{name} writes operand {place} + {offset}"));
            }
        }
    }

    /// Whether anything becomes another when a bit of the byte does, but for that byte itself where
    /// it is left alone. Of bits that are written the others in the byte stay; one that is inverted
    /// is read.
    fn reads(&self, after: &After, at: usize, bit: u8, is_bits: bool) -> bool {
        let mut memory = self.before.clone();
        memory[at] ^= 1 << bit;
        let changed = self.run(&memory);
        let is_kept = memory[at] == changed.0[at] && self.before[at] == after.0[at];
        // Of the byte with the bits: the bit that was changed, if the instruction has changed it.
        let own = 1 << bit;
        let is_inverted = (changed.0[at] ^ memory[at]) & (after.0[at] ^ self.before[at]) & own != 0;
        let is_left = is_kept || is_bits && !is_inverted;
        let differs = |byte: usize| changed.0[byte] != after.0[byte] && !(byte == at && is_left);
        changed.1 != after.1 || (0..=400).any(differs)
    }
}

/// Executes an instruction once, and once for each byte of its operands with this byte changed.
fn observe(row: &Instruction, kinds: &[Kind], seed: u32, seen: &mut Seen) {
    let mut random = Random(seed);
    let trial = Trial::new(row, kinds, &mut random);
    let after = trial.run(&trial.before);
    trial.writes(&after, seen);
    for (&(index, kind, role), &len) in trial.written.iter().zip(&trial.extents) {
        if kind.value_type().is_none() {
            continue;
        }
        let is_bits = kind.value_type() == Some(Type::Bit) && !role.reads();
        for at in (0..len.min(12)).map(|offset| usize::from(index * STEP + offset)) {
            if !trial.reads(&after, at, random.below(8) as u8, is_bits) {
                continue;
            }
            seen.reads[usize::from(index)] = true;
            if !role.reads() {
                let offset = at as u16 % STEP;
                seen.faults
                    .insert(format!("{:?} {kinds:?} reads operand {index} + {offset}", row.op));
            }
        }
    }
}

#[test]
fn rows_say_what_instructions_do() {
    let (mut count, mut faults) = (0, Vec::new());
    for row in INSTRUCTIONS.iter().filter(|row| !is_apart(row)) {
        for form in row.forms {
            let is_in_memory = |kind: &Kind| kind.shape() != plc_isa::Shape::PageBit;
            let is_numbered = form.kinds.iter().any(|kind| {
                matches!(kind.written(), Written::Timer | Written::Counter | Written::Number(_))
                    || matches!(kind, Kind::Edge | Kind::ErrorMask)
            });
            // Bits of the bit page are written as others are.
            if !form.kinds.iter().all(is_in_memory) || is_numbered {
                continue;
            }
            count += 1;
            let mut seen = Seen::default();
            for seed in 0..MEMORIES {
                observe(row, form.kinds, seed * 7919 + 1, &mut seen);
            }
            faults.extend(std::mem::take(&mut seen.faults));
            let name = format!("{:?} {:?}", row.op, form.kinds);
            for (index, kind, role) in written(row, form.kinds) {
                if kind.value_type().is_none() {
                    continue;
                }
                let place = usize::from(index);
                let wrong = [
                    (seen.reads[place] != role.reads(), "read"),
                    (seen.writes[place] != role.writes(), "written"),
                ];
                for (_, what) in wrong.iter().filter(|(is_wrong, _)| *is_wrong) {
                    faults.push(format!("{name}: operand {index} says of being {what}: {role:?}"));
                }
            }
            if seen.flags != row.flags {
                faults.push(format!("{name}: flags {:08b}, not {:08b}", seen.flags, row.flags));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 130, "{count} forms");
}

#[test]
fn boxes_do_nothing_without_power() {
    for row in INSTRUCTIONS.iter().filter(|row| row.rung == Rung::Boxed && !is_apart(row)) {
        let kinds = row.forms[row.forms.len() - 1].kinds;
        let mut random = Random(1);
        let operands: Option<Vec<Operand>> = (0..)
            .zip(kinds)
            .map(|(index, &kind)| operand(kind, index, &mut random, row.relations()))
            .collect();
        let Some(operands) = operands else { continue };
        let mut machine = Machine::new();
        fill(&mut machine, &written(row, kinds), &mut random);
        let before = state(&machine);
        machine.run_without_power(row.op, &operands);
        assert_eq!(state(&machine), before, "{:?}", row.op);
    }
}
