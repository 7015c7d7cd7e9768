//! The instructions of modules: whether they are executed and how they end. What they do, the
//! chapters hold. Not on the board, where modules are machine code.

mod arithmetic;
mod ascii;
mod clock;
mod compare;
mod convert;
pub(crate) mod execution;
pub(crate) mod freeport;
mod hardware;
pub(crate) mod hardware_state;
mod high_speed;
mod logic;
mod numeral;
mod points;
mod pulse;
mod real;
mod shift;
mod table;
mod text;

use plc_isa::{Bit, ENO, Flow, Group, Op, Operands, PowerFlow, ProgramMemory, SM_START};

pub use clock::TimeOfDay;
use execution::{Execution, Failure};

use crate::environment::Environment;
use crate::interpreter::{Exit, Interpreter};
use crate::range;
use crate::references::Width;
use crate::special::PROGRAMMING_ERROR;

/// SM1.4, the table is full.
const TABLE_FULL: Bit = Bit { address: SM_START + 1, bit: 4 };
/// SM1.5, the table is empty.
const TABLE_EMPTY: Bit = Bit { address: SM_START + 1, bit: 5 };
/// SM1.6, a number is no BCD.
const INVALID_BCD: Bit = Bit { address: SM_START + 1, bit: 6 };
/// SM1.7, a character is no hexadecimal digit.
const INVALID_ASCII: Bit = Bit { address: SM_START + 1, bit: 7 };

/// Executes a module instruction.
pub(crate) fn execute<P: ProgramMemory, E: Environment>(
    interpreter: &mut Interpreter<'_, P, E>,
    op: Op,
    operands: &Operands<'_>,
) -> Flow {
    let instruction = op.instruction();
    let is_executed = instruction.power_flow == PowerFlow::Always || interpreter.stack.top();
    if op.has_eno() {
        interpreter.memory.set_byte(ENO, u8::from(is_executed));
    }
    if !is_executed {
        return Flow::Next;
    }
    let result = Execution { interpreter, operands }.chapter(op, instruction.group);
    let Err(failure) = result else { return Flow::Next };
    match (failure, instruction.group) {
        (Failure::Undefined, _) => return interpreter.leave(Exit::Undefined),
        (Failure::ComparedReal, _) => return interpreter.leave(Exit::ComparedReal),
        (Failure::Operand, Group::Compare) => return interpreter.leave(Exit::ComparedPointer),
        (Failure::Operand, _) => interpreter.memory.set_bit(PROGRAMMING_ERROR, true),
        (Failure::Result, _) => {}
    }
    interpreter.memory.set_byte(ENO, 0);
    Flow::Next
}

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    fn chapter(&mut self, op: Op, group: Group) -> Result<(), Failure> {
        match group {
            Group::Move => self.move_(op),
            Group::Coil => self.coil(op),
            Group::Math => self.arithmetic(op),
            Group::Logic => self.logic(op),
            Group::Shift => self.shift(op),
            Group::Conversion => self.convert(op),
            Group::Compare => self.compare(op),
            Group::Real => self.real(op),
            Group::Text => self.text(op),
            Group::Table => self.table(op),
            Group::InputOutput | Group::Communication => self.points(op),
            Group::Hidden if op == Op::AnalogOutputs => self.analog_outputs(),
            // What the board must be told, the host sees.
            Group::Hidden if op == Op::Freeport => Ok(()),
            _ => Err(Failure::Undefined),
        }
    }

    fn coil(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::SetAny => self.write_bits(true),
            Op::ResetAny => self.write_bits(false),
            _ => Err(Failure::Undefined),
        }
    }

    /// Sets or resets N bits.
    fn write_bits(&mut self, value: bool) -> Result<(), Failure> {
        let (first, count) = (self.operands.bit(0), self.read(1, Width::Byte)? as u8);
        let plan = self.interpreter.program.plan();
        if !range::fits(plan, first, u16::from(first.bit) + u16::from(count)) {
            return Err(Failure::Operand);
        }
        range::write(self.interpreter.memory, plan, first, count, value);
        Ok(())
    }

    fn move_(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::MovbAny => self.copy(Width::Byte),
            Op::MovwAny => self.copy(Width::Word),
            Op::Movd | Op::Movr => self.copy(Width::Double),
            Op::Swap => {
                let out = self.target(0, Width::Word, 1)?;
                let word = self.interpreter.memory.word(out);
                self.interpreter.memory.set_word(out, word.swap_bytes());
                Ok(())
            }
            _ => Err(Failure::Undefined),
        }
    }

    /// OUT := IN.
    fn copy(&mut self, width: Width) -> Result<(), Failure> {
        let (value, out) = (self.read(0, width)?, self.target(1, width, 1)?);
        self.put(out, width, value);
        Ok(())
    }
}
