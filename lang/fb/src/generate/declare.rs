//! The variables of a block in Structured Text.

use diagnostics::Span;

use super::{COUNT, Form, Generator, is_held, is_sampled, one_line};
use crate::model::{Event, Variable};

impl Generator<'_> {
    /// Events and variables that others see.
    pub(super) fn interface(&mut self) {
        let block = self.block;
        self.section("VAR_INPUT", |this| {
            block.event_inputs.iter().for_each(|event| this.event(event));
            block.inputs.iter().for_each(|one| this.variable(one, &one.name.text));
        });
        self.section("VAR_OUTPUT", |this| {
            block.event_outputs.iter().for_each(|event| this.event(event));
            block.outputs.iter().for_each(|one| this.variable(one, &one.name.text));
        });
    }

    /// Variables that nobody else sees.
    pub(super) fn internals(&mut self) {
        self.section("VAR", |this| this.own());
        self.steps("VAR_TEMP");
    }

    /// Everything, for all to see.
    pub(super) fn globals(&mut self) {
        let block = self.block;
        self.section("VAR_GLOBAL", |this| {
            for event in &block.event_inputs {
                this.event(event);
            }
            for event in &block.event_outputs {
                this.event(event);
                let count = format!("{}{}", event.name.text, COUNT.0);
                this.declare(event.name.span, &count, "INT", "how often it was sent");
            }
            for one in block.inputs.iter().chain(&block.outputs) {
                this.variable(one, &one.name.text);
            }
            this.own();
            if this.has_lost() {
                let lost = format!("{}{}", this.names.lost, COUNT.0);
                this.declare(block.name.span, &lost, "INT", "events that came with others");
            }
        });
    }

    /// Whether events that are lost are counted.
    pub(super) fn has_lost(&self) -> bool {
        self.form == Form::Program && self.block.event_inputs.len() > 1
    }

    fn own(&mut self) {
        let block = self.block;
        for one in &block.internals {
            self.variable(one, &one.name.text);
        }
        for one in block.inputs.iter().filter(|one| is_sampled(block, one)) {
            self.copy_of(one);
        }
        for one in block.outputs.iter().filter(|one| is_held(block, one)) {
            self.copy_of(one);
        }
        let states: Vec<String> = (0..)
            .zip(&block.states)
            .map(|(at, state): (u32, _)| format!("{at} {}", state.name.text))
            .collect();
        let name = self.names.state.clone();
        self.declare(block.name.span, &name, "INT", &states.join(", "));
    }

    fn copy_of(&mut self, variable: &Variable) {
        let copy = self.names.copy(&variable.name.text).unwrap_or_default().to_owned();
        self.variable(&Variable { comment: String::new(), ..variable.clone() }, &copy);
    }

    /// What an execution of the chart needs.
    pub(super) fn steps(&mut self, section: &str) {
        let place = self.block.name.span;
        self.section(section, |this| {
            let (event, next) = (this.names.event.clone(), this.names.next.clone());
            this.declare(place, &event, "INT", "number of the event; 0: none any more");
            this.declare(place, &next, "INT", "number of the state that is entered");
        });
    }

    fn section(&mut self, word: &str, write: impl FnOnce(&mut Self)) {
        let place = self.block.name.span;
        self.out.line(place, word);
        let before = self.out.traced.text().len();
        write(self);
        if self.out.traced.text().len() == before {
            // An empty section says nothing.
            self.out.traced.take_back(word.len() + 1);
            return;
        }
        self.out.line(place, "END_VAR");
    }

    fn event(&mut self, event: &Event) {
        let comment = one_line(&event.comment);
        let with: Vec<&str> = event.with.iter().map(|one| one.text.as_str()).collect();
        let with = match with.is_empty() {
            true => String::new(),
            false => format!(" with {}", with.join(", ")),
        };
        let comment = format!("event{with}{}{comment}", if comment.is_empty() { "" } else { ": " });
        self.declare(event.name.span, &event.name.text, "BOOL", &comment);
    }

    fn declare(&mut self, place: Span, name: &str, of_type: &str, comment: &str) {
        self.out.line(place, &format!("    {name} : {of_type}; // {comment}"));
    }

    fn variable(&mut self, variable: &Variable, name: &str) {
        let place = variable.name.span;
        self.out.begin(place);
        self.out.more(place, &format!("    {name} : "));
        if let Some(size) = variable.size {
            self.out.more(place, &format!("ARRAY[0..{}] OF ", size - 1));
        }
        self.out.more(variable.type_span, variable.of_type.name());
        if let Some(initial) = &variable.initial {
            self.out.more(place, " := ");
            self.out.more(initial.span, &initial.text);
        }
        let comment = one_line(&variable.comment);
        let comment = if comment.is_empty() { comment } else { format!(" // {comment}") };
        self.out.more(place, &format!(";{comment}\n"));
    }
}
