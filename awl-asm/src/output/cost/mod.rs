//! What a program costs on the board: cycles of every instruction, interpreted and translated, and
//! of the longest scan. Nothing is executed; `tests/tests/cost.rs` holds the figures against the
//! simulated board.

mod events;
pub mod interpreter;
mod longest;
mod loops;
mod modules;
mod path;
mod stated;
pub mod typical;
mod ways;

pub use interpreter::of_form;
use plc_isa::{Area, Decoded, Op, Plan, PowerFlow, TimerResolution, timer_resolution, verify};

pub use crate::output::cycles::Cycles;
use crate::output::native::{BYTECODE, Translated, TranslatedInstruction, Vector, translate};
pub use events::Often;
use longest::{Analysis, Beside, Tier};
pub use longest::{Assumption, Longest, Missing};
pub use stated::Stated;
pub use ways::Ways;
use ways::is_fast;

/// Cycles in a microsecond.
pub const CYCLES_PER_US: u32 = 16;

/// From entering the engine to the first instruction of machine code, and from its return to the
/// engine's end.
pub const NATIVE_START: u32 = 58;
/// See [`NATIVE_START`].
pub const NATIVE_END: u32 = 47;

/// Most cycles that a scan takes beside its program: inputs, system bits, self-test, outputs, the
/// interrupts of a scan that is shorter than a millisecond. Not the first scan after RUN, and none
/// in which the serial line is answered.
const OVERHEAD_MAX: u32 = 4_000;
/// More of them for each millisecond that the scan takes: the clock's interrupt.
const OVERHEAD_EACH_MS: u32 = 400;
/// From the vector to the look for events of bytecode and back, with a byte stored and loaded for
/// each that is in a register: machine code.
const NATIVE_LOOK: u32 = 60;
const NATIVE_LOOK_PIN: u32 = 4;
/// More of them for each timer of the program: of 100 ms, and of 1 and 10 ms, which advance at the
/// start of a scan.
const OVERHEAD_TIMER_MAX: u32 = 20;
const OVERHEAD_ADVANCE_MAX: u32 = 700;
/// More of them when values are retained, for each byte of these, and for each counter among them.
const OVERHEAD_RETENTION_MAX: u32 = 2_500;
const OVERHEAD_RETAINED_MAX: u32 = 14;
const OVERHEAD_COUNTER_MAX: u32 = 310;

/// An instruction with what it costs.
#[derive(Debug, Clone, Copy)]
pub struct InstructionCost {
    /// Its offset in the bytecode image.
    pub at: u16,
    /// Interpreted.
    pub interpreted: Ways,
    /// Translated; `None` where the program is not translated, or nothing is known of the
    /// instruction.
    pub translated: Option<Ways>,
}

/// What a program costs.
#[derive(Debug, Clone)]
pub struct ProgramCost {
    /// Its instructions in order, the hidden ones and the end of the program too.
    pub instructions: Vec<InstructionCost>,
    /// The longest scan's program, interpreted.
    pub interpreted: Longest,
    /// The same translated.
    pub translated: Option<Longest>,
    /// Whether there are instructions of modules, whose most was seen with values as programs have
    /// them: the longest scan has a tenth more of each.
    pub is_typical: bool,
}

/// What the program of an image costs when nothing is stated of it; `None` for an image that is not
/// valid, or for no board.
pub fn cost(image: &[u8]) -> Option<ProgramCost> {
    cost_with(image, &Stated::default())
}

