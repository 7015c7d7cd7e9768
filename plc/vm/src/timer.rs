//! Timers TON, TOF and TONR with their three resolutions (docs/s7-200.md 2.1 to 2.3).
//!
//! 100 ms timers advance when their instruction executes, 10 ms timers at scan start, 1 ms timers
//! at scan start and whenever they are executed or read. The execution that starts a timer adds
//! nothing.

use plc_isa::{
    C_BITS_START, DATA_START, Plan, Program, ProgramMemory, T_BITS_START, TIMER_LEN,
    TIMER_SLOT_LEN, TimerFamily, TimerKind, TimerResolution, TimerSlot, timer_bit, timer_family,
    timer_resolution,
};

use crate::memory::Memory;

/// State bit: time is being counted.
const RUNNING: u8 = 1;
/// State bit: TOF has seen its input on, so that it starts when the input goes off.
const WAS_ON: u8 = 2;

/// A timer of the plan and the memory it lives in.
pub(crate) struct Timer<'m> {
    pub memory: &'m mut Memory,
    pub slot: TimerSlot,
}

impl Timer<'_> {
    fn current(&self) -> i16 {
        self.memory.int(self.slot.address)
    }

    fn set_current(&mut self, value: i16) {
        self.memory.set_int(self.slot.address, value);
    }

    fn preset(&self) -> i16 {
        self.memory.int(self.slot.address + 2)
    }

    fn state(&self) -> u8 {
        self.memory.byte(self.slot.address + 4)
    }

    fn set_state(&mut self, state: u8) {
        self.memory.set_byte(self.slot.address + 4, state);
    }

    fn set_bit(&mut self, value: bool) {
        self.memory.set_bit(timer_bit(self.slot.number), value);
    }

    /// The instruction executes. `ticks` are the intervals that an already running timer gains by
    /// it.
    pub fn execute(&mut self, input: bool, preset: i16, ticks: u16) {
        self.memory.set_int(self.slot.address + 2, preset);
        match self.slot.kind {
            TimerKind::OffDelay => self.off_delay(input, ticks),
            TimerKind::OnDelay if !input => self.reset(),
            TimerKind::RetentiveOnDelay if !input => self.set_state(0),
            _ => self.on_delay(ticks),
        }
    }

    fn on_delay(&mut self, ticks: u16) {
        let is_running = self.state() & RUNNING != 0;
        if !is_running && self.slot.kind == TimerKind::OnDelay {
            self.set_current(0);
        }
        self.set_state(RUNNING);
        self.count(if is_running { ticks } else { 0 });
    }

    fn off_delay(&mut self, input: bool, ticks: u16) {
        let state = self.state();
        if input {
            self.set_state(WAS_ON);
            self.set_current(0);
            self.set_bit(true);
        } else if state & WAS_ON != 0 {
            self.set_state(RUNNING);
            self.set_current(0);
            self.count(0);
        } else if state & RUNNING != 0 {
            self.count(ticks);
        }
    }

    /// Time passes for a running timer.
    fn count(&mut self, ticks: u16) {
        let ticks = i16::try_from(ticks).unwrap_or(i16::MAX);
        let (current, preset) = (self.current().saturating_add(ticks), self.preset());
        let done = current >= preset;
        if self.slot.kind == TimerKind::OffDelay {
            self.set_current(if done { preset.max(0) } else { current });
            if done {
                self.set_state(0);
                self.set_bit(false);
            }
        } else {
            self.set_current(current);
            self.set_bit(done);
        }
    }

    /// R, and TON without power flow: bit and current value 0, not running.
    pub fn reset(&mut self) {
        self.set_state(0);
        self.set_current(0);
        self.set_bit(false);
    }
}

/// Advances every running timer of this resolution.
pub(crate) fn advance<P: ProgramMemory>(
    memory: &mut Memory,
    plan: &Plan<P>,
    resolution: TimerResolution,
    ticks: u16,
) {
    if ticks == 0 {
        return;
    }
    for slot in plan.timers().filter(|slot| timer_resolution(slot.number) == resolution) {
        let mut timer = Timer { memory, slot };
        if timer.state() & RUNNING != 0 {
            timer.count(ticks);
        }
    }
}

/// The resolutions of a program's timers: those of 1 ms and 10 ms advance at scan start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AtScanStart(u8);

impl AtScanStart {
    /// No timers.
    pub const NONE: AtScanStart = AtScanStart(0);

    /// Whether there are any of this resolution.
    pub fn has(self, resolution: TimerResolution) -> bool {
        self.0 & 1 << resolution as u8 != 0
    }
}

/// Where the bits are in data memory.
const BITS: core::ops::Range<usize> =
    (T_BITS_START - DATA_START) as usize..(C_BITS_START - DATA_START) as usize;

/// The change to RUN (docs/s7-200.md 2.2): no timer runs, all bits are 0; only TONR keeps its
/// current value.
pub(crate) fn start_of_run<P: ProgramMemory>(
    memory: &mut Memory,
    program: &Program<P>,
) -> AtScanStart {
    let mut found = 0;
    memory.bytes_mut()[BITS].fill(0);
    let plan = program.plan();
    let (mut at, mut address) = (plan.timers_at, plan.timers_start);
    while at != plan.counters_at {
        let number = program.memory().byte(at);
        memory.set_byte(address + 4, 0);
        if timer_family(number) == TimerFamily::TonTof {
            memory.set_word(address, 0);
        }
        found |= 1 << timer_resolution(number) as u8;
        at += TIMER_LEN;
        address += TIMER_SLOT_LEN;
    }
    AtScanStart(found)
}
