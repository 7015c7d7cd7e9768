//! An ATmega328P at 16 MHz, simulated by libsimavr: flash, memory, pins, converter, UART. Knows no
//! PLC.
//!
//! libsimavr is GPL-3, so this crate is for tools that test and is part of nothing that is shipped.
//! Without the feature `link` it is empty and needs no libsimavr.

#[cfg(feature = "link")]
mod avr;
#[cfg(feature = "link")]
mod elf;
#[cfg(feature = "link")]
mod ffi;
#[cfg(feature = "link")]
mod hex;
#[cfg(feature = "link")]
mod pin;

#[cfg(feature = "link")]
pub use avr::{Avr, Edge, Reset, Stopped};
#[cfg(feature = "link")]
pub use elf::{Elf, LoadError};
#[cfg(feature = "link")]
pub use pin::{Pin, Port};
