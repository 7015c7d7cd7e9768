//! What translated code finds in the processor's registers, and how it calls the interpreter.
//!
//! Code is entered at an entry of the [`Translation`](crate::Translation), with the first three
//! registers set. R0 to R3 and the flags it does not keep.
//!
//! To execute an instruction of the program by the interpreter it puts the instruction's offset in
//! R0 and its length in R1, and calls what STEP leads to. That returns only when the next
//! instruction in the text is the next one executed; otherwise it goes where the program goes. A
//! length of 0 says that there is no code after the call.

use crate::instructions::Register;

/// The logic stack, S0 in bit 0. Bits of levels that do not exist are 0.
pub const STACK: Register = Register(4);
/// Address of the first byte of data memory.
pub const MEMORY: Register = Register(5);
/// Address of the routine that executes an instruction by the interpreter, with bit 0 set as for
/// BLX.
pub const STEP: Register = Register(6);
/// The code's own; calls keep it: address of the part of data memory that it works on.
pub const WINDOW: Register = Register(7);
