//! A basic function block as data: interface, states, algorithms. It knows neither file format nor
//! execution.

use diagnostics::Span;

use crate::data_type::DataType;

/// A name or text of a block, and where it was read. Equal are those that say the same, wherever
/// they are.
#[derive(Debug, Clone, Default)]
pub struct Text {
    /// What it says.
    pub text: String,
    /// Where it is in the file that it was read from.
    pub span: Span,
}

impl Text {
    /// One that was not read from a file.
    pub fn new(text: impl Into<String>) -> Text {
        Text { text: text.into(), span: Span::default() }
    }

    /// Whether it names the same as another: letter case does not matter.
    pub fn names(&self, other: &str) -> bool {
        self.text.eq_ignore_ascii_case(other)
    }
}

impl PartialEq for Text {
    fn eq(&self, other: &Text) -> bool {
        self.text == other.text
    }
}

/// A basic function block.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Block {
    /// Its name.
    pub name: Text,
    /// What it is for.
    pub comment: String,
    /// Who made it by which standard: names with values, in order.
    pub identification: Vec<(String, String)>,
    /// Its versions, oldest first, each as names with values.
    pub versions: Vec<Vec<(String, String)>>,
    /// Events that it takes.
    pub event_inputs: Vec<Event>,
    /// Events that it sends.
    pub event_outputs: Vec<Event>,
    /// Variables that are read with events.
    pub inputs: Vec<Variable>,
    /// Variables that are sent with events.
    pub outputs: Vec<Variable>,
    /// Variables of its own.
    pub internals: Vec<Variable>,
    /// The states of its execution control chart (ECC). The first one is the initial one.
    pub states: Vec<State>,
    /// The transitions. Of one state's transitions the first one that can clears.
    pub transitions: Vec<Transition>,
    /// Its algorithms.
    pub algorithms: Vec<Algorithm>,
    /// What it must answer.
    pub service: Option<Service>,
}

impl Block {
    /// All variables: inputs, outputs, internal ones.
    pub fn variables(&self) -> impl Iterator<Item = &Variable> {
        self.inputs.iter().chain(&self.outputs).chain(&self.internals)
    }

    /// The number of a state.
    pub fn state(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name.names(name))
    }

    /// An algorithm.
    pub fn algorithm(&self, name: &str) -> Option<&Algorithm> {
        self.algorithms.iter().find(|algorithm| algorithm.name.names(name))
    }
}

/// An event.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Event {
    /// Its name.
    pub name: Text,
    /// What it means.
    pub comment: String,
    /// Variables that are read or sent with it (WITH).
    pub with: Vec<Text>,
}

/// A variable.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name.
    pub name: Text,
    /// Its type.
    pub of_type: DataType,
    /// Where the type was read.
    pub type_span: Span,
    /// How many elements it has, if it is an array.
    pub size: Option<u32>,
    /// Its initial value, as written in ST.
    pub initial: Option<Text>,
    /// What it is.
    pub comment: String,
}

impl PartialEq for Variable {
    /// Wherever their types are.
    fn eq(&self, other: &Variable) -> bool {
        let Variable { name, of_type, type_span: _, size, initial, comment } = self;
        *name == other.name
            && *of_type == other.of_type
            && *size == other.size
            && *initial == other.initial
            && *comment == other.comment
    }
}

/// A place in the drawing; 100 is some five letters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// To the right.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// A state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// Its name.
    pub name: Text,
    /// What it is for.
    pub comment: String,
    /// Where it is drawn.
    pub place: Option<Place>,
    /// What is done on entry, in order.
    pub actions: Vec<Action>,
}

/// What is done on entry of a state: first the algorithm, then the event.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Action {
    /// The algorithm that is executed.
    pub algorithm: Option<Text>,
    /// The event that is sent.
    pub output: Option<Text>,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Transition {
    /// The state that it leaves.
    pub source: Text,
    /// The state that it enters.
    pub destination: Text,
    /// When it clears, as written: `CU[CV < 65535]`, `1`.
    pub condition: Text,
    /// Why.
    pub comment: String,
    /// Where it is drawn.
    pub place: Option<Place>,
}

/// An algorithm in Structured Text.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Algorithm {
    /// Its name.
    pub name: Text,
    /// What it computes.
    pub comment: String,
    /// Its statements.
    pub text: Text,
}

/// What a block must answer to which events.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Service {
    /// Names of its two interfaces and a comment: names with values, in order.
    pub attributes: Vec<(String, String)>,
    /// Its sequences.
    pub sequences: Vec<Sequence>,
}

/// A sequence of events and answers, from the beginning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sequence {
    /// Its name.
    pub name: Text,
    /// What else is said about it, such as a comment and the state in which it starts.
    pub attributes: Vec<(String, String)>,
    /// Its steps.
    pub transactions: Vec<Transaction>,
}

/// An event and the answers to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Transaction {
    /// The event, with values.
    pub input: Option<Primitive>,
    /// The answers, in order, with values.
    pub outputs: Vec<Primitive>,
}

/// An event at an interface.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Primitive {
    /// The name of the interface.
    pub interface: Text,
    /// The name of the event.
    pub event: Text,
    /// Values that it has with it: `PV:=3;Q:=TRUE`.
    pub parameters: Text,
}
