//! Renders docs/benchmarks.md from figures. It measures and judges nothing.

use std::fmt::Write as _;

use super::budget;
use super::comparison::{self, Line};
use super::exceptions::{EXCEPTIONS, is_slower};
use super::record::{INTERPRETER, Record, TIERS, TYPICAL, find};
use super::text;

/// Sections that are no chapters of instructions.
const OTHER_SECTIONS: [&str; 5] = ["program", "scan", "firmware", "pico", "pico instructions"];

/// The page.
pub fn page(records: &[Record]) -> String {
    let mut page = String::from(text::HEAD);
    budgets_table(&mut page, records);
    programs_table(&mut page, records);
    scans_table(&mut page, records);
    comparison_tables(&mut page, records);
    pico_tables(&mut page, records);
    others_table(&mut page);
    host_table(&mut page);
    instruction_tables(&mut page, records);
    module_tables(&mut page, records);
    exceptions_table(&mut page, records);
    page
}

/// A title, words, and the head of a table.
fn section(page: &mut String, title: &str, words: &str, columns: &[&str]) {
    let _ = write!(page, "\n## {title}\n\n{words}");
    if !words.is_empty() {
        page.push('\n');
    }
    line(page, columns);
    let rule: String = columns.iter().map(|_| "---|").collect();
    let _ = writeln!(page, "|{rule}");
}

fn line<T: AsRef<str>>(page: &mut String, cells: &[T]) {
    let cells: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
    let _ = writeln!(page, "| {} |", cells.join(" | "));
}

fn budgets_table(page: &mut String, records: &[Record]) {
    section(page, "Budgets", "", &["what", "measured", "budget", ""]);
    for verdict in budget::verdicts(records) {
        let value = verdict
            .value
            .map_or("-".to_string(), |value| format!("{} {}", number(value), verdict.unit));
        let met = if verdict.is_met() { "met" } else { "**missed**" };
        line(
            page,
            &[
                verdict.title.clone(),
                value,
                format!("{} {}", number(verdict.budget), verdict.unit),
                met.into(),
            ],
        );
    }
}

/// What is measured of the generated programs, with digits after the point.
const OF_PROGRAMS: [&str; 5] = [
    "cycles",
    "cycles an instruction",
    "cycles a bit instruction",
    "cycles a word instruction",
    "bytes an instruction",
];

fn programs_table(page: &mut String, records: &[Record]) {
    let columns = ["program", "what", TIERS[0], TIERS[1], TIERS[2]];
    section(page, "Programs", text::PROGRAMS, &columns);
    for name in names(records, "program") {
        for what in OF_PROGRAMS {
            let cells: Vec<String> =
                TIERS.iter().map(|tier| value(records, tier, what, name)).collect();
            if cells.iter().any(|cell| cell != "-") {
                line(page, &[vec![name.to_string(), what.to_string()], cells].concat());
            }
        }
        let ms = |tier: &&str| match find(records, tier, "cycles", name) {
            Some(record) => format!("{:.3}", record.us() / 1000.0),
            None => "-".to_string(),
        };
        line(
            page,
            &[vec![name.to_string(), "ms".to_string()], TIERS.iter().map(ms).collect()].concat(),
        );
    }
}

fn scans_table(page: &mut String, records: &[Record]) {
    let columns = [
        "cycles",
        "tier",
        "min",
        "median",
        "99 % below",
        "max",
        "mean",
        "the PLC of 2015, measured before",
    ];
    section(page, "Scans of station1", text::SCANS, &columns);
    for (what, before) in [("program", "5,518"), ("whole scan", "15,873"), ("period", "")] {
        for tier in TIERS {
            let cell = |of: &str| value(records, tier, &format!("{what} {of}"), "station1");
            let cells = ["min", "median", "p99", "max", "mean"].map(cell);
            if cells.iter().any(|cell| cell != "-") {
                let head = vec![what.to_string(), tier.to_string()];
                line(page, &[head, cells.to_vec(), vec![before.to_string()]].concat());
            }
        }
    }
    page.push('\n');
    line(page, &["", TIERS[0], TIERS[1], TIERS[2]]);
    let _ = writeln!(page, "|---|---|---|---|");
    for what in ["overhead", "overhead mean", "bytes an instruction"] {
        let cells = TIERS.iter().map(|tier| value(records, tier, what, "station1"));
        line(page, &[what.to_string()].into_iter().chain(cells).collect::<Vec<_>>());
    }
    for record in records.iter().filter(|record| record.section == "firmware") {
        let _ = write!(page, "\n{}: {} {}.\n", record.name, number(record.max), record.what);
    }
}

