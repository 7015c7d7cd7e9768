//! The numbers of docs/protocol.md that both ends of a line need: function codes and limits. No
//! meaning.

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
/// Service function: bytes of the program slot or of a trace's memory.
pub const READ_BLOCK: u8 = 71;
/// Service function: operands get values, all or none.
pub const SET: u8 = 72;

/// Service function: a single scan with the status of instructions in it.
pub const SCAN_STATUS: u8 = 100;
/// Service function: a program comes, while another one may run.
pub const DOWNLOAD: u8 = 101;

/// Most operands in one request to watch.
pub const WATCH_MAX: u8 = 32;
/// Most operands in one request to set.
pub const SET_MAX: u8 = 16;
/// Most instructions in a status window.
pub const STATUS_MAX: u8 = 24;
/// Less than so many bytes of the image lie between the first and the last instruction of a status
/// window.
pub const STATUS_SPAN: u16 = plc_isa::WINDOW_LEN;
/// Most operands in a trace.
pub const TRACE_MAX: u8 = 8;
/// Most operands forced at the same time.
pub const FORCES_MAX: u8 = 16;
/// Most bytes of a block that is read.
pub const BLOCK_MAX: u8 = 64;
/// Most bytes of a block of a program that comes.
pub const DOWNLOAD_MAX: u8 = 240;
/// Bytes of a request before them.
pub const DOWNLOAD_HEAD_LEN: u8 = 5;
/// Bytes of a force in an answer: reference and value.
pub const FORCE_LEN: u8 = 7;

/// A trace: there is none.
pub const TRACE_NONE: u8 = 0;
/// It is complete, or was stopped.
pub const TRACE_DONE: u8 = 1;
/// It waits for its trigger. From here on samples are taken.
pub const TRACE_WAITING: u8 = 2;
/// It fills after the trigger.
pub const TRACE_FILLING: u8 = 3;

/// In the memory of a trace: how many values a sample has. These are offsets; words have the high
/// byte first.
pub const TRACE_VALUES: u16 = 8;
/// Bytes of a sample.
pub const TRACE_SAMPLE_LEN: u16 = 10;
/// Samples that the ring holds.
pub const TRACE_CAPACITY: u16 = 13;
/// Samples that are in it.
pub const TRACE_SAMPLES: u16 = 15;
/// The sample of the trigger, counted from the oldest; 0xFFFF: not yet.
pub const TRACE_TRIGGERED_AT: u16 = 17;
/// Scan of the latest sample.
pub const TRACE_SCAN: u16 = 19;
/// Data address of the ring.
pub const TRACE_FIRST: u16 = 21;
/// Data address of the next sample.
pub const TRACE_NEXT: u16 = 23;
/// Bytes before the places of the values, two for each. The ring follows.
pub const TRACE_HEAD_LEN: u16 = 25;
