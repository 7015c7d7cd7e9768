//! Answers to requests on the serial line, seen from Rust: what the assembly needs to know.
//!
//! The assembly means what the crate plc-link means, which a compiler makes too large for the
//! board; tests compare their answers.
#![allow(unsafe_code)]

use core::arch::global_asm;
use core::mem::offset_of;

use plc_isa::{
    AC_START, AIN_START, AIW_START, AQW_START, ARENA_START, DATA_END, FORCED, HC0, I_START,
    LINE_ROOM, Program, ProgramMemory, Q_START, SLOT_LEN, SLOT_START, V_RANGE_LEN, WINDOW_LEN,
};

use crate::board::clock::{COUNTS_PER_MS, Moment};
use crate::board::flash::{ProgramSlot, address};
use crate::board::stack;

/// Longest request and answer: function code and data.
const PDU_MAX: u16 = 252;
/// Bytes of a force: place, reference, value.
const FORCE_LEN: usize = 9;
const FORCES_MAX: usize = 16;
/// Bytes after a request in the frame, its checksum.
const BEHIND_REQUEST: u16 = 2;
/// The service function that more is done for here.
const IDENTIFY: u8 = 65;
/// Bit of the state: single scans.
const STEPPING: u8 = 1 << 4;
/// Commands: RUN to STOP, STOP to RUN, forget the fault, single scans from STOP.
pub const STOP: u8 = 0;
/// As above.
pub const RUN: u8 = 1;
/// As above.
pub const CLEAR_FAULT: u8 = 2;
/// As above.
pub const SCANS: u8 = 3;
const NONE: u8 = 0xFF;
/// A request that nothing has been done about.
const NEW: u8 = 0;
/// Phases of a request for the status of instructions: the next scan fills its entries in, and it
/// has.
const ARMED: u8 = 2;
const NOTED: u8 = 3;
/// Bytes of the frame before the entries.
const FIRST_ENTRY: u16 = 3;

/// What begins anew when a program is loaded.
#[repr(C)]
struct Loaded {
    trace_state: u8,
    left: u8,
    at: u8,
    /// What the request asks for beside an answer, and how many scans.
    command: u8,
    scans_wanted: u16,
    /// Addresses of the plan's tables in flash; all the same without a program.
    v_table: u16,
    timers_table: u16,
    counters_table: u16,
    labels_table: u16,
    /// Data addresses of the first slots.
    timers_start: u16,
    counters_start: u16,
    /// The program's name in flash.
    name_at: u16,
    name_len: u8,
    /// The bits of the state that the program alone makes.
    program_bits: u8,
    forces_count: u8,
}

impl Loaded {
    const NOTHING: Loaded = Loaded {
        trace_state: 0,
        left: 0,
        at: 0,
        command: 0,
        scans_wanted: 0,
        v_table: 0,
        timers_table: 0,
        counters_table: 0,
        labels_table: 0,
        timers_start: 0,
        counters_start: 0,
        name_at: 0,
        name_len: 0,
        program_bits: 0,
        forces_count: 0,
    };
}

/// What the assembly works with. It reads and writes it at these offsets.
#[repr(C)]
struct Line {
    /// Data address of requests and answers, and their most bytes.
    frame: u16,
    room: u8,
    loaded: Loaded,
    /// Single scans that are left; 0: RUN has no end.
    scans_left: u16,
    /// Bit 0 RUN, 1 there is a program, 3 it is machine code, 4 single scans.
    state: u8,
    fault: u32,
    fault_before_reset: u32,
    /// Lengths of the scans since RUN, inputs to outputs, in timer counts: the shortest, the last,
    /// the longest. 0: there is none yet. Three bytes of each are used.
    shortest: u32,
    last: u32,
    longest: u32,
    /// Scans since RUN.
    scans: u32,
    /// Bytes of stack that were never used.
    free_stack: u16,
    image_len: u16,
    forces: [u8; FORCE_LEN * FORCES_MAX],
    /// Data memory for a trace, and its end.
    ring: u16,
    ring_end: u16,
    /// How far the work on a request has come.
    phase: u8,
}

const _: () = assert!(
    offset_of!(Line, loaded.v_table) == 9
        && offset_of!(Line, loaded.forces_count) == 25
        && offset_of!(Line, state) == 28
        && offset_of!(Line, scans) == 49
);
const _: () = assert!(
    offset_of!(Line, forces) == 57
        && offset_of!(Line, ring) == 201
        && offset_of!(Line, phase) == 205
);

// Where the engine finds the same of the plan.

