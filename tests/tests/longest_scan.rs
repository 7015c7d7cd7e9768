//! The longest scan that the assembler tells holds on the board: no scan of programs with loops,
//! jumps back, routines, segments and interrupts is longer, and where the way through a program is
//! its longest one, what is told is near. Random programs with units are among them.
#![cfg(feature = "uno")]

use awl_asm::cost::{Longest, Stated, cost_with};
use fastrand::Rng;
use tests::effort::effort;
use tests::measure::{Executable, Meter, Tier};
use tests::random::{random_interrupts, random_program};

const TIERS: [Tier; 2] = [Tier::Interpreter, Tier::Native { pins: true }];
/// Scans of each program.
const SCANS: usize = 30;
/// Milliseconds for which whole scans are looked at.
const WHOLE_MS: u64 = 200;

/// A program that goes its longest way in each scan, and the share by which what is told may be
/// too high, interpreted and as machine code: little, but where it looks for events, which finds
/// nothing most of the time.
struct Row {
    name: &'static str,
    text: &'static str,
    too_high: [f64; 2],
}

const fn row(name: &'static str, text: &'static str, too_high: [f64; 2]) -> Row {
    Row { name, text, too_high }
}

const LOOP: [f64; 2] = [0.15, 0.35];
const STRAIGHT: [f64; 2] = [0.25, 0.15];
const LOOKS: [f64; 2] = [4.5, 5.0];

const ROWS: [Row; 11] = [
    row(
        "FOR with constants",
        "LD SM0.0\nFOR MW0, 1, 60\nLD SM0.0\n+I 3, VW0\nMOVW VW0, VW2\nNEXT\n",
        LOOP,
    ),
    row(
        "a loop of many milliseconds",
        "LD SM0.0\nFOR MW0, 1, 1500\nLD SM0.0\n+I 3, VW0\nMOVW VW0, VW2\nNEXT\n",
        LOOP,
    ),
    row(
        "FOR with a bound",
        "LD SM0.0\nMOVW 40, MW2\n//# bound 40\nFOR MW0, 1, MW2\nLD SM0.0\n+I 3, VW0\n\
            MOVW VW0, VW2\nNEXT\n",
        LOOP,
    ),
    row(
        "FOR in FOR",
        "LD SM0.0\nFOR MW0, 1, 12\nLD SM0.0\nFOR MW2, 1, 9\nLD SM0.0\n-I 3, VW0\nNEXT\nNEXT\n",
        LOOP,
    ),
    row(
        "a jump back",
        "LD SM0.0\nMOVW 0, VW0\n//# bound 50\nLBL 1\nLD SM0.0\nINCW VW0\n+I 5, VW2\n\
            LDW>= VW0, 50\nNOT\nJMP 1\n",
        LOOP,
    ),
    row(
        "one of two branches",
        "LD SM0.0\nJMP 1\nLD SM0.0\nMOVW 1, VW0\nMOVW 1, VW2\nLBL 1\nLD SM0.0\nMOVW 2, VW0\n\
            MOVW 3, VW4\nMOVW 3, VW6\nMOVW 3, VW8\nMOVW 3, VW10\n+I 5, VW0\n+I 5, VW4\n",
        STRAIGHT,
    ),
    row(
        "routines with parameters",
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.0\nFOR MW0, 1, 10\nLD SM0.0\n\
            CALL SBR0, VW0, M5.0, VW2\nNEXT\nEND_ORGANIZATION_BLOCK\n\
            SUBROUTINE_BLOCK A:SBR0\nVAR_INPUT\na:INT;\nb:BOOL;\nEND_VAR\nVAR_OUTPUT\nc:INT;\n\
            END_VAR\nBEGIN\nLD SM0.0\nMOVW #a, #c\n+I 1, #c\nCALL SBR1\nEND_SUBROUTINE_BLOCK\n\
            SUBROUTINE_BLOCK B:SBR1\nBEGIN\nLD SM0.0\nINCW VW8\nCRET\nEND_SUBROUTINE_BLOCK\n",
        LOOP,
    ),
    row(
        "segments",
        "LD SM0.0\nS S0.0, 2\nLSCR S0.0\nLD SM0.0\nMOVW 1, VW0\n+I 5, VW0\nSCRE\nLSCR S0.1\n\
            LD SM0.0\nMOVW 1, VW2\n+I 5, VW2\nSCRE\n",
        STRAIGHT,
    ),
    row(
        "instructions of modules",
        "//# memory VB0-VB99\nLD SM0.0\nFILL 5, VW0, 20\nBMW VW0, VW50, 10\nMOVR 1.5, VD60\n\
            *R 2.5, VD60\nSCPY \"abcdefgh\", VB70\n",
        [0.2, 0.2],
    ),
    row(
        "timed interrupts",
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\nMOVB 1, SMB34\nATCH INT0, 10\nENI\n\
            LD SM0.0\nMOVW 1, VW0\nLD SM0.0\nMOVW 2, VW2\nEND_ORGANIZATION_BLOCK\n\
            INTERRUPT_BLOCK T:INT0\nBEGIN\nLD SM0.0\nFOR MW0, 1, 20\nLD SM0.0\nINCW VW4\nNEXT\n\
            END_INTERRUPT_BLOCK\n",
        LOOKS,
    ),
    row(
        "edges at a rate",
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\n//# rate 500\nATCH INT0, 0\n\
            //# rate 500\nATCH INT0, 1\nENI\nLD SM0.0\nMOVW 1, VW0\nLD SM0.0\nMOVW 2, VW2\n\
            END_ORGANIZATION_BLOCK\n\
            INTERRUPT_BLOCK T:INT0\nBEGIN\nLD SM0.0\nINCW VW4\nEND_INTERRUPT_BLOCK\n",
        LOOKS,
    ),
];

