//! The board's part: runs the measuring program, holds its figures against the budgets, against the
//! S7-200 and against those of docs/benchmarks.csv, and writes them there.

use std::fs;

use anyhow::{Context, Result, ensure};

use super::budget;
use super::costs;
use super::exceptions;
use super::page;
use super::pairs;
use super::record::{Record, parse_all, text_of};
use crate::process::{WITH_BOARD, cargo, root};
use crate::{firmware, packages};

const FIGURES: &str = "docs/benchmarks.csv";
const PAGE: &str = "docs/benchmarks.md";
/// What the assembler knows about modules.
const COSTS: &str = "awl-asm/src/output/cost/modules.rs";

/// Share by which a figure may change without being a change. What the assembler engine does is
/// exact; another version of the compiler makes other code of the rest.
const TOLERANCE: f64 = 0.03;

/// Measures and writes the files, unless something has become slower. Then prints what misses its
/// budget.
pub fn write() -> Result<()> {
    let records = measure()?;
    if root().join(FIGURES).exists() {
        let bad = changes(&known()?, &records)
            .into_iter()
            .filter(|change| matches!(change.kind, Kind::Worse | Kind::Gone));
        report("worse than in docs/benchmarks.csv (delete the file if it has to be so)", bad)?;
    }
    put(FIGURES, &text_of(&records))?;
    println!("{} figures in {PAGE} and {FIGURES}, those of modules in {COSTS}", records.len());
    write_pages()
}

/// Writes what is made of the figures, and prints what misses its budget. Measures nothing.
pub fn write_pages() -> Result<()> {
    let records = known()?;
    for (file, text) in files_of(&records)? {
        put(file, &text)?;
    }
    judge(&records)
}

/// What is made of figures: files with their texts.
fn files_of(records: &[Record]) -> Result<[(&'static str, String); 2]> {
    // The page has what needs no board, too.
    let page = page::page(records) + &pairs::tables()?;
    Ok([(PAGE, page), (COSTS, costs::table(records)?)])
}

/// Fails where a file that is made of the figures says something else. Measures nothing.
pub fn check_files() -> Result<()> {
    for (file, text) in files_of(&known()?)? {
        let kept =
            fs::read_to_string(root().join(file)).with_context(|| format!("cannot read {file}"))?;
        ensure!(kept == text, "{file} is not what {FIGURES} says: run `cargo xtask bench`");
    }
    Ok(())
}

/// Measures, and fails where a budget is missed or the figures have changed.
pub fn check() -> Result<()> {
    let (known, records) = (known()?, measure()?);
    let (better, bad): (Vec<_>, Vec<_>) =
        changes(&known, &records).into_iter().partition(|change| change.kind == Kind::Better);
    if !better.is_empty() {
        println!(
            "{} figures are better than in {PAGE}: `cargo xtask bench` writes them there",
            better.len()
        );
    }
    report(
        "not what docs/benchmarks.csv says; `cargo xtask bench` writes it, unless it is worse",
        bad,
    )?;
    judge(&records)
}

fn known() -> Result<Vec<Record>> {
    let text = fs::read_to_string(root().join(FIGURES))
        .with_context(|| format!("cannot read {FIGURES}"))?;
    parse_all(&text).with_context(|| FIGURES.to_string())
}

fn put(file: &str, text: &str) -> Result<()> {
    fs::write(root().join(file), text).with_context(|| format!("cannot write {file}"))
}

/// Builds the firmware and measures it.
fn measure() -> Result<Vec<Record>> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    let elf = firmware::build()?;
    let mut command = cargo();
    command.args(["run", "--quiet", "--bin", "measure"]).args(WITH_BOARD);
    command.env(awl_asm::firmware::VARIABLE, elf);
    let output =
        command.stderr(std::process::Stdio::inherit()).output().context("cannot start cargo")?;
    ensure!(output.status.success(), "the measuring failed ({})", output.status);
    parse_all(&String::from_utf8(output.stdout)?)
}

