//! A block at work, line by line: inputs are set, events are sent, and what comes of it is told and
//! compared. It reads and prints nothing itself.

mod part;
mod value;

use std::fmt::Write as _;

use awl_asm::suggest::nearest;

use crate::interpreter::{Interpreter, Step, Stopped, Value};
use crate::model::{Block, Text};
use crate::parsed::Parsed;
pub use part::Mistake;
use part::{Outcome, Part, without_comment};
use value::Place;
pub(crate) use value::{is_same, value_of, written};

/// What the commands are.
pub const HELP: &str = "\
  X = 5, Y = TRUE            sets inputs; the block sees them with an event that has them with it
  A = [1, 2, 3], A[0] = 4    sets an array, or one of its elements
  event NAME                 sends an event; of several, NAME, NAME, the block uses one
  expect X = 5, State = S    fails where it is something else; an output event is 1 or 0
  show                       state and values
  chart                      states, actions and transitions; > is the state it is in
  reset                      begins anew
  help, exit";

/// The name under which the state is asked for, where no variable has it.
const STATE: &str = "State";

/// What a line came to.
#[derive(Debug, Clone, PartialEq)]
pub enum Done {
    /// What there is to tell.
    Said(String),
    /// What is not as it was expected.
    Failed(String),
    /// There is nothing more.
    End,
}

/// A block that is told what to do.
pub struct Session<'b> {
    block: &'b Block,
    parsed: &'b Parsed,
    interpreter: Interpreter<'b>,
    last: Step,
}

