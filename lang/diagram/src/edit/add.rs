//! New elements.

use diagnostics::Span;
use picture::Point;
use st::lexer::{Kind, cut};
use st::tree::{Section, SectionKind};

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
        let name = self.free_name(&interface.name);
        let mut changes = Changes::default();
        self.declare(&format!("{name} : {};", interface.name), &mut changes);
        self.add(&format!("{name}()"), at, &mut changes);
        Ok(Edited { new: Some(name), ..self.done(changes)? })
    }

    pub(super) fn written(&self, statement: &str, at: Point) -> Result<Edited, Refusal> {
        let statement = statement.trim().trim_end_matches(';').trim_end();
        let target = statement.split([':', '(']).next().unwrap_or_default().trim();
        let mut changes = Changes::default();
        self.add(statement, at, &mut changes);
        let edited = Edited { new: Some(target.to_owned()), ..self.done(changes)? };
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

    /// A name for an instance of a block that the text does not have: `Pid1`.
    fn free_name(&self, block: &str) -> String {
        let mut stem = block.to_lowercase();
        stem.get_mut(..1).into_iter().for_each(str::make_ascii_uppercase);
        let tokens = cut(self.text()).tokens;
        let words = tokens.iter().filter(|one| one.kind == Kind::Word);
        let taken: Vec<String> =
            words.map(|one| one.span.text(self.text()).to_lowercase()).collect();
        let mut names = (1..).map(|number| format!("{stem}{number}"));
        let is_free = |name: &String| !taken.contains(&name.to_lowercase());
        names.find(is_free).unwrap_or(stem.clone())
    }

    /// Puts a statement after the last one.
    fn add(&self, statement: &str, at: Point, changes: &mut Changes) {
        let text = self.text();
        let new = format!("{} {statement};", pragma(self.place_of(at)));
        match self.unit.body.last() {
            Some(last) => {
                let start = text::begin(text, last.span.start);
                insert_after(changes, text, Span { start, end: last.span.end }, &new);
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

    /// Declares an instance after the last variable of its section.
    fn declare(&self, declaration: &str, changes: &mut Changes) {
        let text = self.text();
        let is_plain = |one: &&Section| one.kind == SectionKind::Var && !one.is_constant;
        let sections = self.unit.sections.iter().filter(is_plain);
        match sections.filter_map(|one| one.declarations.last()).next_back() {
            Some(last) => {
                let start =
                    last.names.first().map_or(last.of_type.span.start, |one| one.span.start);
                let end = last.initial.as_ref().map_or(last.of_type.span.end, |one| one.span.end);
                insert_after(changes, text, Span { start, end }, declaration);
            }
            None => changes
                .insert(self.unit.name.span.end, format!("\nVAR\n    {declaration}\nEND_VAR")),
        }
    }
}

fn on_grid(one: i32) -> i32 {
    one.saturating_add(GRID / 2).div_euclid(GRID) * GRID
}
