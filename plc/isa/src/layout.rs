//! Where data lives: the address map of the controller's data memory, the same on every board.
//! Where it ends is a [profile](crate::Profile)'s.
//!
//! Addresses are AVR data addresses, so that the operand of an instruction is an address the board
//! can use as it stands. What the fixed areas do not hold (V bytes, timer and counter words, edge
//! memories) is placed per program in the [arena](ARENA_START) by the memory plan.

/// First data address: the start of SRAM on the Uno.
pub const DATA_START: u16 = 0x0100;

/// Bytes between the controller's data memory and the firmware's variables: a word or a timer at
/// the very end of data memory reaches after it when the program in flash has changed.
pub const DATA_GAP: u16 = 4;

/// The bit page: 256 bytes from here hold all areas with short bit addresses.
pub const PAGE_START: u16 = DATA_START;
/// Bytes in the bit page.
pub const PAGE_LEN: u16 = 256;

/// Process image of the inputs, IB0-IB15.
pub const I_START: u16 = 0x0100;
/// Process image of the outputs, QB0-QB15.
pub const Q_START: u16 = 0x0110;
/// Marks, MB0-MB31.
pub const M_START: u16 = 0x0120;
/// Special memory, SMB0-SMB31.
pub const SM_START: u16 = 0x0140;
/// Sequence control bits, SB0-SB31.
pub const S_START: u16 = 0x0160;
/// Timer bits, T0-T255.
pub const T_BITS_START: u16 = 0x0180;
/// Counter bits, C0-C255.
pub const C_BITS_START: u16 = 0x01A0;
/// Local memory, LB0-LB63: the frames of all units of the program, overlaid.
pub const L_START: u16 = 0x01C0;

/// Analog inputs scaled to 0..=32000: AIW0, AIW2, ... AIW10, one word each.
pub const AIW_START: u16 = 0x0200;
/// The same analog inputs as raw 10-bit counts: Ain0 ... Ain5, one word each.
pub const AIN_START: u16 = 0x020C;
/// Analog inputs that there are words for.
pub const ANALOG_INPUTS: u16 = 6;

/// Accumulators AC0-AC3, a double word each.
pub const AC_START: u16 = 0x0218;
/// How many accumulators there are.
pub const ACCUMULATORS: u8 = 4;
/// Current value of high-speed counter 0, a double word.
pub const HC0: u16 = 0x0228;
/// Current value of high-speed counter 3.
pub const HC3: u16 = 0x022C;
/// Analog outputs AQW0 and AQW2, a word each.
pub const AQW_START: u16 = 0x0230;
/// Analog outputs that there are words for.
pub const ANALOG_OUTPUTS: u8 = 2;
/// ENO of the last box, as far as the program asks for it there: a byte, 0 or 1. Boxes of modules
/// leave it, those of the core with [`Op::NoteEno`](crate::Op::NoteEno).
pub const ENO: u16 = 0x0234;
/// In the operand of AENO: looks at the ENO that was left, not at SMB1 alone.
pub const LEFT_ENO: u8 = 0x80;
/// On the board: what the last look for interrupt events saw; after it what waits. No instruction
/// names these bytes.
pub const EVENTS_SEEN: u16 = 0x0235;
/// The value of that byte when RUN begins and nothing has been seen.
pub const EVENTS_RUN_BEGINS: u8 = 0xFF;

/// On the board: what is forced of IB0, then of QB0, for immediate access. For each a byte with the
/// bits that are forced, and one with their values, 0 in the others. No instruction names these
/// bytes.
pub const FORCED: u16 = 0x023C;

/// The arena: memory planned per program.
pub const ARENA_START: u16 = 0x0240;
/// Bytes of data memory that every program leaves free after its arena: for requests on the serial
/// line and their answers.
pub const LINE_ROOM: u16 = 64;

/// Arena bytes per timer: current value (2), preset (2), state (1).
pub const TIMER_SLOT_LEN: u16 = 5;
/// Arena bytes per counter: current value (2), state (1).
pub const COUNTER_SLOT_LEN: u16 = 3;
/// Most bytes of bytecode from the beginning of a unit, or from one instruction that looks for a
/// status window, to the next: so far the board goes to a window step by step.
pub const APPROACH_LEN: u16 = 152;
/// Less than so many bytes of bytecode lie between the first and the last instruction of a status
/// window; a multiple of 256.
pub const WINDOW_LEN: u16 = 512;
/// Most edge instructions (EU and ED together) in a program.
pub const EDGES_MAX: u16 = 256;