impl<'b> Session<'b> {
    /// A block before its first event. Its texts have no errors.
    pub fn new(block: &'b Block, parsed: &'b Parsed) -> Result<Session<'b>, Stopped> {
        let interpreter = Interpreter::new(block, parsed)?;
        Ok(Session { block, parsed, interpreter, last: Step::default() })
    }

    /// The number of the state that the chart is in.
    pub fn state_number(&self) -> usize {
        self.interpreter.state_number()
    }

    /// What the last event brought about.
    pub fn last(&self) -> &Step {
        &self.last
    }

    /// Executes a line.
    pub fn obey(&mut self, line: &str) -> Outcome<Done> {
        let line = Part { text: without_comment(line), start: 0 }.trimmed();
        let end = line.text.find(char::is_whitespace).unwrap_or(line.text.len());
        let (word, rest) = line.split(end, 0);
        if rest.text.starts_with('=') || line.text.contains('=') && word.text.contains('=') {
            return self.set(line);
        }
        match word.text {
            "" => Ok(Done::Said(String::new())),
            "event" => self.event(rest),
            "expect" => self.expect(rest),
            "show" => Ok(Done::Said(self.shown())),
            "chart" => Ok(Done::Said(self.chart())),
            "reset" => match Session::new(self.block, self.parsed) {
                Ok(session) => {
                    *self = session;
                    Ok(Done::Said(String::new()))
                }
                Err(stopped) => line.wrong(stopped.to_string(), None),
            },
            "help" => Ok(Done::Said(HELP.to_owned())),
            "exit" | "quit" => Ok(Done::End),
            other => {
                let commands = ["event", "expect", "show", "chart", "reset", "help", "exit"];
                let help = match nearest(other, commands) {
                    Some(near) => format!("`{near}` is one; `help` lists them"),
                    None => "`help` lists the commands; X = 5 sets an input".to_owned(),
                };
                word.wrong(format!("{other}: no such command"), Some(help))
            }
        }
    }

    fn unknown<T>(&self, name: Part, what: &str, names: Vec<&str>) -> Outcome<T> {
        let help = match nearest(name.text, names.iter().copied()) {
            Some(near) => format!("`{near}` is one"),
            None => format!("there is {}", names.join(", ")),
        };
        name.wrong(format!("{}: no {what} of the block", name.text), Some(help))
    }

    /// `X = 5`: the name and the value.
    fn assignment<'l>(&self, part: Part<'l>) -> Outcome<(Part<'l>, Part<'l>)> {
        match part.text.find('=') {
            Some(at) => Ok(part.split(at, 1)),
            None => part.wrong(format!("{}: no value", part.text), Some("write X = 5".to_owned())),
        }
    }

    fn set(&mut self, line: Part) -> Outcome<Done> {
        let mut all = Vec::new();
        for part in line.list() {
            let (name, value) = self.assignment(part)?;
            let Some(place) = Place::find(name, self.block.inputs.iter())? else {
                let names = self.block.inputs.iter().map(|one| one.name.text.as_str());
                return self.unknown(name, "input", names.collect());
            };
            all.push((place.values(value)?, place));
        }
        for (values, place) in all {
            for (at, value) in place.elements.zip(values) {
                self.interpreter.set_element(&place.variable.name.text, at, value);
            }
        }
        Ok(Done::Said(String::new()))
    }

    fn event(&mut self, list: Part) -> Outcome<Done> {
        let mut events = Vec::new();
        for part in list.list() {
            let mut all = self.block.event_inputs.iter();
            match all.position(|one| one.name.names(part.text)) {
                Some(event) => events.push(event),
                None => {
                    let names = self.block.event_inputs.iter().map(|one| one.name.text.as_str());
                    return self.unknown(part, "event", names.collect());
                }
            }
        }
        let before = self.interpreter.state();
        match self.interpreter.send(&events) {
            Ok(step) => {
                self.last = step;
                Ok(Done::Said(self.told(before, &events)))
            }
            Err(stopped) => list.wrong(stopped.to_string(), None),
        }
    }

    /// What an event brought about.
    fn told(&self, before: &str, events: &[usize]) -> String {
        let Block { states, event_inputs, event_outputs, .. } = self.block;
        let Step { sent, lost, entered, .. } = &self.last;
        let name = |event: &usize| event_inputs.get(*event).map_or("", |one| &one.name.text);
        let used: Vec<&str> = events.iter().filter(|one| !lost.contains(one)).map(name).collect();
        let mut path = vec![before];
        path.extend(entered.iter().filter_map(|at| Some(states.get(*at)?.name.text.as_str())));
        let mut text = format!("{}: {}", used.join(", "), path.join(" -> "));
        for event in sent.iter().filter_map(|event| event_outputs.get(*event)) {
            let with: Vec<String> = event.with.iter().map(|one| self.assigned(one)).collect();
            let _ = write!(text, "\n  {} {}", event.name.text, with.join(", "));
        }
        for event in lost {
            let _ = write!(text, "\n  {} is lost: it came with another", name(event));
        }
        text.lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
    }

    fn assigned(&self, name: &Text) -> String {
        format!("{} = {}", name.text, self.value(&name.text))
    }

    /// A value as others see it, of an array all of its elements.
    pub fn value(&self, name: &str) -> String {
        let variable = self.block.variables().find(|one| one.name.names(name));
        variable.map(Place::of).map_or(String::new(), |place| place.written(&self.values(&place)))
    }

    fn values(&self, place: &Place) -> Vec<Value> {
        let name = &place.variable.name.text;
        place.elements.clone().filter_map(|at| self.interpreter.element(name, at)).collect()
    }

    fn expect(&mut self, list: Part) -> Outcome<Done> {
        let mut wrong = Vec::new();
        for part in list.list() {
            let (name, value) = self.assignment(part)?;
            let found = self.found(name, value)?;
            wrong.extend(found);
        }
        Ok(match wrong.is_empty() {
            true => Done::Said(String::new()),
            false => Done::Failed(wrong.join("; ")),
        })
    }

    /// What something is, where it is not what is expected.
    fn found(&self, name: Part, value: Part) -> Outcome<Option<String>> {
        let Block { states, event_outputs, .. } = self.block;
        if let Some(place) = Place::find(name, self.block.variables())? {
            let (is, wanted) = (self.values(&place), place.values(value)?);
            let is_it = is.iter().zip(&wanted).all(|(is, wanted)| is_same(*is, *wanted));
            let [is, wanted] = [is, wanted].map(|values| place.written(&values));
            return Ok((!is_it).then(|| format!("{} is {is}, not {wanted}", name.text)));
        }
        if let Some(event) = event_outputs.iter().position(|one| one.name.names(name.text)) {
            let wanted = match value.text {
                "0" | "FALSE" => false,
                "1" | "TRUE" => true,
                other => {
                    let help = "1: it was sent with the last event; 0: it was not".to_owned();
                    return value.wrong(format!("{other}: no value of an event"), Some(help));
                }
            };
            let is = self.last.sent.contains(&event);
            let was = if is { "was" } else { "was not" };
            return Ok((is != wanted).then(|| format!("{} {was} sent", name.text)));
        }
        if !name.text.eq_ignore_ascii_case(STATE) {
            let mut names: Vec<&str> =
                self.block.variables().map(|one| one.name.text.as_str()).collect();
            names.extend(event_outputs.iter().map(|one| one.name.text.as_str()));
            names.push(STATE);
            return self.unknown(name, "variable or output event", names);
        }
        if !states.iter().any(|one| one.name.names(value.text)) {
            let names = states.iter().map(|one| one.name.text.as_str());
            return self.unknown(value, "state", names.collect());
        }
        let is = self.interpreter.state();
        let is_it = is.eq_ignore_ascii_case(value.text);
        Ok((!is_it).then(|| format!("State is {is}, not {}", value.text)))
    }

    fn shown(&self) -> String {
        let block = self.block;
        let mut text = format!("{STATE} = {}", self.interpreter.state());
        let parts = [("in", &block.inputs), ("out", &block.outputs), ("own", &block.internals)];
        for (what, variables) in parts.iter().filter(|(_, all)| !all.is_empty()) {
            let all: Vec<String> = variables.iter().map(|one| self.assigned(&one.name)).collect();
            let _ = write!(text, "\n{what:<4}{}", all.join(", "));
        }
        text
    }

    fn chart(&self) -> String {
        let block = self.block;
        let mut lines = Vec::new();
        for (at, state) in block.states.iter().enumerate() {
            let mark = if at == self.interpreter.state_number() { ">" } else { " " };
            let name = |text: &Option<Text>| text.as_ref().map(|one| one.text.clone());
            let actions = state.actions.iter().map(|one| {
                let both = [name(&one.algorithm), name(&one.output).map(|one| format!("!{one}"))];
                both.into_iter().flatten().collect::<Vec<_>>().join(" ")
            });
            let line =
                format!("{mark} {} {}", state.name.text, actions.collect::<Vec<_>>().join(", "));
            lines.push(line.trim_end().to_owned());
            let leaving = block.transitions.iter().filter(|one| one.source.names(&state.name.text));
            lines
                .extend(leaving.map(|one| {
                    format!("      {} -> {}", one.condition.text, one.destination.text)
                }));
        }
        lines.join("\n")
    }
}
