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
pub struct Sheet {
    /// Its name with those of the charts around.
    pub name: String,
    /// Where that is written.
    pub title: (i32, i32),
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
    /// Its name.
    pub name: String,
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
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Transition {
    /// Its line, from 1.
    pub line: u32,
    /// How it is called.
    pub title: String,
    /// The steps before it: which of the sheet.
    pub from: Vec<u32>,
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
