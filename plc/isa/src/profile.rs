//! What a board has, as a value: everything that differs from board to board and that a program,
//! its image or a tool depends on. What is the same on all of them is in `layout`.

use crate::area::Area;
use crate::header::{FORMAT_VERSION, NATIVE_INTERFACE};
use crate::layout::{ARENA_START, DATA_START, LINE_ROOM};

/// A board, or the host where a program names no board.
///
/// Names and numbers are in images and sources, and never become those of another profile.
#[derive(Debug, PartialEq, Eq)]
pub struct Profile {
    /// As `//# board` names it.
    pub name: &'static str,
    /// As it is called in messages, with its article: "the Uno".
    pub title: &'static str,
    /// As images name it, 0 to 15.
    pub number: u8,
    /// Whether the [operands](crate::Kind::stored_len_in) that may be too short are stored wide.
    pub is_wide: bool,
    /// One past the last data address that a program can reach; at most [`DATA_END_MAX`].
    pub data_end: u16,
    /// Program slot: address of the first byte in flash; 0 where it is not in flash.
    pub slot_start: u16,
    /// Program slot: bytes, the longest image; at most [`IMAGE_LEN_MAX`].
    pub slot_len: u16,
    /// Bytes of memory for retained values, of which two copies are kept.
    pub retention_len: u16,
    /// The pins of the digital inputs, from I0.0 on, as they are called on the board; at most 8.
    pub input_pins: &'static [&'static str],
    /// The pins of the digital outputs, from Q0.0 on; at most 8.
    pub output_pins: &'static [&'static str],
    /// The pins of the analog inputs, at most [`ANALOG_INPUTS`](crate::ANALOG_INPUTS).
    pub analog_pins: &'static [&'static str],
    /// Bits of a raw analog value.
    pub analog_bits: u8,
    /// Analog outputs, at most [`ANALOG_OUTPUTS`](crate::ANALOG_OUTPUTS).
    pub analog_outputs: u8,
    /// Whether there are interrupt events, high-speed counters and pulse outputs.
    pub has_events: bool,
    /// Whether the machine code of [modules](crate::MODULES) travels with the program. Others
    /// execute their instructions themselves.
    pub takes_modules: bool,
    /// The firmware interface of machine code; 0: programs are not translated.
    pub native_interface: u8,
    /// Whether programs come over the line, while another one is in force.
    pub takes_downloads: bool,
    /// The chip as avrdude calls it, where that writes it.
    pub avrdude_part: Option<&'static str>,
    /// The drive that the board shows for its flash to be written, where it does.
    pub drive: Option<Drive>,
}

/// A drive that takes UF2 files.
#[derive(Debug, PartialEq, Eq)]
pub struct Drive {
    /// What the line `Board-ID` of the drive's file INFO_UF2.TXT says.
    pub board_id: &'static str,
    /// The chip as UF2 files name it.
    pub family: u32,
    /// Address of the first byte of flash, which is the firmware's.
    pub flash_start: u32,
    /// Address of the first byte of the program slot.
    pub slot_start: u32,
    /// Addresses of the sectors that say which program is in force, where programs come over the
    /// line, too; while they are erased, the one in the slot is.
    pub records: &'static [u32],
}

/// No data memory ends after this: a reference is an address, or 0x8000 and an address.
pub const DATA_END_MAX: u16 = 0x4000;
/// Longest image of any profile: 64 KB less what the longest constant after an offset can take, so
/// that no offset wraps.
pub const IMAGE_LEN_MAX: u16 = 0xFE00;
/// Labels of a narrow image.
const NARROW_LABELS_MAX: u16 = 256;
/// Bits of byte 4 of an image with the format's version; above it the number of the profile.
const VERSION_BITS: u32 = 4;

/// The Arduino Uno.
pub const UNO: Profile = Profile {
    name: "uno",
    title: "the Uno",
    number: 0,
    is_wide: false,
    data_end: 0x0600,
    slot_start: 0x6000,
    slot_len: 0x7E00 - 0x6000,
    retention_len: 992,
    input_pins: &["D2", "D3", "D4", "D5", "D6", "D7"],
    output_pins: &["D8", "D9", "D10", "D11", "D12", "D13"],
    analog_pins: &["A0", "A1", "A2", "A3", "A4", "A5"],
    analog_bits: 10,
    analog_outputs: 2,
    has_events: true,
    takes_modules: true,
    native_interface: NATIVE_INTERFACE,
    takes_downloads: false,
    avrdude_part: Some("m328p"),
    drive: None,
};

/// The host, for programs that name no board and that the Uno is too small for: all of the
/// S7-200's memory, with the points that the simulator has.
pub const HOST: Profile = Profile {
    name: "host",
    title: "the host",
    number: 1,
    is_wide: true,
    data_end: DATA_END_MAX,
    slot_start: 0,
    slot_len: IMAGE_LEN_MAX,
    retention_len: 4096,
    takes_modules: false,
    native_interface: 0,
    avrdude_part: None,
    ..UNO
};

