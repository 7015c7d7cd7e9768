//! The library of signal blocks: what it is, as files, and what the blocks give, beside NumPy and
//! SciPy (`reference.py`) and beside formulas. Cases with scenarios are in `../cases/library`.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, Opened, open_files};
use awl_sim::operand::Operand;
use diagnostics::Source;
use st::library::{BLOCKS, Block};
use st::model::{SectionKind, UnitKind};
use st::{Around, compile};

/// Most that a value differs from the reference, as part of the largest value of its column: a REAL
/// has 24 bits, so each operation adds up to 6e-8, and a filter some hundreds of them.
const BOUND: f64 = 5e-6;

fn here(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(folder)
}

fn opened(text: String) -> Opened<Host> {
    let file = File { name: "main.st".to_owned(), bytes: text.into_bytes() };
    open_files(&[file], &[], None).unwrap_or_else(|error| panic!("{error}"))
}

/// A value as a table has it: with a point a REAL, else a whole number.
fn bits(text: &str) -> i32 {
    match text.contains('.') {
        true => text.parse::<f32>().expect("a number").to_bits() as i32,
        false => text.parse().expect("a number"),
    }
}

/// Runs a program through the rows of its table; each value that is wrong, and how wrong at most.
fn differences(name: &str, table: &str) -> (Vec<String>, f64) {
    let program = here("cases/library").join(name).with_extension("st");
    let mut opened = opened(fs::read_to_string(program).expect("the table's program"));
    let mut lines = table.lines();
    let columns: Vec<&str> = lines.next().expect("names").split(',').collect();
    let operand = |name: &&str| Operand::parse(name, &opened.symbols).expect("a variable");
    let operands: Vec<Operand> = columns.iter().map(operand).collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    // Main.x is a variable, Main.Filter.Y an output.
    let is_output = |name: &str| name.matches('.').count() > 1;
    let largest = |column: usize| {
        let values = rows.iter().map(|row| row[column].parse::<f64>().expect("a number"));
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let (mut wrong, mut most) = (Vec::new(), 0.0f64);
    for (at, row) in rows.iter().enumerate() {
        let all = || columns.iter().zip(&operands).zip(row);
        for ((_, &operand), value) in all().filter(|((name, _), _)| !is_output(name)) {
            opened.machine.write(operand, bits(value)).expect("an input");
        }
        opened.machine.scan(at as u64 * 10);
        for (column, ((name, &operand), value)) in all().enumerate() {
            if !is_output(name) {
                continue;
            }
            let found = opened.machine.read(operand).expect("an output");
            let found = f64::from(f32::from_bits(found as u32));
            let wanted: f64 = value.parse().expect("a number");
            let difference = (found - wanted).abs() / largest(column);
            most = most.max(difference);
            if difference.is_nan() || difference > BOUND {
                wrong.push(format!(
                    "{program}, row {at}: {name} is {found}, not {wanted}",
                    program = name
                ));
            }
        }
    }
    (wrong, most)
}

#[test]
fn blocks_do_what_scipy_does() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for entry in fs::read_dir(here("blocks")).expect("a folder").flatten() {
        let path = entry.path();
        if path.extension().is_none_or(|ending| ending != "csv") {
            continue;
        }
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let (found, most) = differences(&name, &fs::read_to_string(&path).expect("a table"));
        println!("{name}: {most:.1e}");
        wrong.extend(found.into_iter().take(3));
        count += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count >= 24, "{count} tables");
}

/// 1 Hz, amplitude 1, 10 ms, 1,001 points: the root of the mean square of the difference, as part
/// of the span, is below 0.0001 %.
#[test]
fn a_sine_is_one() {
    let text = "PROGRAM Main\nVAR Wave : SINE; END_VAR\nWave(TS := T#10ms);\nEND_PROGRAM\n";
    let mut opened = opened(text.to_owned());
    let operand = Operand::parse("Main.Wave.Y", &opened.symbols).expect("a variable");
    let mut squares = 0.0;
    for at in 0..1001u16 {
        opened.machine.scan(u64::from(at) * 10);
        let found = opened.machine.read(operand).expect("an output");
        let wanted = (std::f64::consts::TAU * f64::from(at) * 0.01).sin();
        squares += (f64::from(f32::from_bits(found as u32)) - wanted).powi(2);
    }
    let nrmsd = (squares / 1001.0).sqrt() / 2.0;
    println!("{:.7} %", nrmsd * 100.0);
    assert!(nrmsd < 1e-6, "{nrmsd}");
}

/// Whatever time scans take, a slow controller is executed once for ten times of the fast one.
#[test]
fn periods_are_exact_multiples() {
    let text = "PROGRAM Main\nVAR Fast : EVERY; Slow : EVERY_NTH; inner, outer : INT; END_VAR\n\
        Fast(TS := T#10ms);\nSlow(IN := Fast.Q, N := 10);\n\
        IF Fast.Q THEN inner := inner + 1; END_IF\nIF Slow.Q THEN outer := outer + 1; END_IF\n\
        END_PROGRAM\n";
    let mut opened = opened(text.to_owned());
    let operand = |name| Operand::parse(name, &opened.symbols).expect("a variable");
    let [fast, slow, lost] = ["Main.inner", "Main.outer", "Main.Fast.LOST"].map(operand);
    let (mut now, mut number) = (0u64, 1u64);
    for _ in 0..2_000 {
        opened.machine.scan(now);
        let read = |machine: &mut Host, operand| machine.read(operand).expect("a variable");
        let [fast, slow, lost] = [fast, slow, lost].map(|one| read(&mut opened.machine, one));
        assert_eq!(slow, (fast + 9) / 10, "at {now} ms");
        // None is early, and none is lost without being counted.
        assert_eq!(i64::from(fast + lost) - 1, (now / 10) as i64, "at {now} ms");
        number = number * 1_103_515_245 % 2_147_483_647 + 12_345;
        now += number % 27 + 1;
    }
}

