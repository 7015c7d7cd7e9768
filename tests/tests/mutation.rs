//! Whether the cases bite: exchanging an instruction for one that looks the same must break at least one case.
//!
//! For every form of the table and every sibling - another form whose bytes have the same shape and which does the same
//! to the depth of the stack - the tokens of the form are replaced by the sibling's in all cases. The same with each
//! relation of a comparison and each other relation. What the loader refuses needs no case.

use plc_isa::{Relation, verify};
use tests::case::{Prepared, host};
use tests::forms::{Row, places, rows, with_tokens};

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

/// Exchanges tokens in the cases that contain the row, until one fails.
fn fate(cases: &[&Prepared], exchange: impl Fn(&Row, u8) -> Option<u8>) -> Fate {
    let mut fate = Fate::NotRun;
    for case in cases {
        let Some(image) = with_tokens(&case.image, &exchange) else { continue };
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
        for other in rows.iter().filter(|other| row.is_sibling(other)) {
            let exchange = |found: &Row, offset: u8| found.is(row).then_some(other.form.first_token + offset);
            note(fate(&cases, exchange), &|| format!("{} -> {}", row.name(), other.name()));
        }
        if row.has_relation() {
            for (from, to) in pairs() {
                let first = row.form.first_token;
                let exchange =
                    |found: &Row, offset: u8| (found.is(row) && offset == from as u8).then_some(first + to as u8);
                note(fate(&cases, exchange), &|| format!("{} {} -> {}", row.name(), from.symbol(), to.symbol()));
            }
        }
    }
    assert!(survivors.is_empty(), "{} survive, {killed} do not\n{}", survivors.len(), survivors.join("\n"));
    assert!(killed > 700, "only {killed} mutations were tried");
}

/// Each relation with each other.
fn pairs() -> impl Iterator<Item = (Relation, Relation)> {
    let all = Relation::ALL;
    all.into_iter().flat_map(move |from| all.into_iter().filter(move |&to| to != from).map(move |to| (from, to)))
}
