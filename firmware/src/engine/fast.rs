//! The fast engine seen from Rust: what the assembly needs to know, and what it calls.
//!
//! The assembly is put together by the build script from `engine.s`, `handlers.s` and the
//! instruction table.
#![allow(unsafe_code)]

use core::arch::global_asm;
use core::mem::offset_of;
use core::ptr;

use plc_isa::{
    COUNTERS_ENTRY, COUNTERS_MODULE, DIRECTORY_AT, ENO, EVENTS_ENTRY, EVENTS_MODULE, EVENTS_SEEN,
    FREEPORT_ENTRY, FREEPORT_MODULE, MODULE_HEAD_LEN, PULSES_ENTRY, PULSES_MODULE, SLOT_START,
    TimerResolution,
};
use plc_vm::{CALLS_MAX, Environment, Exit, Scan, TimeOfScan};

use crate::board::flash::{ProgramSlot, address};
use crate::board::{clock, takeover, watchdog};
use crate::engine::link;
use crate::environment::{ModuleEvents, ScanTime};

/// The firmware's interface to native programs.
pub const NATIVE_INTERFACE: u8 = plc_isa::NATIVE_INTERFACE;

type Execution<'a> = Scan<'a, ProgramSlot, ScanTime, ModuleEvents>;
type Time<'a> = TimeOfScan<'a, ScanTime>;

/// What is known of the program and the scan. The assembly reads it at these offsets.
#[repr(C)]
struct Context {
    /// Where execution begins in flash: the address of bytecode, the word address of machine code.
    start: u16,
    is_native: bool,
    /// Address of the plan's table of routines in flash, and data address of its edge memory. More
    /// of the plan is known to the line.
    routines_in_flash: u16,
    edges_start: u16,
    /// How many timers the plan has.
    timers: u16,
    /// Intervals of 100 ms between the starts of this scan and the last.
    ticks_100: u16,
    /// Two bytes after the start of the instruction that left the program, in flash.
    left_at: u16,
    /// The stack pointer where the program is left.
    stack: u16,
    /// The low byte of the clock when the watchdog was asked last.
    tick: u8,
    /// How many routines are being executed.
    depth: u8,
    /// The upper byte of where the last instruction of a status window is in flash; 0: there is
    /// none in this scan.
    window_page: u8,
}

static mut CONTEXT: Context = Context {
    start: 0,
    is_native: false,
    routines_in_flash: 0,
    edges_start: 0,
    timers: 0,
    ticks_100: 0,
    left_at: 0,
    stack: 0,
    tick: 0,
    depth: 0,
    window_page: 0,
};

/// What the module for the clock keeps of the time of day; 0 until it is set.
static mut TIME_OF_DAY: [u8; 10] = [0; 10];

/// The time of the execution that the assembly is in.
static mut TIME: *mut Time<'static> = ptr::null_mut();

const LEFT_AT_END: u8 = 0;
const LEFT_BY_STOP: u8 = 1;
const LEFT_BY_WATCHDOG: u8 = 2;
const LEFT_BY_UNDEFINED: u8 = 3;
/// After the last: modules count from it.
const LEFT_BY_POINTER: u8 = 4;
const LEFT_BY_REAL: u8 = 5;

