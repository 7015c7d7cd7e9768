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
pub mod texts;
pub mod trace;
pub mod watchdog;

use core::cell::Cell;

use avr_device::atmega328p::Peripherals;
use avr_device::interrupt::{self, Mutex};
use plc_vm::Fault;

use data::Data;
use eeprom::Eeprom;
use ports::Ports;
use serial::Serial;

static TAKEN: Mutex<Cell<bool>> = Mutex::new(Cell::new(false));

/// Everything there is one of.
pub struct Board {
    /// Digital inputs and outputs.
    pub ports: Ports,
    /// The serial line.
    pub serial: Serial,
    /// Memory that keeps without power.
    pub eeprom: Eeprom,
    /// The data memory of the controller.
    pub data: Data,
}

impl Board {
    /// Sets the hardware up. At the start; a second time there is nothing to take, and the board resets.
    pub fn take() -> Board {
        if interrupt::free(|cs| TAKEN.borrow(cs).replace(true)) {
            watchdog::reset(Fault::Panic);
        }
        // First: after its own reset the watchdog goes on with its shortest time.
        watchdog::stop();
        stack::paint();
        // SAFETY: comes here once, before anything else touches a peripheral; interrupts take their own registers only.
        let peripherals = unsafe { Peripherals::steal() };
        let ports = Ports::new(peripherals.PORTB, peripherals.PORTD);
        analog::start();
        clock::start(&peripherals.TC0);
        let serial = Serial::new();
        watchdog::start();
        // SAFETY: everything that interrupts share has been set up.
        unsafe { interrupt::enable() };
        Board { ports, serial, eeprom: Eeprom::new(peripherals.EEPROM), data: Data::take() }
    }
}
