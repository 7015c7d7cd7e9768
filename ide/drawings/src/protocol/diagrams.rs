//! Diagrams of blocks: how they are answered, and changed.

use serde::{Deserialize, Serialize};

use super::{At, Mistake};

/// The diagrams of a text.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Diagrams {
    /// How wide all of it is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// The diagrams in the order of the text.
    pub sheets: Vec<Sheet>,
    /// Why they cannot be drawn; then there are no sheets.
    pub obstacle: Option<String>,
    /// What is wrong in the text; what could be read is drawn all the same.
    pub mistake: Option<Mistake>,
}

/// A diagram.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sheet {
    /// Its name.
    pub name: String,
    /// Where that is written.
    pub title: At,
    /// What it takes.
    pub frame: [i32; 4],
    /// Its elements in the order of the text.
    pub elements: Vec<Element>,
    /// From outputs to inputs.
    pub links: Vec<Link>,
    /// Where links of one output part.
    pub junctions: Vec<At>,
    /// Frames around elements.
    pub groups: Vec<Group>,
}

/// A call of a block, or an assignment.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Element {
    /// Which one.
    pub id: String,
    /// Its line, from 1.
    pub line: usize,
    /// Where in that its name begins, in characters from 1.
    pub column: usize,
    /// The instance, or what is assigned to, as drawn: one that is too long ends in dots.
    pub name: String,
    /// That in full.
    pub full_name: String,
    /// Its block; of an assignment none.
    pub block: Option<String>,
    /// Whether it is a call of a block that is not known: its pins are those of the text.
    pub is_unknown: bool,
    /// What is said about it in its line.
    pub comment: String,
    /// In which place it is executed, from 1.
    pub order: usize,
    /// Its box.
    pub frame: [i32; 4],
    /// What it takes with the texts beside it.
    pub room: [i32; 4],
    /// On the left.
    pub inputs: Vec<Pin>,
    /// On the right.
    pub outputs: Vec<Pin>,
    /// Inputs that are not drawn.
    pub parameters: Vec<Parameter>,
}

/// An input or output.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pin {
    /// Its name; of an assignment empty.
    pub name: String,
    /// Its type, if that is known.
    #[serde(rename = "type")]
    pub of_type: String,
    /// Where links end.
    pub at: At,
    /// What is given to it or where it goes, as drawn; empty where a link alone says it.
    pub text: String,
    /// That in full, as written.
    pub written: Option<String>,
    /// What its value may be called in the program.
    pub names: Vec<String>,
}

/// An input that has its value from a declaration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub of_type: String,
    /// Its value as declared, with the instance or in the block; none where it begins as zero.
    pub value: Option<String>,
    /// What is said about it.
    pub comment: String,
    /// What it may be called in the program.
    pub names: Vec<String>,
}

/// A link.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Link {
    /// The numbers of an element and of an output there.
    pub from: (usize, usize),
    /// Of an element and of an input there.
    pub to: (usize, usize),
    /// Whether the value of the scan before is taken.
    pub is_feedback: bool,
    /// Its line.
    pub points: Vec<At>,
}

/// Elements that belong together.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Group {
    /// What it is called.
    pub name: String,
    /// Around its elements.
    pub frame: [i32; 4],
    /// The numbers of these.
    pub elements: Vec<usize>,
}

/// A change of a diagram, as `diagram::edit` describes it.
#[expect(missing_docs, reason = "told with `diagram::edit::Edit`")]
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum DiagramEdit {
    Move { elements: Vec<String>, by: At },
    Call { block: String, at: At },
    Write { statement: String, at: At },
    Give { element: String, input: String, value: String },
    Set { element: String, parameter: String, value: String },
    Group { elements: Vec<String>, name: String },
    Comment { element: String, comment: String },
    Paste { text: String, by: At },
    Remove { elements: Vec<String> },
}

/// A block that a diagram can have.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Block {
    /// Its name.
    pub name: String,
    /// `project`, `library`, `standard`.
    pub origin: &'static str,
    /// What it is, in a line; may be empty.
    pub summary: String,
    /// The names of its inputs.
    pub inputs: Vec<String>,
    /// The names of its outputs.
    pub outputs: Vec<String>,
}