global_asm!(
    ".equ TIMERS_IN_FLASH, {timers_in_flash}",
    ".equ COUNTERS_IN_FLASH, {counters_in_flash}",
    ".equ LABELS_IN_FLASH, {labels_in_flash}",
    ".equ ROUTINES_IN_FLASH, {routines_in_flash}",
    ".equ DEPTH, {depth}",
    ".equ CALLS_MAX, {calls_max}",
    ".equ DIRECTORY_AT, {directory_at}",
    ".equ MODULE_HEAD_LEN, {module_head_len}",
    ".equ COUNTERS_MODULE, {counters_module}",
    ".equ PULSES_MODULE, {pulses_module}",
    ".equ FREEPORT_MODULE, {freeport_module}",
    ".equ COUNTERS_ENTRY, {counters_entry}",
    ".equ PULSES_ENTRY, {pulses_entry}",
    ".equ FREEPORT_ENTRY, {freeport_entry}",
    ".equ SERIAL_FLAG, {serial_flag}",
    ".equ ENO, {eno}",
    ".equ EVENTS_SEEN, {events_seen}",
    ".equ EVENTS_MODULE, {events_module}",
    ".equ EVENTS_ENTRY, {events_entry}",
    ".equ TIMERS_START, {timers_start}",
    ".equ COUNTERS_START, {counters_start}",
    ".equ EDGES_START, {edges_start}",
    ".equ TIMERS, {timers}",
    ".equ TICKS_100, {ticks_100}",
    ".equ LEFT_AT, {left_at}",
    ".equ STACK, {stack}",
    ".equ TICK, {tick}",
    ".equ WINDOW_PAGE, {window_page}",
    ".equ LEFT_AT_END, {at_end}",
    ".equ LEFT_BY_STOP, {by_stop}",
    ".equ LEFT_BY_WATCHDOG, {by_watchdog}",
    ".equ LEFT_BY_UNDEFINED, {by_undefined}",
    ".set CONTEXT, {context}",
    ".set TIME_OF_DAY, {time_of_day}",
    timers_in_flash = const link::TIMERS_IN_FLASH,
    counters_in_flash = const link::COUNTERS_IN_FLASH,
    labels_in_flash = const link::LABELS_IN_FLASH,
    routines_in_flash = const offset_of!(Context, routines_in_flash),
    depth = const offset_of!(Context, depth),
    // An interrupt routine, and what it calls, come on top.
    calls_max = const CALLS_MAX + 2,
    directory_at = const DIRECTORY_AT,
    module_head_len = const MODULE_HEAD_LEN,
    counters_module = const COUNTERS_MODULE,
    pulses_module = const PULSES_MODULE,
    freeport_module = const FREEPORT_MODULE,
    counters_entry = const COUNTERS_ENTRY,
    pulses_entry = const PULSES_ENTRY,
    freeport_entry = const FREEPORT_ENTRY,
    serial_flag = const takeover::SERIAL.trailing_zeros(),
    eno = const ENO,
    events_seen = const EVENTS_SEEN,
    events_module = const EVENTS_MODULE,
    events_entry = const EVENTS_ENTRY,
    timers_start = const link::TIMERS_START,
    counters_start = const link::COUNTERS_START,
    edges_start = const offset_of!(Context, edges_start),
    timers = const offset_of!(Context, timers),
    ticks_100 = const offset_of!(Context, ticks_100),
    left_at = const offset_of!(Context, left_at),
    stack = const offset_of!(Context, stack),
    tick = const offset_of!(Context, tick),
    window_page = const offset_of!(Context, window_page),
    at_end = const LEFT_AT_END,
    by_stop = const LEFT_BY_STOP,
    by_watchdog = const LEFT_BY_WATCHDOG,
    by_undefined = const LEFT_BY_UNDEFINED,
    context = sym CONTEXT,
    time_of_day = sym TIME_OF_DAY,
);
global_asm!(include_str!(concat!(env!("OUT_DIR"), "/engine.s")), options(raw));

unsafe extern "C" {
    fn uno200_run(address: u16) -> u8;
    fn uno200_run_native(word_address: u16) -> u8;
    fn uno200_run_steps(steps: u16, window: u16, address: u16) -> u8;
    fn uno200_steps();
    fn uno200_advance_timers(is_10_ms: u8, ticks: u16);
}

/// Advances the running timers of 1 ms or 10 ms. In the scan that begins a RUN there are none.
pub fn advance_timers(resolution: TimerResolution, ticks: u16) {
    if ticks == 0 {
        return;
    }
    // SAFETY: the context is that of the program in force, whose plan has been checked; the
    // assembly changes memory of its timers and their bits and keeps what the calling convention
    // asks for.
    unsafe { uno200_advance_timers(u8::from(resolution == TimerResolution::Ms10), ticks) }
}

/// Why the program was left, as the assembly says it.
#[derive(Clone, Copy)]
pub struct Left(u8);

impl Left {
    /// Whether the program came to its end.
    #[inline(always)]
    pub fn is_at_end(self) -> bool {
        self.0 == LEFT_AT_END
    }

