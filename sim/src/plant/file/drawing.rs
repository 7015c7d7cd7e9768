//! The statement `draw`: a shape of a fixed set, with its colour, when it is to be seen, and what
//! moves it.

use awl_asm::suggest::nearest;

use super::conditions::condition;
use super::cursor::{Cursor, Read, wrong};
use super::diagnostic::Code;
use super::model::{Colour, Condition, Description, Shape, ShapeKind};
use super::words::SHAPES;

/// Places and sizes on the sheet, which is 640 by 400; a shape may begin outside of it.
const PLACE_MAX: i64 = 2000;

/// Reads what follows `draw`.
pub(super) fn shape(names: &Description, mut line: Cursor<'_>) -> Read<Shape> {
    let word = line.word();
    let Some((_, form)) = SHAPES.iter().find(|(name, _)| word.is(name)) else {
        let shapes: Vec<&str> = SHAPES.iter().map(|(name, _)| *name).collect();
        if word.text.is_empty() {
            return Err(line.expected(word, "a shape"));
        }
        let error = wrong(Code::Statement, word, format!("there is no shape {}", word.text));
        return Err(match nearest(word.text, shapes.iter().copied()) {
            Some(name) => error.suggest(name),
            None => error.help(format!("the shapes are {}", shapes.join(", "))),
        });
    };
    line.form = form;
    let at = place(&mut line, "X", "Y")?;
    let kind = kind(names, &word.text.to_ascii_lowercase(), &mut line)?;
    let mut shape =
        Shape { at, colour: usual_colour(&kind), kind, when: Condition::default(), moved: None };
    if let Some((_, colour)) = Colour::ALL.iter().find(|(name, _)| line.takes(name)) {
        shape.colour = *colour;
    }
    if line.takes("move") {
        let part = names.part(line.word())?;
        shape.moved = Some((part, place(&mut line, "DX", "DY")?));
    }
    if line.takes("if") {
        shape.when = condition(names, line.rest)?;
        return Ok(shape);
    }
    if !line.rest.text.is_empty() {
        let word = line.word();
        let error = wrong(Code::Statement, word, format!("{} is too much here", word.text));
        let colours = Colour::ALL.iter().map(|(name, _)| *name);
        return Err(match nearest(word.text, colours.clone()) {
            Some(colour) => error.suggest(colour),
            None => {
                let colours: Vec<&str> = colours.collect();
                error
                    .help(format!("write {} [COLOUR] [move PART DX DY] [if CONDITION]", line.form))
                    .help(format!("the colours are {}", colours.join(", ")))
            }
        });
    }
    Ok(shape)
}

fn kind(names: &Description, word: &str, line: &mut Cursor<'_>) -> Read<ShapeKind> {
    Ok(match word {
        "box" => ShapeKind::Box(size(line, "WIDTH")?, size(line, "HEIGHT")?),
        "circle" => ShapeKind::Circle(size(line, "RADIUS")?),
        "line" => {
            let (x, y) = place(line, "X2", "Y2")?;
            ShapeKind::Line(x, y)
        }
        "lamp" => ShapeKind::Lamp(size(line, "RADIUS")?),
        "text" => ShapeKind::Text(line.words()?),
        "value" => {
            let subject = names.subject(line.word())?;
            ShapeKind::Value(line.words()?, subject)
        }
        "level" => {
            let (width, height) = (size(line, "WIDTH")?, size(line, "HEIGHT")?);
            ShapeKind::Level(width, height, names.part(line.word())?)
        }
        _ => {
            let to = place(line, "X2", "Y2")?;
            let belt = names.belt(line.word())?;
            ShapeKind::Pieces(to, belt, (size(line, "WIDTH")?, size(line, "HEIGHT")?))
        }
    })
}

/// The colour of a shape for which none is written.
fn usual_colour(kind: &ShapeKind) -> Colour {
    match kind {
        ShapeKind::Box(..) | ShapeKind::Circle(_) => Colour::Grey,
        ShapeKind::Line(..) | ShapeKind::Text(_) | ShapeKind::Value(..) => Colour::Dark,
        ShapeKind::Lamp(_) => Colour::Green,
        ShapeKind::Level(..) => Colour::Blue,
        ShapeKind::Pieces(..) => Colour::Brown,
    }
}

/// Two numbers, with the names that the form has for them.
fn place(line: &mut Cursor<'_>, x: &str, y: &str) -> Read<(i32, i32)> {
    let mut one = |name| line.named_in(name, -PLACE_MAX, PLACE_MAX).map(|number| number as i32);
    Ok((one(x)?, one(y)?))
}

fn size(line: &mut Cursor<'_>, name: &str) -> Read<i32> {
    line.named_in(name, 1, PLACE_MAX).map(|number| number as i32)
}
