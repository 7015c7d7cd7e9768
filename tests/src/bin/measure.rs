//! Measures everything that `cargo xtask bench` reports about the board, and prints it line by
//! line; with `table`, the table of awl-asm/src/output/cost/interpreter.rs; with `pico`, what is
//! measured on the Pico alone. It judges nothing.

use std::io::{self, Write};

use plc_isa::Op;
use tests::image::example_text;
use tests::measure::module_rows::MODULE_CHAPTERS;
use tests::measure::record::{self, Record};
use tests::measure::rows::{CHAPTERS, Count, Row};
use tests::measure::{self, Executable, Meter, Step, Tier, forms, s7_200, scans, table};
use tests::programs;

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    let asked = std::env::args().nth(1);
    if asked.as_deref() == Some("table") {
        return out.write_all(table::table().as_bytes());
    }
    writeln!(out, "{}", record::HEAD)?;
    match asked.as_deref() {
        #[cfg(feature = "pico")]
        Some("pico") => write_all(&mut out, &pico_records()),
        Some(word) => chapter_alone(&mut out, word),
        None => everything(&mut out),
    }
}

fn write_all(out: &mut impl Write, records: &[Record]) -> io::Result<()> {
    records.iter().try_for_each(|record| writeln!(out, "{record}"))
}

fn everything(out: &mut impl Write) -> io::Result<()> {
    for tier in Tier::ALL {
        write_all(out, &[program_records(tier), station_records(tier)].concat())?;
    }
    write_all(out, &firmware_records())?;
    #[cfg(feature = "pico")]
    write_all(out, &pico_records())?;
    for chapter in &CHAPTERS {
        for row in chapter.rows {
            for tier in Tier::ALL {
                write_all(out, &row_records(chapter.title, row, tier))?;
            }
        }
    }
    for chapter in &MODULE_CHAPTERS {
        for row in chapter.rows {
            write_all(out, &module_row_records(chapter.title, row))?;
        }
    }
    Ok(())
}

/// The rows of modules of which one word is in the chapter's title or in the AWL, to look at them.
fn chapter_alone(out: &mut impl Write, word: &str) -> io::Result<()> {
    for chapter in &MODULE_CHAPTERS {
        let rows = chapter
            .rows
            .iter()
            .filter(|row| chapter.title.contains(word) || row.awl.contains(word));
        for row in rows {
            write_all(out, &module_row_records(chapter.title, row))?;
        }
    }
    Ok(())
}

fn single(
    section: &'static str,
    tier: impl ToString,
    what: &str,
    value: f64,
    name: &str,
) -> Record {
    let (what, name) = (what.to_string(), name.to_string());
    Record { section, tier: tier.to_string(), what, min: value, max: value, quoted_us: None, name }
}

/// Bytes of flash.
fn firmware_records() -> Vec<Record> {
    let elf = measure::elf();
    let of = |name: &str, bytes: f64| Record {
        tier: "-".to_string(),
        ..single("firmware", Tier::Interpreter, "bytes of flash", bytes, name)
    };
    let all = elf.flash.iter().map(|(_, bytes)| bytes.len()).sum::<usize>() as f64;
    let engine = elf.flash_symbol("uno200_engine_end").zip(elf.flash_symbol("uno200_vectors"));
    let engine = engine.map(|(end, start)| of("fast engine", f64::from(end - start)));
    [of("firmware", all)].into_iter().chain(engine).collect()
}

/// The generated programs.
fn program_records(tier: Tier) -> Vec<Record> {
    generated().into_iter().flat_map(|(name, text)| one_program(tier, name, &text)).collect()
}

fn generated() -> [(&'static str, String); 4] {
    [
        ("1024-step 80/20", programs::eighty_twenty()),
        ("1024-step 80/20, power flow at all boxes", programs::eighty_twenty_all_boxes()),
        ("1K Boolean", programs::boolean()),
        ("mix", programs::mix()),
    ]
}

/// The generated programs on the Pico, and every instruction that is quoted.
#[cfg(feature = "pico")]
fn pico_records() -> Vec<Record> {
    const TIER: &str = "Pico";
    let mut meter = measure::pico::PicoMeter::new();
    let mut records = vec![single("pico", TIER, "overhead", meter.overhead().into(), "a scan")];
    for (name, text) in generated() {
        records.push(single("pico", TIER, "cycles", meter.program(&text).into(), name));
    }
    let rows = CHAPTERS.iter().map(|chapter| chapter.rows);
    for row in rows.chain(MODULE_CHAPTERS.iter().map(|chapter| chapter.rows)).flatten() {
        let Some(quoted) = row.quoted_us() else { continue };
        if let Some((least, most)) = meter.row(row) {
            let of = single("pico instructions", TIER, "cycles", most.round(), &row.name());
            records.push(Record { min: least.round(), quoted_us: Some(quoted), ..of });
        }
    }
    records
}

/// Cycles of the shortest and of the longest scan over all inputs, and cycles an instruction by
/// kind.
fn one_program(tier: Tier, name: &str, text: &str) -> Vec<Record> {
    let mut meter = Meter::new(Executable::new(name, text, tier));
    let (len, bytes) = (meter.executable.len() as f64, meter.executable.code_len() as f64);
    let (mut cycles, mut bits, mut words) = (Vec::new(), Average::default(), Average::default());
    for inputs in 0..64 {
        meter.board.drive_inputs(inputs);
        let execution = meter.execute();
        cycles.push(execution.program);
        for step in &execution.steps {
            match is_word(&meter, step) {
                Some(true) => words.add(step.cycles),
                Some(false) => bits.add(step.cycles),
                None => {}
            }
        }
    }
    let spread = scans::Spread::of(cycles);
    let of = |what: &str, value: f64| single("program", tier, what, value, name);
    let mut records = vec![
        Record { min: spread.min as f64, ..of("cycles", spread.max as f64) },
        of("cycles an instruction", spread.max as f64 / len),
        of("bytes an instruction", bytes / len),
    ];
    records.extend(bits.mean().map(|mean| of("cycles a bit instruction", mean)));
    records.extend(words.mean().map(|mean| of("cycles a word instruction", mean)));
    records
}

#[derive(Default)]
struct Average {
    sum: u64,
    count: u64,
}

impl Average {
    fn add(&mut self, value: u64) {
        self.sum += value;
        self.count += 1;
    }

    fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum as f64 / self.count as f64)
    }
}