/// Groups of instructions against the S7-200.
fn comparison_tables(page: &mut String, records: &[Record]) {
    let columns =
        ["instructions", "interpreter", "native", "S7-200", "interpreter is", "native is"];
    section(page, "Against the S7-200", text::COMPARISON, &columns);
    for Line { title, interpreter, native, quoted, speed } in comparison::lines(records) {
        let speed = speed.map(|speed| speed.map_or(String::new(), how_fast));
        let native = native.map_or(String::new(), least_and_most);
        line(
            page,
            &[
                vec![
                    title.to_string(),
                    least_and_most(interpreter),
                    native,
                    least_and_most(quoted),
                ],
                speed.to_vec(),
            ]
            .concat(),
        );
    }
    let _ = write!(page, "\n{}\n", text::VERIFIED);
    line(page, &["row", "interpreter", "CPU 226XM", "which is", "interpreter is"]);
    let _ = writeln!(page, "|---|---|---|---|---|");
    for (name, what, ours, theirs) in comparison::verified(records) {
        line(
            page,
            &[
                format!("`{name}`"),
                short(ours),
                short(theirs),
                what.to_string(),
                how_fast(theirs / ours),
            ],
        );
    }
}

/// Programs and groups of instructions on the Pico.
fn pico_tables(page: &mut String, records: &[Record]) {
    let columns = ["program", "cycles", "ms", "the Uno's interpreter is"];
    section(page, "The Raspberry Pi Pico", text::PICO, &columns);
    for record in records.iter().filter(|record| record.section == "pico") {
        let ms = |record: &Record| record.us() / 1000.0;
        let uno = find(records, INTERPRETER, &record.what, &record.name);
        let slower = uno.map(|uno| format!("{} times slower", short(ms(uno) / ms(record))));
        let name =
            if record.what == "overhead" { "a scan without a program" } else { &record.name };
        let cells = [name, &number(record.max), &format!("{:.3}", ms(record))];
        line(page, &[&cells[..], &[&slower.unwrap_or_default()]].concat());
    }
    page.push('\n');
    line(page, &["instructions", "the Pico, us", "S7-200, us", "the Pico is"]);
    let _ = writeln!(page, "|---|---|---|---|");
    for (title, ours, theirs, times) in comparison::lines_of_pico(records) {
        line(
            page,
            &[title.to_string(), least_and_most(ours), least_and_most(theirs), how_fast(times)],
        );
    }
}

fn least_and_most(range: [f64; 2]) -> String {
    let [least, most] = range.map(short);
    if least == most { least } else { format!("{least} to {most}") }
}

/// In words; the slower is marked.
fn how_fast(times: f64) -> String {
    match times {
        times if times < 0.95 => format!("**{} times slower**", short(1.0 / times)),
        times if times < 1.05 => "as fast".to_string(),
        times => format!("{} times faster", short(times)),
    }
}

/// A number with three digits that count.
fn short(value: f64) -> String {
    match value {
        value if value < 10.0 => number((value * 100.0).round() / 100.0),
        value if value < 100.0 => number((value * 10.0).round() / 10.0),
        value => number(value.round()),
    }
}

fn others_table(page: &mut String) {
    section(
        page,
        "Other systems",
        text::OTHERS_HEAD,
        &["system", "kind", "cycles an AWL instruction"],
    );
    for (name, kind, cycles) in text::OTHERS {
        line(page, &[name, kind, cycles]);
    }
}

/// Budgets only: what is measured differs from machine to machine, and is printed.
fn host_table(page: &mut String) {
    let words = "\
Measured at every run of `cargo xtask bench` and `cargo xtask test`, which print the figures; a \
budget that is missed
fails them. What a machine that is slow at the moment takes longer for work of another kind is \
taken off.
";
    section(page, "Host", words, &["what", "budget"]);
    for (what, budget) in [
        (
            "host interpreter",
            format!(
                ">= {} million bit instructions a second",
                speed::HOST_BITS_PER_SECOND_MIN / 1e6
            ),
        ),
        (
            "assembler",
            format!(">= {} million lines a second", speed::ASSEMBLER_LINES_PER_SECOND_MIN / 1e6),
        ),
        ("assembler, 100,000 lines", format!("<= {} s", speed::LARGE_FILE_SECONDS_MAX)),
    ] {
        line(page, &[what.to_string(), budget]);
    }
}

