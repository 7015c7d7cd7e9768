//! The texts of the serial line, kept in flash.

use super::flash;

/// A text in flash.
#[derive(Clone, Copy)]
pub struct Text {
    address: u16,
    len: u8,
}

impl Text {
    /// Its bytes.
    pub fn bytes(self) -> impl Iterator<Item = u8> {
        (0..u16::from(self.len)).map(move |offset| flash::byte(self.address + offset))
    }

    /// Whether these bytes are the text, in capitals or not.
    pub fn is(self, bytes: &[u8]) -> bool {
        bytes.len() == usize::from(self.len) && self.bytes().zip(bytes).all(|(a, b)| a.eq_ignore_ascii_case(b))
    }
}

macro_rules! texts {
    ($( $(#[doc = $doc:literal])+ $name:ident = $text:literal; )+) => { $(
        $(#[doc = $doc])+
        pub fn $name() -> Text {
            #[unsafe(link_section = ".progmem.data")]
            static TEXT: [u8; $text.len()] = *$text;
            Text { address: &raw const TEXT as u16, len: TEXT.len() as u8 }
        }
    )+ };
}

texts! {
    /// Name and version.
    version = b"uno200 0.1.0";
    /// The mode follows.
    mode = b"mode ";
    /// Mode.
    run = b"RUN";
    /// Mode.
    stop = b"STOP";
    /// The program's name follows.
    program = b"program ";
    /// Instead of a name or a fault.
    none = b"none";
    /// Checksum of the program.
    crc = b" crc ";
    /// The fault follows.
    fault = b"fault ";
    /// The fault before the last reset follows.
    last_fault = b", before the reset ";
    /// Fault; the number of what is wrong follows.
    bad_image = b"bad image ";
    /// Fault.
    watchdog = b"watchdog";
    /// Fault.
    undefined_instruction = b"undefined instruction";
    /// Fault.
    program_changed = b"program changed";
    /// Fault.
    stack_overflow = b"stack overflow";
    /// Fault.
    hang = b"hang";
    /// Fault.
    panic = b"panic";
    /// Fault.
    illegal_pointer = b"illegal pointer";
    /// Fault.
    illegal_real = b"illegal real";
    /// The offset in the image follows.
    at = b" at 0x";
    /// Scan times follow.
    scan = b"scan us min ";
    /// Scan time.
    last = b" last ";
    /// Scan time.
    max = b" max ";
    /// Bytes of stack never used follow.
    stack = b"stack free ";
    /// Command.
    command_status = b"status";
    /// Command.
    command_version = b"version";
    /// Answer to what is no command.
    help = b"commands: status run stop version";
}
