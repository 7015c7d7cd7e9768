//! Every form of every instruction occurs in a case, and the comparisons with all their relations.

use std::collections::BTreeSet;

use plc_isa::Relation;
use tests::case::Prepared;
use tests::forms::{places, rows};

#[test]
fn every_form_has_a_case() {
    let name = |name: String, relation: Option<Relation>| match relation {
        Some(relation) => format!("{name} {}", relation.symbol()),
        None => name,
    };
    let mut seen = BTreeSet::new();
    for case in Prepared::all() {
        seen.extend(places(&case.image).iter().map(|place| name(place.row.name(), place.relation)));
    }
    let forms = rows()
        .into_iter()
        .flat_map(|row| row.relations().into_iter().map(move |found| (row, found)));
    let missing: Vec<String> = forms
        .map(|(row, relation)| name(row.name(), relation))
        .filter(|form| !seen.contains(form))
        .collect();
    assert!(missing.is_empty(), "no case for\n{}", missing.join("\n"));
}
