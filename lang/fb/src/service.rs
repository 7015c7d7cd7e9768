//! Service sequences: what a block must answer to which events, in order. They are run with the
//! interpreter, and written as scenarios for the simulator.

use std::fmt::Write as _;

use diagnostics::Span;
use st::names::safe_name;

use crate::generate::state_name;
use crate::interpreter::{Interpreter, Value};
use crate::model::{Block, Event, Primitive, Sequence, Text, Transaction};
use crate::parsed::Parsed;
use crate::session::{is_same, value_of, written};

/// Why a sequence does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Broken {
    /// Where, in the block's file.
    pub span: Span,
    /// What is otherwise.
    pub message: String,
}

type Outcome<T> = Result<T, Broken>;

fn broken<T>(at: &Text, message: impl Into<String>) -> Outcome<T> {
    Err(Broken { span: at.span, message: message.into() })
}

/// A transaction with names looked up.
struct Step<'b> {
    /// The event that is sent, and what is set before it.
    event: Option<usize>,
    inputs: Vec<(&'b Text, Value)>,
    /// What must come, in order.
    outputs: Vec<Answer<'b>>,
}

/// An event that must come, with values.
struct Answer<'b> {
    event: usize,
    primitive: &'b Primitive,
    values: Vec<(&'b Text, Value)>,
}

/// Runs a sequence from the beginning of the block, or in the state in which it starts.
pub fn run(block: &Block, parsed: &Parsed, sequence: &Sequence) -> Outcome<()> {
    let steps = steps(block, sequence)?;
    let mut interpreter = Interpreter::new(block, parsed)
        .or_else(|stopped| broken(&sequence.name, stopped.to_string()))?;
    if let Some(state) = start(block, sequence)? {
        interpreter.start_in(state);
    }
    for (step, transaction) in steps.iter().zip(&sequence.transactions) {
        for (name, value) in &step.inputs {
            interpreter.set(&name.text, *value);
        }
        let events: Vec<usize> = step.event.into_iter().collect();
        let place = place(transaction, sequence);
        let sent = match interpreter.send(&events) {
            Ok(done) => done.sent,
            Err(stopped) => return broken(place, stopped.to_string()),
        };
        let wanted: Vec<usize> = step.outputs.iter().map(|one| one.event).collect();
        if sent != wanted {
            let message =
                format!("the block sends {}, not {}", names(block, &sent), names(block, &wanted));
            return broken(place, message);
        }
        for (name, value, primitive) in last_values(block, step) {
            let is = interpreter.value(&name.text).unwrap_or(Value::Literal(0));
            if !is_same(is, value) {
                let message = format!("{} is {}, not {}", name.text, written(is), written(value));
                return broken(&primitive.parameters, message);
            }
        }
    }
    Ok(())
}

/// A sequence as a scenario for the simulator, which runs the block as a program: it tells which
/// events are sent, and not in which order.
pub fn scenario(block: &Block, sequence: &Sequence) -> Outcome<String> {
    let mut text = format!("# Service sequence {}\nscan 10ms\n", sequence.name.text);
    let mut now = 0;
    if let Some(state) = start(block, sequence)? {
        let _ = writeln!(text, "at {now}ms {} = {state}", state_name(block));
    }
    for step in steps(block, sequence)? {
        let shown =
            |(name, value): (&Text, Value)| format!("{} = {}", safe_name(&name.text), plain(value));
        let inputs: Vec<String> =
            step.inputs.iter().map(|(name, value)| shown((name, *value))).collect();
        if !inputs.is_empty() {
            let _ = writeln!(text, "at {now}ms {}", inputs.join(", "));
        }
        let event = step.event.and_then(|event| block.event_inputs.get(event));
        if let Some(event) = event {
            let _ = writeln!(text, "at {now}ms event {}", safe_name(&event.name.text));
        }
        now += 10;
        let sent = block.event_outputs.iter().enumerate().map(|(at, event)| {
            let is_sent = step.outputs.iter().any(|one| one.event == at);
            format!("{} = {}", safe_name(&event.name.text), u8::from(is_sent))
        });
        let values =
            last_values(block, &step).into_iter().map(|(name, value, _)| shown((name, value)));
        let all: Vec<String> = sent.chain(values).collect();
        if !all.is_empty() {
            let _ = writeln!(text, "at {now}ms expect {}", all.join(", "));
        }
    }
    Ok(text)
}

