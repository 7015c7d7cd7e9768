//! A board as a PLC: power-up, the scan, the serial line, supervision and retention, over traits
//! that any board can implement. What instructions mean is plc-vm's, what requests mean plc-link's;
//! registers and interrupts are the board's.
//!
//! A board implements [`Board`], most of it by parts that drivers of embedded-hal have ([`Pins`])
//! or that many boards need ([`Slot`], [`Incoming`], [`fault_words`]), and calls
//! [`Controller::power_up`], then [`Controller::scan`] for ever.
#![no_std]

mod absent;
mod analog;
mod board;
mod clock;
mod controller;
mod download;
mod engine;
mod environment;
mod fault_words;
mod freeport;
mod incoming;
mod line;
mod pins;
mod retention;
mod self_test;
mod slot;
mod station;
mod storage;

pub use absent::{NeverWritten, NoLine};
pub use board::{Board, Mark};
pub use controller::Controller;
pub use engine::{Engine, Interpreted};
pub use fault_words::{fault_of_words, fault_words};
pub use incoming::Incoming;
pub use pins::Pins;
pub use retention::SECTORS_MIN;
pub use slot::Slot;
