//! Places of elements.

use picture::Point;

use super::text::Changes;
use super::{Edited, Editing, Refusal};

impl Editing<'_> {
    pub(super) fn moved(&self, elements: &[String], by: Point) -> Result<Edited, Refusal> {
        let moved = elements.iter().map(|id| self.at(id)).collect::<Result<Vec<_>, _>>()?;
        let mut changes = Changes::default();
        for (at, corner) in self.opened.corners.iter().enumerate() {
            let corner = if moved.contains(&at) { corner.moved(by) } else { *corner };
            self.place(at, corner, &mut changes);
        }
        self.done(changes, Vec::new())
    }

    fn place(&self, at: usize, corner: Point, changes: &mut Changes) {
        let Some((element, said)) = self.opened.elements.get(at).zip(self.opened.said.get(at))
        else {
            return;
        };
        let pragma = pragma(corner);
        match &said.place {
            Some((place, _)) if *place == corner => {}
            Some((_, span)) => changes.replace(*span, pragma),
            None => changes.insert(element.statement.span.start, format!("{pragma} ")),
        }
    }
}

/// A place as it is written.
pub(super) fn pragma(Point { x, y }: Point) -> String {
    format!("{{at {x} {y}}}")
}
