//! From instruction to instruction: what the program says, as machine code. Each group of instructions has its module.

use std::collections::BTreeMap;

use plc_isa::{Decoded, Group, LABEL_LEN, Op, Operand, Place, PowerFlow, Reference};

use super::avr::{OfBit, Reg};
use super::bits::{ALWAYS_ON, Combine};
use super::code::{Code, Label};
use super::effects::Effects;
use super::emitter::{Emitter, Traffic};
use super::stack;
use super::vectors::{Vector, bytecode_cycles};

/// The values below the top of the logic stack, a bit each.
pub const STACK: Reg = Reg(16);

/// A decoded program.
#[derive(Debug, Clone)]
pub struct Source<'a> {
    /// The bytecode image.
    pub image: &'a [u8],
    /// Its instructions.
    pub code: Vec<Decoded>,
    /// Their offsets, parallel to `code`.
    pub offsets: Vec<u16>,
    /// How often each is executed in a scan, about; parallel to `code`.
    pub passes: Vec<u32>,
}

/// Where the parts of the machine code begin.
#[derive(Debug)]
pub struct Marks {
    /// Each instruction of the program.
    pub instructions: Vec<usize>,
    /// What is reached from several places: behind the last instruction.
    pub stubs: usize,
    /// Where the end of the program is reached from END.
    pub exit: Label,
    /// Where it is left by STOP.
    pub stop: Label,
}

/// A program on its way to machine code.
pub struct Translator<'a> {
    pub(super) emitter: Emitter<'a>,
    pub(super) source: &'a Source<'a>,
    /// The instruction that is translated.
    pub(super) index: usize,
    /// Where jumps of the program lead, by offset.
    pub(super) targets: BTreeMap<u16, Label>,
    pub(super) exit: Label,
    pub(super) stop: Label,
    pub(super) stops: bool,
    /// Jumps back: where they go when the watchdog time is over, and their offsets.
    pub(super) overdue: Vec<(Label, u16)>,
    needed: Vec<bool>,
    /// Values below the top of the stack. Only the three lowest bits count.
    pushed: u8,
}

