//! A block as XML, as the DTD of IEC 61499 has it. What is written gives the same block when it is
//! read.

use diagnostics::xml::Writer;

use crate::model::{Algorithm, Block, Event, Place, State, Text, Transition, Variable};
use crate::model::{Primitive, Sequence, Service, Transaction};

/// Writes a block.
pub fn write(block: &Block) -> String {
    let mut out = Writer::default();
    out.line("<!DOCTYPE FBType SYSTEM \"http://www.holobloc.com/xml/LibraryElement.dtd\">");
    let head = [("Name", block.name.text.as_str()), ("Comment", &block.comment)];
    out.element("FBType", &said(&head), |out| {
        if !block.identification.is_empty() {
            out.empty("Identification", &borrowed(&block.identification));
        }
        for version in &block.versions {
            out.empty("VersionInfo", &borrowed(version));
        }
        out.element("InterfaceList", &[], |out| interface(out, block));
        out.element("BasicFB", &[], |out| basic(out, block));
        block.service.iter().for_each(|one| service(out, one));
    });
    out.finish()
}

fn borrowed(pairs: &[(String, String)]) -> Vec<(&str, &str)> {
    pairs.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect()
}

fn interface(out: &mut Writer, block: &Block) {
    list(out, "EventInputs", &block.event_inputs, event);
    list(out, "EventOutputs", &block.event_outputs, event);
    list(out, "InputVars", &block.inputs, variable);
    list(out, "OutputVars", &block.outputs, variable);
}

fn basic(out: &mut Writer, block: &Block) {
    list(out, "InternalVars", &block.internals, variable);
    out.element("ECC", &[], |out| {
        block.states.iter().for_each(|one| state(out, one));
        block.transitions.iter().for_each(|one| transition(out, one));
    });
    block.algorithms.iter().for_each(|one| algorithm(out, one));
}

fn event(out: &mut Writer, event: &Event) {
    let head = [("Name", event.name.text.as_str()), ("Comment", &event.comment), ("Type", "Event")];
    let head = said(&head);
    if event.with.is_empty() {
        return out.empty("Event", &head);
    }
    out.element("Event", &head, |out| {
        event.with.iter().for_each(|one| out.empty("With", &[("Var", &one.text)]));
    });
}

fn variable(out: &mut Writer, variable: &Variable) {
    let size = variable.size.map(|size| size.to_string());
    let mut head = vec![("Name", variable.name.text.as_str()), ("Type", variable.of_type.name())];
    head.extend(size.as_deref().map(|size| ("ArraySize", size)));
    head.extend(variable.initial.as_ref().map(|one| ("InitialValue", one.text.as_str())));
    head.push(("Comment", &variable.comment));
    out.empty("VarDeclaration", &said(&head));
}

fn state(out: &mut Writer, state: &State) {
    let head = [("Name", state.name.text.as_str()), ("Comment", &state.comment)];
    let head = placed(&said(&head), state.place);
    let head = as_str(&head);
    if state.actions.is_empty() {
        return out.empty("ECState", &head);
    }
    out.element("ECState", &head, |out| {
        for action in &state.actions {
            let algorithm = action.algorithm.iter().map(|one| ("Algorithm", one.text.as_str()));
            let output = action.output.iter().map(|one| ("Output", one.text.as_str()));
            out.empty("ECAction", &algorithm.chain(output).collect::<Vec<_>>());
        }
    });
}

fn transition(out: &mut Writer, transition: &Transition) {
    let head = [
        ("Source", transition.source.text.as_str()),
        ("Destination", &transition.destination.text),
        ("Condition", &transition.condition.text),
        ("Comment", &transition.comment),
    ];
    out.empty("ECTransition", &as_str(&placed(&said(&head), transition.place)));
}

fn algorithm(out: &mut Writer, algorithm: &Algorithm) {
    let head = [("Name", algorithm.name.text.as_str()), ("Comment", &algorithm.comment)];
    let Text { text, .. } = &algorithm.text;
    out.element("Algorithm", &said(&head), |out| out.empty("ST", &[("Text", text)]));
}

fn service(out: &mut Writer, service: &Service) {
    out.element("Service", &borrowed(&service.attributes), |out| {
        for Sequence { name, attributes, transactions } in &service.sequences {
            let mut head = vec![("Name", name.text.as_str())];
            head.extend(borrowed(attributes));
            out.element("ServiceSequence", &head, |out| {
                for Transaction { input, outputs } in transactions {
                    out.element("ServiceTransaction", &[], |out| {
                        input.iter().for_each(|one| primitive(out, "InputPrimitive", one));
                        outputs.iter().for_each(|one| primitive(out, "OutputPrimitive", one));
                    });
                }
            });
        }
    });
}

fn primitive(out: &mut Writer, name: &str, one: &Primitive) {
    let head = [
        ("Interface", one.interface.text.as_str()),
        ("Event", &one.event.text),
        ("Parameters", &one.parameters.text),
    ];
    let is_said = |(_, value): &(&str, &str)| !value.is_empty();
    out.empty(name, &head.into_iter().filter(is_said).collect::<Vec<_>>());
}

/// Without a comment that says nothing: it is nothing without it, too.
fn said<'a>(head: &[(&'a str, &'a str)]) -> Vec<(&'a str, &'a str)> {
    head.iter().copied().filter(|(name, value)| *name != "Comment" || !value.is_empty()).collect()
}

fn placed<'a>(head: &[(&'a str, &'a str)], place: Option<Place>) -> Vec<(&'a str, String)> {
    let head = head.iter().map(|(name, value)| (*name, (*value).to_owned()));
    let place = place.map(|at| [("x", at.x.to_string()), ("y", at.y.to_string())]);
    head.chain(place.into_iter().flatten()).collect()
}

fn as_str<'a>(pairs: &'a [(&'a str, String)]) -> Vec<(&'a str, &'a str)> {
    pairs.iter().map(|(name, value)| (*name, value.as_str())).collect()
}

/// Elements in one that is left out where there are none.
fn list<T>(out: &mut Writer, name: &str, all: &[T], one: fn(&mut Writer, &T)) {
    if !all.is_empty() {
        out.element(name, &[], |out| all.iter().for_each(|each| one(out, each)));
    }
}
