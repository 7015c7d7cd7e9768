//! Random programs with random inputs and times, for machines that are compared with each other.

use std::ops::Range;

use awl_asm::Address;
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{AnalogInput, Area, Profile, UNO};

use crate::image::image_for;
use crate::naive::Inputs;
use crate::random::{Offer, random_inputs, random_program_of, random_step_ms};

/// Of so many random programs one is long, and how long: in instructions.
const LONG_RARITY: u32 = 10;
const LONG: Range<usize> = 220..600;
/// What random programs consist of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Programs {
    /// Instructions of the core, in one unit.
    Core,
    /// Everything that a board has.
    Everything,
    /// The same in programs that are short enough to be translated.
    Short,
}

/// How long these are.
const SHORT: Range<usize> = 5..100;

/// A random program, its text, and the generator for what happens to it.
pub fn random_image(seed: u64, programs: Programs) -> (Vec<u8>, String, Rng) {
    random_image_for(seed, programs, &UNO)
}

/// The same for a board.
pub fn random_image_for(
    seed: u64,
    programs: Programs,
    board: &'static Profile,
) -> (Vec<u8>, String, Rng) {
    let mut rng = Rng::with_seed(seed);
    // Now and then so long that jumps are far and machine code may be too large.
    let size = match programs {
        Programs::Short => rng.usize(SHORT),
        _ if rng.u32(..LONG_RARITY) == 0 => rng.usize(LONG),
        _ => rng.usize(5..LONG.start),
    };
    let offer = match programs {
        Programs::Core => Offer::core(),
        Programs::Everything | Programs::Short => Offer::board(&mut rng),
    };
    let text = random_program_of(&mut rng, size, offer);
    (image_for(&text, board), text, rng)
}

/// Runs a program with random inputs and times. Returns the number of scans; a difference is a
/// panic.
pub fn random_scans<M: Machine>(
    pair: &mut M,
    rng: &mut Rng,
    difference: impl Fn(&M) -> Option<&str>,
    place: impl Fn(u32) -> String,
) -> u64 {
    let (mut inputs, mut now_ms) = (Inputs::default(), 0);
    let count = rng.u32(3..40);
    for scan in 1..=count {
        inputs = random_inputs(rng, &inputs);
        set_inputs(pair, &inputs);
        pair.scan(now_ms);
        assert_eq!(difference(pair), None, "{}", place(scan));
        now_ms += u64::from(random_step_ms(rng));
        if pair.mode() == Mode::Stop {
            return scan.into();
        }
    }
    count.into()
}

fn set_inputs(machine: &mut impl Machine, inputs: &Inputs) {
    let bytes = (0..)
        .zip(&inputs.digital)
        .map(|(byte, &value)| (Address::Byte { area: Area::I, byte }, value.into()));
    let analog = (0..).zip(&inputs.ain);
    let analog = analog
        .map(|(channel, &counts)| (Address::Analog(AnalogInput::Raw(channel)), counts.into()));
    for (address, value) in bytes.chain(analog) {
        let written = machine.write(Operand::At(address), value);
        assert_eq!(written, Ok(()), "inputs can be set");
    }
}
