//! The instructions that use hardware functions: high-speed counters, pulses, the clock, the serial
//! line.

use plc_isa::{Op, ProgramMemory};

use super::clock::{BUFFER_LEN, TimeOfDay};
use super::execution::{Execution, Failure};
use super::freeport;
use super::hardware_state::Hardware;
use crate::environment::Environment;
use crate::references::Width;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    /// High-speed counters, pulses, the clock, the serial line.
    pub(super) fn hardware(&mut self, op: Op) -> Result<(), Failure> {
        let (number, mode) = (self.operands.number(0), self.operands.number(1));
        match op {
            Op::Hdef => {
                let interpreter = &mut *self.interpreter;
                let Hardware { counters, levels, .. } = &mut interpreter.events.hardware;
                done(counters.define(
                    number,
                    mode,
                    *levels,
                    interpreter.program.plan(),
                    interpreter.memory,
                ))
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
                let time =
                    self.interpreter.events.hardware.clock.now(now_ms).ok_or(Failure::Operand)?;
                let buffer = self.target(0, Width::Byte, BUFFER_LEN)?;
                self.put_bytes(buffer, &time.to_buffer());
                Ok(())
            }
            Op::Todw => {
                let buffer = self.source(0, Width::Byte, BUFFER_LEN)?;
                let bytes = [0, 1, 2, 3, 4, 5, 6, 7]
                    .map(|offset| self.interpreter.memory.byte(buffer + offset));
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

    /// AnalogOutputs, after what writes them: without power flow it has not.
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
        done(interpreter.events.hardware.freeport.send(
            count,
            interpreter.clock.now_ms,
            interpreter.memory,
        ))?;
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
