//! A block as MATLAB text. What MATLAB has no place for is in comments, which are read again.

use std::collections::BTreeSet;

use diagnostics::xml::Places;
use diagnostics::{Severity, Source, Span};

use super::SECTIONS;
use super::constant::Constant;
use super::functions::function;
use super::note::{ending, quoted};
use super::to_matlab::{self, Problem, Translated};
use super::vocabulary::{BEFORE, NOW, RUNNING, WAITING, why_not};
use crate::condition::condition;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Block, Event, Place, Primitive, Sequence, Service, State, Text};
use crate::model::{Transaction, Transition, Variable};
use crate::parsed::parse;

/// A block in MATLAB.
#[derive(Debug)]
pub struct Written {
    /// The text; `None` when there are errors.
    pub text: Option<String>,
    /// What MATLAB has no form for, and what it does otherwise.
    pub diagnostics: Vec<Diagnostic>,
    /// What is wrong in the block's texts.
    pub of_st: Vec<st::Diagnostic>,
}

/// Writes a block without errors that was read from a file.
pub fn write(block: &Block, source: &Source) -> Written {
    let of_st = parse(block, source).diagnostics;
    let mut writer = Writer::new(block, &source.text);
    if !of_st.is_empty() {
        return Written { text: None, diagnostics: Vec::new(), of_st };
    }
    writer.names();
    writer.charts_that_differ();
    writer.all();
    let diagnostics = writer.diagnostics;
    let has_errors = diagnostics.iter().any(|one| one.severity() == Severity::Error);
    Written { text: (!has_errors).then_some(writer.out), diagnostics, of_st }
}

/// The text of a block that was read from MATLAB, to compare it with what was read.
pub(super) fn again(block: &Block, file: &str) -> String {
    let mut writer = Writer::new(block, file);
    writer.all();
    writer.out
}

struct Writer<'b> {
    block: &'b Block,
    file: &'b str,
    out: String,
    functions: BTreeSet<String>,
    diagnostics: Vec<Diagnostic>,
}

