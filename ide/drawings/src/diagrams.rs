//! Diagrams of blocks as the page gets them: what `diagram::drawing` says. What is wrong in a text
//! is told with it; what could be read is drawn all the same.

use diagnostics::Source;
use diagram::drawing::shapes::{self, End};
use diagram::drawing::{self, Drawing};
use diagram::edit::{self, Edit, Edited};
use diagram::interfaces::{Interface, Interfaces, Origin, Variable, of_text};
use picture::Point;

use crate::geometry::{frame, point};
use crate::protocol::diagrams::{
    Block, DiagramEdit, Diagrams, Element, Group, Link, Parameter, Pin, Sheet,
};
use crate::protocol::{Answer, At, Mistake};

/// The diagrams of a text. `others`: the other texts of its project in Structured Text, whose
/// blocks it may call.
pub fn draw(text: String, name: String, others: &[String]) -> Result<Diagrams, String> {
    drawing_of(&source_of(text, name)?, &blocks_of(others))
}

/// Changes a diagram, by its number.
pub fn edit(
    text: String,
    name: String,
    others: &[String],
    (number, change): (usize, DiagramEdit),
) -> Result<Answer, String> {
    let interfaces = blocks_of(others);
    let source = source_of(text, name.clone())?;
    let edited = edit::edit(&source, number, &edit_of(change), &interfaces);
    let Edited { text, new } = edited.map_err(|refusal| refusal.to_string())?;
    let diagrams = drawing_of(&source_of(text.clone(), name)?, &interfaces)?;
    Ok(Answer::EditedDiagram {
        text,
        diagrams,
        new: new.iter().map(|name| name.to_uppercase()).collect(),
    })
}

/// Elements of a diagram as a text that can be pasted.
pub fn copy(
    text: String,
    name: String,
    others: &[String],
    (number, elements): (usize, Vec<String>),
) -> Result<String, String> {
    let copied = edit::copy(&source_of(text, name)?, number, &elements, &blocks_of(others));
    copied.map_err(|refusal| refusal.to_string())
}

/// The blocks that a diagram of the text can have.
pub fn blocks(text: String, name: String, others: &[String]) -> Result<Vec<Block>, String> {
    let own = of_text(&source_of(text, name)?.text, Origin::Project).into_iter();
    let interfaces = Interfaces::with(own.chain(of_texts(others)).collect());
    Ok(interfaces.all().map(block).collect())
}

fn source_of(text: String, name: String) -> Result<Source, String> {
    Source::new(name, text).map_err(|error| error.to_string())
}

fn blocks_of(others: &[String]) -> Interfaces {
    Interfaces::with(of_texts(others).collect())
}

fn of_texts(texts: &[String]) -> impl Iterator<Item = Interface> {
    texts.iter().flat_map(|text| of_text(text, Origin::Project))
}

fn block(one: &Interface) -> Block {
    let names = |all: &[Variable]| all.iter().map(|one| one.name.clone()).collect();
    let origin = match one.origin {
        Origin::Project => "project",
        Origin::Library => "library",
        Origin::Standard => "standard",
    };
    let (name, summary) = (one.name.clone(), one.summary.clone());
    Block { name, origin, summary, inputs: names(&one.inputs), outputs: names(&one.outputs) }
}

fn edit_of(change: DiagramEdit) -> Edit {
    let point = |(x, y): At| Point::new(x, y);
    match change {
        DiagramEdit::Move { elements, by } => Edit::Move { elements, by: point(by) },
        DiagramEdit::Call { block, at } => Edit::Call { block, at: point(at) },
        DiagramEdit::Write { statement, at } => Edit::Write { statement, at: point(at) },
        DiagramEdit::Give { element, input, value } => Edit::Give { element, input, value },
        DiagramEdit::Set { element, parameter, value } => Edit::Set { element, parameter, value },
        DiagramEdit::Group { elements, name } => Edit::Group { elements, name },
        DiagramEdit::Comment { element, comment } => Edit::Comment { element, comment },
        DiagramEdit::Paste { text, by } => Edit::Paste { text, by: point(by) },
        DiagramEdit::Remove { elements } => Edit::Remove { elements },
    }
}

fn drawing_of(source: &Source, interfaces: &Interfaces) -> Result<Diagrams, String> {
    let diagram::Read { file, of_st, diagnostics } = diagram::read(source);
    let mistake = Mistake::first(source, &of_st).or_else(|| Mistake::first(source, &diagnostics));
    match drawing::draw(source, &file, interfaces) {
        Ok(drawing) => Ok(drawn(&drawing, mistake)),
        Err(too_large) => {
            Ok(Diagrams { obstacle: Some(too_large.to_string()), mistake, ..Diagrams::default() })
        }
    }
}

fn drawn(drawing: &Drawing, mistake: Option<Mistake>) -> Diagrams {
    Diagrams {
        width: drawing.width,
        height: drawing.height,
        sheets: drawing.sheets.iter().map(sheet).collect(),
        obstacle: None,
        mistake,
    }
}

fn sheet(sheet: &shapes::Sheet) -> Sheet {
    let group = |one: &shapes::GroupShape| Group {
        name: one.name.clone(),
        frame: frame(one.frame),
        elements: one.elements.clone(),
    };
    Sheet {
        name: sheet.name.clone(),
        title: point(sheet.title),
        frame: frame(sheet.frame),
        elements: sheet.elements.iter().map(element).collect(),
        links: sheet.links.iter().map(link).collect(),
        junctions: sheet.junctions.iter().copied().map(point).collect(),
        groups: sheet.groups.iter().map(group).collect(),
    }
}

fn element(one: &shapes::ElementShape) -> Element {
    Element {
        id: one.id.clone(),
        line: one.line,
        column: one.column,
        name: one.name.clone(),
        full_name: one.full_name.clone(),
        block: one.block.clone(),
        is_unknown: one.is_unknown,
        comment: one.comment.clone(),
        order: one.order,
        frame: frame(one.frame),
        room: frame(one.room()),
        inputs: one.inputs.iter().map(pin).collect(),
        outputs: one.outputs.iter().map(pin).collect(),
        parameters: one.parameters.iter().map(parameter).collect(),
    }
}

fn pin(pin: &shapes::Pin) -> Pin {
    Pin {
        name: pin.name.clone(),
        of_type: pin.of_type.clone(),
        at: point(pin.at),
        text: pin.text.clone(),
        written: pin.written.clone(),
        names: pin.names.clone(),
    }
}

fn parameter(one: &shapes::Parameter) -> Parameter {
    Parameter {
        name: one.name.clone(),
        of_type: one.of_type.clone(),
        value: one.value.clone().or_else(|| one.initial.clone()),
        comment: one.comment.clone(),
        names: one.names.clone(),
    }
}

fn link(link: &shapes::LinkShape) -> Link {
    let end = |End { element, pin }| (element, pin);
    Link {
        from: end(link.from),
        to: end(link.to),
        is_feedback: link.is_feedback,
        points: link.points.iter().copied().map(point).collect(),
    }
}
