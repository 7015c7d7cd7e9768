//! What the assembler says that a program costs, against the board: all examples, the benchmark
//! programs, random programs, interpreted and translated.
//!
//! A prediction is never too low: neither that of an instruction, nor that of the longest scan. Of
//! a program without loops and jumps it is at most 15 % too high: that is, the sum of the longest
//! that each instruction can take on the ways on which it was seen is compared with the sum of the
//! longest that it was seen to take. All timers do not end in the same scan, so that no single scan
//! is that long. Programs whose instructions take their time by values are left out of this.
//!
//! `RANDOM_PROGRAMS=1000 cargo test --package tests --features uno --test cost` runs longer,
//! `RANDOM_SEED` starts elsewhere.
#![cfg(feature = "uno")]

use std::collections::BTreeMap;

use awl_asm::assemble::assemble;
use awl_asm::cost::{self, Longest, ProgramCost, Ways, interpreter};
use awl_asm::native::translate;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{Decoded, Kind, Op, verify};
use tests::bench_board::BenchBoard;
use tests::case::Case;
use tests::effort::effort;
use tests::measure::{Executable, Execution, Meter, Step, Tier};
use tests::programs;
use tests::random::random_program;

/// Share by which a prediction may be too high.
const TOO_HIGH: f64 = 0.15;
/// Scans of each program.
const SCANS: usize = 40;

/// A program with its prediction on a board.
struct Predicted {
    name: String,
    meter: Meter,
    cost: ProgramCost,
    /// Cycles before the first instruction.
    start: u64,
}

/// An instruction over many scans: its longest, predicted and measured, and whether power flowed in
/// one of them.
#[derive(Default, Clone, Copy)]
struct Seen {
    predicted: u64,
    taken: u64,
    on: bool,
}

impl Predicted {
    /// `None` for a program that is too large to be translated.
    fn new(name: &str, text: &str, tier: Tier) -> Option<Predicted> {
        let bytecode = Executable::new(name, text, Tier::Interpreter).bytecode;
        let translated = translate(&bytecode).ok();
        if tier != Tier::Interpreter && translated.is_none() {
            return None;
        }
        let cost = cost::cost(&bytecode).expect("an image of the assembler is valid");
        let start = match (tier, translated) {
            (Tier::Native { .. }, Some(translated)) => cost::NATIVE_START + translated.start.max,
            _ => interpreter::START,
        };
        let meter = Meter::new(Executable::new(name, text, tier));
        meter.board.runs().then_some(())?;
        Some(Predicted { name: format!("{name}, {tier}"), meter, cost, start: start.into() })
    }

    /// The ways on from an instruction; in bytecode from one that reads a count in the scan, with
    /// that.
    fn ways(&self, instruction: usize, count: Option<u8>) -> Ways {
        let (cost, executable) = (&self.cost.instructions[instruction], &self.meter.executable);
        let (_, decoded) = &executable.code[instruction];
        match (executable.tier, count) {
            (Tier::Interpreter, Some(count)) => interpreter::ways(
                decoded,
                &executable.plan(),
                &executable.bytecode,
                Some(count.into()),
            ),
            (Tier::Interpreter, None) => cost.interpreted,
            // The byte may be in a register, where nobody sees it.
            _ => cost.translated.expect("the program is translated"),
        }
    }

    /// What a step should take at most, and what it took.
    fn step(&self, step: &Step, next: Option<usize>) -> (u64, u64) {
        let Some(instruction) = step.instruction else { return (self.start, step.cycles) };
        let ways = self.ways(instruction, step.count);
        // What is no machine code is no step: the next one may be further on.
        let follows = next.is_some_and(|next| {
            next > instruction
                && (instruction + 1..next).all(|between| self.meter.executable.is_nothing(between))
        });
        let next = if step.flow { ways.on } else { ways.off };
        let way = if follows { next.or(ways.away) } else { ways.away.or(next) };
        (u64::from(way.unwrap_or_default().max), step.cycles)
    }

