//! The hardware functions: their state that is not in data memory, and the instructions that use it.

use plc_isa::{Op, Plan, ProgramMemory};

use super::clock::{BUFFER_LEN, SoftwareClock, TimeOfDay};
use super::freeport::{self, Freeport};
use super::high_speed::{HighSpeedCounters, Occurred};
use super::pulse::PulseOutputs;
use super::{Execution, Failure};
use crate::environment::Environment;
use crate::memory::Memory;
use crate::references::Width;

/// State of the hardware functions.
#[derive(Debug, Clone)]
pub(crate) struct Hardware {
    /// IB0 as it was seen last.
    pub levels: u8,
    pub counters: HighSpeedCounters,
    pub pulses: PulseOutputs,
    pub freeport: Freeport,
    pub clock: SoftwareClock,
    /// DLED: the diagnosis LED is on.
    pub diagnosis_led: bool,
}

impl Hardware {
    /// Just switched on.
    pub const NEW: Hardware = Hardware {
        levels: 0,
        counters: HighSpeedCounters::UNDEFINED,
        pulses: PulseOutputs::NONE,
        freeport: Freeport::QUIET,
        clock: SoftwareClock::NOT_SET,
        diagnosis_led: false,
    };

    /// The change to RUN: only the clock goes on.
    pub fn restart(&mut self) {
        *self = Hardware { levels: self.levels, clock: self.clock, ..Hardware::NEW };
    }

    /// Bit `input` of IB0 has changed. The events that it causes.
    pub fn edge<P: ProgramMemory>(&mut self, input: u8, plan: &Plan<P>, memory: &mut Memory) -> [Occurred; 2] {
        self.levels ^= 1 << input;
        self.counters.edge(input, self.levels, plan, memory)
    }
}

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    /// High-speed counters, pulses, the clock, the serial line.
    pub(super) fn hardware(&mut self, op: Op) -> Result<(), Failure> {
        let (number, mode) = (self.operands.number(0), self.operands.number(1));
        match op {
            Op::Hdef => {
                let interpreter = &mut *self.interpreter;
                let Hardware { counters, levels, .. } = &mut interpreter.events.hardware;
                done(counters.define(number, mode, *levels, interpreter.program.plan(), interpreter.memory))
            }
            Op::Hsc => {
                let interpreter = &mut *self.interpreter;
                let counters = &mut interpreter.events.hardware.counters;
                done(counters.activate(number, interpreter.program.plan(), interpreter.memory))
            }
            Op::Pls => {
                let interpreter = &mut *self.interpreter;
                let pulses = &mut interpreter.events.hardware.pulses;
                done(pulses.activate(number, interpreter.program.plan(), interpreter.memory))
            }
            Op::Dled => {
                self.interpreter.events.hardware.diagnosis_led = self.read(0, Width::Byte)? > 0;
                Ok(())
            }
            Op::Todr => {
                let now_ms = self.interpreter.clock.now_ms;
                let time = self.interpreter.events.hardware.clock.now(now_ms).ok_or(Failure::Operand)?;
                let buffer = self.target(0, Width::Byte, BUFFER_LEN)?;
                self.put_bytes(buffer, &time.to_buffer());
                Ok(())
            }
            Op::Todw => {
                let buffer = self.source(0, Width::Byte, BUFFER_LEN)?;
                let bytes = [0, 1, 2, 3, 4, 5, 6, 7].map(|offset| self.interpreter.memory.byte(buffer + offset));
                let time = TimeOfDay::from_buffer(bytes).ok_or(Failure::Operand)?;
                let now_ms = self.interpreter.clock.now_ms;
                self.interpreter.events.hardware.clock.set(time, now_ms);
                Ok(())
            }
            Op::Xmt => self.transmit(),
            Op::Rcv => self.receive(),
            _ => Err(Failure::Undefined),
        }
    }

    /// AnalogOutputs, behind what writes them: without power flow it has not.
    pub(super) fn analog_outputs(&mut self) -> Result<(), Failure> {
        let (outputs, interpreter) = (self.operands.number(0), &mut *self.interpreter);
        if interpreter.stack.top() {
            interpreter.events.hardware.pulses.drive_analog(outputs, interpreter.memory);
        }
        Ok(())
    }

    /// XMT: the first byte of the table is the number of characters.
    fn transmit(&mut self) -> Result<(), Failure> {
        let table = self.source(0, Width::Byte, 1)?;
        let count = self.interpreter.memory.byte(table);
        self.source(0, Width::Byte, 1 + u16::from(count))?;
        let interpreter = &mut *self.interpreter;
        done(interpreter.events.hardware.freeport.send(count, interpreter.clock.now_ms, interpreter.memory))?;
        for at in 1..=u16::from(count) {
            let character = interpreter.memory.byte(table + at);
            interpreter.environment.transmit(character);
        }
        Ok(())
    }

    /// RCV: the table must hold as many characters as may come.
    fn receive(&mut self) -> Result<(), Failure> {
        let plan = self.interpreter.program.plan();
        let count_max = freeport::receive_max(plan, self.interpreter.memory);
        let table = self.target(0, Width::Byte, 1 + u16::from(count_max))?;
        let interpreter = &mut *self.interpreter;
        let (plan, now_ms) = (interpreter.program.plan(), interpreter.clock.now_ms);
        let freeport = &mut interpreter.events.hardware.freeport;
        let (is_done, event) = freeport.receive(table, now_ms, plan, interpreter.memory);
        if let Some(event) = event {
            interpreter.events.occur(event, plan, interpreter.memory);
        }
        done(is_done)
    }
}

/// What cannot be done is a programming error.
fn done(is_done: bool) -> Result<(), Failure> {
    if is_done { Ok(()) } else { Err(Failure::Operand) }
}
