//! From instruction to instruction: what the program says, as machine code. Each group of
//! instructions has its module.

use std::collections::BTreeMap;

use plc_isa::{Decoded, ENO, Group, Op, Operand, PowerFlow, Rung};

use super::avr::{OfBit, Reg};
use super::bits::{ALWAYS_ON, Combine};
use super::code::{Code, Label};
use super::effects::Effects;
use super::emitter::{Emitter, Traffic, ZERO};
use super::stack::StackUse;
use super::units::Moved;
use super::vectors::{BYTECODE, Vector, bytecode_cycles, piece};

/// The values below the top of the logic stack, a bit each.
pub const STACK: Reg = Reg(16);

/// A decoded program.
#[derive(Debug, Clone, Default)]
pub struct Source<'a> {
    /// The bytecode image.
    pub image: &'a [u8],
    /// Its instructions.
    pub code: Vec<Decoded>,
    /// Their offsets, parallel to `code`.
    pub offsets: Vec<u16>,
    /// How often each is executed in a scan, about; parallel to `code`.
    pub passes: Vec<u32>,
    /// The routines among them: where each begins, by its index.
    pub routines: BTreeMap<u8, usize>,
    /// How many labels the native image does not have; all or none.
    pub lost_labels: u16,
    /// Whether any instruction of the program asks for ENO.
    pub reads_eno: bool,
}

/// Where the parts of the machine code begin.
#[derive(Debug)]
pub struct Marks {
    /// Each instruction of the program.
    pub instructions: Vec<usize>,
    /// What is reached from several places: after the last instruction.
    pub stubs: usize,
    /// Where the end of each unit is reached from END or CRET, and where the program is left by
    /// STOP.
    pub exits: Vec<Label>,
}

