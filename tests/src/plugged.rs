//! An Uno that is plugged in: what it does at its pins, what it answers on its line, what is in its
//! flash.

use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use plc_isa::SLOT_START;
use simavr::{Avr, Pin};
use virtual_uno::VirtualUno;

use crate::commands;
use crate::link::{UNIT, checksum, frame};

/// The output follows the input.
pub const FOLLOW: &str = "//# name follow\nLD I0.0\n= Q0.0\n";
/// It does the contrary, after a few networks that make it another length.
pub const INVERT: &str =
    "//# name invert\nLD SM0.0\nMOVW 17, VW0\nMOVW VW0, VW2\nLDN I0.0\n= Q0.0\n";

/// I0.0 on the board.
pub const INPUT: u8 = 2;
/// Q0.0.
pub const OUTPUT: u8 = 8;

/// Long enough for some scans.
pub const SCANS_MS: u32 = 20;

/// The bootloader waits a second for avrdude before it starts the firmware, and flashes its lamp
/// before that.
pub const BOOTLOADER_MS: u32 = 1_800;
/// A short request, its answer and the pauses after them.
const ANSWER_MS: u32 = 20;

/// Time passes.
pub fn pass(uno: &mut VirtualUno, milliseconds: u32) {
    for _ in 0..milliseconds {
        uno.step().unwrap();
    }
}

/// A board from the factory with a switch at every input, all off.
pub fn board() -> VirtualUno {
    let mut uno = VirtualUno::new().unwrap();
    for pin in 2..=7 {
        uno.avr_mut().drive(Pin::of_uno(pin), false);
    }
    uno
}

/// What the output does when the input is 0, 1 and 0 again.
pub fn behaviour(uno: &mut VirtualUno) -> [bool; 3] {
    behaviour_after(uno, SCANS_MS)
}

/// The same of a program whose scans take longer.
pub fn behaviour_after(uno: &mut VirtualUno, milliseconds: u32) -> [bool; 3] {
    [false, true, false].map(|input| {
        uno.avr_mut().drive(Pin::of_uno(INPUT), input);
        pass(uno, milliseconds);
        is_on(uno.avr())
    })
}

/// A lamp at the output, to ground.
pub fn is_on(avr: &Avr) -> bool {
    avr.is_output(Pin::of_uno(OUTPUT)) && avr.level(Pin::of_uno(OUTPUT))
}

/// What a board answers on its line.
#[derive(Debug, PartialEq)]
pub struct Said {
    /// Whether the program runs.
    pub runs: bool,
    /// Whether it has stopped by itself.
    pub has_fault: bool,
    /// The program's name; empty without one.
    pub program: String,
}

/// A board without a fault.
pub fn said(runs: bool, program: &str) -> Said {
    Said { runs, has_fault: false, program: program.to_string() }
}

/// Opens its port, which resets it.
pub fn open(uno: &VirtualUno) -> File {
    let nonblocking = rustix::fs::OFlags::NONBLOCK.bits().cast_signed();
    let mut options = OpenOptions::new();
    options.read(true).write(true).custom_flags(nonblocking).open(uno.port()).unwrap()
}

/// Asks a board by a terminal that is opened, which resets it.
pub fn asked(uno: &mut VirtualUno) -> Said {
    let mut terminal = open(uno);
    pass(uno, BOOTLOADER_MS);
    let mut exchange = |pdu: &[u8]| {
        terminal.write_all(&frame(UNIT, pdu)).unwrap();
        pass(uno, ANSWER_MS);
        let mut answer = [0; 256];
        let len = terminal.read(&mut answer).expect("there is an answer");
        let (answer, crc) = answer[..len].split_at(len - 2);
        assert_eq!(crc, checksum(answer).to_le_bytes());
        answer[1..].to_vec()
    };
    let identity = exchange(&[65]);
    // One object: a head of seven bytes, its number and length, its text.
    let program = match *exchange(&[43, 14, 4, 6]) {
        [0xAB, _] => String::new(),
        ref answer => String::from_utf8(answer[9..].to_vec()).unwrap(),
    };
    Said { runs: identity[3] & 1 != 0, has_fault: identity[4] != 0, program }
}

/// A program, assembled.
pub fn image(program: &str) -> Vec<u8> {
    assemble(&Source::new("p.awl", program).unwrap(), Vec::new())
        .image
        .expect("a program without errors")
}

/// The program slot up to the end of this program.
pub fn slot_has(avr: &Avr, program: &str) -> bool {
    let image = image(program);
    avr.flash()[usize::from(SLOT_START)..].starts_with(&image)
}

/// All of the flash in front of the program.
pub fn firmware_flash(avr: &Avr) -> Vec<u8> {
    avr.flash()[..usize::from(SLOT_START)].to_vec()
}

/// The same flash with the firmware put in by other means than avrdude.
pub fn expected_firmware_flash() -> Vec<u8> {
    let mut avr = Avr::new();
    avr.load_hex(&fs::read_to_string(commands::kept_firmware()).unwrap()).unwrap();
    firmware_flash(&avr)
}