/// The longest scan that is told; `None` where something is missing for it.
fn told(executable: &Executable) -> Option<Longest> {
    let stated = Stated::of(&executable.assembly);
    let cost = cost_with(&executable.bytecode, &stated).expect("the program is for the board");
    match executable.tier {
        Tier::Interpreter => Some(cost.interpreted),
        Tier::Native { .. } => cost.translated,
    }
    .filter(Longest::is_known)
}

/// The most cycles of the program in scans with inputs as `inputs` says, a millisecond apart. None
/// is longer than what is told.
fn longest_measured(
    name: &str,
    meter: &mut Meter,
    told: u64,
    mut inputs: impl FnMut() -> u8,
) -> u64 {
    meter.board.stop_clock();
    let mut most = 0;
    for _ in 0..SCANS {
        meter.board.drive_inputs(inputs());
        meter.pass(1);
        let program = meter.execute().program;
        assert!(program <= told, "{name}: a program took {program}, told {told}");
        most = most.max(program);
    }
    most
}

#[test]
fn what_is_told_is_as_long_as_the_longest_way() {
    let mut wrong = Vec::new();
    for row in &ROWS {
        for (tier, too_high) in TIERS.into_iter().zip(row.too_high) {
            let name = format!("{}, {tier}", row.name);
            let executable = Executable::new(row.name, row.text, tier);
            let longest = told(&executable).unwrap_or_else(|| panic!("{name}: not known"));
            let mut meter = Meter::new(executable);
            let mut level = 0;
            let most = longest_measured(&name, &mut meter, longest.program, || {
                level ^= 0x3F;
                level
            });
            let share = longest.program as f64 / most as f64 - 1.0;
            println!("{name}: {most} of {}, {:.0} % too high", longest.program, 100.0 * share);
            wrong.extend((share > too_high).then(|| format!("{name}: {:.0} %", 100.0 * share)));
        }
    }
    assert!(wrong.is_empty(), "too high: {wrong:#?}");
}

#[test]
fn no_whole_scan_is_longer() {
    for row in &ROWS {
        for tier in TIERS {
            let executable = Executable::new(row.name, row.text, tier);
            let longest = told(&executable).expect("it is known");
            let mut meter = Meter::new(executable);
            let scans = meter.board.scans_for(WHOLE_MS);
            let most = scans.into_iter().map(|scan| scan.cycles()).max().unwrap_or(0);
            println!("{}, {tier}: {most} of {} cycles", row.name, longest.scan);
            assert!(most <= longest.scan, "{}, {tier}: {most} of {}", row.name, longest.scan);
        }
    }
}

/// Events of inputs come once in the millisecond between two scans.
fn with_rates(text: &str) -> String {
    text.replace("ATCH", "//# rate 1000\nATCH")
}

#[test]
fn no_random_program_is_longer() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 60));
    let mut known = 0;
    for seed in first..first + count {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(20..150);
        let texts = [random_program(&mut rng, size), with_rates(&random_interrupts(&mut rng))];
        for (text, tier) in texts.iter().flat_map(|text| TIERS.map(|tier| (text, tier))) {
            let name = format!("seed {seed}, {tier}");
            let executable = Executable::new(&name, text, tier);
            let Some(longest) = told(&executable) else { continue };
            known += 1;
            let mut meter = Meter::new(executable);
            if meter.board.runs() {
                longest_measured(&name, &mut meter, longest.program, || rng.u8(..64));
            }
        }
    }
    println!("{known} of {} known", 4 * count);
    assert!(known > count, "hardly any program whose longest scan is known");
}
