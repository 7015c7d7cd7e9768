//! The elements of a file. It is liberal in what it takes, such as letter case and order, and says
//! what it leaves out; whether the charts are sound is asked by [`super::wiring`].

use diagnostics::xml::{self, Node, attribute, elements, tag, value};
use diagnostics::{Source, Span};

use super::Reading;
use super::document::{
    Action, ActionKind, Element, Grafcet, GrafcetKind, Jump, Link, LinkKind, Name, Project,
    Sequence, Step, StepKind, Transition,
};
use super::words::{Words, plain};
use crate::diagnostic::{Code, Diagnostic};

pub(super) fn read(source: &Source) -> Reading {
    let mut reader = Reader { diagnostics: Vec::new() };
    let project = match xml::parse(&source.text) {
        Ok(document) => reader.root(document.root_element()),
        Err(broken) => {
            reader.error(Code::BrokenXml, broken.span, broken.message, "");
            None
        }
    };
    Reading { project, diagnostics: reader.diagnostics }
}

fn is_called(node: Node, name: &str) -> bool {
    node.tag_name().name().eq_ignore_ascii_case(name)
}

/// The kind that a file writes, in any letter case and with any blanks.
fn kind_of<K: Copy>(all: &[(&str, K)], written: &str) -> Option<K> {
    let squeezed =
        |text: &str| text.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
    all.iter().find(|(text, _)| *text == squeezed(written)).map(|(_, kind)| *kind)
}

struct Reader {
    diagnostics: Vec<Diagnostic>,
}

impl Reader {
    fn error(&mut self, code: Code, span: Span, message: impl Into<String>, help: &str) {
        let error = Diagnostic::new(code, span, message);
        self.diagnostics.push(if help.is_empty() { error } else { error.help(help) });
    }

    fn ignore(&mut self, node: Node, of: &str) {
        let message = format!("{}: no element of a {of}, it is left out", node.tag_name().name());
        self.error(Code::XmlIgnored, tag(node), message, "");
    }

    /// An attribute that has to be there.
    fn needed(&mut self, node: Node, name: &str) -> Name {
        match attribute(node, name) {
            Some(one) if !one.value().trim().is_empty() => {
                Name { text: one.value().trim().to_owned(), span: value(&one) }
            }
            _ => {
                let message = format!("{} has no {name}", node.tag_name().name());
                self.error(
                    Code::XmlStructure,
                    tag(node),
                    message,
                    &format!("write {name}=\"...\""),
                );
                Name { text: String::new(), span: tag(node) }
            }
        }
    }

    /// The attribute `type`; the first kind of the table where there is none.
    fn kind<K: Copy + Default>(&mut self, node: Node, all: &[(&str, K)]) -> K {
        let Some(written) = attribute(node, "type") else { return K::default() };
        kind_of(all, written.value()).unwrap_or_else(|| {
            let message =
                format!("`{}` is no type of a {}", written.value(), node.tag_name().name());
            let names: Vec<&str> = all.iter().map(|(text, _)| *text).collect();
            let help = format!("types are {}", names.join(", "));
            self.error(Code::XmlStructure, value(&written), message, &help);
            K::default()
        })
    }

    fn root(&mut self, node: Node) -> Option<Project> {
        if !is_called(node, "project") {
            let message = format!("{}: this is no chart of SFCEdit", node.tag_name().name());
            self.error(Code::XmlStructure, tag(node), message, "such a file begins with <project>");
            return None;
        }
        let mut project = Project::default();
        for child in elements(node) {
            match is_called(child, "grafcet") {
                true => {
                    let grafcet = self.grafcet(child);
                    project.grafcets.push(grafcet);
                }
                false => self.ignore(child, "project"),
            }
        }
        if project.grafcets.is_empty() {
            let help = "a project has at least one <grafcet>";
            self.error(Code::XmlStructure, tag(node), "there is no chart in the project", help);
        }
        Some(project)
    }

    fn grafcet(&mut self, node: Node) -> Grafcet {
        let kinds = [
            ("normal", GrafcetKind::Normal),
            ("macro", GrafcetKind::Macro),
            ("enclosure", GrafcetKind::Enclosure),
        ];
        let owner = attribute(node, "owner").filter(|one| !one.value().trim().is_empty());
        let owner =
            owner.map(|one| Name { text: one.value().trim().to_owned(), span: value(&one) });
        let mut grafcet = Grafcet {
            kind: self.kind(node, &kinds),
            owner,
            name: self.needed(node, "name"),
            comment: attribute(node, "comment").map_or(String::new(), |one| one.value().to_owned()),
            ..Grafcet::default()
        };
        for child in elements(node) {
            match child.tag_name().name().to_lowercase().as_str() {
                "sequence" => {
                    let sequence = self.sequence(child);
                    grafcet.sequences.push(sequence);
                }
                "hlink" => grafcet.links.extend(self.link(child)),
                "jump" => grafcet.jumps.push(Jump {
                    from: self.needed(child, "seqid_from"),
                    to: self.needed(child, "seqid_to"),
                    span: tag(child),
                }),
                "comment" => grafcet.comment = plain(child),
                _ => self.ignore(child, "grafcet"),
            }
        }
        grafcet
    }

