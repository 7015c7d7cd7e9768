//! The program image: header and tables, as bytes. Whether an image may run is decided in
//! [`verify`](crate::verify).
//!
//! Layout (docs/image.md): header, modules, name, V ranges, timers, counters, labels, retained
//! ranges, routines, events, constants, initial values, code, CRC. Numbers are little-endian.
//! Offsets count from the first byte of the image.

use crate::crc::Crc32;
use crate::header::{FORMAT_AT, HEADER_LEN};
use crate::memory::ProgramMemory;
use crate::plan::Plan;
use crate::profile::Profile;
use crate::settings::{Retained, Settings};

/// First bytes of every image.
pub const MAGIC: [u8; 4] = *b"U200";
/// Bytes of the checksum at the end.
pub const CRC_LEN: u16 = 4;
/// Longest program name in bytes.
pub const NAME_LEN_MAX: u8 = 24;

/// What is wrong with an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageFault {
    /// Shorter than header and checksum, or than it says.
    Length,
    /// Does not begin with the magic bytes: no program.
    Magic,
    /// Written for another version, or for a profile that does not run here.
    Version,
    /// A reserved field that this version does not know. None is left; the number stays taken.
    Flags,
    /// The checksum does not match.
    Crc,
    /// The name is too long or not printable ASCII.
    Name,
    /// A system setting is out of range.
    Settings,
    /// The V ranges are not ascending or out of range.
    VRanges,
    /// The timer table is not ascending, or a timer's kind does not fit its number.
    Timers,
    /// The counter table is not ascending.
    Counters,
    /// A retained range is out of range.
    Retained,
    /// The memory plan does not fit the board or contradicts the tables.
    Plan,
    /// A token that is not in the instruction table.
    UndefinedToken,
    /// The code ends within an instruction, or without the end of the program.
    Truncated,
    /// An operand is not stored as it must be.
    Malformed,
    /// An operand's address or number is not in the plan.
    Operand,
    /// An instruction would write to an input or to read-only memory.
    ReadOnly,
    /// An instruction needs more values than the logic stack holds.
    StackUnderflow,
    /// The label table does not match the labels in the code, or a jump's label does not exist.
    Label,
    /// FOR and NEXT do not pair, or are nested too deep.
    Loop,
    /// Machine code that cannot run here: for another firmware interface, for the board only, or
    /// without a valid entry.
    Interface,
    /// A module is not the one that the firmware knows, or an instruction's module is missing.
    Module,
    /// The table of routines does not match the code, or a call leads to none or backwards.
    Routine,
    /// The table of events is not ascending, or an event is not in it.
    Event,
    /// Initial values are not in V memory.
    Initial,
}

/// What is wrong with an image, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageError {
    /// What.
    pub fault: ImageFault,
    /// Offset in the image.
    pub at: u16,
}

impl ImageFault {
    /// All faults, in the order of their numbers on the board.
    pub const ALL: [ImageFault; 25] = [
        ImageFault::Length,
        ImageFault::Magic,
        ImageFault::Version,
        ImageFault::Flags,
        ImageFault::Crc,
        ImageFault::Name,
        ImageFault::Settings,
        ImageFault::VRanges,
        ImageFault::Timers,
        ImageFault::Counters,
        ImageFault::Retained,
        ImageFault::Plan,
        ImageFault::UndefinedToken,
        ImageFault::Truncated,
        ImageFault::Malformed,
        ImageFault::Operand,
        ImageFault::ReadOnly,
        ImageFault::StackUnderflow,
        ImageFault::Label,
        ImageFault::Loop,
        ImageFault::Interface,
        ImageFault::Module,
        ImageFault::Routine,
        ImageFault::Event,
        ImageFault::Initial,
    ];

    /// The fault in words.
    pub const fn message(self) -> &'static str {
        match self {
            ImageFault::Length => "the image is incomplete",
            ImageFault::Magic => "this is no program image",
            ImageFault::Version => {
                "the image was made for another version or board: assemble it again"
            }
            ImageFault::Flags => "the image asks for something this version does not know",
            ImageFault::Crc => "the checksum does not match",
            ImageFault::Name => "the program name is not valid",
            ImageFault::Settings => "a system setting is out of range",
            ImageFault::VRanges => "the table of V memory is not valid",
            ImageFault::Timers => "the table of timers is not valid",
            ImageFault::Counters => "the table of counters is not valid",
            ImageFault::Retained => "the table of retained memory is not valid",
            ImageFault::Plan => "the memory plan does not fit",
            ImageFault::UndefinedToken => "the code holds an unknown instruction",
            ImageFault::Truncated => "the code ends too early",
            ImageFault::Malformed => "an operand is not stored as it must be",
            ImageFault::Operand => "an operand is not in the memory plan",
            ImageFault::ReadOnly => "an instruction writes to read-only memory",
            ImageFault::StackUnderflow => {
                "an instruction needs more values than the logic stack holds"
            }
            ImageFault::Label => "a jump and its label do not match",
            ImageFault::Loop => "FOR and NEXT do not match",
            ImageFault::Interface => {
                "the image is translated to machine code that this machine does not run"
            }
            ImageFault::Module => "a module of the image is not one that this firmware knows",
            ImageFault::Routine => "a call and its routine do not match",
            ImageFault::Event => "the table of interrupt events is not valid",
            ImageFault::Initial => "the initial values of V memory are not valid",
        }
    }
}

