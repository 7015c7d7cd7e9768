//! Executes a block event by event, straight from its chart and the syntax trees of its texts. It
//! generates no code: what is generated is compared with it.

mod evaluate;
mod functions;
mod value;

use std::collections::HashMap;
use std::fmt;

use diagnostics::Span;
use st::parser::parse_expression;

use crate::data_type::DataType;
use crate::model::{self, Block, Event};
use crate::parsed::Parsed;
use evaluate::{Memory, Variable};
pub use value::{Value, range};

/// Transitions that clear for one event before the chart counts as one without rest.
pub const TRANSITIONS_MAX: usize = 1000;

/// A block at work.
#[derive(Debug, Clone)]
pub struct Interpreter<'b> {
    block: &'b Block,
    parsed: &'b Parsed,
    /// What the algorithms see.
    inside: Memory,
    /// Inputs as others set them, outputs as others see them.
    outside: HashMap<String, Variable>,
    state: usize,
}

/// What an event brought about.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Step {
    /// Numbers of the output events in the order in which they were sent.
    pub sent: Vec<usize>,
    /// Numbers of the events that came at the same time and are lost.
    pub lost: Vec<usize>,
    /// Numbers of the transitions that cleared, in order: among those of [`Parsed`].
    pub cleared: Vec<usize>,
    /// Numbers of the states that were entered with them.
    pub entered: Vec<usize>,
}

/// Why a block does not go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Stopped {
    /// The chart does not come to rest: the names of the states it goes through.
    NoRest(Vec<String>),
    /// A loop in an algorithm does not end.
    Endless,
    /// It is not known what something means.
    Unknown(String),
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stopped::NoRest(states) => write!(
                f,
                "after {TRANSITIONS_MAX} transitions the chart is not at rest: it goes through {}",
                states.join(", ")
            ),
            Stopped::Endless => write!(f, "a loop in an algorithm does not end"),
            Stopped::Unknown(what) => write!(f, "{what}: no block has this"),
        }
    }
}

impl std::error::Error for Stopped {}