/// The Raspberry Pi Pico.
pub const PICO: Profile = Profile {
    name: "pico",
    title: "the Pico",
    number: 2,
    is_wide: true,
    data_end: DATA_END_MAX,
    slot_start: 0,
    slot_len: IMAGE_LEN_MAX,
    // A copy is what a sector of its flash has room for.
    retention_len: 8160,
    input_pins: &["GP2", "GP3", "GP4", "GP5", "GP6", "GP7", "GP8", "GP9"],
    output_pins: &["GP10", "GP11", "GP12", "GP13", "GP14", "GP15", "GP16", "GP17"],
    analog_pins: &["GP26", "GP27", "GP28"],
    analog_bits: 12,
    analog_outputs: 2,
    has_events: false,
    takes_modules: false,
    native_interface: 0,
    takes_downloads: true,
    avrdude_part: None,
    drive: Some(PICO_DRIVE),
};

/// The BBC micro:bit, the first of its versions.
pub const MICROBIT: Profile = Profile {
    name: "microbit",
    title: "the micro:bit",
    number: 3,
    is_wide: true,
    data_end: 0x2100,
    slot_start: 0,
    slot_len: IMAGE_LEN_MAX,
    retention_len: 4096,
    input_pins: &["A", "B", "P0", "P1", "P2"],
    output_pins: &["LED1", "LED2", "LED3", "LED4", "LED5", "P8", "P12", "P16"],
    analog_pins: &[],
    analog_bits: 10,
    analog_outputs: 0,
    has_events: false,
    takes_modules: false,
    native_interface: 0,
    takes_downloads: false,
    avrdude_part: None,
    drive: None,
};

/// The Pico's drive. The firmware has the first megabyte of its flash, with retained values at its
/// end.
pub const PICO_DRIVE: Drive = Drive {
    board_id: "RPI-RP2",
    family: 0xE48B_FF56,
    flash_start: 0x1000_0000,
    slot_start: 0x1010_0000,
    records: &[0x1011_0000, 0x1012_1000],
};

/// The Uno: what is asked of a program before it names another board.
impl Default for &'static Profile {
    fn default() -> Self {
        &UNO
    }
}

impl Profile {
    /// All profiles.
    pub const ALL: [&'static Profile; 4] = [&UNO, &HOST, &PICO, &MICROBIT];

    /// Those that are boards, in the order in which they are proposed.
    pub const BOARDS: [&'static Profile; 3] = [&UNO, &PICO, &MICROBIT];

    /// The largest one that this build has memory for: that of the board which the variable
    /// `PLC_BOARD` names when a firmware is built, otherwise the host's.
    pub const LARGEST: &'static Profile = match option_env!("PLC_BOARD") {
        Some(name) => Self::of_build(name),
        None if cfg!(target_arch = "avr") => &UNO,
        None => &HOST,
    };

    const fn of_build(name: &str) -> &'static Profile {
        let mut index = 0;
        while index < Self::ALL.len() {
            if is_same(Self::ALL[index].name, name) {
                return Self::ALL[index];
            }
            index += 1;
        }
        panic!("PLC_BOARD names no board")
    }

    /// Byte 4 of an image for this profile: version of the format and number.
    pub const fn format(&self) -> u8 {
        FORMAT_VERSION | self.number << VERSION_BITS
    }

    /// The profile of an image with this byte 4; `None` for another version or an unknown profile.
    pub fn of_format(format: u8) -> Option<&'static Profile> {
        Self::ALL.into_iter().find(|profile| profile.format() == format)
    }

    /// The profile with this name, upper or lower case.
    pub fn named(name: &str) -> Option<&'static Profile> {
        Self::ALL.into_iter().find(|profile| profile.name.eq_ignore_ascii_case(name))
    }

    /// Bytes of data memory.
    pub const fn data_len(&self) -> usize {
        (self.data_end - DATA_START) as usize
    }

    /// Bytes of the arena that a program without modules can use.
    pub const fn arena_len(&self) -> u16 {
        self.data_end - LINE_ROOM - ARENA_START
    }

    /// Points with a pin, of inputs or of outputs.
    pub const fn points(&self, area: Area) -> u8 {
        match area {
            Area::I => self.digital_inputs(),
            Area::Q => self.digital_outputs(),
            _ => 0,
        }
    }

    /// Digital inputs with a pin: I0.0 and up.
    pub const fn digital_inputs(&self) -> u8 {
        self.input_pins.len() as u8
    }

    /// Digital outputs with a pin: Q0.0 and up.
    pub const fn digital_outputs(&self) -> u8 {
        self.output_pins.len() as u8
    }

    /// Analog inputs with a pin.
    pub const fn analog_inputs(&self) -> u8 {
        self.analog_pins.len() as u8
    }

    /// Labels that an image can have.
    pub const fn labels_max(&self) -> u16 {
        if self.is_wide { u16::MAX } else { NARROW_LABELS_MAX }
    }

    /// The highest number of a label.
    pub const fn label_number_max(&self) -> u16 {
        self.labels_max() - if self.is_wide { 0 } else { 1 }
    }

    /// Bytes that a program can retain: two copies must fit.
    pub const fn retained_max(&self) -> u16 {
        self.retention_len / 2 - RETENTION_OVERHEAD
    }

    /// Milliseconds between two saves in RUN when so many bytes are retained (docs/retention.md).
    pub const fn retention_interval_ms(&self, values_len: u16) -> u32 {
        let copies = self.retention_len as u32 / self.copy_len(values_len);
        let interval = RETENTION_COPY_INTERVAL_MS / if copies == 0 { 1 } else { copies };
        if interval > RETENTION_INTERVAL_MIN_MS { interval } else { RETENTION_INTERVAL_MIN_MS }
    }

    /// Milliseconds that saving so many bytes takes at most.
    pub const fn retention_write_ms(&self, values_len: u16) -> u32 {
        (self.copy_len(values_len) * RETENTION_BYTE_US).div_ceil(1000)
    }

    const fn copy_len(&self, values_len: u16) -> u32 {
        values_len as u32 + RETENTION_OVERHEAD as u32
    }
}

