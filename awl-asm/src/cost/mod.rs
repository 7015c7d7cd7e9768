//! What a program costs on the board: cycles of every instruction, interpreted and translated, and of the longest scan.
//! Nothing is executed; `tests/tests/cost.rs` holds the figures against the simulated board.

pub mod interpreter;
mod longest;
mod modules;
pub mod typical;

pub use interpreter::of_form;
use plc_isa::{Area, Decoded, Op, Operand, Plan, PowerFlow, ProgramMemory, TimerResolution, timer_resolution, verify};

pub use crate::native::Cycles;
use crate::native::{Translated, TranslatedInstruction, either, translate};
pub use longest::Longest;

/// Cycles in a microsecond.
pub const CYCLES_PER_US: u32 = 16;

/// From entering the engine to the first instruction of machine code, and from its return to the engine's end.
pub const NATIVE_START: u32 = 58;
/// See [`NATIVE_START`].
pub const NATIVE_END: u32 = 47;

/// Most cycles that a scan takes beside its program: inputs, system bits, self-test, outputs, the interrupts of a scan
/// that is shorter than a millisecond. Not the first scan after RUN, and none in which the serial line is answered.
const OVERHEAD_MAX: u32 = 4_000;
/// More of them for each timer of the program: of 100 ms, and of 1 and 10 ms, which advance at the start of a scan.
const OVERHEAD_TIMER_MAX: u32 = 20;
const OVERHEAD_ADVANCE_MAX: u32 = 700;
/// More of them when values are retained, for each byte of these, and for each counter among them.
const OVERHEAD_RETENTION_MAX: u32 = 2_500;
const OVERHEAD_RETAINED_MAX: u32 = 14;
const OVERHEAD_COUNTER_MAX: u32 = 310;

/// The ways on from an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Ways {
    /// To the next instruction, without power flow.
    pub off: Option<Cycles>,
    /// To the next instruction, with power flow.
    pub on: Option<Cycles>,
    /// To elsewhere: a jump that is taken, FOR that is skipped, NEXT that goes back, the end of the program.
    pub away: Option<Cycles>,
}

impl Ways {
    /// To the next instruction, with power flow or without.
    pub fn next(self) -> Option<Cycles> {
        either(self.off, self.on)
    }

    /// Whether there are figures: they are missing for instructions that have not been measured.
    pub fn is_known(self) -> bool {
        self != Ways::default()
    }

    /// The least and the most of all.
    pub fn all(self) -> Cycles {
        either(self.next(), self.away).unwrap_or_default()
    }
}

/// An instruction with what it costs.
#[derive(Debug, Clone, Copy)]
pub struct InstructionCost {
    /// Its offset in the bytecode image.
    pub at: u16,
    /// Interpreted.
    pub interpreted: Ways,
    /// Translated; `None` where the program is not translated, or nothing is known of the instruction.
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
    /// What a scan takes beside it at most.
    pub overhead: u32,
    /// Whether there are instructions of modules, whose most was seen with values as programs have them: other values
    /// can take longer.
    pub is_typical: bool,
}

/// What the program of an image costs; `None` for an image that is not valid.
pub fn cost(image: &[u8]) -> Option<ProgramCost> {
    let program = verify(image).ok()?;
    let code: Vec<(u16, Decoded)> = program.instructions().collect();
    let interpreted: Vec<Ways> =
        code.iter().map(|(_, decoded)| interpreter::ways(decoded, program.plan(), image, None)).collect();
    let translated = translate(image).ok();
    let mut native = translated.as_ref().map(|translated| native_ways(translated, program.plan(), &code));
    // What the firmware executes for machine code costs what it costs the interpreter.
    for (native, _) in native.iter_mut().flatten().zip(&interpreted).filter(|(_, interpreted)| !interpreted.is_known())
    {
        *native = Ways::default();
    }
    let instructions = code.iter().enumerate().map(|(index, &(at, _))| InstructionCost {
        at,
        interpreted: interpreted.get(index).copied().unwrap_or_default(),
        translated: native.as_ref().and_then(|ways| ways.get(index).copied()).filter(|ways| ways.is_known()),
    });
    let timers = u32::from(program.plan().header.timers);
    let longest = |start: u32, ways: &[Ways]| {
        let each_ms = interpreter::EACH_MS + interpreter::EACH_MS_AND_TIMER * timers;
        longest::longest(&program, &code, start, each_ms, ways)
    };
    Some(ProgramCost {
        instructions: instructions.collect(),
        interpreted: longest(interpreter::START, &interpreted),
        translated: translated
            .as_ref()
            .zip(native.as_ref())
            .map(|(translated, ways)| longest(NATIVE_START + translated.start.max, ways)),
        overhead: overhead(program.plan()),
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

/// The ways on from each translated instruction. What leaves the program takes the engine's way out, too.
fn native_ways(translated: &Translated, plan: &Plan<&[u8]>, code: &[(u16, Decoded)]) -> Vec<Ways> {
    let ways = |(instruction, (_, decoded)): (&TranslatedInstruction, &(u16, Decoded))| {
        let leaves = matches!(decoded.op, Op::MainEnd | Op::End | Op::Stop);
        let end = Cycles::exactly(if leaves { NATIVE_END } else { 0 });
        let away = instruction.taken.map(|away| away.then(end));
        let next = instruction.not_taken;
        // The shortest way is that of an instruction that has nothing to do; to branch over it takes two cycles.
        let least = next.map(|next| Cycles { min: next.min, max: next.min.max(2) });
        match (decoded.op.instruction().power_flow, decoded.op) {
            (PowerFlow::Needed, _) => Ways { off: least, on: next, away },
            // The other input of a timer is handled in place, except by the firmware for those of 1 ms.
            (_, Op::Ton | Op::Tonr) if !is_fast(plan, decoded) => Ways { off: least, on: next, away },
            (_, Op::Tof) if !is_fast(plan, decoded) => Ways { off: next, on: least, away },
            _ => Ways { off: next, on: next, away },
        }
    };
    translated.instructions.iter().zip(code).map(ways).collect()
}

/// Whether an instruction is that of a timer of 1 ms.
fn is_fast<P: ProgramMemory>(plan: &Plan<P>, decoded: &Decoded) -> bool {
    match (decoded.op, decoded.operands().next()) {
        (Op::Ton | Op::Tof | Op::Tonr, Some((_, Operand::Number(slot)))) => {
            timer_resolution(plan.timer(slot).number) == TimerResolution::Ms1
        }
        _ => false,
    }
}
