//! The assembler as a library: AWL text to program image and back, with diagnostics. It never runs a program.

pub mod address;
pub mod ast;
pub mod diagnostic;

pub use address::Address;
