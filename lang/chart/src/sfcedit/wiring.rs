//! The steps before and after each transition, from sequences, links and jumps; and what is not
//! well-formed about them.

use std::collections::HashMap;

use super::document::{Element, Grafcet, Link, LinkKind, Name, Step, Transition};
use crate::diagnostic::{Code, Diagnostic};

/// A chart as steps and transitions.
#[derive(Debug, Default)]
pub struct Wiring<'g> {
    /// The steps in the order of the text.
    pub steps: Vec<&'g Step>,
    /// The transitions in the order of the text.
    pub transitions: Vec<Wired<'g>>,
    /// How many jumps there are.
    pub jumps: usize,
}

/// A transition with its steps.
#[derive(Debug)]
pub struct Wired<'g> {
    /// What is written.
    pub transition: &'g Transition,
    /// Numbers of the steps before it.
    pub from: Vec<usize>,
    /// Numbers of the steps after it.
    pub to: Vec<usize>,
}

/// A step or transition by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Node {
    Step(usize),
    Transition(usize),
}

/// Joins the sequences of a chart.
pub fn wire<'g>(grafcet: &'g Grafcet, diagnostics: &mut Vec<Diagnostic>) -> Wiring<'g> {
    let mut wirer = Wirer {
        wiring: Wiring { jumps: grafcet.jumps.len(), ..Wiring::default() },
        ends: HashMap::new(),
        ids: Vec::new(),
        diagnostics,
    };
    wirer.sequences(grafcet);
    for link in &grafcet.links {
        wirer.link(link);
    }
    for jump in &grafcet.jumps {
        let ends = wirer.end(&jump.from).zip(wirer.start(&jump.to));
        if let Some((from, to)) = ends {
            wirer.join(from, to, &jump.from);
        }
    }
    wirer.wiring
}

struct Wirer<'g, 'd> {
    wiring: Wiring<'g>,
    /// First and last element of each sequence.
    ends: HashMap<&'g str, (Node, Node)>,
    ids: Vec<&'g str>,
    diagnostics: &'d mut Vec<Diagnostic>,
}

impl<'g> Wirer<'g, '_> {
    fn error(&mut self, at: &Name, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::XmlStructure, at.span, message).help(help));
    }

    fn sequences(&mut self, grafcet: &'g Grafcet) {
        for sequence in &grafcet.sequences {
            let nodes: Vec<Node> = sequence.elements.iter().map(|one| self.add(one)).collect();
            for (pair, elements) in nodes.windows(2).zip(sequence.elements.windows(2)) {
                let at = Name { text: String::new(), span: elements[1].span() };
                self.join(pair[0], pair[1], &at);
            }
            let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else { continue };
            if self.ends.insert(&sequence.id.text, (*first, *last)).is_some() {
                let message = format!("sequence {}: there are two of this id", sequence.id.text);
                self.error(&sequence.id, message, "links and jumps name sequences by their id");
            }
            self.ids.push(&sequence.id.text);
        }
    }

    fn add(&mut self, element: &'g Element) -> Node {
        match element {
            Element::Step(step) => {
                self.wiring.steps.push(step);
                Node::Step(self.wiring.steps.len() - 1)
            }
            Element::Transition(transition) => {
                let wired = Wired { transition, from: Vec::new(), to: Vec::new() };
                self.wiring.transitions.push(wired);
                Node::Transition(self.wiring.transitions.len() - 1)
            }
        }
    }

    fn ends_of(&mut self, name: &Name) -> Option<(Node, Node)> {
        let found = self.ends.get(name.text.as_str()).copied();
        if found.is_none() && !name.text.is_empty() {
            let message = format!("{}: there is no sequence of this id", name.text);
            let near = awl_asm::suggest::nearest(&name.text, self.ids.iter().copied());
            let mut error = Diagnostic::new(Code::XmlStructure, name.span, message);
            error.suggestion = near.map(str::to_owned);
            self.diagnostics.push(error);
        }
        found
    }

    fn start(&mut self, name: &Name) -> Option<Node> {
        self.ends_of(name).map(|(first, _)| first)
    }

    fn end(&mut self, name: &Name) -> Option<Node> {
        self.ends_of(name).map(|(_, last)| last)
    }

    fn title(&self, node: Node) -> String {
        match node {
            Node::Step(at) => format!("step {}", self.wiring.steps[at].name.text),
            Node::Transition(at) => {
                format!("transition {}", self.wiring.transitions[at].transition.condition.text())
            }
        }
    }

    /// A line from one element to the next.
    fn join(&mut self, from: Node, to: Node, at: &Name) {
        match (from, to) {
            (Node::Step(step), Node::Transition(transition)) => {
                let from = &mut self.wiring.transitions[transition].from;
                if !from.contains(&step) {
                    from.push(step);
                }
            }
            (Node::Transition(transition), Node::Step(step)) => {
                let to = &mut self.wiring.transitions[transition].to;
                if !to.contains(&step) {
                    to.push(step);
                }
            }
            (Node::Step(_), Node::Step(_)) => {
                let message = format!("{} is after {}", self.title(to), self.title(from));
                self.error(at, message, "a transition belongs between two steps");
            }
            (Node::Transition(_), Node::Transition(_)) => {
                let message = format!("{} is after {}", self.title(to), self.title(from));
                self.error(at, message, "a step belongs between two transitions");
            }
        }
    }

    fn link(&mut self, link: &Link) {
        let single = match link.kind.is_divergence() {
            true => self.end(&link.single),
            false => self.start(&link.single),
        };
        let mut branches = Vec::new();
        for branch in &link.branches {
            let end = match link.kind.is_divergence() {
                true => self.start(branch),
                false => self.end(branch),
            };
            branches.extend(end.map(|end| (end, branch)));
        }
        let Some(single) = single else { return };
        if !self.fits(link, single, &link.single, true) {
            return;
        }
        for (end, branch) in branches {
            if !self.fits(link, end, branch, false) {
                continue;
            }
            match link.kind.is_divergence() {
                true => self.join(single, end, branch),
                false => self.join(end, single, branch),
            }
        }
    }

    /// Whether the element at an end of a link is of the kind that belongs there.
    fn fits(&mut self, link: &Link, end: Node, at: &Name, is_single: bool) -> bool {
        let is_and = matches!(link.kind, LinkKind::DivergenceAnd | LinkKind::ConvergenceAnd);
        let is_transition = matches!(end, Node::Transition(_));
        if is_transition == (is_and == is_single) {
            return true;
        }
        let (wanted, other) = match is_transition {
            true => ("step", "transition"),
            false => ("transition", "step"),
        };
        let side = match is_single == link.kind.is_divergence() {
            true => "ends",
            false => "begins",
        };
        let message = format!("{}: sequence {} {side} with a {other}", link.kind.text(), at.text);
        self.error(at, message, &format!("a {wanted} belongs there"));
        false
    }
}
