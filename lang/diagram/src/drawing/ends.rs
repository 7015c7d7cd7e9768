//! From where to where links lead: from the output that writes a value to each input that reads it.

use std::collections::HashMap;

use diagnostics::Span;
use st::tree::StatementKind;

use super::Unwired;
use super::boxes::measure;
use super::shapes::{ElementShape, End, LinkShape};
use crate::elements::{Element, Operand};

/// What writes a name: the number of the element, and which of its writes.
type Writers<'e> = HashMap<&'e str, Vec<(usize, usize)>>;

impl Unwired<'_> {
    /// The links, without lines. Inputs that a link alone gives a value have no text then, and all
    /// boxes have their sizes.
    pub(super) fn links(&self, elements: &mut [ElementShape]) -> Vec<LinkShape> {
        let mut writers: Writers = HashMap::new();
        for (at, element) in self.elements.iter().enumerate() {
            for (which, operand) in element.writes.iter().enumerate() {
                writers.entry(&operand.name).or_default().push((at, which));
            }
        }
        let mut links = Vec::new();
        for (at, element) in self.elements.iter().enumerate() {
            for operand in &element.reads {
                let Some((pin, given)) = self.input_with(element, elements.get(at), operand) else {
                    continue;
                };
                let before = links.len();
                for from in self.sources(&writers, operand, elements) {
                    let (to, is_feedback) = (End { element: at, pin }, operand.is_feedback);
                    let link = LinkShape { from, to, is_feedback, points: Vec::new() };
                    if !links[before..].contains(&link) {
                        links.push(link);
                    }
                }
                if links.len() > before && given == operand.span {
                    let pin = elements.get_mut(at).and_then(|one| one.inputs.get_mut(pin));
                    pin.into_iter().for_each(|pin| pin.text.clear());
                }
            }
        }
        links.sort_by_key(|one| (one.from, one.to));
        links.dedup_by_key(|one| (one.from, one.to, one.is_feedback));
        elements.iter_mut().for_each(measure);
        links
    }

    /// The number of the input in whose expression an operand is read, and all of that.
    fn input_with(
        &self,
        element: &Element,
        shape: Option<&ElementShape>,
        operand: &Operand,
    ) -> Option<(usize, Span)> {
        match &element.statement.kind {
            StatementKind::Call(_, arguments) => {
                let inputs = arguments.iter().enumerate().filter(|(_, one)| !one.is_output);
                let mut holding = inputs.filter(|(_, one)| operand.span.is_in(one.value.span));
                let (at, argument) = holding.next()?;
                let written = argument.value.span.text(self.text);
                let is_it = |pin: &super::shapes::Pin| match &argument.name {
                    Some(name) => pin.name.eq_ignore_ascii_case(&name.text),
                    None => pin.written.as_deref() == Some(written),
                };
                let pin = shape?.inputs.iter().position(is_it).unwrap_or(at);
                Some((pin, argument.value.span))
            }
            StatementKind::Assign(_, value) => Some((0, value.span)),
            _ => None,
        }
    }

    /// The outputs that write what is read: those that write just that, or else all that write
    /// something of the variable.
    fn sources(&self, writers: &Writers, operand: &Operand, shapes: &[ElementShape]) -> Vec<End> {
        let all = writers.get(operand.name.as_str()).map(|all| &all[..]).unwrap_or_default();
        let writes = |&&(at, which): &&(usize, usize)| {
            let written = self.elements.get(at).and_then(|one| one.writes.get(which));
            written.is_some_and(|one| {
                is_part(&operand.path, &one.path) || is_part(&one.path, &operand.path)
            })
        };
        let just: Vec<_> = all.iter().filter(writes).collect();
        let all = if just.is_empty() { all.iter().collect() } else { just };
        let end = |&(at, which): &(usize, usize)| {
            let (element, shape) = (self.elements.get(at)?, shapes.get(at)?);
            Some(End { element: at, pin: output(element, shape, which, operand)? })
        };
        all.into_iter().filter_map(end).collect()
    }
}

/// Whether a path leads to something in another one.
fn is_part(path: &str, of: &str) -> bool {
    path.strip_prefix(of).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// The output of an element from which an operand comes.
fn output(
    element: &Element,
    shape: &ElementShape,
    which: usize,
    operand: &Operand,
) -> Option<usize> {
    let StatementKind::Call(_, arguments) = &element.statement.kind else { return Some(0) };
    let named =
        |name: &str| shape.outputs.iter().position(|pin| pin.name.eq_ignore_ascii_case(name));
    if which == 0 {
        return named(element.output_in(operand)?);
    }
    let written = element.writes.get(which)?.span;
    let argument = arguments.iter().find(|one| one.is_output && written.is_in(one.value.span))?;
    named(&argument.name.as_ref()?.text)
}
