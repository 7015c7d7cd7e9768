//! The order of execution: whoever reads a value comes after those that write it, and before them
//! where it is a feedback. Where that leaves a choice, the order of the text decides.

use std::collections::{BTreeSet, HashMap};

use crate::diagnostic::{Code, Diagnostic};
use crate::elements::{Element, Operand};

/// An element comes after another one, because of this operand of one of them.
struct After<'e> {
    other: usize,
    because: &'e Operand,
}

/// The numbers of the elements in their order. Loops are reported, each once, and opened.
pub(crate) fn of(elements: &[Element], found: &mut Vec<Diagnostic>) -> Vec<usize> {
    let mut after = links(elements);
    let mut order = Vec::new();
    let mut left: BTreeSet<usize> = (0..elements.len()).collect();
    while let Some(first) = left.first().copied() {
        let is_ready = |at: &usize| waits_for(&after, &left, *at).next().is_none();
        if let Some(ready) = left.iter().copied().find(is_ready) {
            left.remove(&ready);
            order.push(ready);
            continue;
        }
        let closed = loop_from(&after, &left, first);
        let (opened, link) = report(elements, &after, &closed, found);
        if let Some(links) = after.get_mut(opened) {
            links.retain(|one| one.other != link);
        }
    }
    order
}

/// What each element comes after.
fn links(elements: &[Element]) -> Vec<Vec<After<'_>>> {
    let mut writers: HashMap<&str, Vec<usize>> = HashMap::new();
    for (at, element) in elements.iter().enumerate() {
        for operand in &element.writes {
            writers.entry(&operand.name).or_default().push(at);
        }
    }
    let mut after: Vec<Vec<After>> = elements.iter().map(|_| Vec::new()).collect();
    for (at, element) in elements.iter().enumerate() {
        for because in &element.reads {
            for &writer in writers.get(because.name.as_str()).into_iter().flatten() {
                let (later, other) = if because.is_feedback { (writer, at) } else { (at, writer) };
                if because.is_feedback && writer == at {
                    continue;
                }
                if let Some(links) = after.get_mut(later) {
                    links.push(After { other, because });
                }
            }
        }
    }
    after
}

fn waits_for<'l, 'e>(
    after: &'l [Vec<After<'e>>],
    left: &'l BTreeSet<usize>,
    at: usize,
) -> impl Iterator<Item = &'l After<'e>> {
    after.get(at).into_iter().flatten().filter(|link| left.contains(&link.other))
}

/// A loop among elements that all wait for others of them: each waits for the next one, the last
/// for the first.
fn loop_from(after: &[Vec<After>], left: &BTreeSet<usize>, first: usize) -> Vec<usize> {
    let mut way = vec![first];
    while let Some(next) = way.last().and_then(|at| waits_for(after, left, *at).next()) {
        if let Some(start) = way.iter().position(|at| *at == next.other) {
            return way.split_off(start);
        }
        way.push(next.other);
    }
    way
}

/// Reports a loop at the link that leads back in the text, and returns that: the element, and the
/// one that it waits for.
fn report(
    elements: &[Element],
    after: &[Vec<After>],
    closed: &[usize],
    found: &mut Vec<Diagnostic>,
) -> (usize, usize) {
    let next = closed.iter().cycle().skip(1);
    let links = || closed.iter().copied().zip(next.clone().copied());
    let back = links().find(|(at, other)| other >= at).or(links().next()).unwrap_or_default();
    let link = after.get(back.0).into_iter().flatten().find(|link| link.other == back.1);
    let name = |at: &usize| elements.get(*at).map_or("", |element| element.name.as_str());
    // Values go from the last one to the first.
    let mut names: Vec<&str> = closed.iter().rev().map(name).collect();
    names.extend(names.first().copied());
    if let Some(link) = link {
        let message = format!("a loop: {}", names.join(" -> "));
        let one = Diagnostic::new(Code::Loop, link.because.span, message);
        found.push(one.help(match link.because.is_feedback {
            true => "a feedback is read before its block is called: another link wants it after",
            false => "`{feedback}` before one of the links takes the value of the scan before",
        }));
    }
    back
}
