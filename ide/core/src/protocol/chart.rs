//! Charts as the page draws them: what `chart::drawing` says, as few numbers as that needs. A
//! rectangle is left, top, width, height; a line from one point to another four numbers, too.

use serde::{Deserialize, Serialize};

/// The charts of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Chart {
    /// What it is called where its situation is told; another one each time.
    pub id: u32,
    /// The file.
    pub file: String,
    /// Why it cannot be drawn; then there are no sheets.
    pub obstacle: Option<String>,
    /// How wide all of it is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// The charts.
    pub sheets: Vec<Sheet>,
}

/// A chart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Sheet {
    /// Its name with those of the charts around.
    pub name: String,
    /// Where that is written.
    pub title: (i32, i32),
    /// Where the place 0, 0 of its text is in the drawing.
    pub origin: (i32, i32),
    /// Whether it is drawn at the places that its text gives to steps.
    pub is_placed: bool,
    /// Whether it is a GRAFCET.
    pub is_grafcet: bool,
    /// Its steps.
    pub steps: Vec<Step>,
    /// Its transitions.
    pub transitions: Vec<Transition>,
}

/// A step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Step {
    /// Its line, from 1.
    pub line: u32,
    /// Its name; one that is too long ends in dots.
    pub name: String,
    /// Its name.
    pub full_name: String,
    /// Its comment.
    pub comment: String,
    /// Whether it has a place of its own.
    pub is_placed: bool,
    /// What it stands for.
    pub note: String,
    /// Its box.
    pub frame: [i32; 4],
    /// Whether it is active at the beginning.
    pub is_initial: bool,
    /// Whether it becomes active with the enclosing step.
    pub is_linked: bool,
    /// `plain`, `macro`, `enclosing`.
    pub look: String,
    /// Its actions.
    pub actions: Vec<Action>,
}

/// An action of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Action {
    /// Its box.
    pub frame: [i32; 4],
    /// Where the qualifier ends and the name begins.
    pub divider: Option<i32>,
    /// Qualifier and time.
    pub qualifier: String,
    /// The action.
    pub name: String,
    /// What it is as an instance; none of a forcing order.
    pub instance: Option<Instance>,
}

/// An instance of an action in the block of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Instance {
    /// Which of the block.
    pub index: u32,
    /// Its qualifier.
    pub qualifier: String,
    /// Its time.
    pub time: Option<String>,
    /// Its action.
    pub action: String,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Transition {
    /// Its line, from 1.
    pub line: u32,
    /// How it is called.
    pub title: String,
    /// The steps before it: which of the sheet.
    pub from: Vec<u32>,
    /// The steps after it.
    pub to: Vec<u32>,
    /// Its condition.
    pub condition: String,
    /// Its name.
    pub name: Option<String>,
    /// Its priority.
    pub priority: Option<u32>,
    /// Its comment.
    pub comment: String,
    /// Whether it has a place of its own.
    pub is_placed: bool,
    /// Its bar.
    pub bar: [i32; 4],
    /// What is written beside that, line by line.
    pub text: Vec<String>,
    /// Where that begins.
    pub label: (i32, i32),
    /// The lines from steps and to steps.
    pub lines: Vec<Vec<(i32, i32)>>,
    /// Double lines: the upper ones.
    pub doubles: Vec<[i32; 4]>,
    /// Where arrows point up.
    pub arrows: Vec<(i32, i32)>,
}