/// The header: lengths and settings, in the order in which they are in the image.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Header {
    /// The firmware interface that the code was translated for; 0: bytecode.
    pub interface: u8,
    /// Bytes of the whole image, checksum included.
    pub total_len: u16,
    /// Bytes of code.
    pub code_len: u16,
    /// Arena bytes the program needs.
    pub arena_len: u16,
    /// Edge memories.
    pub edges: u16,
    /// Labels in the label table.
    pub labels: u16,
    /// Ranges of V memory.
    pub v_ranges: u16,
    /// Timers in the plan.
    pub timers: u16,
    /// Counters in the plan.
    pub counters: u16,
    /// System settings.
    pub settings: Settings,
    /// Bytes of the modules.
    pub modules_len: u16,
    /// Bytes of the constants.
    pub constants_len: u16,
    /// Bytes of the initial values of V memory.
    pub initial_len: u16,
    /// Routines: subroutines and interrupt routines.
    pub routines: u8,
    /// Interrupt events that the program names.
    pub events: u8,
    /// Retained ranges.
    pub retained: u8,
    /// Bytes of the name.
    pub name_len: u8,
}

/// Bytes of a V range in the image: first byte, then how much of the arena the ranges up to and
/// with this one take.
pub const V_RANGE_LEN: u16 = 4;
/// Bytes of a timer in the image: number, kind.
pub const TIMER_LEN: u16 = 2;
/// Bytes of a counter in the image: number.
pub const COUNTER_LEN: u16 = 1;
/// Bytes of a label in the image: offset of its LBL.
pub const LABEL_LEN: u16 = 2;

/// Bytes of a routine in the image: offset of its first instruction, kind, number in the text.
pub const ROUTINE_LEN: u16 = 4;
/// Bytes of an event in the image: its number.
pub const EVENT_LEN: u16 = 1;
/// Bytes before the values of an initial range: first V byte, length.
pub const INITIAL_HEAD_LEN: u16 = 3;

/// Bytes of the entry: an offset in the image, at the start of machine code.
pub const ENTRY_LEN: u16 = 2;

/// Where entry `index` is among others of `len` bytes, whether in a table of the image or in
/// the arena. Wraps.
#[inline(always)]
pub(crate) fn entry_at(start: u16, index: u16, len: u16) -> u16 {
    start.wrapping_add(index.wrapping_mul(len))
}

impl Header {
    /// The header as bytes for a profile, with an empty directory of modules.
    pub fn to_bytes(&self, profile: &Profile) -> [u8; HEADER_LEN as usize] {
        let mut bytes = [0; HEADER_LEN as usize];
        bytes[..4].copy_from_slice(&MAGIC);
        bytes[usize::from(FORMAT_AT)] = profile.format();
        bytes[5] = self.interface;
        let words = [
            self.total_len,
            self.code_len,
            self.arena_len,
            self.edges,
            self.labels,
            self.v_ranges,
            self.timers,
            self.counters,
            self.settings.watchdog_ms,
            self.settings.scan_ms,
        ];
        for (place, word) in bytes[6..26].chunks_exact_mut(2).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        let settings = &self.settings;
        let head = [
            settings.pullup,
            settings.invert_inputs,
            settings.invert_outputs,
            settings.filter,
            settings.modbus_address,
            settings.line,
        ];
        bytes[26..32].copy_from_slice(&head);
        let words = [self.modules_len, self.constants_len, self.initial_len];
        for (place, word) in bytes[32..38].chunks_exact_mut(2).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        bytes[38..42].copy_from_slice(&[self.routines, self.events, self.retained, self.name_len]);
        bytes
    }

    /// Reads a header. Checks what must be known to read on: magic, version, length, checksum.
    pub fn read<P: ProgramMemory>(memory: &P) -> Result<Header, ImageError> {
        Header::check(memory)?;
        Ok(Header::fields(memory))
    }

