//! Writes an Uno through its bootloader: STK500 version 1 as Optiboot speaks it. It opens no port
//! and reads no clock: bytes, levels of control lines and times are passed in and out.
//!
//! A [`Job`] says what is to be written, in an order in which a board that loses its cable never
//! runs half of it. A [`Flasher`] does it. [`bootloader`] is a model of the other end.

pub mod bootloader;
mod failure;
mod flasher;
mod job;
mod stk500;

pub use failure::{Cause, Failure, Holds};
pub use flasher::{Flasher, Output, Phase, Progress};
pub use job::{Firmware, Job, Unfit};

/// Bits a second that the bootloader of an Uno knows, 8N1.
pub const BAUD: u32 = 115_200;
/// Bytes of a page, which are erased and written together.
pub const PAGE_LEN: usize = 128;