/// The same with what its text states.
pub fn cost_with(image: &[u8], stated: &Stated) -> Option<ProgramCost> {
    let program = verify(image).ok()?;
    let plan = program.plan();
    if plan.profile().native_interface == 0 {
        return None;
    }
    let code: Vec<(u16, Decoded)> = program.all_instructions().collect();
    let interpreted: Vec<Ways> =
        code.iter().map(|(_, decoded)| interpreter::ways(decoded, plan, image, None)).collect();
    let translated = translate(image).ok();
    let native = translated.as_ref().map(|translated| native_ways(translated, plan, &code));
    let instructions = code.iter().enumerate().map(|(index, &(at, _))| InstructionCost {
        at,
        interpreted: interpreted.get(index).copied().unwrap_or_default(),
        translated: native
            .as_ref()
            .and_then(|ways| ways.get(index).copied())
            .filter(|ways| ways.is_known()),
    });
    let analysis = Analysis::new(&program, &code, stated);
    let beside = Beside {
        overhead: overhead(plan),
        overhead_each_ms: OVERHEAD_EACH_MS,
        each_ms: interpreter::EACH_MS
            + interpreter::EACH_MS_AND_TIMER * u32::from(plan.header.timers),
        each_ms_looking: interpreter::EACH_MS_LOOKING,
        event: interpreter::EVENT,
        period: u64::from(plan.header.settings.scan_ms) * 1_000 * u64::from(CYCLES_PER_US),
    };
    let longest = |start: u32, ways: &[Ways], look: u32, back: u32| {
        analysis.longest(Tier { start, ways, in_interrupts: &interpreted, look, back }, beside)
    };
    let of_native = translated.as_ref().zip(native.as_ref()).map(|(translated, ways)| {
        let polls = code.iter().zip(&interpreted);
        let poll = polls.filter(|((_, decoded), _)| decoded.op == Op::Poll);
        let poll = poll.map(|(_, ways)| ways.next().unwrap_or_default().max).max().unwrap_or(0);
        let pins = NATIVE_LOOK_PIN * translated.pinned.len() as u32;
        let look = NATIVE_LOOK + BYTECODE.max + pins + poll;
        // That a millisecond has passed is found once in each.
        let asks = Vector::Loop.cycles();
        longest(NATIVE_START + translated.start.max, ways, look, asks.max - asks.min)
    });
    Some(ProgramCost {
        instructions: instructions.collect(),
        interpreted: longest(interpreter::START, &interpreted, 0, 0),
        translated: of_native,
        is_typical: code.iter().any(|(_, decoded)| decoded.op.instruction().module().is_some()),
    })
}

fn overhead(plan: &Plan<&[u8]>) -> u32 {
    let timers = plan.timers().map(|slot| match timer_resolution(slot.number) {
        TimerResolution::Ms100 => OVERHEAD_TIMER_MAX,
        TimerResolution::Ms1 | TimerResolution::Ms10 => OVERHEAD_ADVANCE_MAX,
    });
    let retained = plan.retained().map(|range| {
        let each = if range.area == Area::C { OVERHEAD_COUNTER_MAX } else { OVERHEAD_RETAINED_MAX };
        each * u32::from(range.count)
    });
    let retention = if plan.header.retained > 0 { OVERHEAD_RETENTION_MAX } else { 0 };
    OVERHEAD_MAX + timers.sum::<u32>() + retention + retained.sum::<u32>()
}

/// The ways on from each instruction that is translated; those of interrupt routines are not. What
/// leaves the program takes the engine's way out, too.
fn native_ways(translated: &Translated, plan: &Plan<&[u8]>, code: &[(u16, Decoded)]) -> Vec<Ways> {
    let ways = |(at, decoded): &(u16, Decoded)| {
        let instructions = &translated.instructions;
        let found = instructions.binary_search_by_key(at, |instruction| instruction.at);
        found.map_or_else(
            |_| Ways::default(),
            |index| native_way(&instructions[index], plan, decoded),
        )
    };
    code.iter().map(ways).collect()
}

fn native_way(instruction: &TranslatedInstruction, plan: &Plan<&[u8]>, decoded: &Decoded) -> Ways {
    let leaves = matches!(decoded.op, Op::MainEnd | Op::End | Op::Stop);
    let end = Cycles::exactly(if leaves { NATIVE_END } else { 0 });
    let away = instruction.taken.map(|away| away.then(end));
    let next = instruction.not_taken;
    // The shortest way is that of an instruction that has nothing to do; to branch over it takes
    // two cycles.
    let least = next.map(|next| Cycles { min: next.min, max: next.min.max(2) });
    match (decoded.op.instruction().power_flow, decoded.op) {
        (PowerFlow::Needed, _) => Ways { off: least, on: next, away },
        // The other input of a timer is handled in place, except by the firmware for those of 1 ms.
        (_, Op::Ton | Op::Tonr) if !is_fast(plan, decoded) => Ways { off: least, on: next, away },
        (_, Op::Tof) if !is_fast(plan, decoded) => Ways { off: next, on: least, away },
        _ => Ways { off: next, on: next, away },
    }
}
