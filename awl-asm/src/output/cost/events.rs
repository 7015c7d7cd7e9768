//! How often interrupt routines are executed: the events that a program attaches, and what is known
//! of each. What a routine costs is not known here.

use std::collections::BTreeMap;

use plc_isa::{Area, Decoded, Op, Operand, Program, Reference, Referent};

use super::stated::Stated;

/// Cycles of the board in a second and in a millisecond.
pub const CYCLES_A_SECOND: u64 = 16_000_000;
const CYCLES_A_MS: u64 = CYCLES_A_SECOND / 1_000;

/// Most characters in a second, at 115200 baud.
const CHARACTERS: u64 = 11_520;

/// Cycles of an interrupt that moves a character in freeport mode, that counts an edge, and that
/// makes one of a train: docs/firmware.md.
const CHARACTER_CYCLES: u64 = 324;
const EDGE_CYCLES: u64 = 110;
const LONGEST_EDGE_CYCLES: u64 = 244;
const PULSE_CYCLES: u64 = 140;

/// From where it is known how often something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Often {
    /// A line `//# rate`: so many in a second.
    Stated(u64),
    /// Every so many milliseconds.
    Period(u64),
    /// As many characters as the serial line has in a second at 115200 baud.
    Characters,
}

impl Often {
    /// The most in so many cycles.
    pub fn most_in(self, cycles: u64) -> u64 {
        let whole = match self {
            Often::Stated(rate) => cycles.saturating_mul(rate) / CYCLES_A_SECOND,
            Often::Period(ms) => cycles / CYCLES_A_MS.saturating_mul(ms.max(1)),
            Often::Characters => cycles.saturating_mul(CHARACTERS) / CYCLES_A_SECOND,
        };
        whole.saturating_add(1)
    }
}

/// An event with the routines attached to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// Its number.
    pub number: u8,
    /// Offset of an ATCH.
    pub at: u16,
    /// The routines by their index in the image.
    pub routines: Vec<u8>,
    /// How often it is; `None`: nothing is known.
    pub often: Option<Often>,
}

/// What takes time from the whole scan: interrupts of the processor that modules bring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hardware {
    /// Offset of HDEF, PLS, XMT or RCV.
    pub at: u16,
    /// Cycles of each interrupt, and of the longest.
    pub cycles: [u64; 2],
    /// How often they are; `None`: nothing is known.
    pub often: Option<Often>,
}

/// The events that a program attaches, by their numbers.
pub fn events(program: &Program<&[u8]>, code: &[(u16, Decoded)], stated: &Stated) -> Vec<Event> {
    let mut events: BTreeMap<u8, Event> = BTreeMap::new();
    for (at, decoded) in code.iter().filter(|(_, decoded)| decoded.op == Op::Atch) {
        let operands: Vec<Operand> = decoded.operands().map(|(_, operand)| operand).collect();
        let &[Operand::Number(routine), Operand::Number(index)] = operands.as_slice() else {
            continue;
        };
        let number = program.plan().event(index);
        let often = stated.rate(*at).map(Often::Stated);
        let new = || Event { number, at: *at, routines: Vec::new(), often: None };
        let event = events.entry(number).or_insert_with(new);
        event.routines.push(routine);
        // Of two promises the larger one holds for both.
        event.often = match (event.often, often) {
            (Some(Often::Stated(one)), Some(Often::Stated(other))) => {
                Some(Often::Stated(one.max(other)))
            }
            (one, other) => one.or(other),
        };
    }
    let known = |mut event: Event| {
        event.often = event.often.or_else(|| derived(program, code, event.number));
        event
    };
    events.into_values().map(known).collect()
}

/// What the program itself says of how often an event is.
fn derived(program: &Program<&[u8]>, code: &[(u16, Decoded)], event: u8) -> Option<Often> {
    match event {
        10 | 11 => Some(Often::Period(period(program, code, event - 10))),
        // A timer of 1 ms ends once in a millisecond at most.
        21 | 22 => Some(Often::Period(1)),
        8 | 9 | 23..=26 => Some(Often::Characters),
        _ => None,
    }
}

/// The shortest period of a timed interrupt in milliseconds: the least constant that is moved to
/// SMB34 or SMB35, 1 where anything else is.
fn period(program: &Program<&[u8]>, code: &[(u16, Decoded)], timer: u8) -> u64 {
    let place = program.plan().byte_address(Area::Sm, 34 + u16::from(timer));
    let moved = code.iter().filter_map(|(_, decoded)| {
        let [from, to] = [0, 1].map(|number| decoded.operands().nth(number).map(|one| one.1));
        let is_there = place.is_some() && to.and_then(address) == place;
        is_there.then(|| match (decoded.op, from.and_then(constant)) {
            (Op::Movb | Op::MovbAny, Some(ms)) => ms.max(1),
            _ => 1,
        })
    });
    moved.min().unwrap_or(1)
}

fn address(operand: Operand) -> Option<u16> {
    match operand {
        Operand::Memory(at) => Some(at),
        Operand::Reference(reference) => match reference.place()? {
            Referent::Direct(at) => Some(at),
            _ => None,
        },
        _ => None,
    }
}

fn constant(operand: Operand) -> Option<u64> {
    match operand {
        Operand::Constant(value) => Some(value.into()),
        Operand::Reference(reference) => of_reference(reference),
        _ => None,
    }
}

fn of_reference(reference: Reference) -> Option<u64> {
    match reference.place()? {
        Referent::Constant(value) => u64::try_from(value).ok(),
        _ => None,
    }
}

/// The interrupts of the processor that instructions enable.
pub fn hardware(code: &[(u16, Decoded)], stated: &Stated) -> Vec<Hardware> {
    let mut found = Vec::new();
    for &(at, ref decoded) in code {
        let rate = stated.rate(at).map(Often::Stated);
        let (cycles, often) = match decoded.op {
            Op::Hdef => ([EDGE_CYCLES, LONGEST_EDGE_CYCLES], rate),
            Op::Pls => ([PULSE_CYCLES; 2], rate),
            Op::Xmt | Op::Rcv => ([CHARACTER_CYCLES; 2], Some(Often::Characters)),
            _ => continue,
        };
        // The line sends or receives.
        let is_line = |one: &Hardware| one.often == Some(Often::Characters);
        if often != Some(Often::Characters) || !found.iter().any(is_line) {
            found.push(Hardware { at, cycles, often });
        }
    }
    found
}
