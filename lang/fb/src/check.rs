//! What must be true of every block, whatever is made of it: names are names, there once, and
//! known where they are used, conditions say when, and the chart comes to rest. What ST texts mean
//! is not asked here.

use std::collections::HashMap;

use awl_asm::suggest::nearest;
use diagnostics::xml::Places;

use crate::condition::{Wrong, condition};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Block, Event, Text, Transition, Variable};
use crate::rest::without_rest;

/// Checks a block that was read from a file with this text.
pub fn check(block: &Block, file: &str) -> Vec<Diagnostic> {
    let mut checker = Checker { diagnostics: Vec::new() };
    checker.name(&block.name);
    checker.interface(block);
    checker.chart(block);
    block.transitions.iter().for_each(|one| checker.condition(block, one, file));
    checker.rest(block);
    checker.algorithms(block);
    checker.diagnostics
}

/// Whether a word can be a name: a letter or `_`, then letters, digits and `_`.
pub fn is_name(word: &str) -> bool {
    let mut characters = word.chars();
    characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && characters.all(|next| next.is_ascii_alphanumeric() || next == '_')
}

struct Checker {
    diagnostics: Vec<Diagnostic>,
}

impl Checker {
    fn error(&mut self, code: Code, at: &Text, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, at.span, message).help(help));
    }

    fn name(&mut self, name: &Text) {
        if !is_name(&name.text) && !name.text.is_empty() {
            let message = format!("`{}` is no name", name.text);
            let help = "names begin with a letter and go on with letters, digits and _";
            self.error(Code::BadName, name, message, help);
        }
    }

    /// Each name is there once.
    fn names<'b>(&mut self, what: &str, names: impl Iterator<Item = &'b Text>) {
        let mut first: HashMap<String, &Text> = HashMap::new();
        for name in names {
            self.name(name);
            let Some(other) = first.insert(name.text.to_lowercase(), name) else { continue };
            if name.text.is_empty() {
                continue;
            }
            let message = format!("{}: there are two {what} of this name", name.text);
            let error = Diagnostic::new(Code::BadName, name.span, message);
            self.diagnostics.push(error.related(other.span, "the other one"));
        }
    }

    fn unknown<'b>(&mut self, what: &str, word: &Text, names: impl Iterator<Item = &'b Text>) {
        let names: Vec<&str> = names.map(|name| name.text.as_str()).collect();
        if word.text.is_empty() || names.iter().any(|name| word.names(name)) {
            return;
        }
        let message = format!("{}: there is no {what} of this name", word.text);
        let mut error = Diagnostic::new(Code::UnknownName, word.span, message);
        error.suggestion = nearest(&word.text, names.iter().copied()).map(str::to_owned);
        self.diagnostics.push(error);
    }

    fn interface(&mut self, block: &Block) {
        let events = block.event_inputs.iter().chain(&block.event_outputs);
        let events = events.map(|event| &event.name);
        let variables = block.variables().map(|variable| &variable.name);
        self.names("events or variables", events.chain(variables));
        self.with(&block.event_inputs, &block.inputs, "input");
        self.with(&block.event_outputs, &block.outputs, "output");
        if block.event_inputs.is_empty() {
            let message =
                format!("{}: it takes no event, so it never does anything", block.name.text);
            let help = "a block works when an event arrives: declare one in EventInputs";
            self.error(Code::Incomplete, &block.name, message, help);
        }
    }

    fn with(&mut self, events: &[Event], variables: &[Variable], what: &str) {
        for event in events {
            for word in &event.with {
                self.unknown(what, word, variables.iter().map(|one| &one.name));
            }
        }
        for variable in variables {
            let is_with =
                |event: &Event| event.with.iter().any(|one| one.names(&variable.name.text));
            if !events.iter().any(is_with) {
                let message = format!("{}: no event has this {what} with it", variable.name.text);
                let help = match what {
                    "input" => "it keeps its initial value: name it in a <With> of an event",
                    _ => "nobody is told its value: name it in a <With> of an event",
                };
                self.error(Code::Unused, &variable.name, message, help);
            }
        }
    }

    fn chart(&mut self, block: &Block) {
        if block.states.is_empty() {
            let message = format!("{}: its chart has no states", block.name.text);
            let help = "the first state is the initial one: <ECState Name=\"START\"/>";
            return self.error(Code::Incomplete, &block.name, message, help);
        }
        self.names("states", block.states.iter().map(|state| &state.name));
        let states = || block.states.iter().map(|state| &state.name);
        for Transition { source, destination, .. } in &block.transitions {
            self.unknown("state", source, states());
            self.unknown("state", destination, states());
        }
        for action in block.states.iter().flat_map(|state| &state.actions) {
            if let Some(word) = &action.algorithm {
                self.unknown("algorithm", word, block.algorithms.iter().map(|one| &one.name));
            }
            if let Some(word) = &action.output {
                self.unknown("output event", word, block.event_outputs.iter().map(|one| &one.name));
            }
        }
        self.unreached(block);
    }

    /// States to which no transition leads.
    fn unreached(&mut self, block: &Block) {
        let mut reached = vec![false; block.states.len()];
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            if std::mem::replace(&mut reached[at], true) {
                continue;
            }
            let from = |one: &&Transition| block.state(&one.source.text) == Some(at);
            let next = block.transitions.iter().filter(from);
            open.extend(next.filter_map(|one| block.state(&one.destination.text)));
        }
        for (state, _) in block.states.iter().zip(reached).filter(|(_, reached)| !reached) {
            let message = format!("{}: no transition leads to this state", state.name.text);
            let help = "the first state is the initial one; the others need a transition";
            self.error(Code::Unused, &state.name, message, help);
        }
    }

    fn condition(&mut self, block: &Block, transition: &Transition, file: &str) {
        let Err(wrong) = condition(block, transition) else { return };
        let text = &transition.condition;
        let events = || block.event_inputs.iter().map(|event| event.name.text.as_str());
        let (at, message, help) = match wrong {
            Wrong::Empty => (None, "there is no condition".to_owned(), "1 is always true"),
            Wrong::Open => {
                let message = format!("{}: `]` is missing at the end", text.text);
                (None, message, "an event with a guard is written EVENT[guard]")
            }
            Wrong::NoEvent(at) => {
                let name = at.text(&text.text);
                let message = format!("{name}: there is no event or variable of this name");
                let span = Places::of(&text.text, text.span, file).span(at);
                let mut error = Diagnostic::new(Code::UnknownName, span, message);
                let variables = block.variables().map(|one| one.name.text.as_str());
                error.suggestion = nearest(name, events().chain(variables)).map(str::to_owned);
                return self.diagnostics.push(error);
            }
            Wrong::Second(at) => {
                let message = format!("{}: a second event", at.text(&text.text));
                (Some(at), message, "one event arrives at a time: both together never do")
            }
            Wrong::Inside(at) => {
                let message = format!("{}: an event inside of a guard", at.text(&text.text));
                let help = "write EVENT[guard], and a transition for each event";
                (Some(at), message, help)
            }
        };
        let span = at.map_or(text.span, |at| Places::of(&text.text, text.span, file).span(at));
        self.diagnostics.push(Diagnostic::new(Code::Condition, span, message).help(help));
    }

    fn rest(&mut self, block: &Block) {
        let states = without_rest(block);
        let Some(first) = states.first().and_then(|at| block.states.get(*at)) else { return };
        let names = states.iter().filter_map(|at| block.states.get(*at));
        let names: Vec<&str> = names.map(|state| state.name.text.as_str()).collect();
        let message = format!("the chart never comes to rest in {}", names.join(", "));
        let help = "a transition that needs no event clears at once: give one of them an event";
        self.error(Code::NeverRests, &first.name, message, help);
    }

    fn algorithms(&mut self, block: &Block) {
        self.names("algorithms", block.algorithms.iter().map(|one| &one.name));
        let actions = || block.states.iter().flat_map(|state| &state.actions);
        for algorithm in &block.algorithms {
            let uses = |word: &Text| word.names(&algorithm.name.text);
            if !actions().any(|action| action.algorithm.as_ref().is_some_and(uses)) {
                let message = format!("{}: no state executes this algorithm", algorithm.name.text);
                let help = "name it in an <ECAction> of a state, or leave it out";
                self.error(Code::Unused, &algorithm.name, message, help);
            }
        }
    }
}