/// Addresses of tables in flash.
pub const TIMERS_IN_FLASH: usize = offset_of!(Line, loaded.timers_table);
/// As above.
pub const COUNTERS_IN_FLASH: usize = offset_of!(Line, loaded.counters_table);
/// As above.
pub const LABELS_IN_FLASH: usize = offset_of!(Line, loaded.labels_table);
/// Data addresses of the first slots.
pub const TIMERS_START: usize = offset_of!(Line, loaded.timers_start);
/// As above.
pub const COUNTERS_START: usize = offset_of!(Line, loaded.counters_start);

static mut LINE: Line = Line {
    frame: 0,
    room: 0,
    loaded: Loaded::NOTHING,
    scans_left: 0,
    state: 0,
    fault: 0,
    fault_before_reset: 0,
    shortest: 0,
    last: 0,
    longest: 0,
    scans: 0,
    free_stack: 0,
    image_len: 0,
    forces: [0; FORCE_LEN * FORCES_MAX],
    ring: 0,
    ring_end: 0,
    phase: NEW,
};

global_asm!(
    ".equ CAPABILITIES, 7",
    ".equ I_START, {i_start}",
    ".equ Q_START, {q_start}",
    ".equ AIW_START, {aiw_start}",
    ".equ AIN_START, {ain_start}",
    ".equ AC_START, {ac_start}",
    ".equ HC0, {hc0}",
    ".equ AQW_START, {aqw_start}",
    ".equ ARENA_START, {arena_start}",
    ".equ SLOT_START, {slot_start}",
    ".equ SLOT_LEN, {slot_len}",
    ".equ WINDOW_LEN, {window_len}",
    ".equ V_RANGE_LEN, {v_range_len}",
    ".equ COUNTS_PER_MS, {counts_per_ms}",
    ".equ FORCED_POINTS, {forced}",
    ".set LINE, {line}",
    // Mode in bit 0, then the fault. Harnesses read it by this name.
    ".global UNO200_STATUS",
    ".set UNO200_STATUS, LINE + {state}",
    i_start = const I_START,
    q_start = const Q_START,
    aiw_start = const AIW_START,
    ain_start = const AIN_START,
    ac_start = const AC_START,
    hc0 = const HC0,
    aqw_start = const AQW_START,
    arena_start = const ARENA_START,
    slot_start = const SLOT_START,
    slot_len = const SLOT_LEN,
    window_len = const WINDOW_LEN,
    v_range_len = const V_RANGE_LEN,
    counts_per_ms = const COUNTS_PER_MS,
    forced = const FORCED,
    state = const offset_of!(Line, state),
    line = sym LINE,
);
global_asm!(
    concat!(".macro VERSION_TEXT\n.asciz \"", env!("CARGO_PKG_VERSION"), "\"\n.endm\n"),
    include_str!("link/answer.s"),
    include_str!("link/references.s"),
    include_str!("link/modbus.s"),
    include_str!("link/registers.s"),
    include_str!("link/values.s"),
    include_str!("link/identification.s"),
    include_str!("link/identity.s"),
    include_str!("link/control.s"),
    include_str!("link/watch.s"),
    include_str!("link/forces.s"),
    include_str!("link/blocks.s"),
    include_str!("link/set.s"),
    include_str!("link/status.s"),
    include_str!("link/trace.s"),
    include_str!("link/scan_times.s"),
    include_str!("link/forced.s"),
    options(raw)
);

unsafe extern "C" {
    fn line_answer(len: u8) -> u8;
    fn line_apply_forces();
    fn line_clear_forces();
    fn uno200_tell_forces();
    fn line_count_scan();
    fn line_enter_scan(ms_low: u8, ms_high: u8, counts: u8);
}

/// The state. Only the main program uses it, never while the assembly runs.
#[inline(always)]
fn line() -> &'static mut Line {
    let line = &raw mut LINE;
    // SAFETY: no reference outlives the function below that it is made for; none of them calls
    // another meanwhile.
    unsafe { &mut *line }
}

/// Forgets the request before, of which there is work left when a module took the line over
/// meanwhile.
#[inline(always)]
pub fn forget() {
    line().phase = NEW;
}

/// Answers the request of so many bytes, at least 1, in the frame. Returns the length of the
/// answer, which has replaced it; 0: the answer takes another scan, at whose end this is called
/// again.
pub fn answer(len: u8) -> u8 {
    // SAFETY: the frame is in data memory.
    let function = unsafe { *(line().frame as *const u8) };
    line().loaded.command = NONE;
    if function == IDENTIFY {
        line().free_stack = stack::free();
    }
    // SAFETY: the assembly reads flash and the image that has been checked, writes data memory of
    // the program in force and after it, and keeps what the calling convention asks for. Nobody
    // holds a reference to data memory.
    unsafe { line_answer(len) }
}

