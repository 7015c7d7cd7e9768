//! What is connected to what: a block is called once, each input has one source, nothing is beside
//! the diagram.

use std::collections::{HashMap, HashSet};

use diagnostics::Span;
use st::tree::{SectionKind, Unit};

use crate::diagnostic::{Code, Diagnostic};
use crate::elements::{Element, Reading};

/// Reports what is connected twice, or not at all.
pub(crate) fn check(
    reading: &Reading,
    unit: &Unit,
    elements: &[Element],
    found: &mut Vec<Diagnostic>,
) {
    let calls = elements.iter().filter(|element| element.is_call);
    let instances: HashSet<&str> =
        calls.filter_map(|element| Some(element.writes.first()?.path.as_str())).collect();
    let mut sources: HashMap<&str, Span> = HashMap::new();
    for element in elements {
        for (at, operand) in element.writes.iter().enumerate() {
            let written = operand.span.text(reading.text);
            let is_input = operand.path != operand.name && instances.contains(&operand.name[..]);
            let other = sources.insert(&operand.path, operand.span);
            found.extend(match other {
                _ if is_input => Some(input(written, operand.span)),
                Some(other) if element.is_call && at == 0 => {
                    let help = "a block of a diagram is called once: declare another instance";
                    let message = format!("{written}: this block is called twice");
                    let one = Diagnostic::new(Code::CalledTwice, operand.span, message);
                    Some(one.help(help).related(other, "the other call"))
                }
                Some(other) => {
                    let help = "choose one of two values with SEL, or join them with OR, MAX, +";
                    let message = format!("{written}: two elements give it a value");
                    let one = Diagnostic::new(Code::TwoSources, operand.span, message);
                    Some(one.help(help).related(other, "the other one"))
                }
                None => None,
            });
        }
    }
    not_connected(reading, unit, elements, found);
}

/// Something that is assigned to in a block that is called.
fn input(written: &str, span: Span) -> Diagnostic {
    let message = format!("{written}: its block is called, and that is what gives it a value");
    let help = "an input is given in the call, `Block(IN := Button);`";
    Diagnostic::new(Code::TwoSources, span, message).help(help)
}

/// Reports variables of the unit's own that no element has.
fn not_connected(
    reading: &Reading,
    unit: &Unit,
    elements: &[Element],
    found: &mut Vec<Diagnostic>,
) {
    if elements.is_empty() {
        return;
    }
    let operands = elements.iter().flat_map(|one| one.reads.iter().chain(&one.writes));
    let connected: HashSet<&str> = operands.map(|operand| operand.name.as_str()).collect();
    let own = unit.sections.iter().filter(|one| one.kind == SectionKind::Var && !one.is_constant);
    for name in own.flat_map(|one| &one.declarations).flat_map(|one| &one.names) {
        if connected.contains(&reading.addresses.resolve(&name.text)[..]) {
            continue;
        }
        let message = format!("{}: nothing is connected to it", name.text);
        let help = "call it if it is a block, connect it, or take its declaration out";
        found.push(Diagnostic::new(Code::NotConnected, name.span, message).help(help));
    }
}
