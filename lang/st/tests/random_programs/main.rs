//! Random programs: what the compiled program leaves in its variables after every scan is what the
//! naive evaluator of the syntax tree says. `ST_PROGRAMS` sets how many, `ST_SEED` shows one.

mod coarse;
mod declarations;
mod evaluator;
mod generate;
mod values;

use awl_sim::machine::Machine;
use awl_sim::open::{File, open};
use awl_sim::operand::Operand;
use diagnostics::Source;
use evaluator::Evaluator;
use fastrand::Rng;
use generate::{Generator, VARIABLES};
use values::{Kind, Value};

const SCANS: usize = 12;

/// The name in AWL of a variable of the evaluator; elements of arrays by their place in the row.
fn name_in_awl(name: &str) -> String {
    let Some((array, behind)) = name.split_once('[') else { return name.to_owned() };
    let (at, member) = behind.split_once(']').expect("its end");
    let first = if array.ends_with("LIST") { 1 } else { 0 };
    // An array of structures is one array for each member.
    format!("{array}{member}[{}]", at.parse::<i64>().expect("a number") + first)
}

fn seen(value: Value) -> i64 {
    match value {
        Value::Bool(value) => value.into(),
        Value::Number(Kind::Word | Kind::Uint, value) => i64::from(value as u16 as i16),
        Value::Number(Kind::Sint, value) => i64::from(value as i8 as u8),
        Value::Number(Kind::Udint, value) => i64::from(value as u32 as i32),
        Value::Number(_, value) | Value::Open(value) => value,
        Value::Real(value) => i64::from(value.to_bits() as i32),
    }
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

fn differs(seed: u64) -> Option<String> {
    let text = Generator::program(seed);
    let source = Source::new("r.st", text.as_str()).expect("a short text");
    let (tree, _) = st::parser::parse(&source);
    let file = File { name: "r.st".to_owned(), bytes: text.clone().into_bytes() };
    let mut opened = match open(&file, &[]) {
        Ok(opened) => opened,
        // Such constants came about by chance, and one expression needs no end of temporaries.
        Err(error) if error.to_string().contains("local memory is full") => return None,
        Err(error) if error.to_string().contains("this divides by zero") => return None,
        Err(error) if error.to_string().contains(" only") => return None,
        Err(error) => return Some(format!("seed {seed}: {error}\n{text}")),
    };
    let mut evaluator = Evaluator::new(tree);
    let mut rng = Rng::with_seed(seed);
    let mut names: Vec<String> = evaluator.values.keys().cloned().collect();
    names.sort();
    let operands: Vec<(String, Operand)> = names
        .into_iter()
        .filter_map(|name| {
            let operand = Operand::parse(&name_in_awl(&name), &opened.symbols).ok()?;
            Some((name, operand))
        })
        .collect();
    assert!(operands.len() > 40, "{} names", operands.len());
    let mut now = 0;
    for scan in 0..SCANS {
        for (kind, names) in VARIABLES {
            for name in names.iter().filter(|name| name.starts_with('g')) {
                let value = input(kind, &mut rng);
                evaluator.values.insert(name.to_uppercase(), value);
                let operand = Operand::parse(name, &opened.symbols).ok()?;
                // What the program does not use is nowhere.
                let _ = opened.machine.write(operand, seen(value) as i32);
            }
        }
        evaluator.scan(now);
        opened.machine.scan(now);
        if let Some(fault) = opened.machine.fault() {
            return Some(format!("seed {seed}, scan {scan}: {fault}\n{text}"));
        }
        for (name, operand) in &operands {
            let Ok(found) = opened.machine.read(*operand).map(i64::from) else { continue };
            let wanted = evaluator.values[name];
            if found != seen(wanted) {
                return Some(format!(
                    "seed {seed}, scan {scan}: {name} is {found}, not {} ({wanted:?})\n{text}",
                    seen(wanted)
                ));
            }
        }
        now += rng.u64(1..30);
    }
    None
}

#[test]
fn compiled_programs_do_what_the_evaluator_says() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    if let Some(seed) = number("ST_SEED") {
        println!("{}", Generator::program(seed));
        assert_eq!(differs(seed), None);
        return;
    }
    let all = 0..number("ST_PROGRAMS").unwrap_or(300);
    let different: Vec<String> = all.filter_map(differs).collect();
    for one in different.iter().take(12) {
        println!("{}", one.lines().next().unwrap_or_default());
    }
    if let Some(shortest) = different.iter().min_by_key(|text| text.len()) {
        panic!("{} programs differ, such as\n{shortest}", different.len());
    }
}
