//! Timers and counters: by the firmware's routines, and in place what is short.

use plc_isa::{
    Bit, Decoded, Op, Operand, TIMER_SLOT_LEN, TimerResolution, TimerSlot, counter_bit, timer_bit,
    timer_resolution,
};

use super::avr::{Condition, Constant, OfBit, Reg};
use super::effects::Effects;
use super::emitter::{Emitter, TEMP, TEMP2, WORD, WORD2, Word, ZERO};
use super::translate::{STACK, Translator};
use super::vectors::Vector;

/// Where routines expect the preset.
const PRESET: Word = Word { high: TEMP2, low: TEMP };
/// Where routines expect the address of the slot, X.
const SLOT: Word = WORD2;
/// Where routines expect the address of the byte with the bit, Z.
const BIT_ADDRESS: Word = Word { high: Reg(31), low: Reg(30) };
/// Where routines expect the mask of the bit, and what else they must know.
const MASK: Reg = WORD.high;
const DETAIL: Reg = WORD.low;

/// Offsets in the slot of a timer.
const PRESET_AT: u16 = 2;
const STATE_AT: u16 = 4;
/// State of TOF whose input is on.
const WAS_ON: u8 = 2;

impl Translator<'_> {
    pub(super) fn timer(&mut self, decoded: &Decoded, slot: u8, preset: Operand) {
        let slot = self.emitter.plan.timer(slot);
        if timer_resolution(slot.number) == TimerResolution::Ms1 {
            return self.by_bytecode(decoded);
        }
        let (vector, at_once) = match decoded.op {
            Op::Ton => (Vector::Ton, false),
            Op::Tof => (Vector::Tof, true),
            _ => (Vector::Tonr, false),
        };
        let emitter = &mut self.emitter;
        match emitter.power_flow {
            Some(input) if input == at_once => emitter.timer_at_once(vector, slot, preset),
            Some(_) => emitter.call_timer(vector, slot, preset),
            None => {
                let end = emitter.code.label();
                let skip =
                    emitter.skip_if(if at_once { Condition::T_CLEAR } else { Condition::T_SET });
                emitter.timer_at_once(vector, slot, preset);
                emitter.code.jump(end);
                emitter.end(skip);
                let skip = emitter.begin(end);
                emitter.call_timer(vector, slot, preset);
                emitter.end(skip);
            }
        }
    }

    pub(super) fn counter(&mut self, op: Op, slot: u8, preset: Operand) {
        let slot = self.emitter.plan.counter(slot);
        let (vector, levels) = match op {
            Op::Ctu => (Vector::Ctu, 1..=1),
            Op::Ctd => (Vector::Ctd, 1..=1),
            _ => (Vector::Ctud, 1..=2),
        };
        let inputs: Vec<(u8, u8)> = levels.map(|level| (level, self.level(level))).collect();
        let bit = counter_bit(slot.number);
        let slot_len = plc_isa::COUNTER_SLOT_LEN;
        let effects = Effects::of_slot(slot.address..slot.address + slot_len, bit.address);
        self.emitter.call(vector, vector.cycles(), effects, |emitter| {
            emitter.slot_arguments(slot.address, bit, preset);
            emitter.constant(Constant::Ldi, DETAIL, 0);
            for (level, stack_bit) in inputs {
                emitter.bit(OfBit::Sbrc, STACK, stack_bit);
                emitter.constant(Constant::Ori, DETAIL, 1 << level);
            }
        });
    }
}

impl Emitter<'_> {
    /// What a timer does when its input says at once what becomes of it: TON and TONR off, TOF on.
    fn timer_at_once(&mut self, vector: Vector, slot: TimerSlot, preset: Operand) {
        self.copy_word(preset, slot.address + PRESET_AT);
        let state = if vector == Vector::Tof { WAS_ON } else { 0 };
        let state = self.value_in(state, TEMP);
        self.write(slot.address + STATE_AT, state);
        if vector == Vector::Tonr {
            return;
        }
        self.write(slot.address, ZERO);
        self.write(slot.address + 1, ZERO);
        let bit = timer_bit(slot.number);
        self.write_bits(bit.address, 1 << bit.bit, vector == Vector::Tof);
    }

    fn call_timer(&mut self, vector: Vector, slot: TimerSlot, preset: Operand) {
        let bit = timer_bit(slot.number);
        let is_slow = timer_resolution(slot.number) == TimerResolution::Ms100;
        let effects = Effects::of_slot(slot.address..slot.address + TIMER_SLOT_LEN, bit.address);
        self.call(vector, vector.cycles(), effects, |emitter| {
            emitter.slot_arguments(slot.address, bit, preset);
            emitter.constant(Constant::Ldi, DETAIL, u8::from(is_slow));
        });
    }

    fn slot_arguments(&mut self, slot: u16, bit: Bit, preset: Operand) {
        match preset {
            Operand::Memory(address) => self.word_in(address, PRESET),
            Operand::Constant(value) => self.load_constant(PRESET, value),
            _ => {}
        }
        self.load_constant(SLOT, slot);
        self.load_constant(BIT_ADDRESS, bit.address);
        self.constant(Constant::Ldi, MASK, 1 << bit.bit);
    }

    /// Loads a constant.
    pub(super) fn load_constant(&mut self, word: Word, value: u16) {
        let [high, low] = value.to_be_bytes();
        self.constant(Constant::Ldi, word.high, high);
        self.constant(Constant::Ldi, word.low, low);
    }
}
