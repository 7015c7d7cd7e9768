//! A module instruction that is being executed, and why it can be given up.

use plc_isa::Operands;

use crate::interpreter::Interpreter;

/// Why an instruction was given up. It has written nothing then, unless it says otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Failure {
    /// A pointer is illegal (0006), an operand (0091) or a count (0092) out of range: SM4.3.
    Operand,
    /// There is no result, as a bit of SMB1 says.
    Result,
    /// A comparison has read a real that is not a number.
    ComparedReal,
    /// The instruction is not known here. Cannot happen in a verified image.
    Undefined,
}

/// A module instruction that is being executed.
pub(crate) struct Execution<'a, 'i, P, E> {
    pub interpreter: &'a mut Interpreter<'i, P, E>,
    pub operands: &'a Operands<'a>,
}
