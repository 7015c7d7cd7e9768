//! A scan that has begun: what an engine executes the program with. The interpreter is one of them.

use plc_isa::{Program, ProgramMemory};

use crate::clock::Clock;
use crate::environment::Environment;
use crate::memory::Memory;

/// A scan of a controller in RUN: its inputs are in memory, clock and timers have been moved. The
/// program is to be executed.
#[derive(Debug)]
pub struct Scan<'a, P, E, V> {
    pub(crate) program: &'a Program<P>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) environment: &'a mut E,
    pub(crate) clock: &'a mut Clock,
    pub(crate) first_scan: bool,
    pub(crate) events: &'a mut V,
}

impl<'a, P: ProgramMemory, E: Environment, V> Scan<'a, P, E, V> {
    /// The program.
    pub fn program(&self) -> &Program<P> {
        self.program
    }

    /// Whether this is the first scan since RUN.
    pub fn is_first(&self) -> bool {
        self.first_scan
    }

    /// Intervals of 100 ms between the starts of this scan and the last.
    pub fn ticks_100(&self) -> u16 {
        self.clock.ticks_100
    }

    /// What is left when an engine has taken the rest: it knows program and memory itself.
    #[inline(always)]
    pub fn into_time(self) -> TimeOfScan<'a, E> {
        TimeOfScan { environment: self.environment, clock: self.clock }
    }
}

/// What a program that is being executed asks of time.
#[derive(Debug)]
pub struct TimeOfScan<'a, E> {
    /// The outside of the program.
    pub environment: &'a mut E,
    clock: &'a mut Clock,
}

impl<E: Environment> TimeOfScan<'_, E> {
    /// Milliseconds since the 1 ms timers were last brought up to date, which is now.
    pub fn take_fast_ms(&mut self) -> u16 {
        self.clock.take_fast_ms(self.environment.now_ms())
    }
}