    /// Compares a scan, and enters the longest of each instruction, predicted and measured.
    fn compare(&self, execution: &Execution, longest: &mut BTreeMap<Option<usize>, Seen>) {
        let steps = &execution.steps;
        for (index, step) in steps.iter().enumerate() {
            let (most, taken) =
                self.step(step, steps.get(index + 1).and_then(|next| next.instruction));
            // Jumps back take longer when time has passed: what that adds is in the prediction of
            // the whole.
            let is_exact = self.is_straight();
            let instruction = step.instruction.map(|number| self.meter.executable.code[number].1);
            assert!(
                !is_exact || taken <= most,
                "{}: {instruction:?} took {taken}, not {most}, {step:?}",
                self.name
            );
            let entry = longest.entry(step.instruction).or_default();
            *entry = Seen {
                predicted: entry.predicted.max(most),
                taken: entry.taken.max(taken),
                on: entry.on | step.flow,
            };
        }
        let longest = self.longest();
        assert!(
            !longest.is_known() || execution.program <= longest.program,
            "{}: {} > {longest:?}",
            self.name,
            execution.program
        );
    }

    fn longest(&self) -> &Longest {
        match self.meter.executable.tier {
            Tier::Interpreter => &self.cost.interpreted,
            Tier::Native { .. } => self.cost.translated.as_ref().expect("it is translated"),
        }
    }

    fn is_straight(&self) -> bool {
        let jumps = [Op::Jmp, Op::For, Op::Next, Op::End, Op::Stop];
        self.meter.executable.code.iter().all(|(_, decoded)| !jumps.contains(&decoded.op))
    }

    /// Whether its prediction must be near what was measured.
    fn is_judged(&self) -> bool {
        self.is_straight() && !self.depends_on_values()
    }

    /// Whether instructions take longer or shorter by the values that they read: a range by its
    /// count, a division by its divisor. What random programs have there is no measure.
    fn depends_on_values(&self) -> bool {
        let reads_count = |decoded: &Decoded| {
            let is_range =
                matches!(decoded.op, Op::Set | Op::Reset | Op::ResetTimers | Op::ResetCounters);
            is_range && decoded.operands().any(|(kind, _)| kind == Kind::Byte)
        };
        let mut code = self.meter.executable.code.iter();
        code.any(|(_, decoded)| decoded.op == Op::DivInt || reads_count(decoded))
    }

    /// Runs scans with any inputs and times. Returns by how much the prediction is too high.
    fn run(&mut self, rng: &mut Rng) -> f64 {
        self.meter.board.stop_clock();
        let mut longest: BTreeMap<Option<usize>, Seen> = BTreeMap::new();
        for _ in 0..SCANS {
            self.meter.board.drive_inputs(rng.u8(..64));
            self.meter.pass(rng.u32(..120));
            let execution = self.meter.execute();
            self.compare(&execution, &mut longest);
        }
        // An off-delay that was never on has nothing to do.
        let is_asleep = |number: usize, seen: &Seen| {
            self.meter.executable.code[number].1.op == Op::Tof && !seen.on
        };
        longest.retain(|number, seen| number.is_none_or(|number| !is_asleep(number, seen)));
        let predicted: u64 = longest.values().map(|seen| seen.predicted).sum();
        let measured: u64 = longest.values().map(|seen| seen.taken).sum();
        predicted as f64 / measured as f64 - 1.0
    }
}

const TIERS: [Tier; 2] = [Tier::Interpreter, Tier::Native { pins: true }];

fn assert_near(predicted: &mut Predicted, rng: &mut Rng) -> f64 {
    let worst = predicted.run(rng);
    if !predicted.is_judged() {
        return 0.0;
    }
    assert!(
        worst <= TOO_HIGH,
        "{}: the prediction is {:.1} % too high",
        predicted.name,
        100.0 * worst
    );
    worst
}

/// The examples of which every instruction has a price: without modules and routines.
fn examples() -> impl Iterator<Item = (String, String)> {
    let is_priced = |text: &str| -> Option<()> {
        let source = Source::new("example", text).ok()?;
        let image = assemble(&source, Vec::new()).image?;
        let header = verify(image.as_slice()).ok()?.plan().header;
        let is_known = cost::cost(&image)?
            .instructions
            .iter()
            .all(|instruction| instruction.interpreted.is_known());
        (header.modules_len == 0 && header.routines == 0 && is_known).then_some(())
    };
    let examples = Case::examples().into_iter().map(|case| (case.file, case.awl));
    examples.filter(move |(_, text)| is_priced(text).is_some())
}

