//! What is asked about drawings, and the answers, as JSON; the page's `chart/protocol.ts` and
//! `diagram/protocol.ts` say the same. A rectangle is left, top, width, height; a line from one
//! point to another four numbers, too.

pub mod diagrams;
pub mod events;

use std::fmt;

use chart::edit::Element;
use chart::model::{StepId, TransitionId};
use diagnostics::{Code, Diagnostic, Severity, Source};
use diagrams::{Block, DiagramEdit, Diagrams};
use events::Events;
use serde::{Deserialize, Serialize};

/// A point of a drawing, or a place in a text.
pub type At = (i32, i32);

/// A question with its number.
#[derive(Debug, Deserialize)]
pub struct Request {
    /// Which comes with the answer.
    pub id: u32,
    /// What is asked.
    #[serde(flatten)]
    pub question: Question,
}

/// The number of a request.
#[derive(Debug, Deserialize)]
pub struct Number {
    /// As in [`Request`].
    pub id: u32,
}

/// A question. Each has the text as it is, and what a chart is called that is not there yet.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase")]
pub enum Question {
    /// The charts of a text, without those of these names: they are folded. Answer: [`Charts`].
    Draw {
        text: String,
        name: String,
        #[serde(default)]
        folded: Vec<String>,
    },
    /// All of the edits of a chart, which is the number of a sheet, or none. Answer: the text, its
    /// charts and what is to be selected.
    Edit {
        text: String,
        name: String,
        #[serde(default)]
        folded: Vec<String>,
        chart: usize,
        edits: Vec<Edit>,
    },
    /// Which edits would be refused. Answer: for each why, or null.
    Allowed { text: String, name: String, chart: usize, edits: Vec<Edit> },
    /// Steps with the transitions among them as a text, which can be pasted. Answer: the text.
    Copy { text: String, name: String, chart: usize, steps: Vec<ElementId> },
    /// Whether the conditions of transitions are TRUE with values. Answer: a [`Judgement`] each.
    Judge { text: String, name: String, transitions: Vec<Judged> },
    /// Charts of SFCEdit for a target, `twincat`, `pl7`, `plcopen`, `uno200`, with a table of
    /// variables as a file has it. Answer: [`Converted`].
    Convert { text: String, name: String, variables: String, target: String },
    /// The diagrams of blocks of a text; `others` are the other texts of its project in Structured
    /// Text. Answer: [`Diagrams`].
    Diagrams { text: String, name: String, others: Vec<String> },
    /// One change of a diagram, which is the number of a sheet. Answer: the text, its diagrams and
    /// the elements that are new.
    EditDiagram {
        text: String,
        name: String,
        others: Vec<String>,
        diagram: usize,
        edit: DiagramEdit,
    },
    /// Elements of a diagram as a text that can be pasted. Answer: the text.
    CopyDiagram {
        text: String,
        name: String,
        others: Vec<String>,
        diagram: usize,
        elements: Vec<String>,
    },
    /// The blocks that a diagram can have. Answer: a [`Block`] each, those of the project first.
    Blocks { text: String, name: String, others: Vec<String> },
    /// A block of IEC 61499 after lines as `uno200 events` takes them. Answer: [`Events`].
    Events { text: String, name: String, lines: Vec<String> },
}

/// A transition of a chart, with a value for each operand of its condition.
#[derive(Debug, Deserialize)]
pub struct Judged {
    /// The number of the sheet.
    pub chart: usize,
    /// Which one.
    pub transition: ElementId,
    /// What is known of its operands.
    pub values: Vec<Option<f64>>,
}

/// What a condition is.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Judgement {
    /// Whether it is TRUE; null where that is not known.
    pub is_true: Option<bool>,
    /// What is missing, if it is FALSE: `Ready AND (Full OR NOT Stop)`.
    pub waits_for: String,
}

/// What becomes of charts of SFCEdit.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Converted {
    /// The variables in the order of their use: as the table says, or as their use suggests.
    pub variables: Vec<Variable>,
    /// What is wrong, in the table first.
    pub problems: Vec<Problem>,
    /// The text for the target, unless something is wrong.
    pub program: Option<String>,
    /// The ending of its file.
    pub ending: &'static str,
    /// The equations of the steps, in Markdown.
    pub equations: String,
}

