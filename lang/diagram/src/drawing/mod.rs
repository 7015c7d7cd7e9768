//! Diagrams as drawings: boxes with their pins, and links between them, as plain data. Drawn for
//! reading; nothing is known here of colours, fonts and files.
//!
//! `boxes` says what an element looks like, `ends` from where to where links lead, `layout` where
//! elements are, `wiring` how links go around them, `junctions` where they part.

mod boxes;
mod ends;
mod junctions;
mod layout;
pub mod shapes;
mod wiring;

use std::collections::HashMap;
use std::fmt;

use diagnostics::{Source, Span};
use picture::text::text_width;
use picture::{Point, Rect};
use st::lexer::cut;
use st::tree::{File, Unit};

use crate::addresses::Addresses;
use crate::elements::{Element, Reading};
use crate::feedback::Feedback;
use crate::interfaces::Interfaces;
use crate::order;
use crate::pragmas::{self, Said};
pub use shapes::{Drawing, Sheet};
use shapes::{ElementShape, GroupShape, LinkShape};

/// Most elements of a diagram that is drawn.
pub const ELEMENTS_MAX: usize = 2_500;
/// Height of the title of a diagram, and of a group.
const TITLE_HEIGHT: i32 = 30;
/// From the elements of a group to its frame.
const GROUP_GAP: i32 = 16;

/// A diagram with more elements than can be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TooLarge {
    /// The diagram.
    pub diagram: String,
    /// How many elements it has.
    pub count: usize,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { diagram, count } = self;
        write!(f, "{diagram}: {count} elements; up to {ELEMENTS_MAX} are drawn")
    }
}

/// What it takes to draw a unit.
struct Unwired<'u> {
    text: &'u str,
    unit: &'u Unit,
    elements: Vec<Element>,
    said: Vec<Said>,
    interfaces: &'u Interfaces,
}

/// A diagram to be changed: its elements, what is said of each, and what each looks like.
pub(crate) struct Opened<'u> {
    pub(crate) elements: Vec<Element>,
    pub(crate) said: Vec<Said>,
    pub(crate) shapes: Vec<ElementShape>,
    pub(crate) interfaces: &'u Interfaces,
    /// Of each element its arguments: what they are given to, and whether that is an output.
    pub(crate) given: Vec<Vec<(String, bool)>>,
    /// The upper left corner of each element, as a text says it.
    pub(crate) corners: Vec<Point>,
}

impl<'u> Opened<'u> {
    /// `interfaces`: with the blocks of the text.
    pub(crate) fn of(
        source: &'u Source,
        file: &File,
        unit: &'u Unit,
        interfaces: &'u Interfaces,
    ) -> Opened<'u> {
        let pragmas = cut(&source.text).pragmas;
        let mut feedback = Feedback::of(&source.text, &pragmas);
        // Those of the diagrams before are theirs.
        let before = crate::diagrams(file).take_while(|one| one.span != unit.span);
        for other in before {
            Unwired::of(&source.text, other, &pragmas, &mut feedback, interfaces);
        }
        let unwired = Unwired::of(&source.text, unit, &pragmas, &mut feedback, interfaces);
        let mut shapes = unwired.shapes();
        let links = unwired.links(&mut shapes);
        let corners = layout::corners(&shapes, &links, &unwired.said);
        let given = unwired.elements.iter().map(|one| unwired.names_given(one)).collect();
        let Unwired { elements, said, .. } = unwired;
        Opened { elements, said, shapes, interfaces, given, corners }
    }
}

/// Draws the diagrams of a text, as Structured Text has read it. `interfaces`: the blocks that its
/// project has beside it.
pub fn draw(source: &Source, file: &File, interfaces: &Interfaces) -> Result<Drawing, TooLarge> {
    let pragmas = cut(&source.text).pragmas;
    let mut feedback = Feedback::of(&source.text, &pragmas);
    let interfaces = interfaces.and_of(&source.text, file);
    let sheets = crate::diagrams(file).map(|unit| {
        let count = unit.body.len();
        if count > ELEMENTS_MAX {
            return Err(TooLarge { diagram: unit.name.text.clone(), count });
        }
        let unwired = Unwired::of(&source.text, unit, &pragmas, &mut feedback, &interfaces);
        Ok(unwired.sheet(source))
    });
    Ok(packed(sheets.collect::<Result<_, _>>()?))
}