/// What has become of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Worse,
    Better,
    /// Not measured any more.
    Gone,
    New,
}

/// A figure that is not what it was.
struct Change {
    text: String,
    kind: Kind,
}

fn changes(known: &[Record], records: &[Record]) -> Vec<Change> {
    let mut changes = Vec::new();
    for old in known {
        let Some(new) = records.iter().find(|new| new.is_same(old)) else {
            changes.push(Change {
                text: format!("{}: not measured any more", old.title()),
                kind: Kind::Gone,
            });
            continue;
        };
        if old.is_by_chance() {
            continue;
        }
        let kind = match new.max {
            max if max > old.max * (1.0 + TOLERANCE) => Kind::Worse,
            max if max < old.max * (1.0 - TOLERANCE) => Kind::Better,
            _ => continue,
        };
        changes
            .push(Change { text: format!("{}: {}, was {}", old.title(), new.max, old.max), kind });
    }
    let added = records.iter().filter(|new| !known.iter().any(|old| old.is_same(new)));
    changes
        .extend(added.map(|new| Change { text: format!("{}: new", new.title()), kind: Kind::New }));
    changes
}

fn report(what: &str, changes: impl IntoIterator<Item = Change>) -> Result<()> {
    let texts: Vec<String> = changes.into_iter().map(|change| change.text).collect();
    ensure!(texts.is_empty(), "{} figures are {what}:\n  {}", texts.len(), texts.join("\n  "));
    Ok(())
}

/// Prints every budget, and fails where one is missed or an instruction is slower than it may be.
fn judge(records: &[Record]) -> Result<()> {
    let verdicts = budget::verdicts(records);
    for verdict in &verdicts {
        println!("{verdict}");
    }
    let breaches = exceptions::breaches(records);
    for breach in &breaches {
        println!("{breach}");
    }
    let missed = verdicts.iter().filter(|verdict| !verdict.is_met()).count();
    ensure!(
        missed == 0 && breaches.is_empty(),
        "{missed} budgets missed, {} comparisons with the S7-200",
        breaches.len()
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records(lines: &[&str]) -> Vec<Record> {
        parse_all(&format!("{}\n{}", super::super::record::HEAD, lines.join("\n"))).unwrap()
    }

    #[test]
    fn the_longest_scans_are_a_matter_of_chance() {
        let of =
            |max: u32| records(&[&format!("scan,native,whole scan max,{max},{max},,\"station1\"")]);
        assert!(changes(&of(1000), &of(2000)).is_empty());
        let of = |max: u32| {
            records(&[&format!("scan,native,whole scan median,{max},{max},,\"station1\"")])
        };
        assert_eq!(changes(&of(1000), &of(2000)).len(), 1);
    }

    #[test]
    fn a_figure_that_is_three_percent_higher_is_a_change_for_the_worse() {
        let known = records(&[
            "scan,native,program,400,400,,\"station1\"",
            "scan,native,period,900,1000,,\"station1\"",
        ]);
        let found = |program: u32, period: u32| {
            let lines = [
                format!("scan,native,program,{program},{program},,\"station1\""),
                format!("scan,native,period,900,{period},,\"station1\""),
            ];
            let new = records(&[&lines[0], &lines[1]]);
            changes(&known, &new).iter().map(|change| change.kind).collect::<Vec<_>>()
        };
        assert!(found(400, 1000).is_empty() && found(412, 970).is_empty());
        assert_eq!(found(413, 1000), [Kind::Worse]);
        assert_eq!(found(400, 960), [Kind::Better]);
        let kinds = |known, records| {
            changes(known, records).iter().map(|change| change.kind).collect::<Vec<_>>()
        };
        assert_eq!(kinds(&known, &known[..1]), [Kind::Gone]);
        assert_eq!(kinds(&known[..1], &known), [Kind::New]);
    }
}
