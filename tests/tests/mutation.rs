//! Whether the cases bite: exchanging an instruction for one that looks the same must break at
//! least one case.
//!
//! For every form of the table and every sibling - another form whose bytes have the same shape and
//! which does the same to the depth of the stack - the tokens of the form are replaced by the
//! sibling's in all cases. The same with each relation of a comparison and each other relation.
//! What the loader refuses needs no case.

use plc_isa::{Op, Relation, verify};
use tests::case::{Prepared, host};
use tests::forms::{Row, places, rows, with_relation, with_row};

/// What became of a mutation.
#[derive(Debug, PartialEq, Eq)]
enum Fate {
    /// A case failed.
    Killed,
    /// No image with it is valid, or no case has the form.
    NotRun,
    /// Cases ran and held.
    Survived,
}

/// Changes the image of each case that contains the row, until one fails.
fn fate(cases: &[&Prepared], change: impl Fn(&[u8]) -> Option<Vec<u8>>) -> Fate {
    let mut fate = Fate::NotRun;
    for case in cases {
        let Some(image) = change(&case.image) else { continue };
        if verify(&image[..]).is_err() {
            continue;
        }
        if !case.failures(&mut host(&image)).is_empty() {
            return Fate::Killed;
        }
        fate = Fate::Survived;
    }
    fate
}

#[test]
fn exchanged_instructions_break_a_case() {
    let prepared = Prepared::all();
    let (mut survivors, mut killed) = (Vec::new(), 0);
    let mut note = |fate: Fate, name: &dyn Fn() -> String| match fate {
        Fate::Killed => killed += 1,
        Fate::NotRun => {}
        Fate::Survived => survivors.push(name()),
    };
    let rows = rows();
    for row in &rows {
        let has_row = |case: &&Prepared| places(&case.image).iter().any(|place| place.row.is(row));
        let cases: Vec<&Prepared> = prepared.iter().filter(has_row).collect();
        for other in rows.iter().filter(|other| row.is_sibling(other) && !mean_the_same(row, other))
        {
            note(fate(&cases, |image| with_row(image, row, other)), &|| {
                format!("{} -> {}", row.name(), other.name())
            });
        }
        for (from, to) in pairs(row) {
            let change = |image: &[u8]| with_relation(image, row, from, to);
            note(fate(&cases, change), &|| {
                format!("{} {} -> {}", row.name(), from.symbol(), to.symbol())
            });
        }
    }
    assert!(
        survivors.is_empty(),
        "{} survive, {killed} do not\n{}",
        survivors.len(),
        survivors.join("\n")
    );
    assert!(killed > 3_000, "only {killed} mutations were tried");
}

/// Whether one row in the place of the other changes nothing that a case on the host can see: a
/// real is copied like any double word, a contact is a contact, both returns return, both jumps
/// jump. Time is still within a scan, and where no event is attached none is looked for.
fn mean_the_same(row: &Row, other: &Row) -> bool {
    let is_in =
        |ops: &[Op]| ops.contains(&row.instruction.op) && ops.contains(&other.instruction.op);
    let returns = is_in(&[Op::Cret, Op::Creti]);
    let jumps = is_in(&[Op::Jmp, Op::Cscre]);
    let idle =
        is_in(&[Op::Scre, Op::Refresh, Op::Poll, Op::Approach]) && row.instruction.op != Op::Poll;
    is_in(&[Op::Movd, Op::Movr]) || is_in(&[Op::A, Op::ScrAnd]) || returns || jumps || idle
}

/// Each relation of a row with each other.
fn pairs(row: &Row) -> Vec<(Relation, Relation)> {
    let all: Vec<Relation> = row.relations().into_iter().flatten().collect();
    all.iter()
        .flat_map(|&from| all.iter().filter(move |&&to| to != from).map(move |&to| (from, to)))
        .collect()
}