fn instruction_tables(page: &mut String, records: &[Record]) {
    let _ = write!(page, "\n## Instructions\n\n{}", text::INSTRUCTIONS);
    let mut chapters: Vec<&str> = Vec::new();
    for record in records.iter().filter(|record| !is_typical(records, record)) {
        if !chapters.contains(&&*record.section) && !OTHER_SECTIONS.contains(&&*record.section) {
            chapters.push(&record.section);
        }
    }
    for chapter in chapters {
        let _ = write!(page, "\n### {chapter}\n\n");
        line(
            page,
            &[
                "AWL",
                "interpreter",
                "us",
                "off",
                "native",
                "us",
                "off",
                "native in SRAM",
                "us",
                "off",
                "S7-200",
            ],
        );
        let _ = writeln!(page, "|{}", "---|".repeat(11));
        for name in names(records, chapter) {
            let mut cells = vec![format!("`{name}`")];
            cells.extend(TIERS.iter().flat_map(|tier| instruction_cells(records, tier, name)));
            let quoted =
                records.iter().find(|record| record.name == name && record.what == "cycles");
            cells.push(quoted.and_then(|record| record.quoted_us).map_or("-".to_string(), number));
            line(page, &cells);
        }
    }
}

/// Whether a figure is of an instruction whose time goes with values.
fn is_typical(records: &[Record], record: &Record) -> bool {
    record.what == TYPICAL || find(records, INTERPRETER, TYPICAL, &record.name).is_some()
}

/// Instructions whose time goes with values.
fn module_tables(page: &mut String, records: &[Record]) {
    let _ = write!(page, "\n## Instructions of modules\n\n{}", text::MODULES);
    let mut chapter = "";
    for record in records.iter().filter(|record| record.what == TYPICAL) {
        if record.section != chapter {
            chapter = &record.section;
            let _ = write!(page, "\n### {chapter}\n\n");
            line(page, &["AWL", "typical", "us", "least-most", "each", "off", "S7-200"]);
            let _ = writeln!(page, "|{}", "---|".repeat(7));
        }
        let of = |what: &str| find(records, INTERPRETER, what, &record.name);
        let each = records.iter().filter(|other| other.name == record.name).find_map(Record::each);
        let each = each.filter(|(cycles, ..)| *cycles > 0.0);
        let mark = if is_slower(record) { " !" } else { "" };
        line(
            page,
            &[
                format!("`{}`", record.name),
                number(record.max),
                format!("{:.1}{mark}", record.us()),
                of("cycles").filter(|range| range.min < range.max).map_or(String::new(), span),
                each.map_or(String::new(), |(cycles, unit, _)| {
                    format!("{} a {unit}", number(cycles))
                }),
                of("without power flow").map_or(String::new(), span),
                record.quoted_us.map_or("-".to_string(), number),
            ],
        );
    }
}

fn instruction_cells(records: &[Record], tier: &str, name: &str) -> [String; 3] {
    let cycles = find(records, tier, "cycles", name);
    let mark = |record: &Record| if is_slower(record) { " !" } else { "" };
    let us = cycles.map_or("-".to_string(), |record| format!("{:.2}{}", record.us(), mark(record)));
    let off = find(records, tier, "without power flow", name);
    let off = off.map_or(String::new(), |record| format!("{}{}", span(record), mark(record)));
    [cycles.map_or("-".to_string(), span), us, off]
}

fn exceptions_table(page: &mut String, records: &[Record]) {
    let slower = records.iter().filter(|record| is_slower(record)).count();
    let words = format!(
        "Marked with `!` above ({slower}): slower than what is quoted. Nothing else may be.\n"
    );
    section(page, "Slower than the S7-200", &words, &["instructions", "tier", "what", "why"]);
    for exception in EXCEPTIONS {
        let names: Vec<String> =
            exception.names.iter().map(|name| format!("`{}`", name.trim())).collect();
        line(
            page,
            &[&*names.join(" "), &*exception.tiers.join(", "), exception.what, exception.reason],
        );
    }
}

/// The names in a section, each once, in their order.
fn names<'a>(records: &'a [Record], section: &str) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for record in records.iter().filter(|record| record.section == section) {
        if !names.contains(&&*record.name) {
            names.push(&record.name);
        }
    }
    names
}

fn value(records: &[Record], tier: &str, what: &str, name: &str) -> String {
    find(records, tier, what, name).map_or("-".to_string(), |record| number(record.max))
}

fn span(record: &Record) -> String {
    match record.min == record.max {
        true => number(record.max),
        false => format!("{}-{}", number(record.min), number(record.max)),
    }
}

/// A number with commas between thousands and at most two digits after the point.
fn number(value: f64) -> String {
    let text = format!("{:.2}", value);
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let mut grouped = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index) % 3 == 0 {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    match fraction.trim_end_matches('0') {
        "" => grouped,
        fraction => format!("{grouped}.{fraction}"),
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_are_easy_to_read() {
        let texts = [0.0, 3.5, 18.256, 999.0, 1000.0, 1_234_567.1].map(number);
        assert_eq!(texts, ["0", "3.5", "18.26", "999", "1,000", "1,234,567.1"]);
    }
}