    fn sequence(&mut self, node: Node) -> Sequence {
        let mut sequence = Sequence { id: self.needed(node, "id"), elements: Vec::new() };
        for child in elements(node) {
            match child.tag_name().name().to_lowercase().as_str() {
                "step" => sequence.elements.push(Element::Step(self.step(child))),
                "transition" => {
                    sequence.elements.push(Element::Transition(self.transition(child)));
                }
                _ => self.ignore(child, "sequence"),
            }
        }
        if sequence.elements.is_empty() {
            let message = format!("sequence {} is empty", sequence.id.text);
            let help = "a sequence has steps and transitions in turn";
            self.error(Code::XmlStructure, tag(node), message, help);
        }
        sequence
    }

    fn step(&mut self, node: Node) -> Step {
        let (kind, name) = (self.kind(node, &StepKind::ALL), self.needed(node, "name"));
        let mut step = Step { kind, span: name.span, name, ..Step::default() };
        for child in elements(node) {
            match child.tag_name().name().to_lowercase().as_str() {
                "comment" => step.comment = plain(child),
                "action" => {
                    let action = self.action(child);
                    step.actions.push(action);
                }
                _ => self.ignore(child, "step"),
            }
        }
        step
    }

    fn action(&mut self, node: Node) -> Action {
        let mut action = Action {
            kind: self.kind(node, &ActionKind::ALL),
            span: tag(node),
            ..Action::default()
        };
        for child in elements(node) {
            match child.tag_name().name().to_lowercase().as_str() {
                "text" => action.text = Words::of(child, &mut self.diagnostics),
                "condition" => action.condition = Some(Words::of(child, &mut self.diagnostics)),
                "comment" => action.comment = plain(child),
                _ => self.ignore(child, "action"),
            }
        }
        if action.text.is_empty() {
            let help = "what is done is in <text>: <action><text>Motor</text></action>";
            self.error(Code::XmlStructure, tag(node), "an action without a text", help);
        }
        let needs = matches!(action.kind, ActionKind::Conditional | ActionKind::Event);
        if needs && action.condition.as_ref().is_none_or(Words::is_empty) {
            let message = format!("action {}: there is no condition", action.text.text());
            let help = "this type of action needs a <condition>";
            self.error(Code::XmlStructure, tag(node), message, help);
        }
        action
    }

    fn transition(&mut self, node: Node) -> Transition {
        let mut transition = Transition { span: tag(node), ..Transition::default() };
        for child in elements(node) {
            match child.tag_name().name().to_lowercase().as_str() {
                "condition" => transition.condition = Words::of(child, &mut self.diagnostics),
                "comment" => transition.comment = Words::of(child, &mut self.diagnostics),
                "action" => {
                    let action = self.action(child);
                    transition.actions.push(action);
                }
                _ => self.ignore(child, "transition"),
            }
        }
        match transition.condition.is_empty() {
            true => {
                let help = "what it waits for is in <condition>; 1 is always true";
                self.error(Code::XmlStructure, tag(node), "a transition without a condition", help);
            }
            false => transition.span = transition.condition.span,
        }
        transition
    }

    fn link(&mut self, node: Node) -> Option<Link> {
        let Some(written) = attribute(node, "type") else {
            self.needed(node, "type");
            return None;
        };
        let Some(kind) = kind_of(&LinkKind::ALL, written.value()) else {
            let message = format!("`{}` is no type of a link", written.value());
            let help = "types are div and, div or, conv and, conv or";
            self.error(Code::XmlStructure, value(&written), message, help);
            return None;
        };
        let single = self.needed(node, "seqid");
        let mut branches = Vec::new();
        for child in elements(node) {
            match is_called(child, "node") {
                true => branches.push(self.needed(child, "seqid")),
                false => self.ignore(child, "hlink"),
            }
        }
        if branches.len() < 2 {
            let message = format!("{}: a link has two branches at least", kind.text());
            let help = "each branch is a <node seqid=\"...\"/>";
            self.error(Code::XmlStructure, tag(node), message, help);
        }
        Some(Link { kind, single, branches, span: tag(node) })
    }
}
