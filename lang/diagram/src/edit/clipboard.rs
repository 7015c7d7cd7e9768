//! Elements as a text that can be pasted: their declarations and statements as they are written.

use diagnostics::{Source, Span};
use picture::Point;
use st::lexer::{Kind, Token, cut};
use st::tree::{Declaration, Unit};

use super::moves::pragma;
use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, readable, refused};
use crate::pragmas::{self, Pragma};

/// What a text to be pasted is in while it is read.
const HEAD: &str = "PROGRAM Clipboard\n";

impl Editing<'_> {
    /// The text of elements, in their order.
    pub(super) fn copied(&self, elements: &[String]) -> Result<String, Refusal> {
        let mut chosen = elements.iter().map(|id| self.at(id)).collect::<Result<Vec<_>, _>>()?;
        chosen.sort_unstable();
        let elements = || chosen.iter().filter_map(|at| self.opened.elements.get(*at));
        let instances = elements().filter(|one| one.is_call);
        let declared: String = instances
            .filter_map(|one| Some((&one.name, self.declaration(&one.name)?)))
            .map(|(name, one)| format!("    {};\n", declaration_text(self.text(), name, one)))
            .collect();
        let section = match declared.is_empty() {
            true => String::new(),
            false => format!("VAR\n{declared}END_VAR\n"),
        };
        let statements =
            elements().map(|one| format!("{}\n", self.of_statement(one).text(self.text())));
        Ok(section + &statements.collect::<String>())
    }

    /// Elements of a text, by other names where theirs are taken, and moved by so much.
    pub(super) fn pasted(&self, clipboard: &str, by: Point) -> Result<Edited, Refusal> {
        let whole = format!("{HEAD}{clipboard}\nEND_PROGRAM\n");
        let (read, source) = read(&whole)?;
        let units: Vec<&Unit> = crate::diagrams(&read.file).collect();
        let unit = match units[..] {
            [unit] if readable(&whole).is_ok() && !unit.body.is_empty() => unit,
            _ => return refused("this is no part of a diagram"),
        };
        let declared = unit.sections.iter().flat_map(|one| &one.declarations);
        let names: Vec<String> =
            declared.flat_map(|one| &one.names).map(|one| one.text.clone()).collect();
        let renamed = self.renamed(&names);
        let fresh = replaced(&source.text, &renamed, by);
        self.insert_unit(&fresh)
    }

    /// A name for each that the text does not have.
    fn renamed(&self, names: &[String]) -> Vec<(String, String)> {
        let mut given: Vec<(String, String)> = Vec::new();
        for name in names {
            let stem = name.trim_end_matches(|one: char| one.is_ascii_digit());
            let others: Vec<&str> = given.iter().map(|(_, new)| new.as_str()).collect();
            let new = match self.is_taken(name) {
                true => self.free_name(stem, &others),
                false => name.clone(),
            };
            given.push((name.clone(), new));
        }
        given
    }

    /// Puts what is in another text's unit into this one.
    fn insert_unit(&self, whole: &str) -> Result<Edited, Refusal> {
        let (read, source) = read(whole)?;
        let text = &source.text;
        let mut changes = Changes::default();
        let mut new = Vec::new();
        let units: Vec<&Unit> = crate::diagrams(&read.file).collect();
        let units = || units.iter();
        let declared = units().flat_map(|one| &one.sections).flat_map(|one| &one.declarations);
        let declared: Vec<String> = declared
            .flat_map(|one| one.names.iter().map(move |name| (one, name)))
            .map(|(one, name)| format!("{};", declaration_text(text, &name.text, one)))
            .collect();
        self.declare(&declared, &mut changes);
        for statement in units().flat_map(|one| &one.body) {
            let start = text::begin(text, statement.span.start);
            let span = Span { start, end: text::end(text, statement.span.end) };
            new.push(target(statement.span.text(text)).to_owned());
            self.append(span.text(text), &mut changes);
        }
        Ok(Edited { new, ..self.done(changes)? })
    }
}

/// What a statement is about.
pub(super) fn target(statement: &str) -> &str {
    statement.split([':', '(']).next().unwrap_or_default().trim()
}

fn read(text: &str) -> Result<(crate::Read, Source), Refusal> {
    let source = Source::new("clipboard.fbd", text).map_err(|error| Refusal(error.to_string()))?;
    Ok((crate::read(&source), source))
}

/// The declaration of one of its names alone, without its semicolon.
fn declaration_text(text: &str, name: &str, one: &Declaration) -> String {
    let end = one.initial.as_ref().map_or(one.of_type.span.end, |value| value.span.end);
    let of_type = Span { start: one.of_type.span.start, end };
    format!("{name} : {}", of_type.text(text))
}

/// A text with other names for variables, and other places for elements.
fn replaced(text: &str, renamed: &[(String, String)], by: Point) -> String {
    let mut changes = Changes::default();
    let cut = cut(text);
    let mut depth = 0u32;
    for (at, Token { kind, span }) in cut.tokens.iter().enumerate() {
        let sign =
            |at: Option<usize>| match at.and_then(|at| cut.tokens.get(at)).map(|one| one.kind) {
                Some(Kind::Sign(sign)) => sign,
                _ => "",
            };
        match kind {
            Kind::Sign("(") => depth += 1,
            Kind::Sign(")") => depth = depth.saturating_sub(1),
            Kind::Word => {
                // Fields and the names of parameters are those of blocks.
                let is_field = sign(at.checked_sub(1)) == ".";
                let is_parameter = depth > 0 && matches!(sign(Some(at + 1)), ":=" | "=>");
                let word = span.text(text);
                let new = renamed.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
                if let Some((_, new)) = new.filter(|_| !is_field && !is_parameter) {
                    changes.replace(*span, new.as_str());
                }
            }
            _ => {}
        }
    }
    for span in cut.pragmas {
        if let Pragma::Place(place) = pragmas::read(span.text(text)) {
            changes.replace(span, pragma(place.moved(by)));
        }
    }
    changes.carry_out(text)
}
