//! The execution control chart (ECC) of a block as a drawing: where its states and transitions are,
//! by the places in the file or automatically. It writes no pictures.

mod curves;
mod layout;
pub mod shapes;
mod vector;

use std::fmt;

use picture::text::text_width;
use picture::{MARGIN, Point, Rect};

use crate::model::Block;
use curves::Curves;
use shapes::{Drawing, StateShape};

/// Height of the title.
const TITLE_HEIGHT: i32 = 34;
/// Most states, and most transitions, that are drawn.
pub const ELEMENTS_MAX: usize = 1000;

/// Why a chart is not drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TooLarge {
    /// How many states or transitions it has.
    pub count: usize,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a chart with {} states or transitions; drawn are up to {ELEMENTS_MAX}",
            self.count
        )
    }
}

/// Draws the chart of a block. Transitions from or to states that are not there are left out.
pub fn draw(block: &Block) -> Result<Drawing, TooLarge> {
    let count = block.states.len().max(block.transitions.len());
    if count > ELEMENTS_MAX {
        return Err(TooLarge { count });
    }
    let mut states: Vec<StateShape> = block.states.iter().map(StateShape::of).collect();
    if let Some(first) = states.first_mut() {
        first.is_initial = true;
    }
    let ways = ways(block);
    let rows = layout::place(block, &ways, &mut states);
    let transitions = Curves { block, states: &states, rows: &rows, ways: &ways }.all();
    let name = block.name.text.clone();
    let mut drawing = Drawing { name, states, transitions, ..Drawing::default() };
    frame(&mut drawing);
    Ok(drawing)
}

/// A transition by its number, with those of the states that it leaves and enters.
#[derive(Debug, Clone, Copy)]
struct Way {
    number: usize,
    from: usize,
    to: usize,
}

/// The transitions between states that are there.
fn ways(block: &Block) -> Vec<Way> {
    let all = block.transitions.iter().enumerate().map(|(number, one)| {
        let from = block.state(&one.source.text)?;
        Some(Way { number, from, to: block.state(&one.destination.text)? })
    });
    all.flatten().collect()
}

/// Moves everything so that the frame begins in the corner, with the title above.
fn frame(drawing: &mut Drawing) {
    let states = drawing.states.iter().map(StateShape::room);
    let curves = drawing.transitions.iter().map(|one| one.room());
    let taken = states.chain(curves).reduce(Rect::union).unwrap_or_default();
    let by = Point::new(MARGIN - taken.x, MARGIN + TITLE_HEIGHT - taken.y);
    drawing.states.iter_mut().for_each(|one| one.move_by(by));
    drawing.transitions.iter_mut().for_each(|one| one.move_by(by));
    drawing.title = Point::new(MARGIN, MARGIN + TITLE_HEIGHT / 2 - 8);
    drawing.width = taken.width.max(text_width(&drawing.name)) + 2 * MARGIN;
    drawing.height = taken.height + TITLE_HEIGHT + 2 * MARGIN;
}
