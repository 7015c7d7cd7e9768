//! What pragmas before an element say of its drawing: `{at 120 40}`, its place, and
//! `{group "Name"}`, the group that it is in.

use std::collections::HashSet;

use diagnostics::Span;
use picture::{PLACE_MAX, Point};
use st::tree::Unit;

use crate::diagnostic::{Code, Diagnostic};

/// What is said of an element.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Said {
    /// The upper left corner of its box, and the pragma.
    pub(crate) place: Option<(Point, Span)>,
    /// The name of its group, and the pragma.
    pub(crate) group: Option<(String, Span)>,
}

/// What a pragma is.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Pragma {
    Place(Point),
    Group(String),
    /// It begins as one of these, and says nothing.
    Wrong(&'static str),
    Other,
}

/// Reads a pragma, with its brackets.
pub(crate) fn read(pragma: &str) -> Pragma {
    let inner = pragma.trim_matches(['{', '}']).trim();
    let (word, rest) = inner.split_once(char::is_whitespace).unwrap_or((inner, ""));
    match &word.to_ascii_lowercase()[..] {
        "at" => place(rest).map_or(Pragma::Wrong("{at 120 40}"), Pragma::Place),
        "group" => {
            let quoted = rest.trim().strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
            let name = quoted.map(str::trim).filter(|name| !name.is_empty());
            let group = |name: &str| Pragma::Group(name.to_owned());
            name.map_or(Pragma::Wrong("{group \"Name\"}"), group)
        }
        _ => Pragma::Other,
    }
}

/// Two numbers that a drawing can have.
fn place(text: &str) -> Option<Point> {
    let mut numbers = text.split_whitespace().map(|one| one.parse::<i32>().ok());
    let (x, y) = (numbers.next()??, numbers.next()??);
    let is_near = |one: i32| (-PLACE_MAX..=PLACE_MAX).contains(&one);
    (numbers.next().is_none() && is_near(x) && is_near(y)).then(|| Point::new(x, y))
}

/// What is said of each statement of a unit, by the pragmas of the text: by those between it and
/// what is before it.
pub(crate) fn of_statements(text: &str, pragmas: &[Span], unit: &Unit) -> Vec<Said> {
    let mut end_before = end_of_declarations(unit);
    let said = unit.body.iter().map(|statement| {
        let from = pragmas.partition_point(|one| one.start < end_before);
        let to = pragmas.partition_point(|one| one.start < statement.span.start);
        end_before = statement.span.end;
        let mut said = Said::default();
        for span in pragmas.get(from..to).unwrap_or_default() {
            match read(span.text(text)) {
                Pragma::Place(at) => said.place = Some((at, *span)),
                Pragma::Group(name) => said.group = Some((name, *span)),
                Pragma::Wrong(_) | Pragma::Other => {}
            }
        }
        said
    });
    said.collect()
}

fn end_of_declarations(unit: &Unit) -> u32 {
    let last = unit.declarations().map(|one| one.span().end).max();
    last.unwrap_or(0).max(unit.name.span.end)
}

/// What is said about pragmas of drawings that say nothing of an element.
pub(crate) fn check<'u>(
    text: &str,
    pragmas: &[Span],
    diagrams: impl Iterator<Item = &'u Unit>,
) -> Vec<Diagnostic> {
    let said = diagrams.flat_map(|unit| of_statements(text, pragmas, unit));
    let taken: HashSet<Span> = said
        .flat_map(|said| [said.place.map(|(_, span)| span), said.group.map(|(_, span)| span)])
        .flatten()
        .collect();
    let warning = |span: &Span| {
        let (message, help) = match read(span.text(text)) {
            Pragma::Other => return None,
            Pragma::Wrong(form) => {
                ("this says nothing of a drawing", format!("write it so: `{form}`"))
            }
            _ if taken.contains(span) => return None,
            _ => ("this is before no element", "it is before a call or an assignment".to_owned()),
        };
        Some(Diagnostic::new(Code::Drawing, *span, message).help(help))
    };
    pragmas.iter().filter_map(warning).collect()
}
