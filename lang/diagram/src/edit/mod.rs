//! Changes of a diagram, as changes of its text: that is all there is of it, and what is not
//! touched stays as it is written. A change that would leave a text that cannot be read is refused.

mod add;
mod clipboard;
mod inputs;
mod moves;
mod remove;
mod text;

use std::fmt;

use diagnostics::{Severity, Source};
use picture::Point;
use st::tree::{File, Unit};

use crate::diagnostic::Code;
use crate::drawing::Opened;
use crate::interfaces::Interfaces;
use text::Changes;

/// A change. Elements are named by what drawings call them.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Elements are moved by so much. The first one of a diagram writes the places of all of its
    /// elements down.
    Move {
        /// Which ones.
        elements: Vec<String>,
        /// How far.
        by: Point,
    },
    /// A new instance of a block is declared and called.
    Call {
        /// The block.
        block: String,
        /// Its upper left corner in the drawing, about: it is put on a grid.
        at: Point,
    },
    /// A call or an assignment, as written.
    Write {
        /// Without its semicolon: `%Q0.0 := Loop.Q`.
        statement: String,
        /// Its upper left corner in the drawing.
        at: Point,
    },
    /// An input gets a value; where that closes a loop, it is that of the scan before.
    Give {
        /// Whose input.
        element: String,
        /// Its name; of an assignment empty.
        input: String,
        /// As written; empty: the call gives it nothing.
        value: String,
    },
    /// A parameter gets a value in the declaration of the instance.
    Set {
        /// Whose parameter.
        element: String,
        /// Its name.
        parameter: String,
        /// As written; empty: that of the block.
        value: String,
    },
    /// Elements of a text that [`copy`] has made, by other names where theirs are taken.
    Paste {
        /// Declarations and statements.
        text: String,
        /// How far from the places in the text.
        by: Point,
    },
    /// Elements are taken out, with their links and with declarations that nothing needs any more.
    Remove {
        /// Which ones.
        elements: Vec<String>,
    },
}

/// What came of a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edited {
    /// The text.
    pub text: String,
    /// The elements that are new.
    pub new: Vec<String>,
}

/// Why a change is not possible.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal(pub(crate) String);

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

fn refused<T>(why: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal(why.into()))
}

/// What a change needs of a diagram.
struct Editing<'e> {
    source: &'e Source,
    file: &'e File,
    /// The number of the diagram among those of the text.
    number: usize,
    unit: &'e Unit,
    opened: &'e Opened<'e>,
    interfaces: &'e Interfaces,
}

/// Changes a diagram, by its number in the text. The first element of a text without any makes
/// `PROGRAM Main`.
pub fn edit(
    source: &Source,
    number: usize,
    change: &Edit,
    interfaces: &Interfaces,
) -> Result<Edited, Refusal> {
    let file = right(source)?;
    if crate::diagrams(&file).nth(number).is_none() {
        return begun(source, number, change, interfaces);
    }
    let edited = opened(source, &file, (number, interfaces), |editing| match change {
        Edit::Move { elements, by } => editing.moved(elements, *by),
        Edit::Call { block, at } => editing.called(block, *at),
        Edit::Write { statement, at } => editing.written(statement, *at),
        Edit::Give { element, input, value } => editing.given(element, input, value),
        Edit::Set { element, parameter, value } => editing.set(element, parameter, value),
        Edit::Paste { text, by } => editing.pasted(text, *by),
        Edit::Remove { elements } => editing.removed(elements),
    })?;
    readable(&edited.text)?;
    Ok(edited)
}

/// Elements of a diagram as a text that can be pasted.
pub fn copy(
    source: &Source,
    number: usize,
    elements: &[String],
    interfaces: &Interfaces,
) -> Result<String, Refusal> {
    let file = right(source)?;
    opened(source, &file, (number, interfaces), |editing| editing.copied(elements))
}

/// A text that can be read.
fn right(source: &Source) -> Result<File, Refusal> {
    let crate::Read { file, of_st, .. } = crate::read(source);
    let Some(first) = of_st.iter().find(|one| one.severity() == Severity::Error) else {
        return Ok(file);
    };
    let (line, _) = source.position(first.span.start as usize);
    refused(format!("line {line} has to be right first: {}", first.message))
}

/// Does something with a diagram, by its number in the text.
fn opened<T>(
    source: &Source,
    file: &File,
    (number, interfaces): (usize, &Interfaces),
    act: impl FnOnce(&Editing) -> Result<T, Refusal>,
) -> Result<T, Refusal> {
    let all = interfaces.and_of(&source.text, file);
    let Some(unit) = crate::diagrams(file).nth(number) else {
        return refused("there is no such diagram");
    };
    let opened = Opened::of(source, file, unit, &all);
    act(&Editing { source, file, number, unit, opened: &opened, interfaces })
}

/// Adds the first element of a text that has no diagram.
fn begun(
    source: &Source,
    number: usize,
    change: &Edit,
    interfaces: &Interfaces,
) -> Result<Edited, Refusal> {
    if number > 0 || !matches!(change, Edit::Call { .. } | Edit::Write { .. } | Edit::Paste { .. })
    {
        return refused("there is no such diagram");
    }
    let line_end = if source.text.is_empty() || source.text.ends_with('\n') { "" } else { "\n" };
    let text = format!("{}{line_end}PROGRAM Main\nEND_PROGRAM\n", source.text);
    let begun = Source::new(source.name.clone(), text);
    edit(&begun.map_err(|error| Refusal(error.to_string()))?, 0, change, interfaces)
}

/// Refuses a text that cannot be read, such as one with a wrong value.
fn readable(text: &str) -> Result<(), Refusal> {
    let source = Source::new("changed.fbd", text).map_err(|error| Refusal(error.to_string()))?;
    let read = crate::read(&source);
    let first = read.of_st.iter().find(|one| one.severity() == Severity::Error);
    first.map_or(Ok(()), |one| refused(one.message.clone()))
}

/// How many loops a text has that nothing opens.
fn loops(text: &str) -> usize {
    let read = Source::new("changed.fbd", text).map(|source| crate::read(&source));
    read.map_or(0, |read| read.diagnostics.iter().filter(|one| one.code == Code::Loop).count())
}

impl Editing<'_> {
    fn text(&self) -> &str {
        &self.source.text
    }

    /// The number of an element.
    fn at(&self, id: &str) -> Result<usize, Refusal> {
        let found = self.opened.shapes.iter().position(|one| one.id.eq_ignore_ascii_case(id));
        found.map_or_else(|| refused(format!("{id} is not in the diagram any more")), Ok)
    }

    fn done(&self, changes: Changes) -> Result<Edited, Refusal> {
        Ok(Edited { text: changes.carry_out(self.text()), new: Vec::new() })
    }
}
