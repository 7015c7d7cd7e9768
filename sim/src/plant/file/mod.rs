//! Plants that a file describes: what there is, how outputs move it, what the PLC sees of it, how
//! it is drawn. A text becomes a [`Description`], which is data; a plant runs it.
//! docs/simulator.md tells how it is written.
//!
//! ```
//! use awl_sim::plant::file::PlantFile;
//! use awl_sim::plant::{Inputs, Outputs};
//!
//! let text = "part Door 0..100\nmove Door +50/s if Q0.0\ninput I0.1 if Door = 100\n";
//! let file = PlantFile::read("door.plant", text).unwrap();
//! let mut plant = file.build();
//! let mut inputs = Inputs::default();
//! plant.step(0, Outputs::from(0b1), &mut inputs);
//! plant.step(1999, Outputs::from(0b1), &mut inputs);
//! assert!(!inputs.digital(1));
//! plant.step(2000, Outputs::from(0b1), &mut inputs);
//! assert!(inputs.digital(1));
//! ```

#![expect(clippy::result_large_err, reason = "a diagnostic is large, and made where reading ends")]

mod belts;
mod conditions;
mod cursor;
mod diagnostic;
mod drawing;
pub mod model;
mod names;
mod parser;
mod run;
mod words;

use std::fmt;
use std::sync::Arc;

use diagnostics::{Source, render};

use super::faults::WithFaults;
use super::{Plant, Words};
use crate::piece::Piece;
use crate::problem::Problem;
use cursor::Cursor;
pub use diagnostic::{Code, Diagnostic};
use model::Description;
use run::Described;
pub use words::{SHAPES, STATEMENTS, Statement};

/// Whether a file of this name describes a plant: it ends in `.plant`.
pub fn is_plant_file(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("plant"))
}

/// A plant file that was read without errors.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlantFile {
    /// Its name, as it was asked for.
    pub name: String,
    /// What it describes.
    pub description: Arc<Description>,
}

impl PlantFile {
    /// Reads a text. All errors are found in one go.
    pub fn read(name: &str, text: &str) -> Result<PlantFile, PlantErrors> {
        let (description, diagnostics) = parser::read(text);
        if diagnostics.is_empty() {
            return Ok(PlantFile { name: name.to_string(), description: Arc::new(description) });
        }
        Err(PlantErrors { name: name.to_string(), text: text.to_string(), diagnostics })
    }

    /// The plant at time 0.
    pub fn build(&self) -> Box<dyn Plant> {
        let described = Box::new(Described::new(Arc::clone(&self.description)));
        Box::new(WithFaults::new(described, self.description.faults.clone()))
    }
}

/// What is wrong with a text, in its order.
pub fn problems(text: &str) -> Vec<Diagnostic> {
    parser::read(text).1
}

/// The names that a text makes, as far as it can be understood; those of a belt's counts, too.
pub fn names(text: &str) -> Vec<String> {
    parser::read(text).0.names().into_iter().map(|(name, _)| name).collect()
}

/// Words for people, and nothing else: `"Door" de "Tor" es "Puerta"`. `form`: how the statement is
/// written.
pub(crate) fn words_of(text: Piece<'_>, form: &'static str) -> Result<Words, Problem> {
    let mut cursor = Cursor { rest: text, form };
    let words = cursor.words().and_then(|words| cursor.end().map(|()| words));
    words.map_err(|Diagnostic { span, message, help, .. }| {
        let problem = Problem::new(span.start as usize..span.end as usize, message);
        help.into_iter().fold(problem, Problem::help)
    })
}

/// All that is wrong with a plant file.
#[derive(Debug, Clone)]
pub struct PlantErrors {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// What is wrong, in the order of the text; never empty.
    pub diagnostics: Vec<Diagnostic>,
}

impl PlantErrors {
    /// The first one with its place, in a line.
    pub fn first(&self) -> String {
        let Ok(source) = Source::new(&self.name, &self.text) else { return self.to_string() };
        let first = self
            .diagnostics
            .first()
            .map(|one| format!("{}: {}", source.place(one.span.start as usize), one.message));
        first.unwrap_or_default()
    }

    /// The errors as people read them; with terminal colours if asked for. Ends with a line feed.
    pub fn render(&self, coloured: bool) -> String {
        match Source::new(&self.name, &self.text) {
            Ok(source) => {
                let all = self.diagnostics.iter();
                all.map(|one| render::human(&source, one, coloured)).collect()
            }
            Err(error) => format!("error: {error}\n"),
        }
    }
}

/// In lines, for where [`PlantErrors::render`]'s picture has no room.
impl fmt::Display for PlantErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Source::new(&self.name, &self.text) {
            Ok(source) => f.write_str(&render::plain(&source, &self.diagnostics)),
            Err(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PlantErrors {}

#[cfg(test)]
mod tests;
