//! The chip as tests use it: load, run, look, drive. What it runs is not known here.

use crate::elf::{Elf, LoadError};
use crate::ffi::{Chip, Ran};
use crate::hex;
use crate::pin::Pin;

/// Why the chip starts: the bit that is set in MCUSR.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reset {
    /// Power came.
    PowerOn,
    /// The reset pin was low, as avrdude makes it.
    External,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// The program wrote this value to GPIOR0.
    Mark(u8),
    /// The cycles are over.
    Limit,
    /// The program left flash or memory, or sleeps with interrupts off. Only a reset helps.
    Crash {
        /// The address in flash, in bytes.
        pc: u32,
    },
}

/// A change that a timer makes at a pin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// When, by [`Avr::cycles`].
    pub cycle: u64,
    /// Where.
    pub pin: Pin,
    /// The new level.
    pub high: bool,
}

/// An ATmega328P at 16 MHz and 5 V. Time is its cycle counter alone; nothing waits for a real
/// clock.
///
/// A new chip is powered but not [reset](Avr::reset): flash and EEPROM are erased, SRAM is 0. SRAM,
/// pins, voltages and flash survive a reset.
pub struct Avr {
    chip: Chip,
}

impl Default for Avr {
    fn default() -> Self {
        Self::new()
    }
}

impl Avr {
    /// Cycles in a second.
    pub const FREQUENCY: u64 = 16_000_000;
    /// The reference of the converter.
    pub const REFERENCE_MILLIVOLTS: u16 = 5_000;

    /// A chip.
    ///
    /// # Panics
    /// Without memory for it.
    pub fn new() -> Avr {
        Avr { chip: Chip::new(false).expect("no memory for another simulated chip") }
    }

    /// An ATmega2560 instead, with external memory up to address 0xFFFF: for programs that are too
    /// large for the Uno. Of what is beside its memories only GPIOR0 is like the Uno's.
    ///
    /// # Panics
    /// Without memory for it.
    pub fn with_room() -> Avr {
        Avr { chip: Chip::new(true).expect("no memory for another simulated chip") }
    }

    /// Writes what an ELF holds into flash and EEPROM; the rest of them stays. Then a reset is due.
    pub fn load_elf(&mut self, elf: &Elf) -> Result<(), LoadError> {
        for (at, bytes) in &elf.flash {
            self.write_flash(*at, bytes)?;
        }
        elf.eeprom.iter().try_for_each(|(at, bytes)| self.write_eeprom(*at, bytes))
    }

    /// Writes an Intel HEX file into flash; the rest of it stays. Then a reset is due.
    pub fn load_hex(&mut self, text: &str) -> Result<(), LoadError> {
        for (at, bytes) in hex::parse(text)? {
            self.write_flash(at, &bytes)?;
        }
        Ok(())
    }

    /// Writes into flash as a programmer does, without asking the program.
    pub fn write_flash(&mut self, at: u32, bytes: &[u8]) -> Result<(), LoadError> {
        let flash = self.chip.flash_mut();
        let place = flash.get_mut(at as usize..).and_then(|rest| rest.get_mut(..bytes.len()));
        let place = place.ok_or_else(|| {
            LoadError(format!("{} bytes at {at:#06x} are outside flash", bytes.len()))
        })?;
        place.copy_from_slice(bytes);
        Ok(())
    }

    /// The flash, all of it: the Uno has 32 KB.
    pub fn flash(&self) -> &[u8] {
        self.chip.flash()
    }

    /// The flash to be changed after the program's back.
    pub fn flash_mut(&mut self) -> &mut [u8] {
        self.chip.flash_mut()
    }

    /// Data memory: registers, I/O registers, SRAM from 0x0100 on.
    pub fn data(&self) -> &[u8] {
        self.chip.data()
    }

    /// Data memory to be changed after the program's back. A write to an I/O register changes what
    /// the program reads there and does nothing else.
    pub fn data_mut(&mut self) -> &mut [u8] {
        self.chip.data_mut()
    }