#[test]
fn a_file_is_a_block_of_its_name() {
    let names: HashSet<&str> = BLOCKS.iter().map(|block| block.name).collect();
    assert_eq!(names.len(), BLOCKS.len());
    assert!(BLOCKS.len() >= 37, "{} blocks", BLOCKS.len());
    for block in &BLOCKS {
        let name = block.name;
        let text = format!("PROGRAM Main\nVAR b : {name}; END_VAR\nb();\nEND_PROGRAM\n");
        let texts = [("main.st", text), ("library.st", block.text.to_owned())];
        // As a file of the program everything that is wrong with it is told.
        let sources = texts.map(|(file, text)| Source::new(file, text).expect("a short text"));
        let found = compile(&sources, &Around::default());
        assert!(found.diagnostics.is_empty(), "{name}: {:?}", found.diagnostics);
        let unit = found.program.unit(name).unwrap_or_else(|| panic!("{name}: is not in its file"));
        assert_eq!((unit.kind, unit.file, &*unit.name), (UnitKind::Block, Some(1), name));
        let of = |section| unit.variables.iter().filter(move |one| one.section == section);
        let both = of(SectionKind::Input).chain(of(SectionKind::Output));
        let declared: Vec<&str> = both.map(|one| one.name.as_str()).collect();
        let documented: Vec<&str> = block.parameters().iter().map(|one| one.name).collect();
        assert_eq!(documented, declared, "{name}");
        let comment = block.comment();
        let first = comment.lines().next().unwrap_or_default();
        assert!(first.ends_with('.'), "{name}: {first}");
    }
}

#[test]
fn only_blocks_that_are_used_are_part_of_a_program() {
    let units = |text: &str| {
        let source = Source::new("t.st", text).expect("a short text");
        let compiled = compile(&[source], &Around::default());
        assert!(compiled.awl.is_some(), "{text}: {:?}", compiled.diagnostics);
        let names = compiled.program.units.into_iter().filter(|unit| unit.file.is_none());
        names.map(|unit| unit.name).filter(|name| Block::find(name).is_some()).collect::<Vec<_>>()
    };
    let nothing: [&str; 0] = [];
    assert_eq!(units("PROGRAM Main\nVAR Lag : INT; END_VAR\nLag := 1;\nEND_PROGRAM\n"), nothing);
    let one = "VAR_GLOBAL a : ARRAY[1..3] OF Pid; END_VAR\nPROGRAM Main\na[2]();\nEND_PROGRAM\n";
    assert_eq!(units(one), ["PID"]);
}

/// Whatever inputs are, also far out of their ranges and from scan to scan, no value becomes
/// infinite or "not a number", and no scan ends with a fault.
#[test]
fn no_input_is_too_much() {
    let reals = [0.0, -1.0, 1e-30, 0.5, -3e38, 3e38, 1e6, 49.0f32].map(|value| value.to_bits());
    let others = [0, 1, -1, 32767, -32768, i32::MAX, i32::MIN, 33];
    let mut rng = fastrand::Rng::with_seed(1);
    for block in &BLOCKS {
        let name = block.name;
        let text = format!("PROGRAM Main\nVAR b : {name}; END_VAR\nb();\nEND_PROGRAM\n");
        let mut opened = opened(text);
        let variables: Vec<(Operand, &str)> = block
            .parameters()
            .iter()
            .filter_map(|one| {
                // An array is written by its first element.
                let is_array = one.declared.starts_with("ARRAY");
                let path = format!("Main.b.{}{}", one.name, if is_array { "[0]" } else { "" });
                Some((Operand::parse(&path, &opened.symbols).ok()?, one.declared))
            })
            .collect();
        let inputs = block.parameters().iter().filter(|one| !one.is_output).count();
        for scan in 0..300 {
            for &(operand, declared) in variables.iter().take(inputs) {
                let value = match declared {
                    _ if rng.bool() => continue,
                    _ if declared.contains("REAL") => *rng.choice(&reals).expect("some") as i32,
                    _ if declared.starts_with("BOOL") => rng.bool().into(),
                    _ if declared.starts_with("INT") => *rng.choice(&others[..5]).expect("some"),
                    _ => *rng.choice(&others).expect("some"),
                };
                opened.machine.write(operand, value).expect("an input");
            }
            opened.machine.scan(scan * 10);
            assert_eq!(opened.machine.fault(), None, "{name}");
            for &(operand, declared) in &variables {
                let found = opened.machine.read(operand).expect("a variable");
                let is_number = f32::from_bits(found as u32).is_finite();
                assert!(is_number || !declared.contains("REAL"), "{name}, scan {scan}: {declared}");
            }
        }
    }
}

#[test]
fn the_example_of_the_page_is_a_program() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/blocks.md");
    let page = fs::read_to_string(page).expect("the page");
    let text = page.split("```").nth(1).expect("an example").trim_start();
    let source = Source::new("page.st", text).expect("a short text");
    let compiled = compile(&[source], &Around::default());
    assert!(
        compiled.diagnostics.is_empty() && compiled.awl.is_some(),
        "{:?}",
        compiled.diagnostics
    );
}