impl<'b> Interpreter<'b> {
    /// A block before its first event. Its texts have no errors.
    pub fn new(block: &'b Block, parsed: &'b Parsed) -> Result<Interpreter<'b>, Stopped> {
        let mut inside = Memory::default();
        for declared in block.variables() {
            let variable = initial(&mut inside, declared)?;
            inside.variables.insert(declared.name.text.to_lowercase(), variable);
        }
        let shared = block.inputs.iter().chain(&block.outputs);
        let names = shared.map(|one| one.name.text.to_lowercase());
        let outside = names.filter_map(|name| {
            let variable = inside.variables.get(&name)?.clone();
            Some((name, variable))
        });
        let outside = outside.collect();
        Ok(Interpreter { block, parsed, inside, outside, state: 0 })
    }

    /// The name of the state that the chart is in.
    pub fn state(&self) -> &'b str {
        self.block.states.get(self.state).map_or("", |state| &state.name.text)
    }

    /// The number of the state that the chart is in.
    pub fn state_number(&self) -> usize {
        self.state
    }

    /// Goes on in a state, by its number, as if the chart had come to it.
    pub fn start_in(&mut self, state: usize) {
        self.state = state.min(self.block.states.len().saturating_sub(1));
    }

    /// What others see of a variable: an input as it was set, an output as it was sent, an internal
    /// variable as it is.
    pub fn value(&self, name: &str) -> Option<Value> {
        self.element(name, 0)
    }

    /// The same of an element of an array.
    pub fn element(&self, name: &str, at: usize) -> Option<Value> {
        let name = name.to_lowercase();
        let variable = self.outside.get(&name).or_else(|| self.inside.variables.get(&name))?;
        variable.values.get(at).copied()
    }

    /// Sets an input. The block sees it with an event that has it with it. Returns whether there is
    /// such an input.
    pub fn set(&mut self, input: &str, value: Value) -> bool {
        self.set_element(input, 0, value)
    }

    /// The same with an element of an array.
    pub fn set_element(&mut self, input: &str, at: usize, value: Value) -> bool {
        let is_input = self.block.inputs.iter().any(|one| one.name.names(input));
        let variable = self.outside.get_mut(&input.to_lowercase()).filter(|_| is_input);
        let of_type = variable.as_ref().map(|variable| variable.of_type);
        let slot = variable.and_then(|variable| variable.values.get_mut(at));
        match slot.zip(of_type) {
            Some((slot, of_type)) => {
                *slot = value.to(of_type);
                true
            }
            None => false,
        }
    }

    /// Delivers an event by its name; `None` if there is none of this name.
    pub fn send_named(&mut self, event: &str) -> Option<Result<Step, Stopped>> {
        let number = self.block.event_inputs.iter().position(|one| one.name.names(event))?;
        Some(self.send(&[number]))
    }

    /// Delivers one of the events that came at the same time, by their numbers: the one that the
    /// first transition names that clears then, or else the first of them.
    pub fn send(&mut self, events: &[usize]) -> Result<Step, Stopped> {
        let mut step = Step::default();
        let Some(event) = self.chosen(events)? else { return Ok(step) };
        step.lost = events.iter().copied().filter(|one| *one != event).collect();
        self.sample(event);
        let mut present = Some(event);
        while let Some(next) = self.clearing(present)? {
            present = None;
            let (number, state) = next;
            self.state = state;
            step.cleared.push(number);
            step.entered.push(state);
            self.act(&mut step)?;
            if step.entered.len() >= TRANSITIONS_MAX {
                return Err(self.no_rest(&step.entered));
            }
        }
        Ok(step)
    }

    fn no_rest(&self, entered: &[usize]) -> Stopped {
        let mut names: Vec<String> = Vec::new();
        for state in entered.iter().rev().take(self.block.states.len() * 2) {
            let name = self.block.states.get(*state).map_or("", |state| &state.name.text);
            if !names.iter().any(|known| known == name) {
                names.push(name.to_owned());
            }
        }
        names.reverse();
        Stopped::NoRest(names)
    }

    fn chosen(&mut self, events: &[usize]) -> Result<Option<usize>, Stopped> {
        let parsed = self.parsed;
        let here = self.state;
        for transition in parsed.transitions.iter().filter(|one| one.source == here) {
            let Some(event) = transition.event.filter(|event| events.contains(event)) else {
                continue;
            };
            let before = self.inside.clone();
            self.sample(event);
            let holds = match &transition.guard {
                Some(guard) => self.inside.expression(guard)?.is_true(),
                None => true,
            };
            self.inside = before;
            if holds {
                return Ok(Some(event));
            }
        }
        Ok((0..self.block.event_inputs.len()).find(|event| events.contains(event)))
    }

    /// Copies the inputs that an event has with it.
    fn sample(&mut self, event: usize) {
        let Some(Event { with, .. }) = self.block.event_inputs.get(event) else { return };
        for name in with {
            let name = name.text.to_lowercase();
            if let Some(value) = self.outside.get(&name) {
                self.inside.variables.insert(name, value.clone());
            }
        }
    }

    /// The first transition that clears, and the state that it enters.
    fn clearing(&mut self, present: Option<usize>) -> Result<Option<(usize, usize)>, Stopped> {
        let parsed = self.parsed;
        let here = self.state;
        let leaving = parsed.transitions.iter().enumerate().filter(|(_, one)| one.source == here);
        for (number, transition) in leaving {
            let is_there = transition.event.is_none() || transition.event == present;
            let holds = match &transition.guard {
                Some(guard) if is_there => self.inside.expression(guard)?.is_true(),
                _ => is_there,
            };
            if holds {
                return Ok(Some((number, transition.destination)));
            }
        }
        Ok(None)
    }

    fn act(&mut self, step: &mut Step) -> Result<(), Stopped> {
        let (block, parsed) = (self.block, self.parsed);
        let Some(state) = block.states.get(self.state) else { return Ok(()) };
        for action in &state.actions {
            let number = action.algorithm.as_ref().and_then(|name| {
                block.algorithms.iter().position(|one| one.name.names(&name.text))
            });
            if let Some(statements) = number.and_then(|number| parsed.algorithms.get(number)) {
                self.inside.execute(statements)?;
            }
            let output = action.output.as_ref().and_then(|name| {
                block.event_outputs.iter().position(|one| one.name.names(&name.text))
            });
            if let Some(output) = output {
                step.sent.push(output);
                self.send_data(output);
            }
        }
        Ok(())
    }

    /// Copies the outputs that an event has with it.
    fn send_data(&mut self, event: usize) {
        let Some(Event { with, .. }) = self.block.event_outputs.get(event) else { return };
        for name in with {
            let name = name.text.to_lowercase();
            if let Some(value) = self.inside.variables.get(&name) {
                self.outside.insert(name, value.clone());
            }
        }
    }
}

/// A variable with its initial value.
fn initial(memory: &mut Memory, declared: &model::Variable) -> Result<Variable, Stopped> {
    let of_type = declared.of_type;
    if of_type.is_long() || of_type == DataType::String {
        return Err(Stopped::Unknown(format!("{}: {}", declared.name.text, of_type.name())));
    }
    let count = declared.size.unwrap_or(1) as usize;
    let mut values = vec![Value::zero(of_type); count];
    let Some(text) = &declared.initial else { return Ok(Variable { of_type, values }) };
    let inner = text.text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
    let texts: Vec<&str> = inner.map_or(vec![text.text.as_str()], |text| text.split(',').collect());
    for (slot, text) in values.iter_mut().zip(texts) {
        let (expression, _) = parse_expression(text, Span::new(0, text.len()));
        let value = expression.map(|one| memory.expression(&one)).transpose()?;
        *slot = value.unwrap_or(Value::zero(of_type)).to(of_type);
    }
    Ok(Variable { of_type, values })
}