/// A value as scenarios write it.
fn plain(value: Value) -> String {
    match value {
        Value::Real(value) => format!("{value:?}"),
        other => other.whole().to_string(),
    }
}

fn names(block: &Block, events: &[usize]) -> String {
    let names = events.iter().filter_map(|at| block.event_outputs.get(*at));
    let names: Vec<&str> = names.map(|one| one.name.text.as_str()).collect();
    if names.is_empty() { "no event".to_owned() } else { names.join(", ") }
}

fn place<'s>(transaction: &'s Transaction, sequence: &'s Sequence) -> &'s Text {
    transaction.input.as_ref().map_or(&sequence.name, |one| &one.event)
}

/// The state in which a sequence starts, if it says so.
fn start(block: &Block, sequence: &Sequence) -> Outcome<Option<usize>> {
    let found = sequence.attributes.iter().find(|(name, _)| name == "StartState");
    let Some((_, name)) = found.filter(|(_, name)| !name.is_empty()) else { return Ok(None) };
    match block.state(name) {
        Some(state) => Ok(Some(state)),
        None => broken(&sequence.name, format!("{name}: there is no state of this name")),
    }
}

/// What must be seen after a transaction: of a value that is sent twice the last one.
fn last_values<'b>(block: &Block, step: &Step<'b>) -> Vec<(&'b Text, Value, &'b Primitive)> {
    let mut values = Vec::new();
    for (at, answer) in step.outputs.iter().enumerate() {
        for (name, value) in &answer.values {
            let mut later = step.outputs.iter().skip(at + 1);
            let is_sent_again = later.any(|one| {
                let event = block.event_outputs.get(one.event);
                event.is_some_and(|one| one.with.iter().any(|with| with.names(&name.text)))
            });
            if !is_sent_again {
                values.push((*name, *value, answer.primitive));
            }
        }
    }
    values
}

fn steps<'b>(block: &'b Block, sequence: &'b Sequence) -> Outcome<Vec<Step<'b>>> {
    let mut steps = Vec::new();
    for transaction in &sequence.transactions {
        let (mut event, mut inputs) = (None, Vec::new());
        if let Some(primitive) = &transaction.input {
            event = Some(event_of(&block.event_inputs, primitive)?);
            inputs = parameters(block, primitive)?;
        }
        let mut outputs = Vec::new();
        for primitive in &transaction.outputs {
            let event = event_of(&block.event_outputs, primitive)?;
            let values = parameters(block, primitive)?;
            outputs.push(Answer { event, primitive, values });
        }
        steps.push(Step { event, inputs, outputs });
    }
    Ok(steps)
}

fn event_of(events: &[Event], primitive: &Primitive) -> Outcome<usize> {
    let name = primitive.event.text.trim_end_matches(['+', '-']);
    match events.iter().position(|one| one.name.names(name)) {
        Some(event) => Ok(event),
        None => broken(&primitive.event, format!("{name}: the block has no such event here")),
    }
}

/// `PV:=3;Q:=TRUE`
fn parameters<'b>(block: &'b Block, primitive: &'b Primitive) -> Outcome<Vec<(&'b Text, Value)>> {
    let mut values = Vec::new();
    let parts = primitive.parameters.text.split([';', ',']).map(str::trim);
    for part in parts.filter(|part| !part.is_empty()) {
        let Some((name, value)) = part.split_once(":=").or_else(|| part.split_once('=')) else {
            return broken(&primitive.parameters, format!("{part}: write X:=5"));
        };
        let mut all = block.inputs.iter().chain(&block.outputs);
        let Some(variable) = all.find(|one| one.name.names(name.trim())) else {
            let message = format!("{}: the block has no variable of this name", name.trim());
            return broken(&primitive.parameters, message);
        };
        match value_of(value.trim(), variable) {
            Ok(value) => values.push((&variable.name, value)),
            Err(message) => return broken(&primitive.parameters, message),
        }
    }
    Ok(values)
}