/// A variable of charts of SFCEdit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// `signal`, `input`, `output`, `memory`, `system`, `constant`, `timer`, `counter`.
    pub kind: &'static str,
    /// Its type.
    #[serde(rename = "type")]
    pub of_type: String,
    /// Its value, of a constant.
    pub value: Option<String>,
}

/// An error or a warning about them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Problem {
    /// Its line, from 1.
    pub line: u32,
    /// Whether it is in the table of variables.
    pub is_of_table: bool,
    /// Or a warning.
    pub is_error: bool,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: Vec<String>,
}

/// What kind of value it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum OperandKind {
    /// TRUE or FALSE.
    Truth,
    /// A number.
    Number,
    /// Milliseconds.
    Time,
}

/// A variable in a condition.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Operand {
    /// As it is written.
    pub written: String,
    /// What it may be called in the program: the first one that there is.
    pub names: Vec<String>,
    /// What kind of value it has there.
    pub kind: OperandKind,
}

/// What is answered to a request.
#[derive(Debug, Serialize)]
pub struct Reply {
    id: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    answer: Option<Answer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
}

impl Reply {
    /// To the request of a number.
    pub fn of(id: u32, outcome: Result<Answer, String>) -> Reply {
        match outcome {
            Ok(answer) => Reply { id, answer: Some(answer), refused: None },
            Err(message) => Reply { id, answer: None, refused: Some(message) },
        }
    }
}

/// An answer.
#[expect(missing_docs, reason = "the questions say what is answered")]
#[derive(Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    Charts(Charts),
    Edited { text: String, charts: Charts, select: Vec<ElementId> },
    Allowed(Vec<Option<String>>),
    Copy(String),
    Judged(Vec<Judgement>),
    Converted(Converted),
    Diagrams(Diagrams),
    EditedDiagram { text: String, diagrams: Diagrams, new: Vec<String> },
    Blocks(Vec<Block>),
    Events(Box<Events>),
}

/// An element of a chart, as `s3` or `t4`: a step or a transition, and its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct ElementId(pub Element);

impl fmt::Display for ElementId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Element::Step(StepId(number)) => write!(f, "s{number}"),
            Element::Transition(TransitionId(number)) => write!(f, "t{number}"),
            // Actions are edited with their steps.
            Element::Action(action) => write!(f, "a{}", action.0),
        }
    }
}

impl From<ElementId> for String {
    fn from(id: ElementId) -> String {
        id.to_string()
    }
}

impl TryFrom<String> for ElementId {
    type Error = String;

    fn try_from(text: String) -> Result<ElementId, String> {
        let numbered = |kind| text.strip_prefix(kind)?.parse().ok();
        let step = numbered('s').map(|number| Element::Step(StepId(number)));
        let transition = || numbered('t').map(|number| Element::Transition(TransitionId(number)));
        let element = step.or_else(transition);
        element.map(ElementId).ok_or_else(|| format!("{text:?} is no step and no transition"))
    }
}

/// An edit: see [`chart::edit::Edit`], whose variants it has.
#[expect(missing_docs, reason = "the edits of charts say what each means")]
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum Edit {
    AddStep {
        at: Option<At>,
        is_initial: bool,
    },
    AddAfter {
        of: ElementId,
    },
    AddBefore {
        of: ElementId,
    },
    AddBranch {
        of: ElementId,
        is_parallel: bool,
    },
    Connect {
        from: Vec<ElementId>,
        to: Vec<ElementId>,
    },
    Erase {
        elements: Vec<ElementId>,
    },
    Rename {
        step: ElementId,
        name: String,
    },
    SetInitial {
        step: ElementId,
        is_initial: bool,
    },
    SetCondition {
        transition: ElementId,
        text: String,
    },
    SetTransition {
        transition: ElementId,
        name: Option<String>,
        priority: Option<u32>,
        from: Vec<ElementId>,
        to: Vec<ElementId>,
    },
    SetAction {
        step: ElementId,
        index: usize,
        action: Wanted,
    },
    InsertAction {
        step: ElementId,
        index: usize,
        action: Wanted,
    },
    RemoveAction {
        step: ElementId,
        index: usize,
    },
    ClearActions {
        step: ElementId,
    },
    MoveAction {
        step: ElementId,
        index: usize,
        to: usize,
    },
    /// Places as they are in the drawing, without its origin.
    Place {
        elements: Vec<(ElementId, At)>,
    },
    Layout {},
    Paste {
        text: String,
        at: Option<At>,
    },
    Comment {
        of: ElementId,
        text: String,
    },
}

