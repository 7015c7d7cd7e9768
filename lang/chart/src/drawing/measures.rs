//! Sizes in the drawing of a chart, and how texts are cut to them.

pub use picture::text::{CHARACTER, TEXT_LINE, cut, text_width};
pub(super) use picture::{CLEARANCE, CORRIDOR};

/// The sizes that lines depend on, as they are called where standards are explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Measures {
    /// LP: width of a step.
    pub step_width: i32,
    /// AP: height of a step.
    pub step_height: i32,
    /// LC: length of the bar of a transition.
    pub bar: i32,
    /// LR: length of a line from a step to the first bend.
    pub stub: i32,
    /// SP: smallest clearance.
    pub clearance: i32,
    /// SS: gap of a double line.
    pub double: i32,
}

/// The gap of double lines.
pub const DOUBLE: i32 = 4;
/// Height of the box of an action.
pub const ACTION_HEIGHT: i32 = 18;
/// From a step to the block of its actions.
pub const BLOCK_GAP: i32 = 12;
/// Height of the title of a chart.
pub const TITLE_HEIGHT: i32 = 30;

pub(super) const STEP_HEIGHT: i32 = 36;
pub(super) const BAR: i32 = 24;
/// The shortest stub: a bar with its text has room on it.
pub(super) const STUB_MIN: i32 = 32;
/// From the bar of a transition to its text.
pub(super) const LABEL_GAP: i32 = 5;

const STEP_WIDTH_MIN: i32 = 56;
/// Characters of a name.
const NAME_MAX: usize = 24;
/// Characters of a line of a condition, and its lines.
const LABEL_MAX: (usize, usize) = (24, 3);

impl Measures {
    /// For a chart whose longest name has so many characters, and whose longest condition so many
    /// lines.
    pub fn of(name: usize, lines: usize) -> Measures {
        let name = name.min(NAME_MAX) as i32 * CHARACTER + 16;
        Measures {
            step_width: name.max(STEP_WIDTH_MIN),
            step_height: STEP_HEIGHT,
            bar: BAR,
            stub: STUB_MIN.max(lines as i32 * TEXT_LINE + 2),
            clearance: CLEARANCE,
            double: DOUBLE,
        }
    }
}

/// A name that fits into a box; a longer one ends in dots.
pub(super) fn short(name: &str) -> String {
    cut(name, NAME_MAX)
}

/// A text in short lines. What is too long ends in dots.
pub(super) fn wrapped(text: &str) -> Vec<String> {
    let (most, count) = LABEL_MAX;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let length = |line: &String| line.chars().count() + 1 + word.chars().count();
        match lines.last_mut() {
            Some(line) if length(line) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    let is_cut = lines.len() > count;
    lines.truncate(count);
    if let Some(last) = lines.last_mut().filter(|_| is_cut) {
        last.push_str(" …");
    }
    lines.iter().map(|line| cut(line, most)).collect()
}
