//! Measures a row of the table of instructions: the cycles it takes in many situations, with and
//! without power flow, with random bits and words and those at the ends of their ranges, with
//! timers and counters in all their states.

use std::collections::BTreeMap;

use fastrand::Rng;
use plc_isa::{M_START, PowerFlow};

use super::rows::Row;
use super::scans::Spread;
use super::{Executable, Meter, Tier, values};

impl Row {
    /// Whether it needs power flow.
    ///
    /// # Panics
    /// If its program has errors.
    pub fn is_box(&self) -> bool {
        let (text, numbers) = self.program();
        let executable = Executable::new(self.awl, &text, Tier::Interpreter);
        let selected = numbers.first().and_then(|&number| executable.assembly.code.get(number));
        selected.is_some_and(|selected| selected.op.instruction().power_flow == PowerFlow::Needed)
    }
}

/// What an instruction takes: without and with power flow, if it was executed so.
pub type ByFlow = BTreeMap<bool, Spread>;

/// Scans of a row's program, each in another situation.
const SITUATIONS: usize = 300;

/// Measures a row.
///
/// # Panics
/// If its program has errors or does not run.
pub fn measure(row: &Row, tier: Tier) -> ByFlow {
    measure_with(row, tier, row.count.map_or(0, |count| count.usual))
}

/// The same with this count.
///
/// # Panics
/// If its program has errors or does not run.
pub fn measure_with(row: &Row, tier: Tier, count: u8) -> ByFlow {
    let (text, numbers) = row.program_with(count);
    let mut meter = Meter::new(Executable::new(row.awl, &text, tier));
    meter.board.stop_clock();
    let (mut rng, mut found) = (Rng::with_seed(200), BTreeMap::<bool, Vec<u64>>::new());
    for _ in 0..SITUATIONS {
        situation(&mut meter, &mut rng);
        values::write(&mut meter, row.items, count, &mut rng);
        let execution = meter.execute();
        // What is hidden before an instruction, and after it, is part of that.
        let (mut before, mut last) = (0, None::<(_, bool)>);
        for step in &execution.steps {
            let Some(instruction) = step.instruction else { continue };
            let number = meter.executable.written(instruction);
            let is_of_row = number.is_some_and(|number| numbers.contains(&number));
            if meter.executable.is_hidden(instruction) {
                match last.filter(|(of, _)| *of == number) {
                    Some((_, flow)) if is_of_row => {
                        let taken = found.get_mut(&flow).and_then(|all| all.last_mut());
                        taken.into_iter().for_each(|taken| *taken += step.cycles);
                    }
                    Some(_) => {}
                    None => before = step.cycles,
                }
                continue;
            }
            last = Some((number, step.flow));
            let taken = std::mem::take(&mut before) + step.cycles;
            if is_of_row {
                found.entry(step.flow).or_default().push(taken);
            }
        }
    }
    // What is no machine code takes no time.
    let code = 0..meter.executable.code.len();
    let of_row = |&instruction: &usize| {
        meter.executable.written(instruction).is_some_and(|n| numbers.contains(&n))
    };
    if code.filter(of_row).all(|instruction| meter.executable.is_nothing(instruction)) {
        found.insert(true, vec![0]);
    }
    found.into_iter().map(|(flow, cycles)| (flow, Spread::of(cycles))).collect()
}

/// Words at the ends of ranges and around the constants of the programs.
const WORDS: [i16; 14] =
    [0, 1, -1, 2, 3, 4, 5, 6, 7, 500, i16::MAX, i16::MIN, i16::MAX - 500, i16::MIN + 500];

/// Bytes of M that become random words before a scan, and one with random bits after them.
const RANDOM_WORDS: u16 = 28;
const RANDOM_BITS: u16 = 30;

/// Other inputs, bits, words and time before the next scan.
pub fn situation(meter: &mut Meter, rng: &mut Rng) {
    meter.board.drive_inputs(rng.u8(..64));
    let plan = meter.executable.plan();
    let v_bytes: Vec<u16> = plan.v_ranges().flat_map(|(first, len)| first..first + len).collect();
    let words = v_bytes.chunks_exact(2).filter_map(|pair| plan.v_address(pair[0]));
    for address in (M_START..M_START + RANDOM_WORDS).step_by(2).chain(words) {
        let word = if rng.bool() { WORDS[rng.usize(..WORDS.len())] } else { rng.i16(..) };
        meter.board.write(address, &word.to_be_bytes());
    }
    meter.board.write(M_START + RANDOM_BITS, &[rng.u8(..)]);
    let ms = [0, 1, 2, 9, 10, 11, 50, 99, 100, 101, 250];
    meter.pass(ms[rng.usize(..ms.len())]);
}