/// An action of a block as a person writes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wanted {
    /// `N`, `L` and so on.
    pub qualifier: String,
    /// The time of qualifiers that have one: `T#2s`.
    pub time: Option<String>,
    /// The name of an action, a variable or an address.
    pub action: String,
}

/// The charts of a text.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Charts {
    /// How wide all of it is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// The charts, those in actions after the one around.
    pub sheets: Vec<Sheet>,
    /// Why it cannot be drawn; then there are no sheets.
    pub obstacle: Option<String>,
    /// Why it cannot be edited.
    pub mistake: Option<Mistake>,
}

/// Why a text cannot be edited.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// Its line, from 1.
    pub line: u32,
    /// What it is.
    pub message: String,
}

impl Mistake {
    /// What a reader of a text has found wrong.
    pub fn of<C: Code>(source: &Source, error: &Diagnostic<C>) -> Mistake {
        let (line, _) = source.position(error.span.start as usize);
        Mistake { line: line as u32, message: error.message.clone() }
    }

    /// The first error among what was found.
    pub fn first<C: Code>(source: &Source, found: &[Diagnostic<C>]) -> Option<Mistake> {
        let error = found.iter().find(|one| one.severity() == Severity::Error)?;
        Some(Mistake::of(source, error))
    }
}

/// A chart.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Sheet {
    /// Its name with those of the charts around.
    pub name: String,
    /// Where that is written.
    pub title: At,
    /// What it takes.
    pub frame: [i32; 4],
    /// Whether it is folded: it has no elements then.
    pub is_folded: bool,
    /// Whether it is a GRAFCET.
    pub is_grafcet: bool,
    /// Whether the text says where its steps are; otherwise the layout is automatic.
    pub is_placed: bool,
    /// Where the place (0, 0) of its text is: a place is a point of the drawing without this.
    pub origin: At,
    /// Its steps.
    pub steps: Vec<Step>,
    /// Its transitions.
    pub transitions: Vec<Transition>,
}

/// A step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Step {
    /// Which one.
    pub id: ElementId,
    /// Its line, from 1.
    pub line: u32,
    /// Its name as drawn; one that is too long ends in dots.
    pub name: String,
    /// Its name.
    pub full_name: String,
    /// What it stands for.
    pub note: String,
    /// Its comment.
    pub comment: String,
    /// Its box.
    pub frame: [i32; 4],
    /// Whether it is active at the beginning.
    pub is_initial: bool,
    /// Whether it becomes active with the enclosing step.
    pub is_linked: bool,
    /// `plain`, `macro`, `enclosing`.
    pub look: &'static str,
    /// Its actions, then its forcing orders.
    pub actions: Vec<Action>,
    /// The number of the sheet that a macro-step stands for.
    pub expansion: Option<usize>,
}

/// An action of a step, or a forcing order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Action {
    /// Its line, from 1.
    pub line: u32,
    /// Its box.
    pub frame: [i32; 4],
    /// Where the qualifier ends and the name begins.
    pub divider: Option<i32>,
    /// Qualifier and time, as drawn.
    pub qualifier: String,
    /// The action with its condition or event, as drawn.
    pub name: String,
    /// What there is to be edited; of a forcing order nothing.
    pub written: Option<Wanted>,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Transition {
    /// Which one.
    pub id: ElementId,
    /// Its line, from 1.
    pub line: u32,
    /// How it is called.
    pub title: String,
    /// Its name.
    pub name: Option<String>,
    /// Its priority.
    pub priority: Option<u32>,
    /// Its condition as written.
    pub condition: String,
    /// The variables in that.
    pub operands: Vec<Operand>,
    /// Its comment.
    pub comment: String,
    /// The steps before it.
    pub from: Vec<ElementId>,
    /// The steps after it.
    pub to: Vec<ElementId>,
    /// Its bar.
    pub bar: [i32; 4],
    /// What is written beside that, line by line.
    pub text: Vec<String>,
    /// Where that begins.
    pub label: At,
    /// The lines from steps and to steps.
    pub lines: Vec<Vec<At>>,
    /// Double lines: the upper ones.
    pub doubles: Vec<[i32; 4]>,
    /// Where arrows point up.
    pub arrows: Vec<At>,
}
