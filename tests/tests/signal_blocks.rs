//! Signal blocks over long times, on the host and on the board: periods of controllers that are
//! exact multiples of each other, and a sine. What a block computes is for lang/st to test.

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::source::Source;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::operand::Operand;
use fastrand::Rng;

/// Two controllers in cascade: the inner one each 10 ms, the outer one each tenth time.
const CASCADE: &str = "\
PROGRAM Main
VAR
    Fast : EVERY := (TS := T#10ms);
    Slow : EVERY_NTH := (N := 10);
    Outer : COUNTED := (TS := T#100ms);
    Inner : COUNTED := (TS := T#10ms);
    Beam : LAG := (TS := T#10ms);
END_VAR
Fast();
Slow(IN := Fast.Q);
Outer(EN := Slow.Q, SP := 1.0, PV := {feedback} Beam.Y);
Inner(EN := Fast.Q, SP := Outer.U, PV := {feedback} Beam.Y);
Beam(EN := Fast.Q, X := Inner.U);
END_PROGRAM
";

/// A controller that counts how often it is executed.
const COUNTED: &str = "\
FUNCTION_BLOCK COUNTED
VAR_INPUT SP, PV : REAL; TS : TIME; END_VAR
VAR_OUTPUT U : REAL; RUNS : DINT; END_VAR
VAR Loop : PID; END_VAR
Loop(SP := SP, PV := PV, TS := TS);
U := Loop.U;
RUNS := RUNS + 1;
END_FUNCTION_BLOCK
";

const SINE: &str = "PROGRAM Main\nVAR Wave : SINE; END_VAR\nWave(TS := T#10ms);\nEND_PROGRAM\n";
const SECOND: u64 = 1000;

fn compiled(files: &[(&str, &str)]) -> Assembly {
    let sources = files.iter().map(|(name, text)| Source::new(*name, *text).expect("short"));
    let joined = project::join(sources.collect()).expect("a program");
    let mut assembly = assemble(&joined.awl, Vec::new());
    assembly.require_board();
    assert!(assembly.image.is_some(), "{:?}", assembly.diagnostics);
    assembly
}

fn cascade() -> Assembly {
    compiled(&[("main.fbd", CASCADE), ("counted.st", COUNTED)])
}

fn operand(assembly: &Assembly, name: &str) -> Operand {
    Operand::parse(name, &assembly.program.symbols).expect("a variable")
}

fn host(assembly: &Assembly) -> Host {
    tests::case::host(assembly.image.as_ref().expect("an image"))
}

/// Runs for so many seconds with scans of 1 to `longest` ms; after each scan the outer controller
/// was executed once for each ten times of the inner one, that time begun.
fn assert_exact_multiples(
    machine: &mut dyn Machine,
    assembly: &Assembly,
    seconds: u64,
    longest: u64,
) {
    let names = ["Main.Inner.RUNS", "Main.Outer.RUNS", "Main.Fast.LOST"];
    let wanted = names.map(|name| operand(assembly, name));
    let (mut now, mut scans) = (0, 0u64);
    let mut rng = Rng::with_seed(longest);
    let mut inner_runs = 0;
    while now < seconds * SECOND {
        machine.scan(now);
        let [inner, outer, lost] = wanted.map(|one| machine.read(one).expect("a variable"));
        assert_eq!(outer, (inner + 9) / 10, "at {now} ms");
        // None is early, and none is left out without being counted.
        assert_eq!(i64::from(inner + lost), (now / 10 + 1) as i64, "at {now} ms");
        (inner_runs, scans) = (inner, scans + 1);
        now += if longest > 1 { rng.u64(1..=longest) } else { 1 };
    }
    println!("{seconds} s, {scans} scans: {inner_runs} times the inner controller");
    assert!(i64::from(inner_runs) > (seconds * SECOND / 10 / longest) as i64);
}

/// 1 Hz, amplitude 1, 10 ms, 1,001 points: the root of the mean square of the difference from the
/// formula is below 0.0001 % of the span.
fn assert_sine(machine: &mut dyn Machine, assembly: &Assembly) {
    let output = operand(assembly, "Main.Wave.Y");
    let squares = (0..1001u16).map(|at| {
        machine.scan(u64::from(at) * 10);
        let found = machine.read(output).expect("an output");
        let wanted = (std::f64::consts::TAU * f64::from(at) * 0.01).sin();
        (f64::from(f32::from_bits(found as u32)) - wanted).powi(2)
    });
    let share = (squares.sum::<f64>() / 1001.0).sqrt() / 2.0;
    println!("{:.7} %", share * 100.0);
    assert!(share < 1e-6, "{share}");
}

#[test]
fn an_hour_of_two_periods() {
    let assembly = cascade();
    assert_exact_multiples(&mut host(&assembly), &assembly, 3600, 9);
    assert_exact_multiples(&mut host(&assembly), &assembly, 3600, 35);
}

#[test]
fn a_sine_on_the_host() {
    let assembly = compiled(&[("main.st", SINE)]);
    assert_sine(&mut host(&assembly), &assembly);
}

#[cfg(feature = "uno")]
mod on_board {
    use super::{Assembly, SINE, assert_exact_multiples, assert_sine, cascade, compiled};
    use awl_sim::machine::uno::{Code, Uno};
    use tests::lockstep::board;

    fn loaded(code: Code, assembly: &Assembly) -> Uno {
        let mut uno = board(code);
        uno.load(assembly.image.clone().expect("an image")).expect("there is room");
        uno
    }

    #[test]
    fn a_minute_of_two_periods() {
        let assembly = cascade();
        for code in [Code::Bytecode, Code::Native] {
            assert_exact_multiples(&mut loaded(code, &assembly), &assembly, 60, 19);
        }
    }

    #[test]
    fn a_sine_on_the_board() {
        let assembly = compiled(&[("main.st", SINE)]);
        for code in [Code::Bytecode, Code::Native] {
            assert_sine(&mut loaded(code, &assembly), &assembly);
        }
    }
}