/// What the last request asks for beside an answer: one of the commands.
#[inline(always)]
pub fn command() -> u8 {
    line().loaded.command
}

/// RUN was asked for, or single scans: as many are left now.
#[inline(always)]
pub fn begin_scans() {
    let line = line();
    line.scans_left = if line.loaded.command == SCANS { line.loaded.scans_wanted } else { 0 };
    line.state &= !STEPPING;
}

/// Whether this scan is to fill in a status window.
#[inline(always)]
pub fn has_window() -> bool {
    line().phase == ARMED
}

/// Data address of its first entry. It is filled in when the next request is answered.
#[inline(always)]
pub fn take_window() -> u16 {
    let line = line();
    line.phase = NOTED;
    line.frame + FIRST_ENTRY
}

/// Data address of the frame.
pub fn frame() -> u16 {
    line().frame
}

/// Whether something is forced.
#[inline(always)]
pub fn is_forced() -> bool {
    line().loaded.forces_count != 0
}

/// Gives forced operands their values.
#[inline(always)]
pub fn apply_forces() {
    // SAFETY: the assembly writes data memory at places of the program in force.
    unsafe { line_apply_forces() }
}

/// RUN has ended: nothing is forced, and no single scans go on.
pub fn end_run() {
    line().scans_left = 0;
    // SAFETY: as above.
    unsafe {
        line_clear_forces();
        uno200_tell_forces();
    }
}

/// Places the frame after the program's memory and the copy of what is retained, and notes where
/// its tables are. Nothing is forced,
/// and no request is being answered. Returns the most bytes of a request.
pub fn place(program: Option<&Program<ProgramSlot>>, retained_len: u16) -> u8 {
    let line = line();
    let (mut frame, mut end) = (ARENA_START, DATA_END);
    line.loaded = Loaded::NOTHING;
    let loaded = &mut line.loaded;
    line.image_len = 0;
    if let Some(program) = program {
        let plan = program.plan();
        let header = &plan.header;
        frame = plan.end() + retained_len;
        end = program.memory().modules_end().unwrap_or(frame + LINE_ROOM);
        loaded.timers_table = address(plan.timers_at);
        loaded.counters_table = address(plan.counters_at);
        loaded.labels_table = address(plan.labels_at);
        loaded.timers_start = plan.timers_start;
        loaded.counters_start = plan.counters_start;
        loaded.v_table = address(plan.v_ranges_at);
        loaded.name_len = header.name_len;
        loaded.name_at = loaded.v_table - u16::from(header.name_len);
        line.image_len = header.total_len;
        loaded.program_bits = if header.interface == 0 { 1 << 1 } else { 1 << 1 | 1 << 3 };
    }
    line.phase = NEW;
    line.frame = frame;
    line.room = (end - frame - BEHIND_REQUEST).min(PDU_MAX) as u8;
    line.ring = frame + u16::from(line.room) + BEHIND_REQUEST;
    line.ring_end = end;
    line.room
}

/// Mode and fault are these now.
pub fn tell(runs: bool, fault: u32) {
    let line = line();
    let mut state = u8::from(runs) | line.loaded.program_bits;
    if line.scans_left != 0 {
        state |= STEPPING;
    }
    line.state = state;
    line.fault = fault;
}

/// The fault before the last reset.
pub fn set_fault_before_reset(fault: u32) {
    line().fault_before_reset = fault;
}

/// RUN begins with a first scan.
pub fn begin_run() {
    let line = line();
    (line.shortest, line.last, line.longest, line.scans) = (0, 0, 0, 0);
}

/// Whether single scans are to begin or go on.
pub fn has_scans_left() -> bool {
    line().scans_left != 0
}

/// Whether RUN consists of single scans.
#[inline(always)]
pub fn is_stepping() -> bool {
    line().state & STEPPING != 0
}

/// One of them is over. Returns whether it was the last.
pub fn count_down() -> bool {
    let line = line();
    line.scans_left -= 1;
    line.scans_left == 0
}

/// The program has been executed: what is told from now on is of this scan.
#[inline(always)]
pub fn count_scan() {
    // SAFETY: the assembly writes the number of scans.
    unsafe { line_count_scan() }
}

/// A scan is over that began at this moment.
#[inline(always)]
pub fn enter_scan(start: Moment) {
    // SAFETY: the assembly writes the times of scans and, for a trace, data memory behind the
    // frame.
    unsafe { line_enter_scan(start.ms[0], start.ms[1], start.counts) }
}