impl<'a> Translator<'a> {
    /// Ready to translate. The emitter has written nothing yet.
    pub fn new(source: &'a Source<'a>, mut emitter: Emitter<'a>) -> Translator<'a> {
        let (exit, stop) = (emitter.code.target(), emitter.code.target());
        let mut targets = BTreeMap::new();
        for offset in source.targets(emitter.plan) {
            targets.entry(offset).or_insert_with(|| emitter.code.target());
        }
        let needed = stack::needed(&source.code);
        let (stops, overdue) = (false, Vec::new());
        Translator { emitter, source, index: 0, targets, exit, stop, stops, overdue, needed, pushed: 0 }
    }

    /// Translates the whole program.
    pub fn run(mut self) -> (Code, Marks, Traffic) {
        let mut instructions = Vec::with_capacity(self.source.code.len());
        self.emitter.load_pinned();
        let source = self.source;
        for (index, (decoded, &at)) in source.code.iter().zip(&source.offsets).enumerate() {
            instructions.push(self.emitter.code.mark());
            self.index = index;
            self.emitter.passes = source.passes.get(index).copied().unwrap_or(1);
            if let Some(&label) = self.targets.get(&at) {
                self.emitter.bind_target(label);
                self.emitter.power_flow = None;
            }
            self.instruction(decoded);
            self.emitter.power_flow = self.power_flow_after(decoded);
        }
        let stubs = self.emitter.code.mark();
        self.stubs();
        let marks = Marks { instructions, stubs, exit: self.exit, stop: self.stop };
        (self.emitter.code, marks, self.emitter.traffic)
    }

    /// What is known of the top of the stack behind an instruction.
    fn power_flow_after(&self, decoded: &Decoded) -> Option<bool> {
        let before = self.emitter.power_flow;
        match (decoded.op, decoded.operands().next()) {
            (Op::Ld, Some((_, Operand::Bit(ALWAYS_ON)))) | (Op::Next, _) => Some(true),
            (Op::Ldn, Some((_, Operand::Bit(ALWAYS_ON)))) => Some(false),
            (Op::Lps | Op::Nop, _) => before,
            _ => match decoded.op.instruction().group {
                Group::Coil | Group::Math | Group::Move | Group::Timer | Group::Counter | Group::Hidden => before,
                _ => None,
            },
        }
    }

    fn instruction(&mut self, decoded: &Decoded) {
        let operands: Vec<Operand> = decoded.operands().map(|(_, operand)| operand).collect();
        match (decoded.op, operands.as_slice()) {
            (Op::Ld, &[Operand::Bit(bit)]) => self.contact(Combine::Load, bit, true),
            (Op::Ldn, &[Operand::Bit(bit)]) => self.contact(Combine::Load, bit, false),
            (Op::A, &[Operand::Bit(bit)]) => self.contact(Combine::And, bit, true),
            (Op::An, &[Operand::Bit(bit)]) => self.contact(Combine::And, bit, false),
            (Op::O, &[Operand::Bit(bit)]) => self.contact(Combine::Or, bit, true),
            (Op::On, &[Operand::Bit(bit)]) => self.contact(Combine::Or, bit, false),
            (Op::Assign, &[Operand::Bit(bit)]) => self.assign(bit),
            (Op::Set, &[Operand::Bit(bit), Operand::Constant(count)]) => self.bits(decoded, bit, count, true),
            (Op::Reset, &[Operand::Bit(bit), Operand::Constant(count)]) => self.bits(decoded, bit, count, false),
            (Op::ResetTimers, &[Operand::Number(first), Operand::Constant(count)]) => {
                self.reset_timers(decoded, first, count);
            }
            (Op::ResetCounters, &[Operand::Number(first), Operand::Constant(count)]) => {
                self.reset_counters(decoded, first, count);
            }
            (Op::Not, _) => self.not(),
            (Op::Eu, &[Operand::Number(edge)]) => self.edge(edge, true),
            (Op::Ed, &[Operand::Number(edge)]) => self.edge(edge, false),
            (Op::Ald, _) => self.and_load(),
            (Op::Old, _) => self.or_load(),
            (Op::Lps, _) => self.push(),
            (Op::Lrd, _) => self.logic_read(),
            (Op::Lpp, _) => self.logic_pop(),
            (Op::Lds, &[Operand::Number(level)]) => self.load_stack(level),
            (Op::Nop | Op::Lbl, _) => {}
            _ => self.wider_instruction(decoded, &operands),
        }
    }

    /// The instructions on more than bits.
    fn wider_instruction(&mut self, decoded: &Decoded, operands: &[Operand]) {
        match (decoded.op, operands) {
            (Op::Ldw, &[Operand::Relation(relation), a, b]) => self.compare_words(Combine::Load, relation, a, b),
            (Op::Aw, &[Operand::Relation(relation), a, b]) => self.compare_words(Combine::And, relation, a, b),
            (Op::Ow, &[Operand::Relation(relation), a, b]) => self.compare_words(Combine::Or, relation, a, b),
            (Op::Ldb, &[Operand::Relation(relation), a, b]) => self.compare_bytes(Combine::Load, relation, a, b),
            (Op::Ab, &[Operand::Relation(relation), a, b]) => self.compare_bytes(Combine::And, relation, a, b),
            (Op::Ob, &[Operand::Relation(relation), a, b]) => self.compare_bytes(Combine::Or, relation, a, b),
            (Op::Movb, &[input, Operand::Memory(out)]) => self.move_byte(input, out),
            (Op::Movw, &[input, Operand::Memory(out)]) => self.move_word(input, out),
            (Op::AddInt, &[in1, Operand::Memory(out)]) => self.add(in1, out),
            (Op::SubInt, &[in1, Operand::Memory(out)]) => self.subtract(in1, out),
            (Op::Incw, &[Operand::Memory(out)]) => self.increment(out),
            (Op::Decw, &[Operand::Memory(out)]) => self.decrement(out),
            (Op::Ton | Op::Tof | Op::Tonr, &[Operand::Number(slot), preset]) => self.timer(decoded, slot, preset),
            (Op::Ctu | Op::Ctd | Op::Ctud, &[Operand::Number(slot), preset]) => self.counter(decoded.op, slot, preset),
            (Op::For, &[Operand::Memory(indx), init, last, Operand::Offset(end)]) => {
                self.for_loop(indx, init, last, end);
            }
            (Op::Next, &[Operand::Offset(start), Operand::Offset(here)]) => self.next_pass(start, here),
            (Op::Jmp, &[Operand::Number(label), Operand::Offset(here)]) => self.jump(label, here),
            (Op::End, _) => self.emitter.branch_if(true, self.exit),
            (Op::Stop, _) => {
                self.stops = true;
                self.emitter.branch_if(true, self.stop);
            }
            (Op::MainEnd, _) => self.main_end(),
            _ => self.by_bytecode(decoded),
        }
    }

    /// The firmware executes the instruction.
    pub(super) fn by_bytecode(&mut self, decoded: &Decoded) {
        let (image, plan) = (self.source.image, self.emitter.plan);
        let at = self.source.offsets.get(self.index).copied().unwrap_or(0);
        let bytes = image.get(usize::from(at)..usize::from(at + decoded.len));
        let mut piece = bytes.unwrap_or(&[]).to_vec();
        move_constants(decoded, &mut piece, LABEL_LEN * plan.header.labels);
        piece.extend(Op::MainEnd.instruction().encode(&[]).iter().flat_map(|encoded| encoded.bytes()));
        let cycles = bytecode_cycles(decoded, plan, image);
        let call = |emitter: &mut Emitter<'_>| {
            emitter.call(Vector::Bytecode, cycles, Effects::of(decoded, plan), |emitter| {
                emitter.code.piece_address(piece);
            });
        };
        match decoded.op.instruction().power_flow {
            PowerFlow::Needed => self.emitter.with_power_flow(call),
            PowerFlow::Always => call(&mut self.emitter),
        }
    }

