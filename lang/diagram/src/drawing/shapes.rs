//! What a drawing consists of: data alone, in units of the drawing; y grows downward. Each element
//! says which of the diagram it is, and its line.

pub use picture::{Point, Rect};

/// Above the right corner of a box: its place in the order.
const ORDER_WIDTH: i32 = 24;
const ORDER_HEIGHT: i32 = 13;

/// Diagrams of a file, side by side and below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// How wide all of it is.
    pub width: i32,
    /// How high.
    pub height: i32,
    /// The diagrams in the order of the text.
    pub sheets: Vec<Sheet>,
}

/// A diagram: a PROGRAM or FUNCTION_BLOCK.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Its name.
    pub name: String,
    /// Where its name is written: where the text begins, on its middle line.
    pub title: Point,
    /// What it takes, with its title.
    pub frame: Rect,
    /// Whether elements are where the text says; otherwise the layout is automatic.
    pub is_placed: bool,
    /// Where the place `{at 0 0}` is.
    pub origin: Point,
    /// Its elements in the order of the text.
    pub elements: Vec<ElementShape>,
    /// From outputs to inputs.
    pub links: Vec<LinkShape>,
    /// Where links of one output part.
    pub junctions: Vec<Point>,
    /// Frames around elements.
    pub groups: Vec<GroupShape>,
}

/// A call or an assignment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ElementShape {
    /// Which one: its name in upper case and, where others have it, `#2` and so on.
    pub id: String,
    /// Its line in the text.
    pub line: usize,
    /// Where in that its name begins, in characters from 1.
    pub column: usize,
    /// The instance, or what is assigned to; one that is too long ends in dots.
    pub name: String,
    /// That in full.
    pub full_name: String,
    /// The name of its block; of an assignment none.
    pub block: Option<String>,
    /// Whether it is a call of a block that is not known: its pins are those of the text.
    pub is_unknown: bool,
    /// What is said about it in its line.
    pub comment: String,
    /// In which place it is executed, from 1.
    pub order: usize,
    /// Its box.
    pub frame: Rect,
    /// From above, on the left.
    pub inputs: Vec<Pin>,
    /// From above, on the right.
    pub outputs: Vec<Pin>,
    /// Inputs that are not drawn.
    pub parameters: Vec<Parameter>,
}

/// An input or an output.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pin {
    /// Its name; of an assignment empty.
    pub name: String,
    /// Its type, if that is known.
    pub of_type: String,
    /// Where links end.
    pub at: Point,
    /// What is given to it or where it goes; empty where a link alone says that. A text that is too
    /// long ends in dots. That of an assignment is in the box.
    pub text: String,
    /// That in full, as written.
    pub written: Option<String>,
    /// What its value may be called in the program: the first one that there is. Of an input that
    /// a variable gives its value that variable.
    pub names: Vec<String>,
}

/// An input that has its value from a declaration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    pub of_type: String,
    /// Its value in the declaration of the instance.
    pub value: Option<String>,
    /// Its value in that of the block.
    pub initial: Option<String>,
    /// What is said about it: its unit, its range.
    pub comment: String,
    /// What it may be called in the program.
    pub names: Vec<String>,
}

/// An output or an input of an element: the number of the element, and of the pin there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct End {
    /// Which element.
    pub element: usize,
    /// Which of its outputs, or of its inputs.
    pub pin: usize,
}

/// A link.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinkShape {
    /// An output.
    pub from: End,
    /// An input.
    pub to: End,
    /// Whether the value of the scan before is taken.
    pub is_feedback: bool,
    /// Its line, all horizontal and vertical.
    pub points: Vec<Point>,
}

/// Elements that belong together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GroupShape {
    /// What it is called.
    pub name: String,
    /// Around its elements and its name, which is at the top.
    pub frame: Rect,
    /// Its elements, as numbers.
    pub elements: Vec<usize>,
}

impl Sheet {
    pub(super) fn move_by(&mut self, by: Point) {
        self.title = self.title.moved(by);
        self.origin = self.origin.moved(by);
        self.frame = self.frame.moved(by);
        self.elements.iter_mut().for_each(|one| one.move_by(by));
        self.links.iter_mut().flat_map(|one| &mut one.points).for_each(|at| *at = at.moved(by));
        self.junctions.iter_mut().for_each(|at| *at = at.moved(by));
        self.groups.iter_mut().for_each(|one| one.frame = one.frame.moved(by));
    }
}

impl ElementShape {
    pub(super) fn move_by(&mut self, by: Point) {
        self.frame = self.frame.moved(by);
        let pins = self.inputs.iter_mut().chain(&mut self.outputs);
        pins.for_each(|pin| pin.at = pin.at.moved(by));
    }

    /// What it takes: its box, its place in the order above that, and the texts at its pins.
    pub fn room(&self) -> Rect {
        self.texts().fold(self.frame, Rect::union)
    }

    /// Its place in the order, and the texts beside its box with what leads to them.
    pub fn texts(&self) -> impl Iterator<Item = Rect> {
        let width = ORDER_WIDTH.min(self.frame.width);
        let Rect { y, .. } = self.frame;
        let order = Rect {
            x: self.frame.right() - width,
            y: y - ORDER_HEIGHT,
            width,
            height: ORDER_HEIGHT,
        };
        let beside = self.inputs.iter().chain(&self.outputs).filter(|_| self.block.is_some());
        let beside = beside.filter(|pin| !pin.text.is_empty());
        let beside = beside.map(|pin| {
            let (left, right) = (self.frame.x, self.frame.right());
            let edge = if pin.at.x < left { left } else { right };
            let at = |x: i32, dy: i32| Point::new(x, pin.at.y + dy);
            Rect::between(at(pin.at.x, -7), at(edge, 7))
        });
        std::iter::once(order).chain(beside)
    }
}
