//! New elements.

use std::collections::HashSet;

use diagnostics::Span;
use picture::Point;
use st::lexer::cut;
use st::tree::{Section, SectionKind};

use super::clipboard::target;
use super::moves::pragma;
use super::text::{self, Changes, insert_after};
use super::{Edited, Editing, Refusal, refused};
use crate::diagnostic::Code;
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
        let name = free_name(&stem, &self.taken());
        let mut changes = Changes::default();
        self.declare(&[format!("{name} : {};", interface.name)], &mut changes);
        self.add(&format!("{name}()"), at, &mut changes);
        self.done(changes, vec![name])
    }

    pub(super) fn written(&self, statement: &str, at: Point) -> Result<Edited, Refusal> {
        let statement = statement.trim().trim_end_matches(';').trim_end();
        let mut changes = Changes::default();
        self.add(statement, at, &mut changes);
        let (text, read) = self.carried_out(changes)?;
        let unit = crate::diagrams(&read.file).nth(self.number);
        let is_one = unit.is_some_and(|unit| unit.body.len() == self.unit.body.len() + 1);
        if !is_one || read.diagnostics.iter().any(|one| one.code == Code::NoElement) {
            return refused("write one call or one assignment, such as `%Q0.0 := Loop.Q`");
        }
        Ok(Edited { text, new: vec![target(statement).to_owned()] })
    }

    /// The words of the text, in upper case: nothing new is called so.
    pub(super) fn taken(&self) -> HashSet<String> {
        self.words().iter().map(|at| at.text(self.text()).to_uppercase()).collect()
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
        let drawing = drawing::draw(self.source, &self.read.file, self.interfaces).ok();
        let sheet = drawing.as_ref().and_then(|drawing| drawing.sheets.get(self.number));
        let first = sheet.and_then(|sheet| sheet.elements.first());
        let corner = self.opened.corners.first();
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
                for declaration in declarations {
                    insert_after(changes, text, last.span(), declaration);
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

/// A name with a number that is not taken: `Pid1`.
pub(super) fn free_name(stem: &str, taken: &HashSet<String>) -> String {
    let mut names = (1..).map(|number| format!("{stem}{number}"));
    let is_free = |name: &String| !taken.contains(&name.to_uppercase());
    names.find(is_free).unwrap_or_else(|| stem.to_owned())
}

fn on_grid(one: i32) -> i32 {
    one.saturating_add(GRID / 2).div_euclid(GRID) * GRID
}