    /// The EEPROM.
    pub fn eeprom(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.chip.eeprom_len()];
        self.chip.eeprom_read(0, &mut bytes);
        bytes
    }

    /// Writes into the EEPROM without asking the program.
    pub fn write_eeprom(&mut self, at: u16, bytes: &[u8]) -> Result<(), LoadError> {
        let outside =
            || LoadError(format!("{} bytes at {at:#06x} are outside the EEPROM", bytes.len()));
        self.chip.eeprom_write(at, bytes).then_some(()).ok_or_else(outside)
    }

    /// Erases the EEPROM.
    pub fn erase_eeprom(&mut self) {
        self.chip.eeprom_write(0, &vec![0xFF; self.chip.eeprom_len()]);
    }

    /// Address of the EEPROM byte that the program is just writing, which takes 3.4 ms. It has its
    /// new value already; a real one has none yet that could be relied on.
    pub fn eeprom_writing(&self) -> Option<u16> {
        u16::try_from(self.chip.eeprom_writing())
            .ok()
            .filter(|&at| usize::from(at) < self.chip.eeprom_len())
    }

    /// How often the program has written each byte of the EEPROM.
    pub fn eeprom_writes(&self) -> Vec<u32> {
        (0..self.chip.eeprom_len() as u16).map(|at| self.chip.eeprom_writes(at)).collect()
    }

    /// Whether the program has ever used the EEPROM or its address while a byte was being written.
    pub fn eeprom_is_misused(&self) -> bool {
        self.chip.eeprom_is_misused()
    }

    /// Resets the chip. Bytes on their way from or to the UART are lost; the cycle counter goes on.
    pub fn reset(&mut self, cause: Reset) {
        self.chip.reset(match cause {
            Reset::PowerOn => 1 << 0,
            Reset::External => 1 << 1,
        });
    }

    /// Address in flash, in bytes, where the next resets lead: 0, or a bootloader's start.
    pub fn set_reset_pc(&mut self, at: u32) {
        self.chip.set_reset_pc(at);
    }

    /// Address in flash of the next instruction, in bytes.
    pub fn pc(&self) -> u32 {
        self.chip.pc()
    }

    /// Goes on at another address.
    pub fn set_pc(&mut self, at: u32) {
        self.chip.set_pc(at);
    }

    /// Cycles since the chip was made.
    pub fn cycles(&self) -> u64 {
        self.chip.cycles()
    }

    /// Executes one instruction, or sleeps until the next event.
    pub fn step(&mut self) -> Stopped {
        let ran = self.chip.step();
        self.stopped(ran)
    }

    /// Runs until GPIOR0 is written or so many cycles are over, to the instruction.
    pub fn run_to_mark(&mut self, cycles: u64) -> Stopped {
        let ran = self.chip.run(cycles);
        self.stopped(ran)
    }

    /// Runs for so many cycles, whatever is written to GPIOR0.
    pub fn run_for(&mut self, cycles: u64) -> Stopped {
        let end = self.cycles() + cycles;
        loop {
            match self.run_to_mark(end.saturating_sub(self.cycles())) {
                Stopped::Mark(_) if self.cycles() < end => {}
                Stopped::Mark(_) => return Stopped::Limit,
                stopped => return stopped,
            }
        }
    }

    fn stopped(&self, ran: Ran) -> Stopped {
        match ran {
            Ran::On => Stopped::Limit,
            Ran::ToMark => Stopped::Mark(self.chip.mark()),
            Ran::Crashed => Stopped::Crash { pc: self.pc() },
        }
    }

    /// Drives a pin from outside, against any pull-up, until it is driven otherwise. An output
    /// stays what it is.
    pub fn drive(&mut self, pin: Pin, high: bool) {
        self.chip.drive(pin.port.index(), pin.bit, high);
    }

    /// Whether the program drives this pin.
    pub fn is_output(&self, pin: Pin) -> bool {
        pin.is_output(self.data())
    }

    /// Whether this pin is an input with its pull-up on.
    pub fn has_pull_up(&self, pin: Pin) -> bool {
        pin.has_pull_up(self.data())
    }

    /// The level of a pin; of one that nobody has driven yet it means nothing.
    pub fn level(&self, pin: Pin) -> bool {
        match pin.wave().filter(|_| self.is_output(pin) && pin.is_wave(self.data())) {
            Some(wave) => self.chip.wave(wave),
            None => pin.level(self.data()),
        }
    }

    /// From now on notes the edges that timer 1 makes at its outputs, in fast PWM up to ICR1.
    pub fn watch_waves(&mut self) {
        self.chip.watch_edges();
    }

    /// The edges since this was last asked for, to a few cycles.
    pub fn take_waves(&mut self) -> Vec<Edge> {
        let edge = |edge: u64| Edge {
            cycle: edge >> 2,
            pin: Pin::of_wave(edge & 2 != 0),
            high: edge & 1 != 0,
        };
        self.chip.take_edges().into_iter().map(edge).collect()
    }

    /// The voltage at input `channel` (0 to 7) of the converter, from its next conversion on.
    ///
    /// # Panics
    /// If there is no such channel.
    pub fn set_millivolts(&mut self, channel: u8, millivolts: u16) {
        self.chip.set_millivolts(channel, millivolts);
    }

    /// The same, as the lowest voltage that gives this value (0 to 1023) of the converter.
    pub fn set_counts(&mut self, channel: u8, counts: u16) {
        let reference = u32::from(Self::REFERENCE_MILLIVOLTS);
        self.set_millivolts(
            channel,
            (u32::from(counts.min(1023)) * reference).div_ceil(1023) as u16,
        );
    }

    /// Sends bytes to the UART. They wait outside until the program has switched the receiver on
    /// and takes them, at its speed: none gets lost.
    ///
    /// # Panics
    /// Without memory for them.
    pub fn uart_send(&mut self, bytes: &[u8]) {
        assert!(self.chip.uart_send(bytes), "no memory for {} bytes", bytes.len());
    }

    /// How many sent bytes still wait outside.
    pub fn uart_waiting(&self) -> usize {
        self.chip.uart_waiting()
    }

    /// What the program has sent since it was last asked for.
    pub fn uart_take(&mut self) -> Vec<u8> {
        self.uart_take_with_control().into_iter().map(|[byte, _]| byte).collect()
    }

    /// The same, each byte with what UCSR0B was when the program wrote it.
    pub fn uart_take_with_control(&mut self) -> Vec<[u8; 2]> {
        self.chip.uart_take()
    }

    /// Does what the program's `wdr` does: the hardware watchdog begins again, if it is on.
    pub fn feed_watchdog(&mut self) {
        self.chip.feed_watchdog();
    }
}
