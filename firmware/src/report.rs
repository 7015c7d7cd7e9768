//! The lines that the board writes: what it says about itself, in words. No line is longer than the serial queue.

use embedded_hal_nb::serial::Write;
use plc_isa::{CRC_LEN, Program, ProgramMemory};
use ufmt::uwrite;

use crate::board::flash::ProgramSlot;
use crate::board::serial::Serial;
use crate::board::texts::{self, Text};
use crate::scan::ScanTimes;

/// Microseconds in a timer count.
const US_PER_COUNT: u32 = 4;

/// Writes the parts of a line.
pub struct Report<'a> {
    serial: &'a mut Serial,
}

impl ufmt::uWrite for Report<'_> {
    type Error = core::convert::Infallible;

    fn write_str(&mut self, text: &str) -> Result<(), Self::Error> {
        text.bytes().for_each(|byte| self.byte(byte));
        Ok(())
    }
}

impl Report<'_> {
    /// Begins a line.
    pub fn on(serial: &mut Serial) -> Report<'_> {
        Report { serial }
    }

    fn byte(&mut self, byte: u8) {
        // Lines are begun when the queue is empty and they are shorter.
        let _ = self.serial.write(byte);
    }

    /// Writes a text.
    #[inline(never)]
    pub fn text(&mut self, text: Text) {
        text.bytes().for_each(|byte| self.byte(byte));
    }

    fn number(&mut self, number: u32) {
        let _ = uwrite!(self, "{}", number);
    }

    /// Two hexadecimal digits.
    fn hex(&mut self, byte: u8) {
        for digit in [byte >> 4, byte & 0xF] {
            self.byte(if digit < 10 { b'0' + digit } else { b'A' - 10 + digit });
        }
    }

    /// Name and checksum of the program.
    pub fn program(&mut self, program: Option<&Program<ProgramSlot>>) {
        self.text(texts::program());
        let Some(program) = program else { return self.text(texts::none()) };
        program.plan().name().for_each(|byte| self.byte(byte));
        self.text(texts::crc());
        let end = program.plan().header.total_len;
        for offset in (end - CRC_LEN..end).rev() {
            self.hex(program.memory().byte(offset));
        }
    }

    /// A fault with its place, in the bytes of [`Fault`](plc_vm::Fault).
    pub fn fault(&mut self, [code, detail, low, high]: [u8; 4]) {
        let name = match code {
            0 => texts::none(),
            1 => texts::bad_image(),
            2 => texts::watchdog(),
            3 => texts::undefined_instruction(),
            4 => texts::program_changed(),
            5 => texts::stack_overflow(),
            6 => texts::hang(),
            7 => texts::panic(),
            8 => texts::illegal_pointer(),
            _ => texts::illegal_real(),
        };
        self.text(name);
        if code == 1 {
            self.number(u32::from(detail));
        }
        if matches!(code, 1..=3 | 8..) {
            self.text(texts::at());
            self.hex(high);
            self.hex(low);
        }
    }

    /// Scan times in microseconds.
    pub fn scan(&mut self, times: &ScanTimes) {
        self.scan_time(texts::scan(), &times.min);
        self.scan_time(texts::last(), &times.last);
        self.scan_time(texts::max(), &times.max);
    }

    /// By reference, which makes shorter calls.
    #[inline(never)]
    fn scan_time(&mut self, text: Text, counts: &u32) {
        self.text(text);
        self.number(*counts * US_PER_COUNT);
    }

    /// Bytes of free stack.
    pub fn stack(&mut self, free: u16) {
        self.text(texts::stack());
        self.number(u32::from(free));
    }

    /// Ends the line.
    pub fn end(mut self) {
        self.byte(b'\r');
        self.byte(b'\n');
    }
}