    /// The top of the stack gets a neighbour below, for which it stands.
    pub(super) fn push(&mut self) {
        if self.is_needed() {
            self.emitter.bit(OfBit::Bld, STACK, self.pushed & 7);
        }
        self.pushed = self.pushed.wrapping_add(1);
    }

    /// The top's neighbour goes. Returns its bit.
    pub(super) fn pop(&mut self) -> u8 {
        self.pushed = self.pushed.wrapping_sub(1);
        self.pushed & 7
    }

    /// The bit of a level from 1 on.
    pub(super) fn level(&self, level: u8) -> u8 {
        self.pushed.wrapping_sub(level) & 7
    }

    /// Whether the value that this instruction pushes down is read later.
    pub(super) fn is_needed(&self) -> bool {
        self.needed.get(self.index).copied().unwrap_or(true)
    }
}

/// The constants of a native image begin earlier: it has no labels.
fn move_constants(decoded: &Decoded, piece: &mut [u8], by: u16) {
    let operands_len: usize = decoded.operands().map(|(kind, _)| usize::from(kind.stored_len())).sum();
    let mut at = piece.len().saturating_sub(operands_len);
    for (kind, operand) in decoded.operands() {
        let len = usize::from(kind.stored_len());
        if let (Operand::Reference(reference), Some(place)) = (operand, piece.get_mut(at..at + len))
            && let Some(Place::Pool(offset)) = reference.place()
        {
            place.copy_from_slice(&Reference::to(Place::Pool(offset - by)).0.to_le_bytes());
        }
        at += len;
    }
}
