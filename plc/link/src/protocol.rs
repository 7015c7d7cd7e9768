//! The numbers of docs/protocol.md that both ends of a line need: function codes and limits. No meaning.

/// The version of the service functions.
pub const VERSION: u8 = 1;

/// Modbus function 43, of which there is the identification.
pub const IDENTIFICATION: u8 = 43;
/// Service function: what the PLC is and how it is.
pub const IDENTIFY: u8 = 65;
/// Service function: RUN, STOP, single scans.
pub const CONTROL: u8 = 66;
/// Service function: values of one moment.
pub const WATCH: u8 = 67;
/// Service function: the table of forces.
pub const FORCE: u8 = 68;
/// Service function: status of instructions.
pub const STATUS: u8 = 69;
/// Service function: values of many scans.
pub const TRACE: u8 = 70;
/// Service function: bytes of the program slot or of a trace.
pub const READ_BLOCK: u8 = 71;
/// Service function: operands get values, all or none.
pub const SET: u8 = 72;

/// Most operands in one request to watch.
pub const WATCH_MAX: u8 = 32;
/// Most operands in one request to set.
pub const SET_MAX: u8 = 16;
/// Most instructions in a status window.
pub const STATUS_MAX: u8 = 24;
/// Most operands in a trace.
pub const TRACE_MAX: u8 = 8;
/// Most operands forced at the same time.
pub const FORCES_MAX: u8 = 16;
/// Most bytes of a block.
pub const BLOCK_MAX: u8 = 64;
/// Bytes of a force in an answer: reference and value.
pub const FORCE_LEN: u8 = 7;
