//! New elements.

use diagnostics::Span;
use picture::Point;
use st::lexer::{Kind, cut};
use st::tree::{Section, SectionKind};

use super::clipboard::target;
use super::moves::pragma;
use super::text::{self, Changes, insert_after};
use super::{Edited, Editing, Refusal, refused};
use crate::drawing;

/// New elements are at multiples of so much.
const GRID: i32 = 20;

impl Editing<'_> {
    pub(super) fn called(&self, block: &str, at: Point) -> Result<Edited, Refusal> {
        let Some(interface) = self.opened.interfaces.find(block) else {
            return refused(format!("there is no block {block}"));
        };
        let mut stem = interface.name.to_lowercase();
        stem.get_mut(..1).into_iter().for_each(str::make_ascii_uppercase);
        let name = self.free_name(&stem, &[]);
        let mut changes = Changes::default();
        self.declare(&[format!("{name} : {};", interface.name)], &mut changes);
        self.add(&format!("{name}()"), at, &mut changes);
        Ok(Edited { new: vec![name], ..self.done(changes)? })
    }

    pub(super) fn written(&self, statement: &str, at: Point) -> Result<Edited, Refusal> {
        let statement = statement.trim().trim_end_matches(';').trim_end();
        let mut changes = Changes::default();
        self.add(statement, at, &mut changes);
        let edited = Edited { new: vec![target(statement).to_owned()], ..self.done(changes)? };
        self.one_more(&edited.text)?;
        Ok(edited)
    }

    /// Refuses what is not one element.
    fn one_more(&self, text: &str) -> Result<(), Refusal> {
        super::readable(text)?;
        let source = diagnostics::Source::new("changed.fbd", text);
        let read = source.map(|source| crate::read(&source));
        let units = read.as_ref().map(|read| crate::diagrams(&read.file).collect::<Vec<_>>());
        let count = units.ok().and_then(|all| Some(all.get(self.number)?.body.len()));
        let no_element =
            |code| read.iter().flat_map(|read| &read.diagnostics).any(|one| one.code == code);
        let is_one = count == Some(self.unit.body.len() + 1);
        match is_one && !no_element(crate::Code::NoElement) {
            true => Ok(()),
            false => refused("write one call or one assignment, such as `%Q0.0 := Loop.Q`"),
        }
    }

    /// A name with a number that neither the text nor the others have: `Pid1`.
    pub(super) fn free_name(&self, stem: &str, others: &[&str]) -> String {
        let is_free = |name: &String| {
            !self.is_taken(name) && !others.iter().any(|one| one.eq_ignore_ascii_case(name))
        };
        let mut names = (1..).map(|number| format!("{stem}{number}"));
        names.find(is_free).unwrap_or_else(|| stem.to_owned())
    }

    /// Whether the text has such a word.
    pub(super) fn is_taken(&self, name: &str) -> bool {
        let tokens = cut(self.text()).tokens;
        let mut words = tokens.iter().filter(|one| one.kind == Kind::Word);
        words.any(|one| one.span.text(self.text()).eq_ignore_ascii_case(name))
    }

    fn add(&self, statement: &str, at: Point, changes: &mut Changes) {
        self.append(&format!("{} {statement};", pragma(self.place_of(at))), changes);
    }

    /// Puts a statement after the last one.
    pub(super) fn append(&self, new: &str, changes: &mut Changes) {
        let text = self.text();
        match self.unit.body.last() {
            Some(last) => {
                let start = text::begin(text, last.span.start);
                insert_after(changes, text, Span { start, end: last.span.end }, new);
            }
            None => changes.insert(self.end_of_unit(), format!("{new}\n")),
        }
    }

    /// Where the word is that ends the unit.
    fn end_of_unit(&self) -> u32 {
        let words = cut(self.text()).tokens;
        let is_end = |at: Span| at.text(self.text()).to_ascii_uppercase().starts_with("END_");
        let mut inside = words.iter().filter(|one| one.span.end <= self.unit.span.end);
        inside.rfind(|one| is_end(one.span)).map_or(self.unit.span.end, |one| one.span.start)
    }

    /// A point of the drawing as a place of this diagram.
    fn place_of(&self, at: Point) -> Point {
        let drawing = drawing::draw(self.source, self.file, self.interfaces).ok();
        let sheet = drawing.as_ref().and_then(|drawing| drawing.sheets.get(self.number));
        let first = sheet.and_then(|sheet| sheet.elements.first());
        let corner = self.opened.corners().first().copied();
        let by = first.zip(corner).map_or(Point::default(), |(first, corner)| {
            Point::new(corner.x - first.frame.x, corner.y - first.frame.y)
        });
        let Point { x, y } = at.moved(by);
        Point::new(on_grid(x), on_grid(y))
    }

    /// Declares variables after the last one of their section.
    pub(super) fn declare(&self, declarations: &[String], changes: &mut Changes) {
        let text = self.text();
        let is_plain = |one: &&Section| one.kind == SectionKind::Var && !one.is_constant;
        let sections = self.unit.sections.iter().filter(is_plain);
        match sections.filter_map(|one| one.declarations.last()).next_back() {
            Some(last) => {
                let start =
                    last.names.first().map_or(last.of_type.span.start, |one| one.span.start);
                let end = last.initial.as_ref().map_or(last.of_type.span.end, |one| one.span.end);
                for declaration in declarations {
                    insert_after(changes, text, Span { start, end }, declaration);
                }
            }
            None if declarations.is_empty() => {}
            None => {
                let lines = declarations.join("\n    ");
                let section = format!("\nVAR\n    {lines}\nEND_VAR");
                changes.insert(self.unit.name.span.end, section);
            }
        }
    }
}

fn on_grid(one: i32) -> i32 {
    one.saturating_add(GRID / 2).div_euclid(GRID) * GRID
}
