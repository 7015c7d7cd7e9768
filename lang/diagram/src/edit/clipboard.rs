//! Elements as a text that can be pasted: their declarations and statements as they are written.

use std::collections::HashMap;

use diagnostics::Span;
use picture::Point;
use st::lexer::{Kind, Token, cut};
use st::tree::{Declaration, Name, Statement, Unit};

use super::add::free_name;
use super::moves::pragma;
use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, refused, reread};
use crate::Read;
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
            .filter_map(|one| Some((&one.name, self.unit.declaration(&one.name)?)))
            .map(|(name, one)| format!("    {};\n", declaration_text(self.text(), name, one)))
            .collect();
        let section = match declared.is_empty() {
            true => String::new(),
            false => format!("VAR\n{declared}END_VAR\n"),
        };
        let statements = elements().map(|one| {
            format!("{}\n", text::statement(self.text(), one.statement.span).text(self.text()))
        });
        Ok(section + &statements.collect::<String>())
    }

    /// Elements of a text, by other names where theirs are taken, and moved by so much.
    pub(super) fn pasted(&self, clipboard: &str, by: Point) -> Result<Edited, Refusal> {
        let whole = format!("{HEAD}{clipboard}\nEND_PROGRAM\n");
        let read = reread(&whole).ok();
        let units = read.iter().flat_map(|read| crate::diagrams(&read.file));
        let unit = match units.collect::<Vec<&Unit>>()[..] {
            [unit] if !unit.body.is_empty() => unit,
            _ => return refused("this is no part of a diagram"),
        };
        self.insert_unit(&replaced(&whole, &self.renamed(unit), by))
    }

    /// What is declared in a unit by its name, with one that the text does not have.
    fn renamed(&self, unit: &Unit) -> HashMap<String, String> {
        let declared = unit.declarations();
        let mut taken = self.taken();
        let renamed = declared.flat_map(|one| &one.names).map(|Name { text: name, .. }| {
            let new = match taken.contains(&name.to_uppercase()) {
                true => free_name(name.trim_end_matches(|one: char| one.is_ascii_digit()), &taken),
                false => name.clone(),
            };
            taken.insert(new.to_uppercase());
            (name.to_uppercase(), new)
        });
        renamed.collect()
    }

    /// Puts what is in another text's unit into this one.
    fn insert_unit(&self, whole: &str) -> Result<Edited, Refusal> {
        let Read { file, .. } = reread(whole)?;
        let units = || crate::diagrams(&file);
        let declared = units().flat_map(Unit::declarations);
        let declared: Vec<String> = declared
            .flat_map(|one| one.names.iter().map(move |name| (one, name)))
            .map(|(one, name)| format!("{};", declaration_text(whole, &name.text, one)))
            .collect();
        let mut changes = Changes::default();
        self.declare(&declared, &mut changes);
        let mut new = Vec::new();
        for Statement { span, .. } in units().flat_map(|one| &one.body) {
            new.push(target(span.text(whole)).to_owned());
            self.append(text::statement(whole, *span).text(whole), &mut changes);
        }
        self.done(changes, new)
    }
}

/// What a statement is about.
pub(super) fn target(statement: &str) -> &str {
    statement.split([':', '(']).next().unwrap_or_default().trim()
}

/// The declaration of one of its names alone, without its semicolon.
fn declaration_text(text: &str, name: &str, one: &Declaration) -> String {
    let of_type = Span { start: one.of_type.span.start, end: one.span().end };
    format!("{name} : {}", of_type.text(text))
}

/// A text with other names for variables, and other places for elements.
fn replaced(text: &str, renamed: &HashMap<String, String>, by: Point) -> String {
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
                let new = renamed.get(&span.text(text).to_uppercase());
                if let Some(new) = new.filter(|_| !is_field && !is_parameter) {
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
