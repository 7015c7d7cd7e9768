//! `{feedback}` where a text has none yet: diagrams of others say in which order they are executed,
//! and not which links are of the scan before.

use std::collections::HashMap;

use diagnostics::Source;
use st::lexer::cut;

use crate::addresses::Addresses;
use crate::elements::{Element, Reading};
use crate::feedback::{Feedback, bare};

/// A text whose diagrams are executed in the order of their statements, with `{feedback}` before
/// each name that is read before it is written.
pub fn marked(source: &Source) -> String {
    let (file, _) = st::parser::parse(source);
    let pragmas = cut(&source.text).pragmas;
    let mut feedback = Feedback::of(&source.text, &pragmas);
    let mut marks: Vec<u32> = Vec::new();
    for unit in crate::diagrams(&file) {
        let addresses = Addresses::of(unit);
        let mut reading = Reading { text: &source.text, addresses, feedback: &mut feedback };
        let elements: Vec<Element> = unit
            .body
            .iter()
            .filter_map(|one| Element::of(one.clone(), &mut reading).ok())
            .collect();
        let mut later: HashMap<&str, usize> = HashMap::new();
        for (at, element) in elements.iter().enumerate() {
            later.extend(element.writes.iter().map(|one| (one.name.as_str(), at)));
        }
        for (at, element) in elements.iter().enumerate() {
            let is_later = |name: &str| later.get(name).is_some_and(|writer| *writer >= at);
            let reads = element.reads.iter().filter(|one| !one.is_feedback && is_later(&one.name));
            marks.extend(reads.map(|one| bare(&source.text, one.span).start));
        }
    }
    marks.sort_unstable();
    marks.dedup();
    let mut text = source.text.clone();
    for at in marks.into_iter().rev() {
        text.insert_str(at as usize, "{feedback} ");
    }
    text
}
