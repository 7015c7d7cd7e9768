//! The engine: executes the program of a scan, bytecode and machine code, in assembly; and answers
//! on the line.

mod fast;
pub mod link;

pub use fast::{Left, NATIVE_INTERFACE, advance_timers, run};