impl<'u> Unwired<'u> {
    fn of(
        text: &'u str,
        unit: &'u Unit,
        pragmas: &[Span],
        feedback: &mut Feedback<'u>,
        interfaces: &'u Interfaces,
    ) -> Unwired<'u> {
        let mut reading = Reading { text, addresses: Addresses::of(unit), feedback };
        let said = pragmas::of_statements(text, pragmas, unit).into_iter();
        let all = said.zip(&unit.body).filter_map(|(said, statement)| {
            Some((said, Element::of(statement.clone(), &mut reading).ok()?))
        });
        let (said, elements) = all.unzip();
        Unwired { text, unit, elements, said, interfaces }
    }

    /// What its elements look like, by names that are told apart; not yet where they are.
    fn shapes(&self) -> Vec<ElementShape> {
        let mut elements: Vec<ElementShape> =
            self.elements.iter().map(|one| self.shape(one)).collect();
        number(&mut elements);
        elements
    }

    /// The diagram, from its upper left corner on.
    fn sheet(&self, source: &Source) -> Sheet {
        let mut elements = self.shapes();
        for (place, at) in order::of(&self.elements, &mut Vec::new()).into_iter().enumerate() {
            elements.get_mut(at).into_iter().for_each(|one| one.order = place + 1);
        }
        for (shape, element) in elements.iter_mut().zip(&self.elements) {
            (shape.line, shape.column) = source.position(element.statement.span.start as usize);
        }
        let links = self.links(&mut elements);
        let is_placed = self.said.iter().any(|one| one.place.is_some());
        let corners = layout::corners(&elements, &links, &self.said);
        for (shape, corner) in elements.iter_mut().zip(corners) {
            shape.move_by(Point::new(corner.x - shape.frame.x, corner.y - shape.frame.y));
        }
        let links = wiring::wire(&elements, links);
        let groups = self.groups(&elements);
        let name = self.unit.name.text.clone();
        let junctions = junctions::junctions(&links);
        framed(Sheet { name, is_placed, elements, links, junctions, groups, ..Sheet::default() })
    }

    fn groups(&self, elements: &[ElementShape]) -> Vec<GroupShape> {
        let mut groups: Vec<GroupShape> = Vec::new();
        for (at, (said, element)) in self.said.iter().zip(elements).enumerate() {
            let Some((name, _)) = &said.group else { continue };
            let room = element.room().grown(GROUP_GAP);
            match groups.iter_mut().find(|group| group.name == *name) {
                Some(group) => {
                    group.frame = group.frame.union(room);
                    group.elements.push(at);
                }
                None => {
                    groups.push(GroupShape { name: name.clone(), frame: room, elements: vec![at] });
                }
            }
        }
        for GroupShape { name, frame, .. } in &mut groups {
            frame.y -= TITLE_HEIGHT - GROUP_GAP;
            frame.height += TITLE_HEIGHT - GROUP_GAP;
            frame.width = frame.width.max(text_width(name) + 2 * GROUP_GAP);
        }
        groups
    }
}

/// Tells elements of the same name apart.
fn number(elements: &mut [ElementShape]) {
    let mut seen: HashMap<String, usize> = HashMap::new();
    for element in elements {
        let count = seen.entry(element.id.clone()).or_default();
        *count += 1;
        if *count > 1 {
            element.id = format!("{}#{count}", element.id);
        }
    }
}

/// A sheet whose frame begins in the corner, with its title above everything.
fn framed(mut sheet: Sheet) -> Sheet {
    let rooms = sheet.elements.iter().map(ElementShape::room);
    let lines = sheet.links.iter().flat_map(|link: &LinkShape| &link.points);
    let lines = lines.map(|at| Rect::around(*at, 4, 4));
    let all = rooms.chain(lines).chain(sheet.groups.iter().map(|group| group.frame));
    let taken = all.reduce(Rect::union).unwrap_or_default();
    sheet.move_by(Point::new(-taken.x, TITLE_HEIGHT - taken.y));
    sheet.title = Point::new(0, TITLE_HEIGHT / 2 - 4);
    let width = taken.width.max(text_width(&sheet.name));
    sheet.frame = Rect { x: 0, y: 0, width, height: taken.height + TITLE_HEIGHT };
    sheet
}

/// The sheets in rows.
fn packed(mut sheets: Vec<Sheet>) -> Drawing {
    let (corners, size) = picture::packed(sheets.iter().map(|sheet| sheet.frame));
    sheets.iter_mut().zip(corners).for_each(|(sheet, corner)| sheet.move_by(corner));
    Drawing { width: size.x, height: size.y, sheets }
}
