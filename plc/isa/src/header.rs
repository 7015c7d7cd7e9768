//! Where the fields of an image's header are. What they mean, [`Header`](crate::Header) says.

use crate::modules::MODULES;

/// Offset of the byte with version and profile, see [`Profile::format`](crate::Profile::format).
pub const FORMAT_AT: u16 = 4;
/// Bytes of the header.
pub const HEADER_LEN: u16 = DIRECTORY_AT + 2 * MODULES as u16;
/// Offset of the directory of modules in the header: for each the word address of its jump table in
/// flash, 0 where the program does not use it.
pub const DIRECTORY_AT: u16 = 42;
/// Offset of the first field of [`Header`](crate::Header).
pub const FIELDS_AT: u16 = 5;
// Offsets of what the loader's check names.
pub(crate) const TOTAL_LEN_AT: u16 = 6;
pub(crate) const ARENA_LEN_AT: u16 = 10;
pub(crate) const SETTINGS_AT: u16 = 22;
// Offsets of numbers that the check of operands asks for; the last two are bytes.
pub(crate) const EDGES_AT: u8 = 12;
pub(crate) const LABELS_AT: u8 = 14;
pub(crate) const TIMERS_AT: u8 = 18;
pub(crate) const COUNTERS_AT: u8 = 20;
pub(crate) const ROUTINES_AT: u8 = 38;
pub(crate) const EVENTS_AT: u8 = 39;

/// Version of the image format and of the instruction set it is written in, 0 to 15.
pub const FORMAT_VERSION: u8 = 7;

/// Version of the firmware interface that machine code in an image is translated for
/// (docs/image.md).
pub const NATIVE_INTERFACE: u8 = 1;
