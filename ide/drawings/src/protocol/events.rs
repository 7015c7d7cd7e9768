//! A block of IEC 61499: how its chart is answered, with what events have made of it.

use serde::Serialize;

use super::{At, Mistake};

/// A block after all that was done with it.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Events {
    /// How wide its chart is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// Its name.
    pub name: String,
    /// Where that is written.
    pub title: At,
    /// The states in the order of the block.
    pub states: Vec<State>,
    /// The transitions.
    pub transitions: Vec<Transition>,
    /// The number of the state that it is in.
    pub state: usize,
    /// The numbers of the transitions that the last event has cleared, in order.
    pub cleared: Vec<usize>,
    /// The numbers of the events that it has sent then.
    pub sent: Vec<usize>,
    /// Events that it takes.
    pub event_inputs: Vec<BlockEvent>,
    /// Events that it sends.
    pub event_outputs: Vec<BlockEvent>,
    /// Its inputs.
    pub inputs: Vec<BlockValue>,
    /// Its outputs.
    pub outputs: Vec<BlockValue>,
    /// Variables of its own.
    pub internals: Vec<BlockValue>,
    /// What each line came to.
    pub told: Vec<Told>,
    /// What is wrong in the text; then there is nothing else.
    pub mistake: Option<Mistake>,
}

/// A state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct State {
    /// Its name.
    pub name: String,
    /// What it is for.
    pub comment: String,
    /// Whether it is the initial one.
    pub is_initial: bool,
    /// Its box.
    pub frame: [i32; 4],
    /// On the right of it.
    pub actions: Vec<Action>,
}

/// What is done on entry of a state.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Action {
    /// The algorithm.
    pub algorithm: Option<Boxed>,
    /// The event.
    pub output: Option<Boxed>,
}

/// A text in a box.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Boxed {
    /// The text.
    pub text: String,
    /// The box.
    pub frame: [i32; 4],
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Transition {
    /// The numbers of the states that it leaves and enters.
    pub states: (usize, usize),
    /// Its condition, with its place in the order.
    pub text: String,
    /// Where that is written.
    pub label: [i32; 4],
    /// Its line: beginning, two control points, end.
    pub curve: [At; 4],
    /// The middle of that.
    pub middle: At,
    /// The head of its arrow.
    pub arrow: [At; 3],
}

/// An event.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlockEvent {
    /// Its name.
    pub name: String,
    /// What it means.
    pub comment: String,
    /// The variables that it has with it.
    pub with: Vec<String>,
}

/// A variable.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BlockValue {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub of_type: String,
    /// What it is.
    pub comment: String,
    /// Whether that is a list of values.
    pub is_array: bool,
    /// Its value as others see it.
    pub value: String,
}

/// What a line came to.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Told {
    /// What there is to tell.
    pub text: String,
    /// Whether the line is wrong, or something is not as it was expected.
    pub is_wrong: bool,
}
