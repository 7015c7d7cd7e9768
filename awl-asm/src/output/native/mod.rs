//! Native translation: bytecode images to machine code for the board. It never runs a program and
//! needs no source text.
//!
//! What the machine code may rely on, and what it must keep, is the contract in docs/image.md.

mod avr;
mod bits;
mod calls;
mod code;
mod compares;
mod control;
mod cost;
mod diagnose;
mod effects;
mod emitter;
mod error;
mod image;
mod math;
mod pins;
mod ranges;
mod registers;
mod stack;
mod timers;
mod translate;
mod units;
mod vectors;
mod words;

pub use crate::output::cycles::Cycles;
pub use error::TranslateError;
pub use image::{Options, Translated, TranslatedInstruction, translate, translate_with};
pub use vectors::{BYTECODE, Vector};
