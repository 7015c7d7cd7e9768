//! Every form of every instruction occurs in a case, and the comparisons with all their relations.

use std::collections::BTreeSet;

use plc_isa::Relation;
use tests::case::Prepared;
use tests::forms::{places, rows};

#[test]
fn every_form_has_a_case() {
    let mut seen = BTreeSet::new();
    for case in Prepared::all() {
        for place in places(&case.image) {
            let offset = case.image[place.token_at] - place.row.form.first_token;
            seen.insert((place.row.name(), if place.row.has_relation() { offset } else { 0 }));
        }
    }
    let mut missing = Vec::new();
    for row in rows() {
        let relations = if row.has_relation() { &Relation::ALL[..] } else { &Relation::ALL[..1] };
        for (&relation, offset) in relations.iter().zip(0..) {
            if !seen.contains(&(row.name(), offset)) {
                let sign = if row.has_relation() { relation.symbol() } else { "" };
                missing.push(format!("{} {sign}", row.name()));
            }
        }
    }
    assert!(missing.is_empty(), "no case for\n{}", missing.join("\n"));
}
