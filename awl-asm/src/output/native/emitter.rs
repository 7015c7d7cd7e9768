//! Writes machine code: loads and stores of data memory, with registers that hold bytes of it,
//! conditional stretches and calls. What an instruction of the program means is not known here.

use std::collections::{BTreeMap, BTreeSet};

use plc_isa::{DATA_START, Plan};

use super::avr::{Avr, Condition, Constant, OfBit, Reg, Two};
use super::code::{Code, Label};
use super::effects::Effects;
use super::registers::Registers;
use super::vectors::Vector;
use crate::output::cycles::Cycles;

/// Always 0.
pub const ZERO: Reg = Reg(1);
/// For a value that is needed at once.
pub const SCRATCH: Reg = Reg(0);
/// For values within an instruction: takes constants; calls lose it.
pub const TEMP: Reg = Reg(24);
/// Another one.
pub const TEMP2: Reg = Reg(25);

/// A word in two registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word {
    /// The high byte.
    pub high: Reg,
    /// The low byte.
    pub low: Reg,
}

/// Words within an instruction: take constants.
pub const WORD: Word = Word { high: Reg(18), low: Reg(19) };
/// Another one.
pub const WORD2: Word = Word { high: Reg(27), low: Reg(26) };

/// Units of [`Traffic`]: a cycle that is spent in every scan, or only with power flow.
pub const ALWAYS: u32 = 2;
const WITH_POWER_FLOW: u32 = 1;

/// Furthest displacement of loads and stores by Y.
const DISPLACEMENT_MAX: u16 = 63;

/// What the loads and stores of each byte cost, to choose those that deserve a register.
#[derive(Debug, Default)]
pub struct Traffic {
    /// Weighted cycles by data address.
    pub cycles: BTreeMap<u16, u32>,
    /// Bytes that are stored anywhere.
    pub stored: BTreeSet<u16>,
    /// Calls that touch memory, with the weight of a cycle.
    pub calls: Vec<(Effects, u32)>,
}

/// A stretch of code that may be skipped.
#[must_use]
pub struct Skip {
    end: Label,
    before: Registers,
    was_conditional: bool,
}

/// Machine code being written for a program.
pub struct Emitter<'a> {
    /// The program's plan.
    pub plan: &'a Plan<&'a [u8]>,
    /// The code so far.
    pub code: Code,
    /// What is in registers here.
    pub registers: Registers,
    /// Loads and stores so far.
    pub traffic: Traffic,
    /// Passes of the loops around.
    pub passes: u32,
    /// The top of the stack, where it is known.
    pub power_flow: Option<bool>,
    /// Whether this stretch is executed only with power flow.
    is_conditional: bool,
    /// Bytes that the program stores anywhere, as far as they are pinned.
    modified: BTreeSet<u16>,
}

