//! The execution control chart as statements.

use diagnostics::Span;
use diagnostics::xml::Places;

use super::out::Out;
use super::{COUNT, Form, Generator, one_line};
use crate::model::{Action, Block, Event};
use crate::parsed::Transition;

impl Generator<'_> {
    pub(super) fn body(&mut self) {
        let block = self.block;
        let place = block.name.span;
        for event in &block.event_outputs {
            self.out.line(event.name.span, &format!("{} := FALSE;", event.name.text));
        }
        let event = self.names.event.clone();
        self.out.line(place, "// One event, with what it brings.");
        self.out.line(place, &format!("{event} := -1;"));
        if block.event_inputs.len() > 1 {
            self.choose_by_transition();
            self.out.line(place, &format!("IF {event} < 0 THEN"));
            self.out.inside(|out| choose_first(out, block, &event));
            self.out.line(place, "END_IF;");
        } else {
            choose_first(&mut self.out, block, &event);
        }
        self.sample();
        self.take_events();
        self.rounds();
    }

    /// Of several events the one that the first transition names that clears.
    fn choose_by_transition(&mut self) {
        let block = self.block;
        let parsed = self.parsed;
        if parsed.transitions.iter().all(|one| one.event.is_none()) {
            return;
        }
        self.out.line(block.name.span, &format!("CASE {} OF", self.names.state));
        for (at, state) in block.states.iter().enumerate() {
            let named = parsed.transitions.iter().zip(&block.transitions);
            let named: Vec<(&Transition, Span)> = named
                .filter(|(one, _)| one.source == at && one.event.is_some())
                .map(|(one, written)| (one, written.condition.span))
                .collect();
            if named.is_empty() {
                continue;
            }
            self.out.line(state.name.span, &format!("{at}: // {}", state.name.text));
            for (number, (transition, place)) in named.iter().enumerate() {
                let event = transition.event.and_then(|event| block.event_inputs.get(event));
                let Some((event, index)) = event.zip(transition.event) else { continue };
                let word = if number == 0 { "IF" } else { "ELSIF" };
                self.out.begin(*place);
                self.out.more(*place, &format!("    {word} {}", event.name.text));
                if transition.guard_text.is_some() {
                    self.out.more(*place, " AND ");
                    self.guard(transition, *place, Some(event));
                }
                self.out.more(*place, &format!(" THEN {} := {};\n", self.names.event, index + 1));
            }
            self.out.line(state.name.span, "    END_IF;");
        }
        self.out.line(block.name.span, "END_CASE;");
    }

    /// A guard in brackets; `event`: as it is with the inputs that an event brings.
    fn guard(&mut self, transition: &Transition, place: Span, event: Option<&Event>) {
        let Some(text) = &transition.guard_text else { return };
        let written = self.block.transitions.iter().find(|one| one.condition.span == place);
        let condition = written.map(|one| &one.condition);
        let start = condition.and_then(|condition| condition.text.find(text.as_str()));
        let places = match condition.zip(start) {
            Some((condition, start)) => {
                Places::of(&condition.text, condition.span, self.file).from(start)
            }
            None => Places::whole(place),
        };
        let names = &self.names;
        let renamed = |word: &str| {
            let is_brought =
                event.is_some_and(|event| event.with.iter().any(|one| one.names(word)));
            names.copy(word).filter(|_| !is_brought).map(str::to_owned)
        };
        self.out.more(places.span(Span::new(0, 1)), "(");
        self.out.copy(text, &places, &renamed);
        self.out.more(places.span(Span::new(text.len() - 1, text.len())), ")");
    }

    /// Copies the inputs that the event has with it.
    fn sample(&mut self) {
        let block = self.block;
        for (at, event) in block.event_inputs.iter().enumerate() {
            let copies: Vec<String> = event
                .with
                .iter()
                .filter_map(|one| Some(format!("{} := {};", self.names.copy(&one.text)?, one.text)))
                .collect();
            if copies.is_empty() {
                continue;
            }
            let place = event.name.span;
            self.out.line(place, &format!("IF {} = {} THEN", self.names.event, at + 1));
            self.out.inside(|out| copies.iter().for_each(|copy| out.line(place, copy)));
            self.out.line(place, "END_IF;");
        }
    }

    /// Of a program events are there for one execution, and those that are lost are counted.
    fn take_events(&mut self) {
        let block = self.block;
        if self.has_lost() {
            let lost = format!("{}{}", self.names.lost, COUNT.0);
            for (at, event) in block.event_inputs.iter().enumerate() {
                let (place, name) = (event.name.span, &event.name.text);
                let number = &self.names.event;
                self.out.line(place, &format!("IF {name} AND {number} <> {} THEN", at + 1));
                self.out.inside(|out| out.line(place, &format!("{lost} := {lost} + 1;")));
                self.out.line(place, "END_IF;");
            }
        }
        // Inputs of a FUNCTION_BLOCK are its caller's.
        if self.form == Form::Program {
            for event in &block.event_inputs {
                self.out.line(event.name.span, &format!("{} := FALSE;", event.name.text));
            }
        }
    }

    /// The chart, until no transition clears.
    fn rounds(&mut self) {
        let place = self.block.name.span;
        let (event, next, state) =
            (self.names.event.clone(), self.names.next.clone(), self.names.state.clone());
        self.out.line(place, "// Transitions and actions, until no transition clears.");
        self.out.line(place, &format!("WHILE {event} >= 0 DO"));
        self.out.line(place, &format!("    {next} := -1;"));
        if !self.parsed.transitions.is_empty() {
            self.out.line(place, &format!("    CASE {state} OF"));
            (0..self.block.states.len()).for_each(|at| self.transitions(at));
            self.out.line(place, "    END_CASE;");
        }
        self.out.line(place, &format!("    IF {next} < 0 THEN EXIT; END_IF;"));
        self.out.line(place, &format!("    {event} := 0;"));
        self.out.line(place, &format!("    {state} := {next};"));
        if self.block.states.iter().any(|one| !one.actions.is_empty()) {
            self.out.line(place, &format!("    CASE {state} OF"));
            (0..self.block.states.len()).for_each(|at| self.actions(at));
            self.out.line(place, "    END_CASE;");
        }
        self.out.line(place, "END_WHILE;");
    }

    /// The transitions of a state by their priority.
    fn transitions(&mut self, at: usize) {
        let Some(state) = self.block.states.get(at) else { return };
        let parsed = self.parsed;
        let all = parsed.transitions.iter().zip(&self.block.transitions);
        let all: Vec<(&Transition, Span)> = all
            .filter(|(one, _)| one.source == at)
            .map(|(one, written)| (one, written.condition.span))
            .collect();
        if all.is_empty() {
            return;
        }
        self.out.line(state.name.span, &format!("    {at}: // {}", state.name.text));
        let mut is_open = false;
        for (transition, place) in all {
            let enter = format!("{} := {};", self.names.next, transition.destination);
            if transition.event.is_none() && transition.guard_text.is_none() {
                let otherwise = if is_open { "ELSE " } else { "" };
                self.out.line(place, &format!("        {otherwise}{enter}"));
                break;
            }
            self.out.begin(place);
            self.out.more(place, if is_open { "        ELSIF " } else { "        IF " });
            is_open = true;
            if let Some(event) = transition.event {
                self.out.more(place, &format!("{} = {}", self.names.event, event + 1));
            }
            if transition.guard_text.is_some() {
                self.out.more(place, if transition.event.is_some() { " AND " } else { "" });
                self.guard(transition, place, None);
            }
            self.out.more(place, &format!(" THEN {enter}\n"));
        }
        if is_open {
            self.out.line(state.name.span, "        END_IF;");
        }
    }

    fn actions(&mut self, at: usize) {
        let Some(state) = self.block.states.get(at) else { return };
        if state.actions.is_empty() {
            return;
        }
        let place = state.name.span;
        let comment = one_line(&state.comment);
        let comment = if comment.is_empty() { comment } else { format!(": {comment}") };
        self.out.line(place, &format!("    {at}: // {}{comment}", state.name.text));
        for action in &state.actions {
            self.algorithm(action);
            self.send(action);
        }
    }

    fn algorithm(&mut self, action: &Action) {
        let block = self.block;
        let Some(name) = &action.algorithm else { return };
        let Some(algorithm) = block.algorithm(&name.text) else { return };
        let text = algorithm.text.text.trim_end();
        if text.is_empty() {
            return;
        }
        let place = algorithm.name.span;
        self.out.line(place, &format!("        // {}", algorithm.name.text));
        let places = Places::of(&algorithm.text.text, algorithm.text.span, self.file);
        let names = &self.names;
        let renamed = |word: &str| names.copy(word).map(str::to_owned);
        self.out.inside(|out| {
            out.inside(|out| {
                out.begin(place);
                out.copy(text, &places, &renamed);
                out.more(place, "\n");
            });
        });
    }

    fn send(&mut self, action: &Action) {
        let block = self.block;
        let Some(name) = &action.output else { return };
        let event = block.event_outputs.iter().find(|event| event.name.names(&name.text));
        let Some(event) = event else { return };
        let place = name.span;
        for one in &event.with {
            if let Some(copy) = self.names.copy(&one.text) {
                let line = format!("        {} := {copy};", one.text);
                self.out.line(place, &line);
            }
        }
        self.out.line(place, &format!("        {} := TRUE;", event.name.text));
        if self.form == Form::Program {
            let count = format!("{}{}", event.name.text, COUNT.0);
            self.out.line(place, &format!("        {count} := {count} + 1;"));
        }
    }
}

/// The first of the events that are there.
fn choose_first(out: &mut Out, block: &Block, event: &str) {
    for (at, one) in block.event_inputs.iter().enumerate() {
        let word = if at == 0 { "IF" } else { "ELSIF" };
        out.line(one.name.span, &format!("{word} {} THEN {event} := {};", one.name.text, at + 1));
    }
    out.line(block.name.span, "END_IF;");
}
