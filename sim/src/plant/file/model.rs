//! What a plant file describes, as data: what there is, how it moves, what the PLC sees of it, how
//! it is drawn. Nothing is read or run here.

use std::ops::RangeInclusive;

use plc_isa::Relation;

use crate::plant::{Control, Fault, Words};

/// Positions and levels are counted in millionths, so that a thousandth of a unit in a second is
/// one of them in a millisecond.
pub const UNIT: i64 = 1_000_000;

/// A plant as its file describes it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Description {
    /// What it is called.
    pub title: Words,
    /// Whether a low output pin switches on, as behind a relay board with inverted inputs.
    pub is_inverted: bool,
    /// Positions, levels, temperatures.
    pub parts: Vec<Part>,
    /// Belts with pieces.
    pub belts: Vec<Belt>,
    /// Buttons, switches, sliders, and faults that its conditions ask for.
    pub controls: Vec<Control>,
    /// Faults of sensors and actuators.
    pub faults: Vec<Fault>,
    /// What is counted and told.
    pub counts: Vec<Count>,
    /// Pieces at time 0: the belt, and where the front is.
    pub pieces: Vec<(usize, i64)>,
    /// What moves something, in the order of the file.
    pub motions: Vec<Motion>,
    /// What the PLC's digital inputs see.
    pub inputs: Vec<(u8, Condition)>,
    /// What gives pulses to digital inputs.
    pub encoders: Vec<Encoder>,
    /// What its analog inputs see.
    pub analogs: Vec<Analog>,
    /// What is drawn, the last on top.
    pub shapes: Vec<Shape>,
}

impl Description {
    /// The digital inputs that it drives.
    pub fn digital(&self) -> impl Iterator<Item = u8> {
        let tracks = self.encoders.iter().flat_map(|encoder| encoder.tracks);
        self.inputs.iter().map(|(input, _)| *input).chain(tracks)
    }
}

/// A number between limits that moves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// Its limits, in whole units.
    pub range: (i64, i64),
    /// Its value at time 0.
    pub start: i64,
}

/// A belt: pieces lie on it one behind the other, and none goes through another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Belt {
    /// Its name.
    pub name: String,
    /// From where pieces come to where they leave it.
    pub range: (i64, i64),
    /// Most pieces on it.
    pub pieces: usize,
    /// How long a piece is.
    pub long: i64,
    /// How far it stays behind the one before it, at least.
    pub gap: i64,
}

/// Something that is counted, and told as an event.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Count {
    /// Its name.
    pub name: String,
    /// What has happened.
    pub words: Words,
    /// It counts each time this becomes true.
    pub when: Condition,
}

/// What moves something, as long as its condition is true.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Motion {
    /// What happens.
    pub kind: MotionKind,
    /// When.
    pub when: Condition,
}

/// How something moves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MotionKind {
    /// A part moves so many thousandths of a unit in a second.
    Move(usize, i64),
    /// A part moves so many of its units in a second as the value of something is; down if it is to
    /// be negated.
    MoveBy(usize, Subject, bool),
    /// A part comes closer to a value, with a time constant in milliseconds.
    Approach(usize, i64, i64),
    /// A part comes closer to where it is between its limits what an output is between off and on
    /// in its time, with a time constant in milliseconds.
    Follow(usize, u8, i64),
    /// The pieces of a belt move so many thousandths of a unit in a second.
    Carry(usize, i64),
    /// A piece comes on a belt after each such time in milliseconds.
    FeedEvery(usize, u64),
    /// A piece comes on a belt each time the condition becomes true.
    FeedWhen(usize),
    /// No piece of a belt goes over this place.
    Hold(usize, i64),
    /// Pieces that reach this range are taken off a belt.
    Take(usize, (i64, i64)),
}

/// Two digital inputs that see the tracks of an encoder: each unit of a part is an edge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Encoder {
    /// The inputs; upward the first one is a quarter of a period ahead.
    pub tracks: [u8; 2],
    /// The part.
    pub part: usize,
}

/// An analog input: a number of the plant as counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Analog {
    /// Channel, 0 to 5.
    pub channel: u8,
    /// What it measures.
    pub subject: Subject,
    /// The limits of that, in whole units.
    pub range: (i64, i64),
    /// Counts at these limits.
    pub counts: (i64, i64),
}

/// Conditions of which one must be true: each is a list of terms that must all be true. Empty:
/// always.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Condition(pub Vec<Vec<Term>>);

/// A comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Term {
    /// Of what.
    pub subject: Subject,
    /// Whether it must be false.
    pub is_negated: bool,
    /// How it is compared; of a belt: whether a piece is in the range.
    pub relation: Relation,
    /// With what, in whole units.
    pub values: RangeInclusive<i64>,
}

impl Term {
    /// Whether a name stands by itself, which means: not 0.
    pub fn is_bare(&self) -> bool {
        self.relation == Relation::NotEqual && self.values == (0..=0)
    }
}

/// Something with a value, by its place in its list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// An output: 0 or 1.
    Output(u8),
    /// A part: its value.
    Part(usize),
    /// A belt: how many pieces are on it, or where.
    Belt(usize),
    /// How many pieces came to the end of a belt.
    Out(usize),
    /// How many were taken off it.
    Taken(usize),
    /// A control: its value.
    Control(usize),
    /// A count: how many.
    Count(usize),
}

/// Something that is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shape {
    /// Where it is, on a sheet of 640 by 400.
    pub at: (i32, i32),
    /// What it is.
    pub kind: ShapeKind,
    /// Its colour.
    pub colour: Colour,
    /// It is to be seen, or a lamp lights, only then.
    pub when: Condition,
    /// A part that moves it: which, and how far from its least to its greatest value.
    pub moved: Option<(usize, (i32, i32))>,
}

/// What a shape is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ShapeKind {
    /// A rectangle of this width and height.
    Box(i32, i32),
    /// A circle of this radius.
    Circle(i32),
    /// A line to there.
    Line(i32, i32),
    /// A lamp of this radius: always to be seen, alight at times.
    Lamp(i32),
    /// Words.
    Text(Words),
    /// Words with a number behind them.
    Value(Words, Subject),
    /// A vessel of this width and height, filled as far as a part is.
    Level(i32, i32, usize),
    /// The pieces of a belt that leads from its place to here, as boxes of this width and height.
    Pieces((i32, i32), usize, (i32, i32)),
}

/// Colours that both themes have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// Red.
    Red,
    /// Yellow.
    Yellow,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Brown.
    Brown,
    /// The colour of metal.
    Grey,
    /// The colour of texts.
    Dark,
    /// That of the sheet.
    Light,
}

impl Colour {
    /// All of them with their words.
    pub const ALL: [(&'static str, Colour); 8] = [
        ("red", Colour::Red),
        ("yellow", Colour::Yellow),
        ("green", Colour::Green),
        ("blue", Colour::Blue),
        ("brown", Colour::Brown),
        ("grey", Colour::Grey),
        ("dark", Colour::Dark),
        ("light", Colour::Light),
    ];

    /// As a plant file writes it.
    pub fn word(self) -> &'static str {
        Colour::ALL.iter().find(|(_, colour)| *colour == self).map_or("grey", |(word, _)| word)
    }
}
