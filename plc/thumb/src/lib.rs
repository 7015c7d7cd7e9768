//! Translates a program to machine code of processors with Thumb (ARMv6-M and all Cortex-M after
//! it), on the board, after the image was checked. Logic of bits becomes instructions of the
//! processor; everything else becomes calls of the interpreter, which stays what AWL means.
//!
//! Code is made here and not executed: who executes it keeps to the [`registers`].
#![no_std]

mod instructions;
mod logic;
pub mod registers;
mod translation;

pub use translation::Translation;