/// A program on its way to machine code.
pub struct Translator<'a> {
    pub(super) emitter: Emitter<'a>,
    pub(super) source: &'a Source<'a>,
    /// The instruction that is translated.
    pub(super) index: usize,
    /// Where jumps of the program lead, by offset.
    pub(super) targets: BTreeMap<u16, Label>,
    /// Where the routines begin, by their index.
    pub(super) routines: BTreeMap<u8, Label>,
    /// The end of the unit.
    pub(super) exit: Label,
    pub(super) stop: Label,
    pub(super) stops: bool,
    /// The routine that looks for events, if there is one.
    pub(super) look: Option<Label>,
    /// Jumps back: where they go when the watchdog time is over, and their offsets.
    pub(super) overdue: Vec<(Label, u16)>,
    pub(super) stack_use: StackUse,
    /// How many of the next instructions are executed already, in one go with the last.
    executed: usize,
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
        let routines =
            source.routines.keys().map(|&routine| (routine, emitter.code.label())).collect();
        let stack_use = StackUse::of(&source.code);
        Translator {
            emitter,
            source,
            index: 0,
            targets,
            routines,
            exit,
            stop,
            stops: false,
            look: None,
            overdue: Vec::new(),
            stack_use,
            executed: 0,
            pushed: 0,
        }
    }

    /// Translates the whole program.
    pub fn run(mut self) -> (Code, Marks, Traffic) {
        let mut instructions = Vec::with_capacity(self.source.code.len());
        let mut exits = vec![self.stop, self.exit];
        let begins: BTreeMap<usize, Label> = self
            .source
            .routines
            .iter()
            .filter_map(|(routine, &at)| Some((at, *self.routines.get(routine)?)))
            .collect();
        self.emitter.load_pinned();
        let source = self.source;
        for (index, (decoded, &at)) in source.code.iter().zip(&source.offsets).enumerate() {
            instructions.push(self.emitter.code.mark());
            self.index = index;
            self.emitter.passes = source.passes.get(index).copied().unwrap_or(1);
            if let Some(&label) = begins.get(&index) {
                self.emitter.bind_target(label);
                self.emitter.power_flow = Some(true);
                self.exit = self.emitter.code.target();
                exits.push(self.exit);
            }
            if let Some(&label) = self.targets.get(&at) {
                self.emitter.bind_target(label);
                self.emitter.power_flow = None;
            }
            match self.executed.checked_sub(1) {
                Some(left) => self.executed = left,
                None => self.instruction(decoded),
            }
            self.emitter.power_flow = self.power_flow_after(decoded);
        }
        let stubs = self.emitter.code.mark();
        self.stubs();
        let marks = Marks { instructions, stubs, exits };
        (self.emitter.code, marks, self.emitter.traffic)
    }

    /// What is known of the top of the stack after an instruction.
    fn power_flow_after(&self, decoded: &Decoded) -> Option<bool> {
        let before = self.emitter.power_flow;
        match (decoded.op, decoded.operands().next()) {
            (Op::Ld, Some((_, Operand::Bit(ALWAYS_ON)))) | (Op::Next, _) => Some(true),
            (Op::Ldn, Some((_, Operand::Bit(ALWAYS_ON)))) => Some(false),
            (Op::Lps | Op::Nop, _) => before,
            // Whoever goes on without power flow is after the call.
            (Op::CallBegin, _) => Some(true),
            (Op::ScrAnd, _) => None,
            (Op::Call | Op::Scrt, _) => before,
            _ => match decoded.op.instruction().group {
                Group::Coil
                | Group::Math
                | Group::Move
                | Group::Timer
                | Group::Counter
                | Group::Hidden => before,
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
            (Op::Set, &[Operand::Bit(bit), Operand::Constant(count)]) => {
                self.bits(decoded, bit, count, true)
            }
            (Op::Reset, &[Operand::Bit(bit), Operand::Constant(count)]) => {
                self.bits(decoded, bit, count, false)
            }
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
            (Op::Ldw, &[Operand::Relation(relation), a, b]) => {
                self.compare_words(Combine::Load, relation, a, b)
            }
            (Op::Aw, &[Operand::Relation(relation), a, b]) => {
                self.compare_words(Combine::And, relation, a, b)
            }
            (Op::Ow, &[Operand::Relation(relation), a, b]) => {
                self.compare_words(Combine::Or, relation, a, b)
            }
            (Op::Ldb, &[Operand::Relation(relation), a, b]) => {
                self.compare_bytes(Combine::Load, relation, a, b)
            }
            (Op::Ab, &[Operand::Relation(relation), a, b]) => {
                self.compare_bytes(Combine::And, relation, a, b)
            }
            (Op::Ob, &[Operand::Relation(relation), a, b]) => {
                self.compare_bytes(Combine::Or, relation, a, b)
            }
            (Op::Movb, &[input, Operand::Memory(out)]) => self.move_byte(input, out),
            (Op::Movw, &[input, Operand::Memory(out)]) => self.move_word(input, out),
            (Op::AddInt, &[in1, Operand::Memory(out)]) => self.add(in1, out),
            (Op::SubInt, &[in1, Operand::Memory(out)]) => self.subtract(in1, out),
            (Op::Incw, &[Operand::Memory(out)]) => self.increment(out),
            (Op::Decw, &[Operand::Memory(out)]) => self.decrement(out),
            (Op::Ton | Op::Tof | Op::Tonr, &[Operand::Number(slot), preset]) => {
                self.timer(decoded, slot, preset)
            }
            (Op::Ctu | Op::Ctd | Op::Ctud, &[Operand::Number(slot), preset]) => {
                self.counter(decoded.op, slot, preset)
            }
            (Op::For, &[Operand::Memory(indx), init, last, Operand::Offset(end)]) => {
                self.for_loop(indx, init, last, end);
            }
            (Op::Next, &[Operand::Offset(start), Operand::Offset(here)]) => {
                self.next_pass(start, here)
            }
            (Op::Jmp, &[Operand::Label(label), Operand::Offset(here)]) => self.jump(label, here),
            (Op::End, _) => self.emitter.branch_if(true, self.exit),
            (Op::Stop, _) => {
                self.stops = true;
                self.emitter.branch_if(true, self.stop);
            }
            (Op::MainEnd, _) => self.main_end(),
            _ => self.instruction_of_units(decoded, operands),
        }
    }

    /// Subroutines, sequence control and AENO; the rest is left to the firmware.
    fn instruction_of_units(&mut self, decoded: &Decoded, operands: &[Operand]) {
        match (decoded.op, operands) {
            (Op::CallBegin, &[Operand::Offset(end)]) => {
                let end = self.target(end);
                self.emitter.branch_if(false, end);
            }
            (Op::Call, &[Operand::Number(routine), ..]) => self.call(routine),
            (Op::BitCopy, &[Operand::Bit(from), Operand::Bit(to)]) => self.copy_bit(from, to),
            (Op::Cret | Op::Creti, _) => self.emitter.branch_if(true, self.exit),
            (Op::Ret, _) => self.return_(),
            (Op::Lscr, &[Operand::Bit(bit), Operand::Bit(scr)]) => self.load_scr(bit, scr),
            (Op::ScrAnd, &[Operand::Bit(scr)]) => self.contact(Combine::And, scr, true),
            (Op::Scrt, &[Operand::Bit(bit), Operand::Bit(own)]) => self.scr_transition(bit, own),
            (Op::Cscre, &[Operand::Label(end), Operand::Offset(here)]) => self.jump(end, here),
            (Op::Scre | Op::Approach, _) => {}
            (Op::Poll, _) => self.poll(),
            (Op::NoteEno, &[Operand::Number(errors)]) => self.note_eno(errors),
            (Op::Aeno, &[Operand::Number(errors)]) => self.and_eno(errors),
            _ => self.by_bytecode(decoded),
        }
    }

    /// The firmware executes the instruction, and with it those that follow and can be executed in
    /// one go. What it loads is the new top of the stack.
    pub(super) fn by_bytecode(&mut self, decoded: &Decoded) {
        let (source, plan) = (self.source, self.emitter.plan);
        let len = self.run_len(decoded);
        self.executed = len - 1;
        let (mut bytes, mut effects, mut cycles) = (Vec::new(), Effects::default(), BYTECODE);
        for (decoded, &at) in source.code.iter().zip(&source.offsets).skip(self.index).take(len) {
            bytes.extend(Moved::piece(source.lost_labels).instruction(source.image, at, decoded));
            effects.add(Effects::of(decoded, plan));
            cycles = cycles.then(bytecode_cycles(decoded, plan, source.image));
        }
        let call = |emitter: &mut Emitter<'_>| {
            emitter.call(Vector::Bytecode, cycles, effects, |emitter| {
                emitter.code.piece_address(piece(&bytes))
            });
        };
        if decoded.stack.adds > 0 {
            self.push();
        }
        let instruction = decoded.op.instruction();
        match instruction.power_flow {
            PowerFlow::Needed => {
                // A box of a module that is not executed has no ENO.
                if source.reads_eno && instruction.module().is_some() {
                    self.emitter.write(ENO, ZERO);
                }
                self.emitter.with_power_flow(call);
            }
            PowerFlow::Always => call(&mut self.emitter),
        }
    }

    /// How many instructions from this one on are one piece: boxes, or contacts and comparisons of
    /// modules, of which only the first may load. Nothing may lead to between them.
    fn run_len(&self, first: &Decoded) -> usize {
        if !is_of_run(first) {
            return 1;
        }
        let behind = self.source.code.iter().zip(&self.source.offsets).skip(self.index + 1);
        let continues = |(decoded, at): &(&Decoded, &u16)| {
            let alike = decoded.op.instruction().power_flow == first.op.instruction().power_flow;
            alike && is_of_run(decoded) && decoded.stack.adds == 0 && !self.targets.contains_key(at)
        };
        1 + behind.take_while(continues).count()
    }

    /// The top of the stack gets a neighbour below, for which it is.
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
        self.stack_use.is_needed(self.index)
    }
}

/// Whether an instruction can be one of several that the firmware executes in one go: of a module,
/// a box, or what combines the top of the stack with something.
fn is_of_run(decoded: &Decoded) -> bool {
    let instruction = decoded.op.instruction();
    let combines = instruction.rung.is_contact();
    instruction.module().is_some() && (instruction.rung == Rung::Boxed || combines)
}