/// Whether a step is a word instruction; `None` for what is no instruction.
fn is_word(meter: &Meter, step: &Step) -> Option<bool> {
    let (_, decoded) = meter.executable.code.get(step.instruction?)?;
    (decoded.op != Op::MainEnd).then(|| programs::is_word(decoded.op.instruction().mnemonic()))
}

/// The scans of the station.
fn station_records(tier: Tier) -> Vec<Record> {
    let name = "station1";
    let executable = Executable::new(name, &example_text(name), tier);
    let (len, bytes) = (executable.len() as f64, executable.code_len() as f64);
    let figures = scans::measure(executable);
    let of = |what: &str, value: f64| single("scan", tier, what, value, name);
    let (usual, mean) = figures.overhead();
    let mut records = vec![
        of("overhead", usual as f64),
        of("overhead mean", mean as f64),
        of("bytes an instruction", bytes / len),
    ];
    for (what, spread) in
        [("program", figures.program), ("whole scan", figures.whole), ("period", figures.period)]
    {
        let scans::Spread { min, median, p99, max, mean } = spread;
        for (which, value) in
            [("min", min), ("median", median), ("p99", p99), ("max", max), ("mean", mean)]
        {
            records.push(of(&format!("{what} {which}"), value as f64));
        }
    }
    records
}

fn row_records(chapter: &'static str, row: &Row, tier: Tier) -> Vec<Record> {
    let found = forms::measure(row, tier);
    let record = |what: &str, (min, max): (u64, u64), quoted_us: Option<f64>| Record {
        min: min as f64,
        quoted_us,
        ..single(chapter, tier, what, max as f64, row.awl)
    };
    let range = |flow: bool| found.get(&flow).map(|spread| (spread.min, spread.max));
    let (on, off) = (range(true), range(false));
    if row.is_box() {
        let on = on.map(|cycles| record("cycles", cycles, row.quoted_us()));
        let off_us = row.quoted_us().map(|us| us.min(s7_200::WITHOUT_POWER_FLOW_US));
        return on
            .into_iter()
            .chain(off.map(|cycles| record("without power flow", cycles, off_us)))
            .collect();
    }
    let both = on.into_iter().chain(off).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    both.map(|cycles| record("cycles", cycles, row.quoted_us())).into_iter().collect()
}

/// Of an instruction whose time goes with values: what it takes as a rule, beside the fewest and
/// the most. Machine code calls the interpreter for it.
fn module_row_records(chapter: &'static str, row: &Row) -> Vec<Record> {
    let tier = Tier::Interpreter;
    let name = row.name();
    let of = |what: &str, value: u64| single(chapter, tier, what, value as f64, &name);
    let is_box = row.is_box();
    // A contact is executed with power flow and without.
    let executed = |mut found: forms::ByFlow| {
        let off = if is_box { found.remove(&false) } else { None };
        (found.into_values().reduce(scans::Spread::with), off)
    };
    let (Some(on), off) = executed(forms::measure(row, tier)) else { return Vec::new() };
    let typical = if row.is_once { on.max } else { on.median };
    let mut records = vec![
        Record { min: on.min as f64, ..of("cycles", on.max) },
        Record { quoted_us: row.quoted_us(), ..of("typical cycles", typical) },
    ];
    records.extend(off.map(|off| of("without power flow", off.max)));
    if let Some(Count { unit, usual, many }) = row.count {
        let (longer, _) = executed(forms::measure_with(row, tier, many));
        let more = longer.map_or(0, |longer| longer.max.saturating_sub(on.max));
        records
            .push(of(&format!("each {unit} of {usual}"), more.div_ceil(u64::from(many - usual))));
    }
    records
}