    /// The same in words.
    #[inline(always)]
    pub fn exit(self) -> Exit {
        match self.0 {
            LEFT_AT_END => Exit::End,
            LEFT_BY_STOP => Exit::Stop,
            LEFT_BY_WATCHDOG => Exit::Watchdog,
            LEFT_BY_POINTER => Exit::ComparedPointer,
            LEFT_BY_REAL => Exit::ComparedReal,
            _ => Exit::Undefined,
        }
    }
}

/// Executes the program. Returns why it was left, and the offset of the instruction that left it. A
/// status window that is to be filled in is; native programs leave it alone.
#[inline(always)]
pub fn run(execution: Execution<'_>) -> (Left, u16) {
    enter(&execution);
    let mut time = execution.into_time();
    // SAFETY: the program has been verified; the assembly reads flash, writes to addresses of the
    // plan, and keeps what the calling convention asks for. Machine code is trusted to do the same:
    // its translator made it from a verified program, and its checksum and interface version are
    // right. Nothing else uses the context.
    let left = unsafe {
        TIME = (&raw mut time).cast();
        let (start, is_native) = (CONTEXT.start, CONTEXT.is_native);
        if is_native {
            uno200_run_native(start)
        } else if link::has_window() {
            run_steps(link::take_window(), start)
        } else {
            uno200_run(start)
        }
    };
    // SAFETY: the assembly has returned; nothing else uses the context.
    let at = unsafe { CONTEXT.left_at };
    (Left(left), at.wrapping_sub(SLOT_START + 2))
}

/// Executes bytecode step by step.
///
/// # Safety
/// As for running it at once: the context is that of a verified program. The entries lie in data
/// memory.
#[inline(never)]
unsafe fn run_steps(window: u16, address: u16) -> u8 {
    // SAFETY: nothing else uses the context; the steps are machine code that keeps to the interface
    // of native programs.
    unsafe {
        let left = uno200_run_steps(uno200_steps as *const () as u16, window, address);
        // The program may have been left before its end.
        CONTEXT.window_page = 0;
        left
    }
}

/// Makes an execution the one that the assembly works for. What the plan says stays the same until
/// the next RUN.
#[inline(always)]
fn enter(execution: &Execution<'_>) {
    let plan = execution.program().plan();
    // SAFETY: no interrupt uses the context, and the assembly is not running.
    unsafe {
        let context = &raw mut CONTEXT;
        if execution.is_first() {
            let entry = execution.program().entry();
            (*context).is_native = entry.is_some();
            (*context).start = entry
                .map_or_else(|| address(execution.program().code_at()), |entry| address(entry) / 2);
            (*context).routines_in_flash = address(plan.routines_at);
            (*context).edges_start = plan.edges_start;
            (*context).timers = plan.header.timers;
        }
        (*context).ticks_100 = execution.ticks_100();
    }
}

/// The time of the execution that the assembly is in. Only for what the assembly calls.
#[inline(always)]
fn time() -> &'static mut Time<'static> {
    // SAFETY: the assembly has called, which `run` has called with this time and which waits; `run`
    // does not touch it before the assembly returns, and none of the callers calls another.
    unsafe { &mut *TIME }
}

/// Brings the timers of 1 ms up to date.
#[unsafe(no_mangle)]
extern "C" fn uno200_refresh_timers() {
    advance_timers(TimerResolution::Ms1, time().take_fast_ms());
}

/// Whether the scan takes longer than it may; not 0 if so. Asked again only when the clock has
/// moved.
#[unsafe(no_mangle)]
extern "C" fn uno200_is_overdue() -> u8 {
    let now_ms = clock::now_ms();
    // SAFETY: as in `enter`: the assembly has called and waits.
    unsafe { CONTEXT.tick = now_ms as u8 };
    watchdog::feed(now_ms);
    u8::from(time().environment.is_over())
}

/// The millisecond clock.
#[unsafe(no_mangle)]
extern "C" fn uno200_now() -> u32 {
    clock::now_ms()
}

/// WDR.
#[unsafe(no_mangle)]
extern "C" fn uno200_retrigger_watchdog() {
    time().environment.retrigger_watchdog();
}
