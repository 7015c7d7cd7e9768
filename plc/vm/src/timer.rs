//! Timers TON, TOF and TONR with their three resolutions (reference 2.1 to 2.3).
//!
//! 100 ms timers advance when their instruction executes, 10 ms timers at scan start, 1 ms timers at
//! scan start and whenever they are executed or read. The execution that starts a timer adds nothing.

use plc_isa::{
    C_BITS_START, Plan, ProgramMemory, T_BITS_START, TimerFamily, TimerKind, TimerResolution, TimerSlot, timer_bit,
    timer_family, timer_resolution,
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

    /// The instruction executes. `ticks` are the intervals that an already running timer gains by it.
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
pub(crate) fn advance<P: ProgramMemory>(memory: &mut Memory, plan: &Plan<P>, resolution: TimerResolution, ticks: u16) {
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

/// Whether a program has timers that advance at scan start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AtScanStart {
    /// Of 1 ms.
    pub ms_1: bool,
    /// Of 10 ms.
    pub ms_10: bool,
}

/// The change to RUN (reference 2.2): no timer runs, all bits are 0; only TONR keeps its current value.
pub(crate) fn start_of_run<P: ProgramMemory>(memory: &mut Memory, plan: &Plan<P>) -> AtScanStart {
    let mut found = AtScanStart { ms_1: false, ms_10: false };
    for address in T_BITS_START..C_BITS_START {
        memory.set_byte(address, 0);
    }
    for slot in plan.timers() {
        let mut timer = Timer { memory, slot };
        timer.set_state(0);
        if timer_family(slot.number) == TimerFamily::TonTof {
            timer.set_current(0);
        }
        match timer_resolution(slot.number) {
            TimerResolution::Ms1 => found.ms_1 = true,
            TimerResolution::Ms10 => found.ms_10 = true,
            TimerResolution::Ms100 => {}
        }
    }
    found
}
