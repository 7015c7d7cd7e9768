//! The controller without its hardware: data memory, scan, timers, counters and the reference interpreter.
//!
//! This is the meaning of AWL; every faster engine is compared with it. No I/O, no clock, no
//! allocation: the caller passes inputs and time in and takes outputs out. No text.
#![no_std]

#[cfg_attr(target_arch = "avr", path = "calls_none.rs")]
mod calls;
mod clock;
mod counter;
mod edge;
mod environment;
#[cfg_attr(target_arch = "avr", path = "events_none.rs")]
mod events;
mod fault;
#[cfg(not(target_arch = "avr"))]
pub mod function;
mod instructions;
mod interpreter;
mod math;
mod memory;
#[cfg(not(target_arch = "avr"))]
mod modules;
#[cfg(not(target_arch = "avr"))]
pub mod pid;
mod plc;
mod range;
#[cfg(not(target_arch = "avr"))]
pub mod real;
#[cfg(not(target_arch = "avr"))]
mod references;
mod special;
mod timer;

pub use environment::{Environment, SCAN_MS_MAX};
pub use events::Events;
pub use fault::Fault;
pub use interpreter::CALLS_MAX;
pub use interpreter::{Exit, Interpreter};
pub use memory::Memory;
#[cfg(not(target_arch = "avr"))]
pub use modules::TimeOfDay;
pub use plc::{Inputs, Mode, Plc};
