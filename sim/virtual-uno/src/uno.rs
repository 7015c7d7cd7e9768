//! The board: chip, bootloader, port and the reset that comes with opening the port.

use std::fs;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result};
use simavr::{Avr, Reset, Stopped};

use crate::bootloader;
use crate::clock::Clock;
use crate::port::Port;

/// So long the chip runs between two looks at the port: a dozen bytes at 115200 baud.
const STEP: Duration = Duration::from_millis(1);
const STEP_CYCLES: u64 = Avr::FREQUENCY / 1000;

/// An Uno that is plugged in.
pub struct VirtualUno {
    avr: Avr,
    port: Port,
    clock: Clock,
    was_open: bool,
    has_crashed: bool,
}

impl VirtualUno {
    /// A board from the factory: only the bootloader is in its flash.
    pub fn new() -> Result<VirtualUno> {
        let mut avr = Avr::new();
        avr.load_elf(&bootloader::build()?)?;
        avr.set_reset_pc(bootloader::START);
        avr.reset(Reset::PowerOn);
        let port = Port::new().context("cannot open a pseudo-terminal")?;
        Ok(VirtualUno { avr, port, clock: Clock::new(), was_open: false, has_crashed: false })
    }

    /// Puts an Intel HEX file into the flash, as if it had been written before, and switches the board off and on.
    pub fn load(&mut self, file: &Path) -> Result<()> {
        let text = fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
        self.avr.load_hex(&text).with_context(|| format!("cannot load {}", file.display()))?;
        self.reset(Reset::PowerOn);
        Ok(())
    }

    /// The port, as avrdude's `-P` takes it.
    pub fn port(&self) -> &Path {
        self.port.path()
    }

    /// The chip, to look at.
    pub fn avr(&self) -> &Avr {
        &self.avr
    }

    /// The chip, to drive its pins.
    pub fn avr_mut(&mut self) -> &mut Avr {
        &mut self.avr
    }

    /// Runs for a millisecond, and waits until it has really passed.
    ///
    /// A program that opens the port resets the board. On a real one that is what DTR does; a pseudo-terminal has no DTR,
    /// and opening is when a serial port's driver would set it.
    pub fn step(&mut self) -> Result<()> {
        let is_open = self.port.is_open()?;
        if is_open && !self.was_open {
            self.reset(Reset::External);
        }
        self.was_open = is_open;
        let received = self.port.read()?;
        self.avr.uart_send(&received);
        if !self.has_crashed {
            self.has_crashed = matches!(self.avr.run_for(STEP_CYCLES), Stopped::Crash { .. });
        }
        let sent = self.avr.uart_take();
        // What is sent while nobody listens is lost, as on a real board.
        if is_open && !sent.is_empty() {
            self.port.write(&sent)?;
        }
        self.clock.step(STEP);
        Ok(())
    }

    /// A chip that has crashed stands still until this.
    fn reset(&mut self, cause: Reset) {
        self.avr.reset(cause);
        self.has_crashed = false;
    }
}

#[cfg(test)]
mod tests {
    use std::fs::{File, OpenOptions};
    use std::io::{Read, Write};

    use rustix::fs::{OFlags, fcntl_setfl};

    use super::*;

    fn open(uno: &VirtualUno) -> File {
        let terminal = OpenOptions::new().read(true).write(true).open(uno.port()).unwrap();
        fcntl_setfl(&terminal, OFlags::NONBLOCK).unwrap();
        terminal
    }

    fn pass(uno: &mut VirtualUno, milliseconds: u32) {
        for _ in 0..milliseconds {
            uno.step().unwrap();
        }
    }

    /// Whether the bootloader answers to the command that asks for nothing else.
    fn is_in_sync(uno: &mut VirtualUno) -> bool {
        let mut terminal = open(uno);
        terminal.write_all(b"0 ").unwrap();
        // It flashes its lamp first.
        pass(uno, 500);
        let mut answer = [0; 8];
        terminal.read(&mut answer).is_ok_and(|len| answer[..len] == [0x14, 0x10])
    }

    #[test]
    fn every_opening_is_a_reset_into_the_bootloader() {
        let mut uno = VirtualUno::new().unwrap();
        for _ in 0..2 {
            // Long enough for the bootloader to leave.
            pass(&mut uno, 1_500);
            assert!(uno.avr().pc() < bootloader::START || uno.has_crashed);
            assert!(is_in_sync(&mut uno));
            // The end of the terminal.
            uno.step().unwrap();
        }
    }

    #[test]
    fn power_starts_the_program_at_once() {
        // Loop: rjmp to itself.
        let mut uno = VirtualUno::new().unwrap();
        uno.avr_mut().write_flash(0, &[0xFF, 0xCF]).unwrap();
        uno.reset(Reset::PowerOn);
        pass(&mut uno, 10);
        assert_eq!(uno.avr().pc(), 0);
    }
}
