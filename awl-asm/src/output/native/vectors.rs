//! The routines of the firmware that machine code calls: where they are and how long they take.

use plc_isa::{Decoded, NATIVE_VECTORS, Op, Plan, PowerFlow, ProgramMemory, UNO};

use crate::output::cost::interpreter;
use crate::output::cycles::Cycles;

/// A routine, in the order of the vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vector {
    /// Executes a bytecode instruction.
    Bytecode,
    /// Leaves the program by STOP.
    Stop,
    /// Asks at a jump back whether the watchdog time is over.
    Loop,
    /// Leaves the program because the watchdog time is over.
    Watchdog,
    /// TON.
    Ton,
    /// TOF.
    Tof,
    /// TONR.
    Tonr,
    /// CTU.
    Ctu,
    /// CTD.
    Ctd,
    /// CTUD.
    Ctud,
}

impl Vector {
    /// Its address in flash.
    pub fn address(self) -> u16 {
        NATIVE_VECTORS + 2 * self as u16
    }

    /// Cycles from the vector to after the return, as measured on the firmware; a test holds both
    /// together. Of timers only what is left to the firmware counts: TON and TONR with power flow,
    /// TOF without.
    pub fn cycles(self) -> Cycles {
        let (min, max) = match self {
            Vector::Bytecode | Vector::Stop | Vector::Watchdog => (0, 0),
            // The watchdog is asked when a millisecond has passed since it was asked last.
            Vector::Loop => (13, 190),
            Vector::Ton => (42, 65),
            Vector::Tof => (21, 72),
            Vector::Tonr => (48, 62),
            Vector::Ctu => (36, 51),
            Vector::Ctd => (37, 52),
            Vector::Ctud => (38, 54),
        };
        Cycles { min, max }
    }
}

/// A piece of bytecode for [`Vector::Bytecode`]: an instruction, and the end after it.
pub fn piece(instruction: &[u8]) -> Vec<u8> {
    let end = Op::MainEnd.instruction().encode(&[], &UNO);
    instruction.iter().chain(end.iter().flat_map(|encoded| encoded.bytes())).copied().collect()
}

/// From the vector to the handler, and back through the end of the program after the instruction.
pub const BYTECODE: Cycles = Cycles::exactly(62);

/// Cycles that [`Vector::Bytecode`] takes more for an instruction of a bytecode image, with power
/// flow where it needs that.
pub fn bytecode_cycles<P: ProgramMemory>(
    decoded: &Decoded,
    plan: &Plan<P>,
    image: &[u8],
) -> Cycles {
    let ways = interpreter::ways(decoded, plan, image, None);
    let next = match decoded.op.instruction().power_flow {
        PowerFlow::Needed => ways.on,
        PowerFlow::Always => ways.next(),
    };
    next.unwrap_or_default()
}
