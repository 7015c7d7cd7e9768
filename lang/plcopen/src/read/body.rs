//! What a unit does: statements as they are, a drawing of steps as a chart, diagrams and
//! instruction lists as statements.

use chart::Chart;
use chart::model::Code as Statements;
use chart::text::write_chart;
use diagnostics::Span;
use diagnostics::traced::Traced;
use diagnostics::xml::{Node, Places, elements, tag};
use st::names::is_same;

use super::chart::chart;
use super::diagram;
use super::formatted::{formatted, language};
use super::il;
use super::reader::{Reader, child, optional};
use crate::diagnostic::Code;

/// A unit around a drawing, with the actions and conditions that it names.
pub(super) struct Surroundings<'s, 'a, 'i> {
    /// The name of the unit.
    pub(super) unit: &'s str,
    /// The unit.
    pub(super) node: Node<'a, 'i>,
}

impl<'a, 'i> Surroundings<'_, 'a, 'i> {
    /// The actions of the unit.
    pub(super) fn actions(&self) -> impl Iterator<Item = Node<'a, 'i>> + use<'a, 'i> {
        let list = child(self.node, "actions").into_iter().flat_map(elements);
        list.filter(|one| one.tag_name().name() == "action")
    }

    /// A condition of the unit that has a name.
    pub(super) fn condition(&self, name: &str) -> Option<Node<'a, 'i>> {
        let mut list = child(self.node, "transitions").into_iter().flat_map(elements);
        list.find(|one| optional(*one, "name").is_some_and(|other| is_same(&other.text, name)))
    }
}

/// Reports a body in a language that is not read. `of`: whose it is.
pub(super) fn refuse(reader: &mut Reader, language: Node, of: &str) {
    let name = language.tag_name().name();
    let message = format!("{of} is written in {name}, which is not read");
    let help = match name {
        "IL" => "one that computes one value is: LD, AND, GT; write others as Structured Text (ST)",
        _ => "write it as Structured Text (ST) or as a chart (SFC) in the tool it comes from",
    };
    reader.error(Code::OtherLanguage, tag(language), message, help);
}

/// The statements of a diagram or instruction list; `None`: it is another language.
pub(super) fn translated(reader: &mut Reader, body: Node) -> Option<Vec<Statements>> {
    diagram::statements(reader, body).or_else(|| il::statements(reader, body))
}

/// The body of a unit; returns its chart, if it is one.
pub(super) fn body(reader: &mut Reader, around: &Surroundings, out: &mut Traced) -> Option<Chart> {
    let mut bodies = elements(around.node).filter(|one| one.tag_name().name() == "body");
    let body = bodies.next()?;
    for more in bodies {
        let message = format!("{}: a second body", around.unit);
        reader.error(Code::OtherLanguage, tag(more), message, "one unit has one body");
    }
    let found = language(body)?;
    match found.tag_name().name() {
        "ST" => {
            no_actions(reader, around);
            let text = formatted(found);
            traced(out, &format!("{}\n", text.text), text.span, reader.file);
            None
        }
        "SFC" => {
            let chart = chart(reader, around, found)?;
            written(reader, &chart, out);
            Some(chart)
        }
        _ => {
            let Some(codes) = translated(reader, found) else {
                refuse(reader, found, around.unit);
                return None;
            };
            no_actions(reader, around);
            for code in codes {
                out.push(&format!("{}\n", code.text), code.origin.0);
            }
            None
        }
    }
}

/// Reports actions of a unit that is no chart.
fn no_actions(reader: &mut Reader, around: &Surroundings) {
    for action in around.actions() {
        let message = format!("{}: an action of a unit that is no chart", around.unit);
        let help = "actions belong to charts; a FUNCTION_BLOCK does what this one does";
        reader.error(Code::OtherLanguage, tag(action), message, help);
    }
}

/// A text that is written as it was read.
fn traced(out: &mut Traced, text: &str, span: Span, file: &str) {
    let start = out.text().len();
    out.push(text, span);
    out.trace(Span::new(start, out.text().len()), &Places::of(text.trim_end(), span, file));
}

/// A chart as text.
fn written(reader: &Reader, chart: &Chart, out: &mut Traced) {
    let written = write_chart(chart);
    let start = out.text().len();
    out.push(
        &written.text,
        chart.steps.values().next().map_or(Span::default(), |one| one.origin.0),
    );
    for part in written.parts {
        let text = part.written.text(&written.text);
        let (from, to) = (part.written.start as usize, part.written.end as usize);
        let places = match part.is_code {
            true => Places::of(text, part.origin, reader.file),
            false => Places::whole(part.origin),
        };
        out.trace(Span::new(start + from, start + to), &places);
    }
}
