//! Random programs: what the compiled program leaves in its variables after every scan is what the
//! naive evaluator of the syntax tree says. `ST_PROGRAMS` sets how many, `ST_SEED` the first; one
//! alone is shown.

mod coarse;
mod declarations;
mod evaluator;
mod generate;
mod texts;
mod values;

use awl_asm::Address;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, open};
use awl_sim::operand::Operand;
use diagnostics::Source;
use evaluator::Evaluator;
use fastrand::Rng;
use generate::{Generator, VARIABLES};
use values::{Kind, Value};

/// How many programs an ordinary run has.
const PROGRAMS: u64 = 300;
const SCANS: usize = 12;
/// What is said about a program that is no test of anything: such constants came about by chance,
/// and one expression needs no end of temporaries.
const LEFT_OUT: [&str; 4] = [
    "local memory is full",
    "this divides by zero",
    " only",
    "bytes of data memory, the board has",
];

/// What became of a program.
enum Outcome {
    Same,
    LeftOut,
    /// Seed, place, and the program.
    Differs(String),
}

/// A value as the machine shows it.
fn seen(value: &Value) -> i64 {
    match *value {
        Value::Bool(value) => value.into(),
        Value::Number(Kind::Word | Kind::Uint, value) => i64::from(value as u16 as i16),
        Value::Number(Kind::Sint, value) => i64::from(value as i8 as u8),
        Value::Number(Kind::Udint, value) => i64::from(value as u32 as i32),
        Value::Number(_, value) | Value::Open(value) => value,
        Value::Real(value) => i64::from(value.to_bits() as i32),
        Value::Text(_) => panic!("a text is not one number"),
    }
}

/// Whether there is this value, and what there is in words if not. What is not used is nowhere.
fn differing(machine: &mut Host, operand: Operand, wanted: &Value) -> Option<String> {
    let found = machine.read(operand).ok()?;
    let Value::Text(text) = wanted else {
        let wanted = seen(wanted);
        return (i64::from(found) != wanted).then(|| format!("{found}, not {wanted}"));
    };
    let Operand::At(Address::Byte { area, byte }) = operand else {
        return Some(format!("{operand}, no text"));
    };
    let mut character = |at: u16| {
        let address = Address::Byte { area, byte: byte + at };
        machine.read(Operand::At(address)).map_or(0, |character| character as u8)
    };
    let found: Vec<u8> = (1..=found as u16).map(&mut character).collect();
    let shown = |text: &[u8]| String::from_utf8_lossy(text).into_owned();
    (found != *text).then(|| format!("{:?}, not {:?}", shown(&found), shown(text)))
}

fn input(kind: &str, rng: &mut Rng) -> Value {
    let edges = [0, 1, -1, 2, 5, 32767, -32768, 100];
    let small = edges[rng.usize(..edges.len())];
    match kind {
        "BOOL" => Value::Bool(rng.bool()),
        "INT" if rng.bool() => Value::Number(Kind::Int, rng.i64(-3..8)),
        "INT" => Value::Number(Kind::Int, small),
        "DINT" if rng.bool() => Value::Number(Kind::Dint, small * 65_535),
        "DINT" => Value::Number(Kind::Dint, small),
        "SINT" | "USINT" | "UINT" | "UDINT" => {
            let kind = Kind::of(kind).expect("a type");
            let (low, high) = kind.range();
            let near = [rng.i64(0..8), low + rng.i64(0..4), high - rng.i64(0..4)];
            let value = if rng.bool() { near[rng.usize(..3)] } else { rng.i64(low..=high) };
            Value::Number(kind, value)
        }
        "WORD" => Value::Number(Kind::Word, rng.u16(..).into()),
        _ => Value::Real(f32::from(rng.i16(-1000..1000)) / 8.0),
    }
}

/// Runs a program both ways.
fn outcome(seed: u64) -> Outcome {
    let text = Generator::program(seed);
    let source = Source::new("r.st", text.as_str()).expect("a short text");
    let (tree, _) = st::parser::parse(&source);
    let file = File { name: "r.st".to_owned(), bytes: text.clone().into_bytes() };
    let mut opened = match open(&file, &[]) {
        Ok(opened) => opened,
        Err(error) if LEFT_OUT.iter().any(|text| error.to_string().contains(text)) => {
            return Outcome::LeftOut;
        }
        Err(error) => return Outcome::Differs(format!("seed {seed}: {error}\n{text}")),
    };
    let mut evaluator = Evaluator::new(tree);
    let mut rng = Rng::with_seed(seed);
    let mut names: Vec<String> = evaluator.values.keys().cloned().collect();
    names.sort();
    let operands: Vec<(String, Operand)> = names
        .into_iter()
        .filter_map(|name| {
            let operand = Operand::parse(&evaluator.name_in_awl(&name), &opened.symbols).ok()?;
            Some((name, operand))
        })
        .collect();
    assert!(operands.len() > 40, "{} names", operands.len());
    let mut now = 0;
    for scan in 0..SCANS {
        for (kind, names) in VARIABLES {
            for name in names.iter().filter(|name| name.starts_with('g')) {
                let value = input(kind, &mut rng);
                let operand = Operand::parse(name, &opened.symbols).expect("a variable");
                // What the program does not use is nowhere.
                let _ = opened.machine.write(operand, seen(&value) as i32);
                evaluator.values.insert(name.to_uppercase(), value);
            }
        }
        evaluator.scan(now);
        opened.machine.scan(now);
        if let Some(fault) = opened.machine.fault() {
            return Outcome::Differs(format!("seed {seed}, scan {scan}: {fault}\n{text}"));
        }
        for (name, operand) in &operands {
            let wanted = &evaluator.values[name];
            if let Some(found) = differing(&mut opened.machine, *operand, wanted) {
                return Outcome::Differs(format!(
                    "seed {seed}, scan {scan}: {name} is {found} ({wanted:?})\n{text}"
                ));
            }
        }
        now += rng.u64(1..30);
    }
    Outcome::Same
}

#[test]
fn compiled_programs_do_what_the_evaluator_says() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let (first, count) =
        (number("ST_SEED").unwrap_or(0), number("ST_PROGRAMS").unwrap_or(PROGRAMS));
    if count == 1 {
        println!("{}", Generator::program(first));
    }
    let (mut different, mut left_out) = (Vec::new(), 0);
    for seed in first..first + count {
        match outcome(seed) {
            Outcome::Same => {}
            Outcome::LeftOut => left_out += 1,
            Outcome::Differs(how) => {
                println!("{}", how.lines().next().unwrap_or_default());
                different.push(how);
            }
        }
    }
    println!("{count} programs, {left_out} of them left out");
    if let Some(shortest) = different.iter().min_by_key(|text| text.len()) {
        panic!("{} programs differ, such as\n{shortest}", different.len());
    }
    assert!(left_out * 4 < count || count == 1, "{left_out} of {count} programs are left out");
}

#[test]
fn the_layout_changes_no_word() {
    let laid = |text: &str| {
        st::format::format(&Source::new("r.st", text).expect("a short text")).expect("no errors")
    };
    for seed in 0..300 {
        let text = Generator::program(seed);
        let once = laid(&text);
        assert_eq!(st::format::essence(&once), st::format::essence(&text), "seed {seed}");
        assert_eq!(laid(&once), once, "seed {seed}");
    }
}