impl<'a> Emitter<'a> {
    /// Nothing written yet. `modified`: the pinned bytes that the program changes.
    pub fn new(plan: &'a Plan<&'a [u8]>, pinned: &[u16], modified: BTreeSet<u16>) -> Emitter<'a> {
        Emitter {
            plan,
            code: Code::default(),
            registers: Registers::new(pinned),
            traffic: Traffic::default(),
            passes: 1,
            power_flow: None,
            is_conditional: false,
            modified,
        }
    }

    /// The weight of a cycle here.
    fn weight(&self) -> u32 {
        self.passes * if self.is_conditional { WITH_POWER_FLOW } else { ALWAYS }
    }

    /// An operation on two registers.
    pub fn two(&mut self, two: Two, d: Reg, r: Reg) {
        self.code.op(Avr::Two(two, d, r));
    }

    /// An operation on a register and a constant.
    pub fn constant(&mut self, constant: Constant, d: Reg, value: u8) {
        self.code.op(Avr::Constant(constant, d, value));
    }

    /// An operation on a bit.
    pub fn bit(&mut self, of_bit: OfBit, register: Reg, bit: u8) {
        self.code.op(Avr::Bit(of_bit, register, bit));
    }

    /// T := value.
    pub fn set_top(&mut self, value: bool) {
        self.code.op(if value { Avr::Set } else { Avr::Clt });
    }

    /// T := value, if the bit is as asked; otherwise it stays.
    pub fn set_top_if(&mut self, register: Reg, bit: u8, is_set: bool, value: bool) {
        self.bit(if is_set { OfBit::Sbrc } else { OfBit::Sbrs }, register, bit);
        self.set_top(value);
    }

    /// Loads a byte from memory.
    fn load(&mut self, register: Reg, address: u16) {
        *self.traffic.cycles.entry(address).or_default() += 2 * self.weight();
        self.code.op(match displacement(address) {
            Some(q) => Avr::Ldd(register, q),
            None => Avr::Lds(register, address),
        });
    }

    /// Stores a byte in memory.
    pub fn store(&mut self, address: u16, register: Reg) {
        *self.traffic.cycles.entry(address).or_default() += 2 * self.weight();
        self.traffic.stored.insert(address);
        self.code.op(match displacement(address) {
            Some(q) => Avr::Std(q, register),
            None => Avr::Sts(address, register),
        });
    }

    /// A register that holds the byte, to be read; it is loaded if it is in none.
    pub fn byte(&mut self, address: u16) -> Reg {
        self.byte_for(address, false)
    }

    /// The same, in a register that takes constants if it must be loaded.
    pub fn byte_for(&mut self, address: u16, constants: bool) -> Reg {
        if let Some(register) = self.registers.holding(address) {
            return register;
        }
        let register = self.registers.take(address, constants);
        self.load(register, address);
        register
    }

    /// The byte in this register, which may be changed then.
    pub fn byte_in(&mut self, address: u16, register: Reg) {
        match self.registers.holding(address) {
            Some(from) => self.two(Two::Mov, register, from),
            None => self.load(register, address),
        }
    }

    /// The word at an address in these registers.
    pub fn word_in(&mut self, address: u16, word: Word) {
        self.byte_in(address, word.high);
        self.byte_in(address.wrapping_add(1), word.low);
    }

    /// Registers that hold the word, to be read.
    pub fn word(&mut self, address: u16, constants: bool) -> Word {
        let high = self.byte_for(address, constants);
        let low = self.byte_for(address.wrapping_add(1), constants);
        Word { high, low }
    }

    /// A byte has been changed in the register that [`byte`](Self::byte) gave.
    pub fn changed(&mut self, address: u16, register: Reg) {
        if self.registers.pin(address) == Some(register) {
            self.registers.changed(address);
        } else {
            self.store(address, register);
        }
    }

    /// Writes a byte from a register that has another purpose.
    pub fn write(&mut self, address: u16, register: Reg) {
        match self.registers.pin(address) {
            Some(pin) => {
                self.two(Two::Mov, pin, register);
                self.registers.changed(address);
            }
            None => {
                self.registers.forget(address);
                self.store(address, register);
            }
        }
    }

    /// Writes a word.
    pub fn write_word(&mut self, address: u16, word: Word) {
        self.write(address, word.high);
        self.write(address.wrapping_add(1), word.low);
    }

    /// A register with this value, at best without loading one: `temp` is used if it must be.
    pub fn value_in(&mut self, value: u8, temp: Reg) -> Reg {
        if value == 0 {
            return ZERO;
        }
        self.constant(Constant::Ldi, temp, value);
        temp
    }

    /// A stretch that is executed only with power flow.
    pub fn with_power_flow(&mut self, body: impl FnOnce(&mut Self)) {
        match self.power_flow {
            Some(true) => body(self),
            Some(false) => {}
            None => {
                let skip = self.skip_if(Condition::T_CLEAR);
                body(self);
                self.end(skip);
            }
        }
    }

    /// Goes to a target with power flow, or without.
    pub fn branch_if(&mut self, power_flow: bool, to: Label) {
        match self.power_flow {
            Some(known) if known == power_flow => self.code.jump(to),
            Some(_) => {}
            None => {
                self.code.branch(if power_flow { Condition::T_SET } else { Condition::T_CLEAR }, to)
            }
        }
    }

    /// Begins a stretch that is skipped under a condition.
    pub fn skip_if(&mut self, condition: Condition) -> Skip {
        let end = self.code.label();
        self.code.branch(condition, end);
        self.begin(end)
    }

    /// Begins a stretch around which a way leads to this label.
    pub fn begin(&mut self, end: Label) -> Skip {
        let skip =
            Skip { end, before: self.registers.clone(), was_conditional: self.is_conditional };
        self.is_conditional = true;
        skip
    }

    /// Ends it: from here on only what is certain on both ways is known of the registers.
    pub fn end(&mut self, skip: Skip) {
        self.is_conditional = skip.was_conditional;
        self.registers.join(&skip.before);
        self.code.bind(skip.end);
    }

    /// A label that the program can jump to.
    pub fn bind_target(&mut self, label: Label) {
        self.code.bind(label);
        self.forget_registers();
    }

    /// Calls a routine with these effects on data memory. `arguments` writes what it expects in
    /// registers.
    pub fn call(
        &mut self,
        vector: Vector,
        cycles: Cycles,
        effects: Effects,
        arguments: impl FnOnce(&mut Self),
    ) {
        for (address, register) in self.registers.dirty() {
            if effects.touches(address) {
                self.store(address, register);
                self.registers.flushed(address);
            }
        }
        arguments(self);
        self.code.call(vector, cycles);
        self.registers.called();
        for (address, register) in self.registers.pins() {
            if effects.writes(address) {
                self.load(register, address);
            }
        }
        self.registers.forget_if(|address| effects.writes(address));
        let weight = self.weight();
        self.traffic.calls.push((effects, weight));
    }

    /// Calls a routine of the program: afterwards no more is known than at a label.
    pub fn call_routine(&mut self, routine: Label) {
        self.code.call_routine(routine);
        self.forget_registers();
    }

    fn forget_registers(&mut self) {
        let modified = &self.modified;
        self.registers.at_label(|address| modified.contains(&address));
    }

    /// Stores the pinned bytes that the program changes: all of them, wherever this is reached
    /// from.
    pub fn flush(&mut self) {
        for (address, register) in self.registers.pins() {
            if self.modified.contains(&address) {
                self.store(address, register);
            }
        }
    }

    /// Loads the pinned bytes.
    pub fn load_pinned(&mut self) {
        for (address, register) in self.registers.pins() {
            self.load(register, address);
        }
    }
}

fn displacement(address: u16) -> Option<u8> {
    let distance = address.wrapping_sub(DATA_START);
    (distance <= DISPLACEMENT_MAX).then_some(distance as u8)
}
