//! What is connected to what: a block is called once, each input has one source, nothing is beside
//! the diagram.

use std::collections::HashMap;

use diagnostics::Span;
use st::tree::{SectionKind, Unit};

use crate::diagnostic::{Code, Diagnostic};
use crate::elements::Element;

/// Reports what is connected twice, or not at all.
pub(crate) fn check(text: &str, unit: &Unit, elements: &[Element], found: &mut Vec<Diagnostic>) {
    let addresses = addresses(unit);
    let mut sources: HashMap<&str, Span> = HashMap::new();
    for element in elements {
        for (at, operand) in element.writes.iter().enumerate() {
            let path = addresses.get(&operand.path).unwrap_or(&operand.path);
            let Some(other) = sources.insert(path, operand.span) else { continue };
            let is_instance = element.is_call && at == 0;
            let written = operand.span.text(text);
            found.push(match is_instance {
                true => {
                    let help = "a block of a diagram is called once: declare another instance";
                    let message = format!("{}: this block is called twice", element.name);
                    let one = Diagnostic::new(Code::CalledTwice, operand.span, message);
                    one.help(help).related(other, "the other call")
                }
                false => {
                    let help = "choose one of two values with SEL, or join them with OR, MAX, +";
                    let message = format!("{written}: two elements give it a value");
                    let one = Diagnostic::new(Code::TwoSources, operand.span, message);
                    one.help(help).related(other, "the other one")
                }
            });
        }
    }
    not_connected(unit, elements, found);
}

/// The addresses of the variables that have one, by their names.
fn addresses(unit: &Unit) -> HashMap<String, String> {
    let declarations = unit.sections.iter().flat_map(|section| &section.declarations);
    let with_address = declarations.filter_map(|one| Some((one.at.as_ref()?, &one.names)));
    let of_names = with_address.flat_map(|(at, names)| {
        let address = at.text.to_uppercase();
        names.iter().map(move |name| (name.text.to_uppercase(), address.clone()))
    });
    of_names.collect()
}

/// Reports variables of the unit's own that no element has.
fn not_connected(unit: &Unit, elements: &[Element], found: &mut Vec<Diagnostic>) {
    let own = unit.sections.iter().filter(|one| one.kind == SectionKind::Var && !one.is_constant);
    for name in own.flat_map(|one| &one.declarations).flat_map(|one| &one.names) {
        let key = name.text.to_uppercase();
        let mut operands = elements.iter().flat_map(|one| one.reads.iter().chain(&one.writes));
        if elements.is_empty() || operands.any(|operand| operand.name == key) {
            continue;
        }
        let message = format!("{}: nothing is connected to it", name.text);
        let help = "call it if it is a block, connect it, or take its declaration out";
        found.push(Diagnostic::new(Code::NotConnected, name.span, message).help(help));
    }
}
