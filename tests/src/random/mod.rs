//! Random valid AWL programs, and random inputs and times to run them with. Judges no result.
//!
//! Which instructions exist and which operands they take is read from the instruction table, so a
//! new row takes part without a change here. Addresses come from small pools, so that the
//! instructions of a program meddle with each other: words overlap, coils and boxes write the same
//! bytes. Every program ends its scan soon when run with [`random_inputs`].
//!
//! Some of V memory is apart, so that comparisons of strings and reals find strings and numbers
//! there: see `values.rs`.

mod constants;
mod interrupts;
mod lines;
mod loops;
mod offer;
mod operand_text;
mod operands;
mod pointers;
mod sequence;
mod structure;
mod subroutine;
mod units;
mod values;

use fastrand::Rng;
use plc_isa::{AnalogInput, INSTRUCTIONS, Instruction, Kind, Op, TimerFamily, timer_family};

use crate::naive::Inputs;
pub use interrupts::random_interrupts;
pub use offer::Offer;
use operand_text::Extent;
use subroutine::{Local, Subroutine};

/// Most passes that nested loops make together.
const PASSES_MAX: u32 = 200;
/// Most instructions that a scan executes, roughly.
const WORK_MAX: u32 = 20_000;
/// Deepest nesting of FOR.
const LOOPS_MAX: usize = 3;
/// Most EU and ED in a program.
const EDGES_MAX: u32 = 200;

/// The timers of a program are some of these: all resolutions of both families, with neighbours for
/// R.
const TIMERS: [u8; 28] = [
    0, 1, 4, 5, 6, 31, 64, 65, 68, 69, 95, 32, 33, 34, 35, 36, 37, 38, 63, 96, 97, 98, 100, 101,
    102, 103, 254, 255,
];
/// The counters of a program are some of these.
const COUNTERS: [u8; 10] = [0, 1, 2, 3, 7, 8, 9, 100, 254, 255];

/// A valid program of about `size` instructions of the core, in one unit, or fewer where the code
/// would get too long.
pub fn random_program(rng: &mut Rng, size: usize) -> String {
    random_program_of(rng, size, Offer::core())
}

/// The same with what is offered.
pub fn random_program_of(rng: &mut Rng, size: usize, offer: Offer) -> String {
    let mut generator = Generator::new(rng, size, offer);
    generator.whole_program();
    generator.text
}

/// The inputs of the scan after `previous`: bits of IB0 to IB2 and IB15 toggle now and then, analog
/// values jump now and then. IB10 and IB11 stay 0 and Ain5 stays below 2, because loops of the
/// random programs end there.
pub fn random_inputs(rng: &mut Rng, previous: &Inputs) -> Inputs {
    let mut inputs = previous.clone();
    for (byte, rarity) in [(0, 6), (1, 12), (2, 60), (15, 20)] {
        for bit in 0..8 {
            if rng.u32(..rarity) == 0 {
                inputs.digital[byte] ^= 1 << bit;
            }
        }
    }
    for (channel, raw) in inputs.ain.iter_mut().enumerate() {
        let max = if channel == 5 { 1 } else { 1023 };
        *raw = match rng.u32(..40) {
            0 => 0,
            1 => max,
            2..=4 => rng.u16(..=max),
            5..=12 => (*raw + 1).min(max),
            13..=20 => raw.saturating_sub(1),
            _ => *raw,
        };
        inputs.aiw[channel] = AnalogInput::scale(*raw);
    }
    inputs
}

/// Milliseconds from one scan start to the next.
pub fn random_step_ms(rng: &mut Rng) -> u32 {
    match rng.u32(..100) {
        0..=4 => 0,
        5..=79 => rng.u32(1..=20),
        80..=91 => rng.u32(95..=105),
        92..=97 => 250,
        _ => 2000,
    }
}

struct Generator<'a> {
    rng: &'a mut Rng,
    offer: Offer,
    text: String,
    german: bool,
    networks: u32,
    has_networks: bool,
    may_stop: bool,
    /// Instructions still wanted.
    wanted: usize,
    code_len: u32,
    work: u32,
    edges: u32,
    /// Levels of the logic stack that are certainly in use.
    depth: u8,
    /// Passes of the loops around, multiplied.
    passes: u32,
    loops: usize,
    /// Words that loops around depend on.
    protected: Vec<Extent>,
    /// Labels that will be further down, outside of every loop that is opened from now on.
    open_labels: Vec<u8>,
    unused_labels: Vec<u8>,
    /// Which instruction owns a timer or counter.
    timers: Vec<(u8, Op)>,
    counters: Vec<(u8, Op)>,
    /// The subroutines, the last first: each calls only those that are here already.
    subroutines: Vec<Subroutine>,
    /// Local variables of the subroutine that is being written.
    locals: Vec<Local>,
    is_main: bool,
    /// Segments of the sequence: as many as the S bits from S0.0 on.
    segments: u8,
}

fn takes(instruction: &Instruction, kind: Kind) -> bool {
    instruction.forms.iter().any(|form| form.kinds.contains(&kind))
}

fn family_of(op: Op) -> TimerFamily {
    if op == Op::Tonr { TimerFamily::Tonr } else { TimerFamily::TonTof }
}

impl<'a> Generator<'a> {
    fn new(rng: &'a mut Rng, size: usize, offer: Offer) -> Self {
        let mut unused_labels: Vec<u8> = (0..=255).collect();
        rng.shuffle(&mut unused_labels);
        let timers = owners(rng, &TIMERS, Kind::TimerSlot, |op, number| {
            family_of(op) == timer_family(number)
        });
        let counters = owners(rng, &COUNTERS, Kind::CounterSlot, |_, _| true);
        Generator {
            german: rng.u32(..6) == 0,
            has_networks: rng.u32(..5) != 0,
            may_stop: rng.u32(..12) == 0,
            rng,
            text: String::new(),
            networks: 0,
            wanted: size,
            code_len: 0,
            work: 0,
            edges: 0,
            depth: 0,
            passes: 1,
            loops: 0,
            protected: Vec::new(),
            open_labels: Vec::new(),
            unused_labels,
            timers,
            counters,
            subroutines: Vec::new(),
            locals: Vec::new(),
            is_main: true,
            segments: 0,
            offer,
        }
    }

    fn one_in(&mut self, n: u32) -> bool {
        self.rng.u32(..n) == 0
    }

    fn is_full(&self) -> bool {
        self.wanted == 0 || self.code_len >= self.offer.code_len_max() || self.work >= WORK_MAX
    }
}

/// Gives most of the numbers an instruction that works with such a slot.
fn owners(
    rng: &mut Rng,
    numbers: &[u8],
    slot: Kind,
    fits: impl Fn(Op, u8) -> bool,
) -> Vec<(u8, Op)> {
    let mut owners = Vec::new();
    for &number in numbers {
        let ops = INSTRUCTIONS
            .iter()
            .filter(|row| takes(row, slot) && fits(row.op, number))
            .map(|row| row.op);
        if let Some(op) = rng.choice(ops.collect::<Vec<_>>())
            && rng.u32(..3) != 0
        {
            owners.push((number, op));
        }
    }
    owners
}

#[cfg(test)]
mod tests;
