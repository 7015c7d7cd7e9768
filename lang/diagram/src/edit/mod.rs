//! Changes of a diagram, as changes of its text: that is all there is of it, and what is not
//! touched stays as it is written. A change that would leave a text that cannot be read is refused.

mod add;
mod clipboard;
mod comment;
mod groups;
mod inputs;
mod moves;
mod remove;
mod text;

use std::fmt;

use diagnostics::{Severity, Source, Span};
use picture::Point;
use st::lexer::{Kind, cut};
use st::tree::Unit;

use crate::Read;
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
    /// Elements are put into a group.
    Group {
        /// Which ones.
        elements: Vec<String>,
        /// What it is called; empty: they are in none.
        name: String,
    },
    /// What is said about an element in its line.
    Comment {
        /// About which one.
        element: String,
        /// The words; empty: nothing.
        comment: String,
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
    read: &'e Read,
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
    let read = right(source)?;
    if crate::diagrams(&read.file).nth(number).is_none() {
        return begun(source, number, change, interfaces);
    }
    opened(source, &read, (number, interfaces), |editing| match change {
        Edit::Move { elements, by } => editing.moved(elements, *by),
        Edit::Call { block, at } => editing.called(block, *at),
        Edit::Write { statement, at } => editing.written(statement, *at),
        Edit::Give { element, input, value } => editing.given(element, input, value),
        Edit::Set { element, parameter, value } => editing.set(element, parameter, value),
        Edit::Group { elements, name } => editing.grouped(elements, name),
        Edit::Comment { element, comment } => editing.commented(element, comment),
        Edit::Paste { text, by } => editing.pasted(text, *by),
        Edit::Remove { elements } => editing.removed(elements),
    })
}

/// Elements of a diagram as a text that can be pasted.
pub fn copy(
    source: &Source,
    number: usize,
    elements: &[String],
    interfaces: &Interfaces,
) -> Result<String, Refusal> {
    let read = right(source)?;
    opened(source, &read, (number, interfaces), |editing| editing.copied(elements))
}

/// A text that can be read.
fn right(source: &Source) -> Result<Read, Refusal> {
    let read = crate::read(source);
    let Some(first) = mistake(&read) else { return Ok(read) };
    let (line, _) = source.position(first.span.start as usize);
    refused(format!("line {line} has to be right first: {}", first.message))
}

/// Does something with a diagram, by its number in the text.
fn opened<T>(
    source: &Source,
    read: &Read,
    (number, interfaces): (usize, &Interfaces),
    act: impl FnOnce(&Editing) -> Result<T, Refusal>,
) -> Result<T, Refusal> {
    let all = interfaces.and_of(&source.text, &read.file);
    let Some(unit) = crate::diagrams(&read.file).nth(number) else {
        return refused("there is no such diagram");
    };
    let opened = Opened::of(source, &read.file, unit, &all);
    act(&Editing { source, read, number, unit, opened: &opened, interfaces })
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

/// What keeps a text from being read, such as a wrong value.
fn mistake(read: &Read) -> Option<&st::Diagnostic> {
    read.of_st.iter().find(|one| one.severity() == Severity::Error)
}

/// Reads a text that a change has made; one that cannot be read is refused.
fn reread(text: &str) -> Result<Read, Refusal> {
    let source = Source::new("changed.fbd", text).map_err(|error| Refusal(error.to_string()))?;
    let read = crate::read(&source);
    match mistake(&read) {
        Some(first) => refused(first.message.clone()),
        None => Ok(read),
    }
}

/// How many loops a text has that nothing opens.
fn loops(read: &Read) -> usize {
    read.diagnostics.iter().filter(|one| one.code == Code::Loop).count()
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

    /// Where the words of the text are.
    fn words(&self) -> Vec<Span> {
        let words = cut(self.text()).tokens.into_iter().filter(|one| one.kind == Kind::Word);
        words.map(|one| one.span).collect()
    }

    /// The text with changes, and how it is read.
    fn carried_out(&self, changes: Changes) -> Result<(String, Read), Refusal> {
        let text = changes.carry_out(self.text());
        let read = reread(&text)?;
        Ok((text, read))
    }

    fn done(&self, changes: Changes, new: Vec<String>) -> Result<Edited, Refusal> {
        Ok(Edited { text: self.carried_out(changes)?.0, new })
    }
}