impl<'b> Writer<'b> {
    fn new(block: &'b Block, file: &'b str) -> Writer<'b> {
        let (out, functions, diagnostics) = (String::new(), BTreeSet::new(), Vec::new());
        Writer { block, file, out, functions, diagnostics }
    }

    fn line(&mut self, text: impl AsRef<str>) {
        self.out.push_str(text.as_ref());
        self.out.push('\n');
    }

    fn no_form(&mut self, span: Span, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::NoMatlab, span, message).help(help));
    }

    fn differs(&mut self, span: Span, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::MatlabDiffers, span, message).help(help));
    }

    /// Names that MATLAB does not take.
    fn names(&mut self) {
        let block = self.block;
        for name in block.variables().map(|one| &one.name) {
            if let Some(why) = why_not(&name.text) {
                self.no_form(name.span, format!("{}: no name in MATLAB", name.text), why);
            }
        }
    }

    /// Where the form does otherwise than the chart.
    fn charts_that_differ(&mut self) {
        let block = self.block;
        for one in &block.transitions {
            if one.source.names(&one.destination.text) {
                let message = format!("{}: a transition to itself", one.source.text);
                let help = "in MATLAB it does not execute the state's actions again";
                self.differs(one.condition.span, message, help);
            }
        }
        for state in &block.states {
            let mut sent: Vec<&Text> = Vec::new();
            for action in &state.actions {
                if let Some(first) = sent.first().filter(|_| action.algorithm.is_some()) {
                    let message = format!("{}: an algorithm after this event", first.text);
                    let help =
                        "MATLAB executes all algorithms of a state and then sends its events";
                    self.differs(first.span, message, help);
                    break;
                }
                sent.extend(&action.output);
            }
            let outputs: Vec<&Text> =
                state.actions.iter().filter_map(|one| one.output.as_ref()).collect();
            let again = outputs
                .iter()
                .enumerate()
                .find(|(at, one)| outputs.iter().take(*at).any(|before| before.names(&one.text)));
            if let Some((_, name)) = again {
                let message = format!("{}: the state sends this event twice", name.text);
                let help = "an event that a call of MATLAB sends is there once";
                self.differs(name.span, message, help);
            }
        }
    }

    fn all(&mut self) {
        self.head();
        self.interface();
        self.line(SECTIONS[1]);
        let block = self.block;
        block.internals.iter().for_each(|one| self.variable(one, false));
        self.initial_state();
        self.line(SECTIONS[3]);
        block.event_inputs.iter().for_each(|one| self.sampled(one));
        self.line(SECTIONS[4]);
        self.chart();
        self.actions();
        self.algorithms();
        self.sent();
        self.line(SECTIONS[9]);
        self.line("end");
        for name in std::mem::take(&mut self.functions) {
            self.out.push('\n');
            self.out.push_str(&function(&name).unwrap_or_default());
        }
    }

    fn head(&mut self) {
        let Block { event_inputs, event_outputs, inputs, outputs, .. } = self.block;
        let list = |events: &[Event], variables: &[Variable]| {
            let events = events.iter().map(|one| format!("e_{}", one.name.text));
            let variables = variables.iter().map(|one| format!("v_{}", one.name.text));
            events.chain(variables).collect::<Vec<_>>().join(", ")
        };
        let (ins, outs) = (list(event_inputs, inputs), list(event_outputs, outputs));
        self.line(format!("function [{outs}] = fcn ({ins})"));
    }

    fn interface(&mut self) {
        let block = self.block;
        self.line(SECTIONS[0]);
        self.out.push_str(&format!("% BLOCK {}", block.name.text));
        let comment = &block.comment;
        self.line(if comment.is_empty() { String::new() } else { format!(" {}", quoted(comment)) });
        if !block.identification.is_empty() {
            self.line(format!("% Identification{}", pairs(&block.identification)));
        }
        for version in &block.versions {
            self.line(format!("% VersionInfo{}", pairs(version)));
        }
        block.service.iter().for_each(|one| self.service(one));
        block.inputs.iter().for_each(|one| self.variable(one, false));
        block.outputs.iter().for_each(|one| self.variable(one, true));
        for event in &block.event_outputs {
            let mut with: Vec<String> = event.with.iter().map(|one| one.text.clone()).collect();
            if !with.is_empty() {
                with.insert(0, "WITH".to_owned());
            }
            let note = ending(&with, &event.comment);
            self.line(format!("e_{} = false;{note}", event.name.text));
        }
    }

    fn service(&mut self, service: &Service) {
        self.line(format!("% Service{}", pairs(&service.attributes)));
        for Sequence { name, attributes, transactions } in &service.sequences {
            let name = quoted(&name.text);
            self.line(format!("% ServiceSequence Name {name}{}", pairs(attributes)));
            for Transaction { input, outputs } in transactions {
                self.line("% ServiceTransaction");
                input.iter().for_each(|one| self.primitive("InputPrimitive", one));
                outputs.iter().for_each(|one| self.primitive("OutputPrimitive", one));
            }
        }
    }

    fn primitive(&mut self, name: &str, one: &Primitive) {
        let all =
            [("Interface", &one.interface), ("Event", &one.event), ("Parameters", &one.parameters)];
        let all: Vec<(String, String)> = all
            .iter()
            .map(|(name, text)| ((*name).to_owned(), text.text.clone()))
            .filter(|(_, text)| !text.is_empty())
            .collect();
        self.line(format!("% {name}{}", pairs(&all)));
    }

    /// A variable, which keeps its value between calls; of an output also what was sent.
    fn variable(&mut self, variable: &Variable, is_output: bool) {
        let name = &variable.name.text;
        let initial = variable.initial.as_ref().map(|text| text.text.clone());
        let constant = Constant { of_type: variable.of_type, size: variable.size, initial };
        let Some(code) = constant.code() else {
            let at = variable.initial.as_ref().map_or(variable.name.span, |text| text.span);
            let message = format!("{name}: MATLAB has no form for this initial value");
            return self.no_form(
                at,
                message,
                "numbers, TRUE, FALSE, and texts without blanks have one",
            );
        };
        let mut words = Vec::new();
        if Constant::of_code(&code).as_ref() != Some(&constant) {
            words.push(constant.of_type.name().to_owned());
            words.extend(constant.initial.iter().map(|text| format!(":= {}", quoted(text))));
        }
        let mut note = ending(&words, &variable.comment);
        if !words.is_empty() && variable.comment.is_empty() && constant.initial.is_some() {
            // The last text is the comment.
            note.push_str(" \"\"");
        }
        let (more, sent) = match is_output {
            true => (format!(" e_v_{name}"), format!(" e_v_{name} = {name};")),
            false => (String::new(), String::new()),
        };
        self.line(format!("persistent {name}{more}"));
        self.line(format!("if isempty({name}), {name} = {code};{sent} end{note}"));
    }

    fn initial_state(&mut self) {
        let block = self.block;
        let count = block.states.len();
        self.line(SECTIONS[2]);
        self.line(format!("persistent {NOW}"));
        let states: Vec<&str> = (0..count).map(|at| if at == 0 { "1" } else { "0" }).collect();
        self.line(format!("if isempty({NOW}), {NOW} = logical([{}]); end", states.join(", ")));
        for (at, State { name, comment, place, .. }) in block.states.iter().enumerate() {
            let mut words = vec![format!("{NOW}({})", at + 1), name.text.clone()];
            words.extend(place.iter().flat_map(placed));
            let line = ending(&words, comment);
            self.line(line.trim_start());
        }
        self.line(format!("{BEFORE} = {NOW};"));
        let events: Vec<String> =
            block.event_inputs.iter().map(|one| format!("e_{}", one.name.text)).collect();
        self.line(format!("if {}", events.join(" || ")));
        self.line(format!("    {BEFORE} = false(1, {count});"));
        self.line("end");
    }

    fn sampled(&mut self, event: &Event) {
        let note = ending(&[], &event.comment);
        self.line(format!("if e_{}{note}", event.name.text));
        for Text { text, .. } in &event.with {
            self.line(format!("    {} = v_{};", self.declared(text), self.declared(text)));
        }
        self.line("end");
    }

    /// A variable as it is declared: MATLAB looks at the case of letters.
    fn declared(&self, name: &str) -> String {
        let found = self.block.variables().find(|one| one.name.names(name));
        found.map_or(name, |one| one.name.text.as_str()).to_owned()
    }

    fn chart(&mut self) {
        let block = self.block;
        self.line(format!("while ~isequal({BEFORE}, {NOW})"));
        self.line(format!("{BEFORE} = {NOW};"));
        for (at, transition) in block.transitions.iter().enumerate() {
            self.transition(at, transition);
        }
        for event in &block.event_inputs {
            self.line(format!("e_{} = false;", event.name.text));
        }
    }

    fn transition(&mut self, at: usize, transition: &Transition) {
        let block = self.block;
        let ends =
            block.state(&transition.source.text).zip(block.state(&transition.destination.text));
        let Some((source, destination)) = ends else { return };
        let mut terms = vec![format!("{BEFORE}({})", source + 1)];
        terms.extend(self.when(transition));
        for (before, other) in block.transitions.iter().take(at).enumerate() {
            if !other.source.names(&transition.source.text) {
                continue;
            }
            let Some(target) = block.state(&other.destination.text) else { continue };
            // A transition to itself changes nothing that the others could see.
            let term = match target == source {
                false => format!("~{NOW}({})", target + 1),
                true => {
                    let when: Vec<String> = self.when(&block.transitions[before]);
                    match when.is_empty() {
                        true => "~true".to_owned(),
                        false => format!("~({})", when.join(" && ")),
                    }
                }
            };
            if !terms.contains(&term) {
                terms.push(term);
            }
        }
        let mut words = vec![
            transition.source.text.clone(),
            "->".to_owned(),
            transition.destination.text.clone(),
        ];
        words.extend(transition.place.iter().flat_map(placed));
        let note = ending(&words, &transition.comment);
        self.line(format!("if {}{note}", terms.join(" && ")));
        let (source, destination) = (source + 1, destination + 1);
        self.line(format!("    {NOW}({source}) = false; {NOW}({destination}) = true;"));
        self.line("end");
    }

    /// Event and guard of a transition.
    fn when(&mut self, transition: &Transition) -> Vec<String> {
        let block = self.block;
        let mut terms = Vec::new();
        let Ok(found) = condition(block, transition) else { return terms };
        let event = found.event.and_then(|event| block.event_inputs.get(event));
        terms.extend(event.map(|event| format!("e_{}", event.name.text)));
        if let Some(guard) = found.guard(&transition.condition.text) {
            let span = transition.condition.span;
            let start = transition.condition.text.find(&guard);
            let places = match start {
                Some(at) => Places::of(&transition.condition.text, span, self.file).from(at),
                None => Places::whole(span),
            };
            let text = self.translated(to_matlab::guard(block, &guard), &places);
            terms.push(format!("({text})"));
        }
        terms
    }

    fn translated(&mut self, translated: Translated, places: &Places) -> String {
        for Problem { span, message, help, is_warning } in translated.problems {
            let span = places.span(span);
            match is_warning {
                true => self.differs(span, message, help),
                false => self.no_form(span, message, help),
            }
        }
        self.functions.extend(translated.functions);
        translated.text
    }

    /// The first round in a state.
    fn entered(at: usize) -> String {
        format!("if {NOW}({at}) && ~{BEFORE}({at})", at = at + 1)
    }

    fn actions(&mut self) {
        let block = self.block;
        self.line(SECTIONS[5]);
        self.line(format!("{WAITING} = [];"));
        for (at, state) in
            block.states.iter().enumerate().filter(|(_, one)| !one.actions.is_empty())
        {
            let name = |text: &Option<Text>| text.as_ref().map_or("", |one| &one.text).to_owned();
            let words: Vec<String> = state
                .actions
                .iter()
                .map(|one| format!("{}/{}", name(&one.algorithm), name(&one.output)))
                .collect();
            let numbers = state.actions.iter().filter_map(|one| {
                let name = one.algorithm.as_ref()?;
                let at = block.algorithms.iter().position(|one| one.name.names(&name.text))?;
                Some((at + 1).to_string())
            });
            let numbers: Vec<String> = numbers.collect();
            self.line(format!("{}{}", Self::entered(at), ending(&words, "")));
            self.line(format!("    {WAITING} = [{}];", numbers.join(", ")));
            self.line("end");
        }
    }

    fn algorithms(&mut self) {
        let block = self.block;
        self.line(SECTIONS[6]);
        if block.algorithms.is_empty() {
            return;
        }
        self.line(format!("for {RUNNING} = {WAITING}"));
        self.line(format!("switch {RUNNING}"));
        for (at, algorithm) in block.algorithms.iter().enumerate() {
            let note = ending(std::slice::from_ref(&algorithm.name.text), &algorithm.comment);
            self.line(format!("case {}{note}", at + 1));
            let Text { text, span } = &algorithm.text;
            let places = Places::of(text, *span, self.file);
            let body = self.translated(to_matlab::statements(block, text), &places);
            self.line(body);
        }
        self.line("end");
        self.line("end");
    }

    /// Events that are sent, and what they have with them.
    fn sent(&mut self) {
        let block = self.block;
        let sent = |state: &State| -> Vec<&'b Event> {
            let names = state.actions.iter().filter_map(|one| one.output.as_ref());
            let mut events: Vec<&Event> = Vec::new();
            for name in names {
                let found = block.event_outputs.iter().find(|one| one.name.names(&name.text));
                let is_new = |one: &&Event| !events.iter().any(|known| known.name == one.name);
                events.extend(found.filter(is_new));
            }
            events
        };
        self.line(SECTIONS[7]);
        for (at, state) in block.states.iter().enumerate() {
            let events = sent(state);
            if !events.is_empty() {
                self.line(Self::entered(at));
                events.iter().for_each(|one| self.line(format!("    e_{} = true;", one.name.text)));
                self.line("end");
            }
        }
        self.line(SECTIONS[8]);
        for (at, state) in block.states.iter().enumerate() {
            let mut names: Vec<String> = Vec::new();
            for with in sent(state).iter().flat_map(|event| &event.with) {
                let name = self.declared(&with.text);
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            if !names.is_empty() {
                self.line(Self::entered(at));
                names.iter().for_each(|name| self.line(format!("    e_v_{name} = {name};")));
                self.line("end");
            }
        }
        self.line("end");
        for output in &block.outputs {
            self.line(format!("v_{name} = e_v_{name};", name = output.name.text));
        }
    }
}

/// Names with values, in a comment.
fn pairs(pairs: &[(String, String)]) -> String {
    pairs.iter().map(|(name, value)| format!(" {name} {}", quoted(value))).collect()
}

fn placed(at: &Place) -> [String; 2] {
    [at.x.to_string(), at.y.to_string()]
}