#[test]
fn examples_cost_what_the_assembler_says() {
    let benchmarks = [
        ("80/20", programs::eighty_twenty()),
        ("boolean", programs::boolean()),
        ("mix", programs::mix()),
    ];
    let benchmarks = benchmarks.into_iter().map(|(name, text)| (name.to_string(), text));
    let mut rng = Rng::with_seed(4);
    for (name, text) in examples().chain(benchmarks) {
        for tier in TIERS {
            let mut predicted =
                Predicted::new(&name, &text, tier).expect("examples are small enough");
            let worst = assert_near(&mut predicted, &mut rng);
            println!("{}: at most {:.1} % too high", predicted.name, 100.0 * worst);
        }
    }
}

/// The text without jumps, loops and divisions, if that is a program.
fn straight(text: &str) -> Option<String> {
    let left_out = ["JMP", "LBL", "FOR", "NEXT", "END", "STOP", "/I"];
    let stays =
        |line: &&str| !left_out.contains(&line.split_whitespace().next().unwrap_or_default());
    let text: String = text.lines().filter(stays).map(|line| format!("{line}\n")).collect();
    let source = Source::new("straight", &*text).ok()?;
    assemble(&source, Vec::new()).image.map(|_| text)
}

#[test]
fn random_programs_cost_what_the_assembler_says() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 150));
    let (mut near, mut worst) = (0, 0.0f64);
    for seed in first..first + count {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(20..150);
        let text = random_program(&mut rng, size);
        let straight = straight(&text);
        for (text, tier) in
            [Some(text), straight].iter().flatten().flat_map(|text| TIERS.map(|tier| (text, tier)))
        {
            let Some(mut predicted) = Predicted::new(&format!("seed {seed}"), text, tier) else {
                continue;
            };
            near += u64::from(predicted.is_judged());
            worst = worst.max(assert_near(&mut predicted, &mut rng));
        }
    }
    println!("{count} programs, {near} times straight on, at most {:.1} % too high", 100.0 * worst);
    assert!(near > count / 5, "hardly any program without jumps");
}

/// Routines with parameters, segments, and hidden instructions.
const UNITS: [(&str, &str); 3] = [
    (
        "analog outputs",
        "LD I0.0\nMOVW VW0, AQW0\nLD I0.1\nMOVW VW2, AQW2\nLD SM0.0\n+I 1007, VW0\n-I 777, VW2\n",
    ),
    (
        "routines",
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD I0.0\nCALL SBR0, VW0, I0.1, VW2\nLD SM0.0\n\
            CALL SBR1\nEND_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK A:SBR0\nVAR_INPUT\na:INT;\n\
            b:BOOL;\nEND_VAR\nVAR_OUTPUT\nc:INT;\nEND_VAR\nBEGIN\nLD SM0.0\nMOVW #a, #c\n\
            LD #b\n+I 1, #c\nCALL SBR1\nEND_SUBROUTINE_BLOCK\nSUBROUTINE_BLOCK B:SBR1\n\
            BEGIN\nLD SM0.0\nINCW VW8\nLD I0.2\nCRET\nLD SM0.0\nDECW VW8\n\
            END_SUBROUTINE_BLOCK\n",
    ),
    (
        "segments",
        "LD SM0.1\nS S0.0, 1\nLSCR S0.0\nLD I0.0\nO I0.1\nSCRT S0.1\nSCRE\nLSCR S0.1\n\
            LD I0.2\nCSCRE\nLDN I0.0\nSCRT S0.0\nSCRE\n",
    ),
];

#[test]
fn instructions_of_units_cost_what_the_assembler_says() {
    let mut rng = Rng::with_seed(5);
    for ((name, text), tier) in UNITS.into_iter().flat_map(|one| TIERS.map(|tier| (one, tier))) {
        let mut predicted = Predicted::new(name, text, tier).expect("it is small enough");
        predicted.run(&mut rng);
    }
}

