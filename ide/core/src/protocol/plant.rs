//! Plants: what can be set in one and, of one that a file describes, what is drawn.

use awl_sim::plant::file::model::{Description, Shape as Described, ShapeKind};
use awl_sim::plant::{self, Plant, PlantSpec, Signals};
use serde::{Deserialize, Serialize};

/// English, German, Spanish.
pub type Words = [String; 3];

/// What a page needs to know of a plant before it runs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PlantInfo {
    /// What it is called; empty where the page has the words.
    pub title: Words,
    /// Digital inputs that it drives, bit n is I0.n.
    pub digital: u8,
    /// Analog inputs that it drives, bit n is Ain n.
    pub analog: u8,
    /// What people can set.
    pub controls: Vec<Control>,
    /// What is drawn, the last on top; empty where the page has a picture of its own.
    pub shapes: Vec<Shape>,
}

/// Something that people can set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Control {
    /// Its name.
    pub name: String,
    /// What is read beside it.
    pub words: Words,
    /// `button`, `switch`, `slider`, `fault`.
    pub kind: String,
    /// Least value.
    pub low: i64,
    /// Greatest value.
    pub high: i64,
    /// The value that it has now.
    pub value: i64,
}

/// Something that is drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Shape {
    /// `box`, `circle`, `line`, `lamp`, `text`, `value`, `level`, `pieces`.
    pub kind: String,
    /// Its place.
    pub at: (i32, i32),
    /// Of a box and a level its width and height, of a circle and a lamp the radius, of a line its
    /// end, of pieces the end of their way and their width and height.
    pub size: Vec<i32>,
    /// Of a text and a value.
    pub words: Option<Words>,
    /// `red` and so on.
    pub colour: String,
    /// How far it is moved at most.
    pub by: (i32, i32),
}

/// In all three languages.
pub fn words(words: &plant::Words) -> Words {
    let or_english = |other: &Option<String>| other.clone().unwrap_or_else(|| words.en.clone());
    [words.en.clone(), or_english(&words.de), or_english(&words.es)]
}

impl PlantInfo {
    /// What there is to know of a plant, `now` as it is.
    pub fn of(spec: &PlantSpec, now: &dyn Plant) -> PlantInfo {
        let Signals { digital, analog } = now.signals();
        let controls = now.controls().into_iter().map(|control| Control {
            words: words(&control.words),
            kind: control.kind.word().to_owned(),
            low: control.range.0,
            high: control.range.1,
            value: control.start,
            name: control.name,
        });
        let info = PlantInfo { digital, analog, controls: controls.collect(), ..Self::default() };
        let PlantSpec::Described(file) = spec else { return info };
        let Description { title, shapes, .. } = &*file.description;
        PlantInfo { title: words(title), shapes: shapes.iter().map(Shape::of).collect(), ..info }
    }
}

impl Shape {
    fn of(shape: &Described) -> Shape {
        let (kind, size, text) = match &shape.kind {
            ShapeKind::Box(width, height) => ("box", vec![*width, *height], None),
            ShapeKind::Circle(radius) => ("circle", vec![*radius], None),
            ShapeKind::Line(x, y) => ("line", vec![*x, *y], None),
            ShapeKind::Lamp(radius) => ("lamp", vec![*radius], None),
            ShapeKind::Text(text) => ("text", Vec::new(), Some(text)),
            ShapeKind::Value(text, _) => ("value", Vec::new(), Some(text)),
            ShapeKind::Level(width, height, _) => ("level", vec![*width, *height], None),
            ShapeKind::Pieces((x, y), _, (width, height)) => {
                ("pieces", vec![*x, *y, *width, *height], None)
            }
        };
        Shape {
            kind: kind.to_owned(),
            at: shape.at,
            size,
            words: text.map(words),
            colour: shape.colour.word().to_owned(),
            by: shape.moved.map_or((0, 0), |(_, by)| by),
        }
    }
}