    /// The checks alone.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub(crate) fn check<P: ProgramMemory>(memory: &P) -> Result<(), ImageError> {
        let error = |fault, at| Err(ImageError { fault, at });
        if memory.len() < HEADER_LEN + CRC_LEN {
            return error(ImageFault::Length, 0);
        }
        let [a, b, c, d] = MAGIC;
        if memory.word(0) != u16::from_le_bytes([a, b])
            || memory.word(2) != u16::from_le_bytes([c, d])
        {
            return error(ImageFault::Magic, 0);
        }
        let format = memory.byte(FORMAT_AT);
        let is_taken = match P::PROFILE {
            Some(profile) => format == profile.format(),
            None => Profile::of_format(format).is_some(),
        };
        if !is_taken {
            return error(ImageFault::Version, FORMAT_AT);
        }
        let total_len = memory.word(6);
        if total_len > memory.len()
            || !(HEADER_LEN + CRC_LEN..=memory.profile().slot_len).contains(&total_len)
        {
            return error(ImageFault::Length, 6);
        }
        let mut crc = Crc32::new();
        crc.bytes(memory, 0, total_len);
        if !crc.ends() {
            return error(ImageFault::Crc, total_len - CRC_LEN);
        }
        let interface = memory.byte(5);
        if interface != 0 && interface != P::NATIVE_INTERFACE {
            return error(ImageFault::Interface, 5);
        }
        Ok(())
    }

    /// The header, whatever it says.
    pub(crate) fn fields<P: ProgramMemory>(memory: &P) -> Header {
        let mut header = Header::default();
        memory.read_header(&mut header);
        header
    }

    /// The same in place, field by field.
    pub(crate) fn read_fields<P: ProgramMemory + ?Sized>(&mut self, memory: &P) {
        self.interface = memory.byte(5);
        self.total_len = memory.word(6);
        self.code_len = memory.word(8);
        self.arena_len = memory.word(10);
        self.edges = memory.word(12);
        self.labels = memory.word(14);
        self.v_ranges = memory.word(16);
        self.timers = memory.word(18);
        self.counters = memory.word(20);
        self.settings.watchdog_ms = memory.word(22);
        self.settings.scan_ms = memory.word(24);
        self.settings.pullup = memory.byte(26);
        self.settings.invert_inputs = memory.byte(27);
        self.settings.invert_outputs = memory.byte(28);
        self.settings.filter = memory.byte(29);
        self.settings.modbus_address = memory.byte(30);
        self.settings.line = memory.byte(31);
        self.modules_len = memory.word(32);
        self.constants_len = memory.word(34);
        self.initial_len = memory.word(36);
        self.routines = memory.byte(38);
        self.events = memory.byte(39);
        self.retained = memory.byte(40);
        self.name_len = memory.byte(41);
    }

    /// Offset of the V ranges.
    pub fn v_ranges_at(&self) -> u16 {
        self.tables().v_ranges_at
    }

    /// Offset of the timers.
    pub fn timers_at(&self) -> u16 {
        self.tables().timers_at
    }

    /// Offset of the counters.
    pub fn counters_at(&self) -> u16 {
        self.tables().counters_at
    }

    /// Offset of the labels.
    pub fn labels_at(&self) -> u16 {
        self.tables().labels_at
    }

    /// Offset of the retained ranges.
    pub fn retained_at(&self) -> u16 {
        self.tables().retained_at
    }

    /// Offset of the routines.
    pub fn routines_at(&self) -> u16 {
        self.tables().routines_at
    }

    /// Offset of the interrupt events.
    pub fn events_at(&self) -> u16 {
        self.tables().events_at
    }

    /// Offset of the constants.
    pub fn constants_at(&self) -> u16 {
        self.tables().constants_at
    }

    /// Offset of the initial values.
    pub fn initial_at(&self) -> u16 {
        self.tables().initial_at
    }

    /// Offset of the first instruction.
    pub fn code_at(&self) -> u16 {
        self.tables().code_at()
    }

    /// Where the parts of the image begin, without the image: what its tables place in the arena is
    /// not known.
    fn tables(&self) -> Plan<[u8; 0]> {
        Plan::of_tables([], *self)
    }

    /// Offset of the first byte after the code, which is the checksum.
    pub fn code_end(&self) -> u16 {
        self.code_at() + self.code_len
    }

    /// No count is absurd: offsets cannot overflow after this.
    #[inline(always)]
    pub(crate) fn is_plausible(&self, is_wide: bool) -> bool {
        let is_small = if is_wide {
            self.parts_len() == u32::from(self.total_len)
        } else {
            // Each is below 2,048 if all their bits together are.
            self.v_ranges | self.timers | self.counters | self.labels | self.edges < 2048
                && self.modules_len | self.constants_len | self.initial_len < 8192
        };
        is_small
            && self.code_len <= self.total_len
            && self.name_len <= NAME_LEN_MAX
            && self.retained <= Retained::RANGES_MAX
    }

    /// Bytes of all parts together, checksum included.
    fn parts_len(&self) -> u32 {
        let tables = [
            (self.v_ranges, V_RANGE_LEN),
            (self.timers, TIMER_LEN),
            (self.counters, COUNTER_LEN),
            (self.labels, LABEL_LEN),
            (self.retained.into(), Retained::STORED_LEN),
            (self.routines.into(), ROUTINE_LEN),
            (self.events.into(), EVENT_LEN),
        ];
        let bytes = [
            HEADER_LEN,
            self.modules_len,
            self.name_len.into(),
            self.constants_len,
            self.initial_len,
            self.code_len,
            CRC_LEN,
        ];
        let tables = tables.map(|(count, len)| u32::from(count) * u32::from(len));
        tables.into_iter().sum::<u32>() + bytes.map(u32::from).into_iter().sum::<u32>()
    }
}
