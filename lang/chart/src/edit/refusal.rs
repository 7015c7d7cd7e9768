//! Why an edit is refused, in words for the person who wanted it.

use std::fmt;

use crate::drawing::PLACE_MAX;

/// Why an edit is refused. Nothing has changed then.
#[expect(missing_docs, reason = "the message says what each means")]
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Refusal {
    NoChart,
    NoStep(String),
    NoTransition,
    NoInstance { step: String, count: usize },
    NoAction(String),
    Nothing,
    SeveralInitial(String),
    InitialNeeded(String),
    InitialTaken(String),
    Taken(String),
    TransitionTaken(String),
    Declared(String),
    NotAName(String),
    Keyword(String),
    Captured { name: String, by: String },
    Asked { step: String, by: String },
    EmptySide,
    Exists(String),
    NoPriority,
    NothingLeaves(String),
    SeveralLeave(String),
    LastOfAction(String),
    InstanceTwice { action: String, qualifier: &'static str },
    TimeNeeded(&'static str),
    NoTime(&'static str),
    NotInGrafcet { instance: String, help: &'static str },
    Code { what: String, message: String },
    Illegible { what: String, message: Option<String> },
    PlaceTaken(String),
    TooFar,
    NoPlaces,
    NotACopy(String),
    OtherStandard,
    Statements(String),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use Refusal::*;
        match self {
            NoChart => write!(f, "there is no such chart in the file"),
            NoStep(name) => write!(f, "{name}: there is no step of this name"),
            NoTransition => write!(f, "there is no such transition"),
            NoInstance { step, count } => write!(f, "{step}: its block has {count} actions"),
            NoAction(name) => write!(f, "{name}: there is no action of this name"),
            Nothing => write!(f, "nothing is selected"),
            SeveralInitial(name) => {
                write!(f, "{name} is the initial step already; an SFC has one")
            }
            InitialNeeded(name) => {
                write!(f, "{name} is the initial step: another one must be made that first")
            }
            InitialTaken(name) => {
                write!(f, "{name} is the initial step of the chart: it needs one")
            }
            Taken(name) => write!(f, "{name}: a step or an action is called so already"),
            TransitionTaken(name) => write!(f, "{name}: a transition is called so already"),
            Declared(name) => write!(f, "{name}: a variable is called so already"),
            NotAName(name) => write!(
                f,
                "`{name}` is no name: letters, digits and `_`, and a digit is not the first"
            ),
            Keyword(name) => write!(f, "{name}: a word of the language names nothing"),
            Captured { name, by } => write!(f, "{name}: {by} names something else so"),
            Asked { step, by } => write!(f, "{by} asks for {step}: that must be changed first"),
            EmptySide => write!(f, "a transition has a step before it and one after it"),
            Exists(title) => {
                write!(f, "there is a transition between these steps already: {title}")
            }
            NoPriority => write!(f, "priorities belong to SFC: all that can be crossed are"),
            NothingLeaves(name) => write!(f, "{name}: no transition leaves this step yet"),
            SeveralLeave(name) => {
                write!(f, "{name}: several transitions leave this step; one is to be selected")
            }
            LastOfAction(name) => write!(f, "{name}: the chart of an action keeps a step"),
            InstanceTwice { action, qualifier } => {
                write!(f, "{action}({qualifier}): this is in the block already")
            }
            TimeNeeded(qualifier) => {
                write!(f, "{qualifier}: this qualifier needs a time, such as T#2s")
            }
            NoTime(qualifier) => {
                write!(f, "{qualifier}: this qualifier has no time; L, D, SD, DS and SL have one")
            }
            NotInGrafcet { instance, help } => write!(f, "{instance}: not in a GRAFCET; {help}"),
            Code { what, message } => write!(f, "{what}: {message}"),
            Illegible { what, message: Some(message) } => {
                write!(f, "{what} could not be read again: {message}")
            }
            Illegible { what, message: None } => {
                write!(f, "{what} would be read as something else; comments are apart from it")
            }
            PlaceTaken(name) => write!(f, "{name} is at this place"),
            TooFar => write!(f, "a place is between -{PLACE_MAX} and {PLACE_MAX}"),
            NoPlaces => write!(f, "nothing has a place: the layout is automatic already"),
            NotACopy(why) => write!(f, "this is no copy of steps: {why}"),
            OtherStandard => write!(f, "the copy is of the other standard, SFC or GRAFCET"),
            Statements(name) => write!(f, "{name} has statements: a unit is these or a chart"),
        }
    }
}
