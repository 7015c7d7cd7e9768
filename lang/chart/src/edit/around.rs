//! What is around the charts of a document that is being edited: the names of variables, and where
//! a chart can begin that is not there yet.

use std::collections::{BTreeMap, BTreeSet};

use diagnostics::Source;
use st::lexer::{Kind, cut};
use st::parser::parse;

use super::refusal::Refusal;
use crate::generate::declared;
use crate::model::{Chart, is_same_name};
use crate::text::{Document, Piece};

/// Names, in upper case, that are declared around the charts.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Around {
    globals: BTreeSet<String>,
    /// Those of the unit of a chart, by the number of its piece.
    own: BTreeMap<usize, BTreeSet<String>>,
}

impl Around {
    pub(super) fn of(document: &Document) -> Around {
        let Ok(source) = Source::new("around", text(document)) else {
            return Around::default();
        };
        let (file, _) = parse(&source);
        let mut around =
            Around { globals: declared(&file).into_iter().collect(), ..Around::default() };
        for (at, piece) in document.pieces.iter().enumerate() {
            let Piece::Chart(chart) = piece else { continue };
            let unit = file.units.iter().find(|unit| is_same_name(&unit.name.text, &chart.name));
            let sections = unit.into_iter().flat_map(|unit| &unit.sections);
            let names = sections.flat_map(|one| &one.declarations).flat_map(|one| &one.names);
            around.own.insert(at, names.map(|name| name.text.to_uppercase()).collect());
        }
        around
    }

    /// Whether a variable for the charts of a piece has this name.
    pub(super) fn declares(&self, piece: usize, name: &str) -> bool {
        let name = name.to_uppercase();
        self.globals.contains(&name) || self.own.get(&piece).is_some_and(|own| own.contains(&name))
    }
}

/// The text around the charts.
fn text(document: &Document) -> String {
    let texts = document.pieces.iter().map(|piece| match piece {
        Piece::Text(text) => text.as_str(),
        Piece::Chart(_) => "",
    });
    texts.collect()
}

/// Adds a chart without steps where a document has none.
pub(super) fn with_chart(document: &mut Document, name: &str) -> Result<(), Refusal> {
    if document.charts().next().is_some() {
        return Ok(());
    }
    let text = text(document);
    let (at, unit) = beginning(&text)?;
    let (before, after) = text.split_at(at);
    let chart = Chart::new(unit.unwrap_or_else(|| name.to_owned()));
    let mut pieces = vec![Piece::Text(before.to_owned()), Piece::Chart(chart)];
    pieces.push(Piece::Text(after.to_owned()));
    pieces.retain(|piece| *piece != Piece::Text(String::new()));
    document.pieces = pieces;
    Ok(())
}

/// Where a chart can begin, and the program whose body it is.
fn beginning(text: &str) -> Result<(usize, Option<String>), Refusal> {
    let tokens = cut(text).tokens;
    let is = |at: usize, word: &str| {
        tokens.get(at).is_some_and(|token| {
            token.kind == Kind::Word && token.span.text(text).eq_ignore_ascii_case(word)
        })
    };
    let Some(program) = (0..tokens.len()).find(|at| is(*at, "PROGRAM")) else {
        return Ok((text.len(), None));
    };
    let name = tokens.get(program + 1).map_or("", |token| token.span.text(text)).to_owned();
    let Some(end) = (program..tokens.len()).find(|at| is(*at, "END_PROGRAM")) else {
        return Ok((text.len(), Some(name)));
    };
    if end != program + 2 && !is(end - 1, "END_VAR") {
        return Err(Refusal::Statements(name));
    }
    Ok((tokens.get(end).map_or(text.len(), |token| token.span.start as usize), Some(name)))
}
