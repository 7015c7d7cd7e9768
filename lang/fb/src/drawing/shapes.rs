//! What a drawing consists of, in its units; y grows downward.

use picture::text::{cut, text_width};
use picture::{Point, Rect};

use crate::model::{Action, State, Text};

/// A drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// How wide it is.
    pub width: i32,
    /// How high it is.
    pub height: i32,
    /// The name of the block.
    pub name: String,
    /// Where that begins, on its middle line.
    pub title: Point,
    /// In the order of the block; so are those that lead nowhere.
    pub states: Vec<StateShape>,
    /// In the order of the block, those between states that are there.
    pub transitions: Vec<TransitionShape>,
}

/// A state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateShape {
    /// Its name, as drawn: one that is too long ends in dots.
    pub name: String,
    /// What it is for.
    pub comment: String,
    /// Whether it is the initial one.
    pub is_initial: bool,
    /// Its box.
    pub frame: Rect,
    /// On the right of that, from top to bottom.
    pub actions: Vec<ActionShape>,
}

/// What is done on entry of a state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ActionShape {
    /// The algorithm, with its box.
    pub algorithm: Option<(String, Rect)>,
    /// The event that is sent, with its box.
    pub output: Option<(String, Rect)>,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TransitionShape {
    /// Which one of the block.
    pub number: usize,
    /// The numbers of the states that it leaves and enters.
    pub states: (usize, usize),
    /// In which place it is looked at, from 1, where several leave its state.
    pub order: Option<usize>,
    /// That with the condition, as drawn.
    pub text: String,
    /// Where that is written: its frame.
    pub label: Rect,
    /// Its line, a curve of Bézier: beginning, two control points, end.
    pub curve: [Point; 4],
    /// The middle of its line, where the condition belongs to.
    pub middle: Point,
    /// The head of its arrow.
    pub arrow: [Point; 3],
}

/// Height of the box of a state, and of those of its actions.
const STATE_HEIGHT: i32 = 34;
const ACTION_HEIGHT: i32 = 24;
/// Least width of the box of a state.
const STATE_WIDTH: i32 = 60;
/// From the edge of a box to its text.
const INSET: i32 = 12;
/// From a state to its actions.
const TO_ACTIONS: i32 = 16;
/// Most characters of a name, and of a condition.
const NAME_MAX: usize = 24;
pub(super) const CONDITION_MAX: usize = 32;

impl StateShape {
    /// A state in the corner.
    pub(super) fn of(state: &State) -> StateShape {
        let name = cut(&state.name.text, NAME_MAX);
        let width = (text_width(&name) + 2 * INSET).max(STATE_WIDTH);
        let frame = Rect { x: 0, y: 0, width, height: STATE_HEIGHT };
        let actions = actions(&state.actions, frame);
        StateShape { name, comment: state.comment.clone(), is_initial: false, frame, actions }
    }

    /// What it takes with its actions.
    pub fn room(&self) -> Rect {
        let boxes = self.actions.iter().flat_map(ActionShape::boxes);
        boxes.fold(self.frame, |room, (_, frame)| room.union(*frame))
    }

    pub(super) fn move_by(&mut self, by: Point) {
        self.frame = self.frame.moved(by);
        let actions = self.actions.iter_mut().flat_map(|one| [&mut one.algorithm, &mut one.output]);
        actions.flatten().for_each(|(_, frame)| *frame = frame.moved(by));
    }
}

impl ActionShape {
    /// Its texts with their boxes, from left to right.
    pub fn boxes(&self) -> impl Iterator<Item = &(String, Rect)> {
        self.algorithm.iter().chain(&self.output)
    }
}

/// Actions beside a box: algorithms below each other, and events on the right of them.
fn actions(actions: &[Action], state: Rect) -> Vec<ActionShape> {
    let text = |one: &Option<Text>| one.as_ref().map(|one| cut(&one.text, NAME_MAX));
    let texts: Vec<_> =
        actions.iter().map(|one| (text(&one.algorithm), text(&one.output))).collect();
    let widest = |all: &mut dyn Iterator<Item = &Option<String>>| {
        all.flatten().map(|one| text_width(one) + INSET).max().unwrap_or(0)
    };
    let algorithm = widest(&mut texts.iter().map(|(algorithm, _)| algorithm));
    let output = widest(&mut texts.iter().map(|(_, output)| output));
    let (left, top) = (state.right() + TO_ACTIONS, state.y + (state.height - ACTION_HEIGHT) / 2);
    let shapes = texts.into_iter().enumerate().map(|(row, texts)| {
        let y = top + row as i32 * ACTION_HEIGHT;
        let frame = |x, width| Rect { x, y, width, height: ACTION_HEIGHT };
        ActionShape {
            algorithm: texts.0.map(|text| (text, frame(left, algorithm))),
            output: texts.1.map(|text| (text, frame(left + algorithm, output))),
        }
    });
    shapes.collect()
}

impl TransitionShape {
    /// What it takes with its texts.
    pub fn room(&self) -> Rect {
        let points = self.curve.iter().chain(&self.arrow);
        points.map(|at| Rect::around(*at, 2, 2)).fold(self.label, Rect::union)
    }

    pub(super) fn move_by(&mut self, by: Point) {
        self.label = self.label.moved(by);
        self.middle = self.middle.moved(by);
        self.curve.iter_mut().chain(&mut self.arrow).for_each(|at| *at = at.moved(by));
    }
}
