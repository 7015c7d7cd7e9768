//! The controller without its hardware: data memory, scan, timers, counters and the reference
//! interpreter.
//!
//! This is the meaning of AWL; every faster engine is compared with it. No I/O, no clock, no
//! allocation: the caller passes inputs and time in and takes outputs out. No text.
#![no_std]

mod calls;
mod clock;
mod counter;
mod edge;
mod environment;
mod events;
mod fault;
pub mod function;
mod instructions;
mod interpreter;
mod math;
mod memory;
mod modules;
pub mod pid;
mod plc;
mod range;
pub mod real;
mod references;
mod scan;
mod special;
mod timer;

pub use calls::CALLS_MAX;
pub use environment::{Environment, SCAN_MS_MAX};
pub use events::{EventSystem, Events};
pub use fault::Fault;
pub use interpreter::{Exit, Interpreter};
pub use memory::Memory;
pub use modules::TimeOfDay;
pub use plc::{Inputs, Mode, Plc};
pub use scan::{Scan, TimeOfScan};