/// Programs that have much beside their instructions: timers of each resolution, and retained
/// values.
fn demanding() -> Vec<(String, String)> {
    let timers = |numbers: &[u8]| -> String {
        numbers.iter().map(|n| format!("LD SM0.0\nTON T{n}, 30000\n")).collect()
    };
    let slow: Vec<u8> = (101..=140).collect();
    [
        ("timers of 100 ms", timers(&slow)),
        ("timers of 10 ms", timers(&[33, 34, 35, 36, 97, 98, 99, 100])),
        ("timers of 1 ms", timers(&[32, 96])),
        ("timers of all", timers(&[[32, 33, 34, 96, 97].as_slice(), &slow].concat())),
        ("analog outputs", "LD SM0.0\nMOVW 1, AQW0\nMOVW 32000, AQW2\n".to_string()),
        ("retained V", "//# retain VB0-VB127\nLD SM0.5\nEU\nINCW VW0\n".to_string()),
        ("retained C", "//# retain C0-C31\nLD SM0.5\nLD SM0.1\nCTU C3, 5\n".to_string()),
    ]
    .map(|(name, text)| (name.to_string(), text))
    .to_vec()
}

/// Whole scans by the board's own clock: the longest after the first is not longer than the
/// assembler says.
#[test]
fn no_scan_is_longer_than_the_assembler_says() {
    for ((name, text), tier) in
        examples().chain(demanding()).flat_map(|one| TIERS.map(|tier| (one.clone(), tier)))
    {
        let executable = Executable::new(&name, &text, tier);
        let cost = cost::cost(&executable.bytecode).expect("an image of the assembler is valid");
        let longest =
            if tier == Tier::Interpreter { Some(cost.interpreted) } else { cost.translated };
        let Some(longest) = longest.filter(Longest::is_known) else { continue };
        let mut board = BenchBoard::new();
        board.insert(&executable.image);
        board.power_up();
        board.scan();
        let found = board.scans_for(2_500).into_iter().map(|scan| scan.cycles()).max().unwrap_or(0);
        let most = longest.scan;
        println!("{name}, {tier}: {found} of {most} cycles");
        assert!(found <= most, "{name}, {tier}: a scan took {found}, predicted {most}");
    }
}

/// Share by which an instruction of a module may take longer than with the values of its row.
const UNUSUAL: f64 = 0.1;

/// Instructions of modules in the examples and in the cases of the instruction set, with any
/// inputs: values make them take longer than the assembler says, but not much.
#[test]
fn instructions_of_modules_cost_what_the_assembler_says() {
    let cases =
        Case::examples().into_iter().chain(Case::all()).filter(|case| case.faults.is_empty());
    let (mut instructions, mut worst) = (0, 0.0f64);
    for case in cases {
        let image = Source::new("case", &*case.awl)
            .ok()
            .and_then(|source| assemble(&source, Vec::new()).image);
        let Some(cost) = image.and_then(|image| cost::cost(&image)).filter(|cost| cost.is_typical)
        else {
            continue;
        };
        let mut meter = Meter::new(Executable::new(&case.file, &case.awl, Tier::Interpreter));
        meter.board.stop_clock();
        let mut rng = Rng::with_seed(7);
        for _ in 0..SCANS {
            meter.board.drive_inputs(rng.u8(..64));
            meter.pass(rng.u32(..120));
            for step in meter.execute().steps {
                let Some((op, most)) = most_of_module(&meter, &cost, &step) else { continue };
                let share = step.cycles as f64 / f64::from(most) - 1.0;
                assert!(share <= UNUSUAL, "{}: {op:?} took {}, not {most}", case.file, step.cycles);
                instructions += 1;
                worst = worst.max(share);
            }
        }
    }
    println!("{instructions} instructions of modules, at most {:.1} % longer", 100.0 * worst);
    assert!(instructions > 1_000, "hardly any instruction of a module");
}

/// What the assembler says that an instruction of a module takes at most; `None` of others.
fn most_of_module(meter: &Meter, cost: &ProgramCost, step: &Step) -> Option<(Op, u32)> {
    let number = step.instruction?;
    let op = meter.executable.code[number].1.op;
    op.instruction().module()?;
    let ways = cost.instructions[number].interpreted;
    Some((op, (if step.flow { ways.on } else { ways.off })?.max))
}
