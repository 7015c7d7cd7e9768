//! The board: chip, bootloader, port, the reset that comes with opening the port, and what is kept
//! while it is switched off.

use std::fs;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use simavr::{Avr, Reset, Stopped};

use crate::bootloader;
use crate::clock::Clock;
use crate::port::{Line, Port};

/// So long the chip runs between two looks at the port: a dozen bytes at 115200 baud.
const STEP: Duration = Duration::from_millis(1);
const STEP_CYCLES: u64 = Avr::FREQUENCY / 1000;

/// The first that avrdude sends to a bootloader: is anybody there?
const GET_SYNC: &[u8] = b"0 ";

/// Registers of the UART (data sheet of the ATmega328P, 19.10), and their bits for double speed and
/// for a receiver that is on.
const UCSR0A: usize = 0xC0;
const UCSR0B: usize = 0xC1;
const UBRR0: usize = 0xC4;
const U2X0: u8 = 1 << 1;
const RXEN0: u8 = 1 << 4;
/// How far two ends may be apart. 115200 baud of 16 MHz are 2.1 % more.
const BAUD_TOLERANCE: f64 = 0.04;

/// An Uno that is plugged in.
pub struct VirtualUno {
    avr: Avr,
    port: Port,
    clock: Clock,
    was_open: bool,
    /// As Linux has it: on from the first opening on, off again when a program closes the port that
    /// has left HUPCL set. It resets the board by coming on.
    dtr: bool,
    /// Nothing has come since the port was opened without a reset.
    may_be_avrdude: bool,
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
        Ok(VirtualUno {
            avr,
            port,
            clock: Clock::new(),
            was_open: false,
            dtr: false,
            may_be_avrdude: false,
            has_crashed: false,
        })
    }

    /// What is there without power: flash and EEPROM.
    pub fn memory(&self) -> Vec<u8> {
        [self.avr.flash(), &self.avr.eeprom()].concat()
    }

    /// Puts in place what [`memory`](Self::memory) has given, and switches the board on.
    pub fn set_memory(&mut self, memory: &[u8]) -> Result<()> {
        let flash_len = self.avr.flash().len();
        let whole = flash_len + self.avr.eeprom().len();
        ensure!(memory.len() == whole, "{} bytes instead of {whole}", memory.len());
        let (flash, eeprom) = memory.split_at(flash_len);
        self.avr.write_flash(0, flash)?;
        self.avr.write_eeprom(0, eeprom)?;
        self.reset(Reset::PowerOn);
        Ok(())
    }

    /// Puts an Intel HEX file into the flash, as if it had been written before, and switches the
    /// board off and on.
    pub fn load(&mut self, file: &Path) -> Result<()> {
        let text =
            fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
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
    pub fn step(&mut self) -> Result<()> {
        let (is_open, line) = (self.port.is_open()?, self.port.line()?);
        self.see_dtr(is_open, line);
        let received = self.port.read()?;
        self.see_avrdude(&received);
        let is_understood = self.has_baud(line.baud);
        if is_understood {
            self.avr.uart_send(&received);
        }
        if !self.has_crashed {
            self.has_crashed = matches!(self.avr.run_for(STEP_CYCLES), Stopped::Crash { .. });
        }
        let sent = self.avr.uart_take();
        // What is sent while nobody listens is lost, as on a real board.
        if is_open && is_understood && !sent.is_empty() {
            self.port.write(&sent)?;
        }
        self.clock.step(STEP);
        Ok(())
    }

    /// A pseudo-terminal has no control lines; what a serial port's driver does with DTR is known.
    fn see_dtr(&mut self, is_open: bool, line: Line) {
        if is_open && !self.was_open {
            if !self.dtr {
                self.reset(Reset::External);
            }
            self.may_be_avrdude = self.dtr;
            self.dtr = true;
        } else if self.was_open && !is_open && line.hangs_up {
            self.dtr = false;
        }
        self.was_open = is_open;
    }

    /// avrdude switches DTR off and on by itself, which does not get through: it is known by the
    /// first that it sends.
    fn see_avrdude(&mut self, received: &[u8]) {
        if received.is_empty() || !self.may_be_avrdude {
            return;
        }
        self.may_be_avrdude = false;
        if received.starts_with(GET_SYNC) {
            self.reset(Reset::External);
        }
    }

    /// Whether the chip's UART is at this rate, near enough. At another one nothing is understood.
    /// One that is still off has no rate: what comes waits for it.
    fn has_baud(&self, baud: u32) -> bool {
        let data = self.avr.data();
        if data[UCSR0B] & RXEN0 == 0 {
            return true;
        }
        let divisor = u32::from(data[UBRR0]) | u32::from(data[UBRR0 + 1]) << 8;
        let samples = if data[UCSR0A] & U2X0 != 0 { 8 } else { 16 };
        let own = Avr::FREQUENCY as f64 / f64::from(samples * (divisor + 1));
        (own / f64::from(baud.max(1)) - 1.0).abs() < BAUD_TOLERANCE
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
    use rustix::termios::{ControlModes, OptionalActions, tcgetattr, tcsetattr};

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
    fn a_port_that_keeps_dtr_resets_the_board_once() {
        let mut uno = VirtualUno::new().unwrap();
        // Loop: rjmp to itself.
        uno.avr_mut().write_flash(0, &[0xFF, 0xCF]).unwrap();
        uno.reset(Reset::PowerOn);
        let terminal = open(&uno);
        let mut attributes = tcgetattr(&terminal).unwrap();
        attributes.control_modes.remove(ControlModes::HUPCL);
        tcsetattr(&terminal, OptionalActions::Now, &attributes).unwrap();
        pass(&mut uno, 2);
        assert!(uno.avr().pc() >= bootloader::START);
        drop(terminal);
        pass(&mut uno, 1_500);
        assert_eq!(uno.avr().pc(), 0);
        let mut terminal = open(&uno);
        pass(&mut uno, 2);
        assert_eq!(uno.avr().pc(), 0, "it was reset again");
        // What has DTR in its own hands resets it nevertheless.
        terminal.write_all(GET_SYNC).unwrap();
        pass(&mut uno, 2);
        assert!(uno.avr().pc() >= bootloader::START);
    }

    #[test]
    fn at_another_rate_nothing_is_understood() {
        let mut uno = VirtualUno::new().unwrap();
        let terminal = open(&uno);
        let mut attributes = tcgetattr(&terminal).unwrap();
        attributes.set_speed(9_600).unwrap();
        tcsetattr(&terminal, OptionalActions::Now, &attributes).unwrap();
        assert!(!is_in_sync(&mut uno));
        attributes.set_speed(115_200).unwrap();
        tcsetattr(&terminal, OptionalActions::Now, &attributes).unwrap();
        drop(terminal);
        pass(&mut uno, 1_500);
        assert!(is_in_sync(&mut uno));
    }

    #[test]
    fn flash_and_eeprom_are_there_after_a_new_start() {
        let mut uno = VirtualUno::new().unwrap();
        uno.avr_mut().write_flash(0x6000, &[1, 2, 3]).unwrap();
        uno.avr_mut().write_eeprom(5, &[7]).unwrap();
        let memory = uno.memory();
        let mut again = VirtualUno::new().unwrap();
        again.set_memory(&memory).unwrap();
        assert_eq!(again.avr().flash()[0x6000..0x6003], [1, 2, 3]);
        assert_eq!(again.avr().eeprom()[5], 7);
        assert!(again.set_memory(&memory[1..]).is_err());
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
