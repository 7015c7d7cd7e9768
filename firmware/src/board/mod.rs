//! The Uno's hardware. It knows pins and registers, nothing of programs.
#![allow(unsafe_code)]

pub mod analog;
pub mod clock;
pub mod data;
pub mod eeprom;
pub mod fault_memory;
pub mod flash;
mod panic;
pub mod place;
pub mod ports;
pub mod serial;
pub mod stack;
pub mod takeover;
pub mod trace;
pub mod watchdog;

use avr_device::interrupt;

use data::Data;
use eeprom::Eeprom;
use ports::Ports;

/// Everything there is one of.
pub struct Board {
    /// Digital inputs and outputs.
    pub ports: Ports,
    /// Memory that keeps without power.
    pub eeprom: Eeprom,
    /// The data memory of the controller.
    pub data: Data,
}

impl Board {
    /// The board as a reset leaves it.
    ///
    /// # Safety
    /// Only once.
    pub const unsafe fn of_reset() -> Board {
        // SAFETY: these are rights without data.
        unsafe { core::mem::transmute(()) }
    }
}

/// Sets the hardware up. At the start.
pub fn set_up() {
    // First: after its own reset the watchdog goes on with its shortest time.
    watchdog::stop();
    stack::paint();
    ports::release_outputs();
    analog::start();
    clock::start();
    serial::set_up();
    watchdog::start();
    // SAFETY: everything that interrupts share has been set up.
    unsafe { interrupt::enable() };
}
