//! The parts of a program: units, their networks, labels.

use awl_asm::ast::{Instruction, Network, Program, Statement, Unit};
use diagnostics::Span;
use plc_isa::Op;

use crate::answer::{Outline, OutlineKind};
use crate::language::View;

/// The parts of a program in their order. Each ends where the next of its kind begins.
pub(super) fn of(text: &str, program: &Program) -> Vec<Outline> {
    let mut open = Open { end: text.len() as u32, ..Open::default() };
    for statement in &program.statements {
        match statement {
            Statement::Unit(one) => open.unit(one),
            Statement::Network(one) => open.network(one),
            Statement::Instruction(one) if one.entry.op == Op::Lbl => open.add(label(text, one)),
            Statement::Instruction(_) => {}
        }
    }
    open.close_unit(open.end);
    open.done
}

/// The parts of a program that are in one of its texts, with their places there.
pub(super) fn here(view: View<'_>, parts: Vec<Outline>) -> Vec<Outline> {
    let one = |part: Outline| {
        let children = here(view, part.children);
        match (view.span_here(part.span), view.span_here(part.name_span)) {
            (Some(span), Some(name_span)) => vec![Outline { span, name_span, children, ..part }],
            // The main program around a text without blocks is in no text.
            _ => children,
        }
    };
    parts.into_iter().flat_map(one).collect()
}

/// The parts that are not at their end.
#[derive(Default)]
struct Open {
    done: Vec<Outline>,
    unit: Option<Outline>,
    network: Option<Outline>,
    /// Where the text ends.
    end: u32,
}

impl Open {
    fn unit(&mut self, unit: &Unit) {
        self.close_unit(unit.span.start);
        let name = if unit.name.is_empty() { unit.id.to_string() } else { unit.name.clone() };
        self.unit = Some(Outline {
            name,
            detail: format!("{} {}", unit.id, unit.title).trim_end().to_owned(),
            kind: OutlineKind::Unit,
            span: unit.span,
            name_span: unit.span,
            children: Vec::new(),
        });
    }

    fn network(&mut self, network: &Network) {
        self.close_network(network.span.start);
        self.network = Some(Outline {
            name: format!("NETWORK {}", network.number),
            detail: network.title.clone(),
            kind: OutlineKind::Network,
            span: network.span,
            name_span: network.span,
            children: Vec::new(),
        });
    }

    /// Adds a part to the innermost one that is open.
    fn add(&mut self, part: Outline) {
        match self.network.as_mut().or(self.unit.as_mut()) {
            Some(outer) => outer.children.push(part),
            None => self.done.push(part),
        }
    }

    fn close_network(&mut self, end: u32) {
        if let Some(mut network) = self.network.take() {
            network.span.end = end.max(network.span.end);
            self.unit.as_mut().map_or(&mut self.done, |unit| &mut unit.children).push(network);
        }
    }

    fn close_unit(&mut self, end: u32) {
        self.close_network(end);
        if let Some(mut unit) = self.unit.take() {
            unit.span.end = end.max(unit.span.end);
            self.done.push(unit);
        }
    }
}

fn label(text: &str, source: &Instruction) -> Outline {
    let number = source.operands.first().map_or(source.span, |operand| operand.span);
    Outline {
        name: format!("LBL {}", Span::text(number, text)),
        detail: String::new(),
        kind: OutlineKind::Label,
        span: source.span,
        name_span: number,
        children: Vec::new(),
    }
}