/// Comparison of texts while the compiler runs.
const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut index = 0;
    while index < a.len() && index < b.len() && a[index] == b[index] {
        index += 1;
    }
    index == a.len() && index == b.len()
}

/// Milliseconds between two writes of one copy of what is retained: ten years for each of the
/// 100,000 times that a byte of the EEPROM can be written.
pub const RETENTION_COPY_INTERVAL_MS: u32 = 3_155_760;
/// However many copies there are, changes are saved no more often, in milliseconds.
pub const RETENTION_INTERVAL_MIN_MS: u32 = 60_000;
/// Microseconds that a byte of the EEPROM takes (data sheet: erase and write).
const RETENTION_BYTE_US: u32 = 3_400;

/// Bytes that a saved copy of what is retained takes beside the values: sequence number (2) and
/// checksum (4).
pub const RETENTION_OVERHEAD: u16 = 6;

/// The Uno as constants: for its firmware and modules, their builds and their tests. Everything
/// else asks a profile.
mod uno {
    use super::UNO;
    use crate::layout::DATA_GAP;

    /// One past the last data address of the Uno that a program can reach.
    pub const DATA_END: u16 = UNO.data_end;
    /// Bytes of the Uno's data memory.
    pub const DATA_LEN: usize = UNO.data_len();
    /// The Uno's millisecond clock, four bytes, the lowest first.
    pub const CLOCK: u16 = DATA_END + DATA_GAP;
    /// The Uno's program slot in flash: first address. The firmware lies below, the bootloader
    /// above.
    pub const SLOT_START: u16 = UNO.slot_start;
    /// The Uno's program slot: one past the last address, where Optiboot begins.
    pub const SLOT_END: u16 = SLOT_START + SLOT_LEN;
    /// Bytes in the Uno's program slot: the longest image.
    pub const SLOT_LEN: u16 = UNO.slot_len;
    /// Digital inputs with a pin on the Uno: I0.0-I0.5 at D2-D7.
    pub const DIGITAL_INPUTS: u8 = UNO.digital_inputs();
    /// Digital outputs with a pin on the Uno: Q0.0-Q0.5 at D8-D13.
    pub const DIGITAL_OUTPUTS: u8 = UNO.digital_outputs();
    /// Bytes of the Uno's EEPROM for retained values. The rest is reserved for settings of the
    /// board.
    pub const RETENTION_LEN: u16 = UNO.retention_len;
    /// Vectors: routines of the firmware that machine code in the slot calls. Flash address of the
    /// first; each takes an `rjmp`, two bytes. What they do is said in docs/image.md.
    pub const NATIVE_VECTORS: u16 = 0x0068;
    /// The engine's jump table: flash address of an `rjmp` for each token, a multiple of 512,
    /// because the token is the low byte of a word address there.
    pub const JUMP_TABLE: u16 = 0x0400;
}

pub use uno::*;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_profile_keeps_to_the_format() {
        for (index, profile) in Profile::ALL.into_iter().enumerate() {
            assert!(profile.number < 1 << (u8::BITS - VERSION_BITS), "{}", profile.name);
            assert!(profile.slot_len <= IMAGE_LEN_MAX && profile.data_end <= DATA_END_MAX);
            assert!(profile.input_pins.len() <= 8 && profile.output_pins.len() <= 8);
            assert!(u16::from(profile.analog_inputs()) <= crate::ANALOG_INPUTS);
            assert!(profile.analog_outputs <= crate::ANALOG_OUTPUTS);
            assert_eq!(Profile::of_format(profile.format()), Some(profile));
            assert_eq!(Profile::named(profile.name), Some(profile));
            let others = Profile::ALL.into_iter().skip(index + 1);
            assert!(others.into_iter().all(|other| other.number != profile.number));
        }
        assert_eq!(Profile::of_format(6), None);
        assert_eq!(Profile::named("S7-300"), None);
    }
}
