//! Subroutines, sequence control, events and AENO: what works with a unit's own bits and stack, or
//! leaves the unit.

use plc_isa::{Bit, CLOCK, ENO, EVENTS_SEEN, Encoded, LEFT_ENO, Op, T_BITS_START, UNO};

use super::avr::{Avr, Condition, Constant, OfBit, Two};
use super::bits::Combine;
use super::code::Label;
use super::effects::STATUS;
use super::emitter::{Emitter, SCRATCH, TEMP, TEMP2};
use super::translate::{STACK, Translator};
use super::vectors::{Vector, piece};
use crate::output::cycles::Cycles;

/// I/O address of the levels of D0 to D7, and those of I0.0 to I0.3, whose edges are events.
const LEVELS: u8 = 0x09;
const EDGE_LEVELS: u8 = 0x3C;
/// Timers that cause events, and what stands for their bits beside those levels.
const EVENT_TIMERS: [(u8, u8); 2] = [(32, 1), (96, 2)];

impl Translator<'_> {
    /// CALL: the routine begins with a stack of its own, whose top is 1, as that of the caller must
    /// be.
    pub(super) fn call(&mut self, routine: u8) {
        let Some(&begin) = self.routines.get(&routine) else { return };
        let keeps_stack = self.stack_use.is_read_behind(self.index);
        self.emitter.with_power_flow(|emitter| {
            if keeps_stack {
                emitter.code.op(Avr::Push(STACK));
            }
            emitter.call_routine(begin);
            if keeps_stack {
                emitter.code.op(Avr::Pop(STACK));
            }
            emitter.set_top(true);
        });
    }

    /// Looks for events, with power flow and stack kept.
    pub(super) fn poll(&mut self) {
        let emitter = &mut self.emitter;
        let look = *self.look.get_or_insert_with(|| emitter.code.label());
        emitter.call_routine(look);
    }

    /// The end of a routine.
    pub(super) fn return_(&mut self) {
        self.emitter.code.bind(self.exit);
        self.emitter.code.op(Avr::Ret);
    }

    /// Copies a bit parameter.
    pub(super) fn copy_bit(&mut self, from: Bit, to: Bit) {
        let is_known = self.emitter.power_flow == Some(true);
        let register = self.emitter.byte(from.address);
        if !is_known {
            self.emitter.bit(OfBit::Bld, SCRATCH, 0);
        }
        self.emitter.bit(OfBit::Bst, register, from.bit);
        self.assign(to);
        if is_known {
            self.emitter.set_top(true);
        } else {
            self.emitter.bit(OfBit::Bst, SCRATCH, 0);
        }
    }

    /// LSCR: the S bit is the power flow of the segment.
    pub(super) fn load_scr(&mut self, bit: Bit, scr: Bit) {
        self.contact(Combine::Load, bit, true);
        self.assign(scr);
    }

    /// SCRT: its own S bit first, because the other may be the same.
    pub(super) fn scr_transition(&mut self, bit: Bit, own: Bit) {
        self.emitter.with_power_flow(|emitter| {
            emitter.write_bits(own.address, 1 << own.bit, false);
            emitter.write_bits(bit.address, 1 << bit.bit, true);
        });
    }

    /// ENO of the box before: 1 with power flow and none of these errors in SMB1.
    pub(super) fn note_eno(&mut self, errors: u8) {
        let emitter = &mut self.emitter;
        let status = (errors != 0).then(|| emitter.byte(STATUS));
        emitter.constant(Constant::Ldi, TEMP, 0);
        emitter.bit(OfBit::Bld, TEMP, 0);
        for bit in (0..8).filter(|bit| errors >> bit & 1 != 0) {
            status.into_iter().for_each(|status| emitter.bit(OfBit::Sbrc, status, bit));
            emitter.constant(Constant::Ldi, TEMP, 0);
        }
        emitter.write(ENO, TEMP);
    }

    /// AENO: no power flows after a box with one of these errors in SMB1, or with ENO 0.
    pub(super) fn and_eno(&mut self, errors: u8) {
        let emitter = &mut self.emitter;
        for bit in (0..7).filter(|bit| errors >> bit & 1 != 0) {
            let status = emitter.byte(STATUS);
            emitter.set_top_if(status, bit, true, false);
        }
        if errors & LEFT_ENO != 0 {
            let eno = emitter.byte(ENO);
            emitter.set_top_if(eno, 0, false, false);
        }
    }
}

impl Emitter<'_> {
    /// The routine that looks for events: only when something has changed since the last time is
    /// the firmware asked. What it executes then may read and write every byte.
    pub(super) fn look_for_events(&mut self, look: Label) {
        self.bind_target(look);
        let (ask, unchanged) = (self.code.label(), self.code.label());
        self.code.op(Avr::In(TEMP, LEVELS));
        self.constant(Constant::Andi, TEMP, EDGE_LEVELS);
        for (timer, mask) in
            EVENT_TIMERS.into_iter().filter(|&(timer, _)| self.plan.timer_slot(timer).is_some())
        {
            self.byte_in(T_BITS_START + u16::from(timer / 8), TEMP2);
            self.bit(OfBit::Sbrc, TEMP2, timer % 8);
            self.constant(Constant::Ori, TEMP, mask);
        }
        self.code.op(Avr::Lds(TEMP2, EVENTS_SEEN));
        self.two(Two::Cp, TEMP, TEMP2);
        self.code.branch(Condition::NOT_EQUAL, ask);
        self.code.op(Avr::Lds(TEMP, CLOCK));
        self.code.op(Avr::Lds(TEMP2, EVENTS_SEEN + 1));
        self.two(Two::Cp, TEMP, TEMP2);
        self.code.branch(Condition::EQUAL, unchanged);
        self.code.bind(ask);
        self.flush();
        let poll = Op::Poll.instruction().encode(&[], &UNO);
        self.code.piece_address(piece(poll.as_ref().map_or(&[], Encoded::bytes)));
        self.code.call(Vector::Bytecode, Cycles::default());
        self.load_pinned();
        self.code.bind(unchanged);
        self.code.op(Avr::Ret);
    }
}
