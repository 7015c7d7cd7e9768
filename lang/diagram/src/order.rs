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
    // How many links each waits for, and who waits for it by how many.
    let mut open: Vec<usize> = after.iter().map(Vec::len).collect();
    let mut waiting: Vec<Vec<usize>> = elements.iter().map(|_| Vec::new()).collect();
    for (at, links) in after.iter().enumerate() {
        for link in links {
            waiting.get_mut(link.other).into_iter().for_each(|waiting| waiting.push(at));
        }
    }
    let is_open = |open: &[usize], at: usize| open.get(at).is_some_and(|count| *count > 0);
    let all = 0..elements.len();
    let mut ready: BTreeSet<usize> = all.clone().filter(|at| !is_open(&open, *at)).collect();
    let mut left: BTreeSet<usize> = all.collect();
    let mut order = Vec::new();
    while let Some(first) = left.first().copied() {
        let Some(next) = ready.pop_first() else {
            let closed = loop_from(&after, &left, first);
            let (opened, link) = report(elements, &after, &closed, found);
            let (Some(links), Some(count)) = (after.get_mut(opened), open.get_mut(opened)) else {
                break;
            };
            let before = links.len();
            links.retain(|one| one.other != link);
            *count = count.saturating_sub(before - links.len());
            waiting.get_mut(link).into_iter().for_each(|all| all.retain(|one| *one != opened));
            if *count == 0 {
                ready.insert(opened);
            }
            continue;
        };
        left.remove(&next);
        order.push(next);
        for at in waiting.get_mut(next).map(std::mem::take).unwrap_or_default() {
            let Some(count) = open.get_mut(at) else { continue };
            *count = count.saturating_sub(1);
            if *count == 0 {
                ready.insert(at);
            }
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
