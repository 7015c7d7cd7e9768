//! What a drawing consists of: data alone, in units of the drawing; y grows downward. Each element
//! says which of the chart it is, and its line.

pub use picture::{Point, Rect};

use crate::model::{StepId, TransitionId};

/// Charts of a file, side by side and below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// How wide all of it is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// The charts in the order of the text, those in actions after the one around.
    pub sheets: Vec<Sheet>,
}

/// A chart.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Its name with those of the charts around: `Plant.Stir`. Its steps have their names behind it
    /// and a dot.
    pub name: String,
    /// Where its name is written: where the text begins, on its middle line.
    pub title: Point,
    /// What it takes, with its title.
    pub frame: Rect,
    /// Whether the steps are where the text says; otherwise the layout is automatic.
    pub is_placed: bool,
    /// Where the place `{at 0 0}` is.
    pub origin: Point,
    /// Its steps in the order of the text.
    pub steps: Vec<StepShape>,
    /// Its transitions in the order of the text.
    pub transitions: Vec<TransitionShape>,
}

/// What is drawn of the kind of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Look {
    /// A box.
    #[default]
    Plain,
    /// A macro-step: a line more at its top and at its bottom.
    Macro,
    /// An enclosing step: its corners are cut off.
    Enclosing,
}

/// A step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepShape {
    /// Which one.
    pub id: StepId,
    /// Its line in the text.
    pub line: usize,
    /// Its name; one that is too long ends in dots.
    pub name: String,
    /// The variable that says whether it is active, in the program of the chart.
    pub variable: String,
    /// What it stands for: the expansion of a macro-step, charts that are enclosed; else empty.
    pub note: String,
    /// Its box.
    pub frame: Rect,
    /// Whether it has a double frame.
    pub is_initial: bool,
    /// Whether an asterisk at its left says that it becomes active with the enclosing step.
    pub is_linked: bool,
    /// What its box looks like.
    pub look: Look,
    /// The boxes of its actions, from above; a line leads from the step to the block.
    pub actions: Vec<ActionShape>,
}

/// An action in the block of a step, or a forcing order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ActionShape {
    /// Its line in the text.
    pub line: usize,
    /// Its box.
    pub frame: Rect,
    /// Where the qualifier ends and the name begins; none without a qualifier.
    pub divider: Option<i32>,
    /// Qualifier and time: `L T#2s`.
    pub qualifier: String,
    /// The action, with its condition or event.
    pub name: String,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TransitionShape {
    /// Which one.
    pub id: TransitionId,
    /// Its line in the text.
    pub line: usize,
    /// How it is called: its name, or the steps around it.
    pub title: String,
    /// The steps before it.
    pub from: Vec<StepId>,
    /// The steps after it.
    pub to: Vec<StepId>,
    /// The bar across the line.
    pub bar: (Point, Point),
    /// What is written beside the bar: the condition, in lines that are short enough.
    pub text: Vec<String>,
    /// Where that begins, on the middle line of its first line.
    pub label: Point,
    /// Lines from the steps before it to the steps after it, all horizontal and vertical. Those of
    /// transitions that share a way lie upon each other.
    pub lines: Vec<Vec<Point>>,
    /// The upper ones of double lines, from left to right; the lower ones are
    /// [`DOUBLE`](super::DOUBLE) below.
    pub doubles: Vec<(Point, Point)>,
    /// Where an arrow points up.
    pub arrows: Vec<Point>,
}
