//! Edits of charts as the page wants them: charts by their number in the drawing, steps by their
//! names, transitions by their number in the chart. What each does, `chart::edit` says.

use serde::{Deserialize, Serialize};

/// An edit of one of the charts of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChartEdit {
    /// Which chart.
    pub sheet: u32,
    /// What is to be done.
    #[serde(flatten)]
    pub change: Change,
}

/// What is to be done. Places are middles, in the coordinates of the text.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum Change {
    /// A step, at a place if one is given.
    AddStep { at: Option<(i32, i32)>, initial: bool },
    /// A step after a step or a transition.
    AddStepAfter { step: Option<String>, transition: Option<u32> },
    /// A step before one.
    AddStepBefore { step: Option<String>, transition: Option<u32> },
    /// A step after a transition.
    AddStepBetween { transition: u32 },
    /// A branch with a step, an alternative or a parallel one.
    AddBranch { step: Option<String>, transition: Option<u32>, parallel: bool },
    /// A transition.
    Connect { from: Vec<String>, to: Vec<String> },
    /// Steps and transitions go.
    Erase { steps: Vec<String>, transitions: Vec<u32> },
    /// A step has another name.
    Rename { step: String, name: String },
    /// A step is initial; `initial` false: no longer.
    SetInitial { step: String, initial: Option<bool> },
    /// A transition has another condition.
    SetCondition { transition: u32, text: String },
    /// A transition is another one, apart from its condition.
    SetTransition {
        transition: u32,
        name: Option<String>,
        priority: Option<u32>,
        from: Vec<String>,
        to: Vec<String>,
    },
    /// An action of a step is another one, or is added after the last.
    SetAction { step: String, index: u32, qualifier: String, time: Option<String>, action: String },
    /// An action is added before another one.
    InsertAction {
        step: String,
        index: u32,
        qualifier: String,
        time: Option<String>,
        action: String,
    },
    /// An action of a step goes.
    RemoveAction { step: String, index: u32 },
    /// All actions of a step go.
    ClearActions { step: String },
    /// An action goes from all steps.
    EraseAction { action: String },
    /// An action of a step has another number.
    MoveAction { step: String, index: u32, to: u32 },
    /// Steps and transitions have places. Other steps have theirs from then on, too.
    Place { steps: Vec<PlacedStep>, transitions: Vec<PlacedTransition> },
    /// The layout is automatic.
    Layout,
    /// Steps of a copy; `at`: where the upper left one is.
    Paste { text: String, at: Option<(i32, i32)> },
    /// A comment of a step or a transition.
    Comment { step: Option<String>, transition: Option<u32>, text: String },
}

/// A step and its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacedStep {
    /// Its name.
    pub name: String,
    /// Its place.
    pub at: (i32, i32),
}

/// A transition and its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacedTransition {
    /// Its number.
    pub index: u32,
    /// Its place.
    pub at: (i32, i32),
}

/// What is selected in a chart, in the order in which it was.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Selection {
    /// Names of steps.
    pub steps: Vec<String>,
    /// Numbers of transitions.
    pub transitions: Vec<u32>,
}

/// What becomes of edits.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Edited {
    /// The text of the file then; none if they are refused.
    pub text: Option<String>,
    /// Why they are refused.
    pub refusal: Option<String>,
    /// What is to be selected: names of steps, titles of transitions.
    pub select: Vec<String>,
}

/// Whether an edit is allowed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Allowed {
    /// Which: a [`Change`], `addParallelBranch` or `copy`.
    pub kind: String,
    /// Why it is not.
    pub refusal: Option<String>,
}

/// A copy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Copied {
    /// The steps as text; none if it is refused.
    pub text: Option<String>,
    /// Why it is refused.
    pub refusal: Option<String>,
}
