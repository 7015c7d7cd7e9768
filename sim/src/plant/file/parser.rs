//! Reads a plant file, line by line: first what makes names, then what uses them. All errors are
//! found in one go.

use awl_asm::suggest::nearest;
use diagnostics::Span;

use super::conditions::condition;
use super::cursor::{Cursor, NUMBER_MAX, Read, wrong};
use super::diagnostic::{Code, Diagnostic};
use super::drawing::shape;
use super::model::{
    Analog, Belt, Condition, Count, Description, Encoder, Motion, MotionKind, Part, Subject,
};
use super::names::point_of;
use super::words::{STATEMENTS, form};
use crate::piece::{Piece, lines};
use crate::plant::control::SLOW_MS;
use crate::plant::{Control, ControlKind, Effect, Fault, Words};

/// Most statements of a file.
const STATEMENTS_MAX: usize = 500;
/// Largest file in bytes.
const BYTES_MAX: usize = 100_000;
/// Most pieces on a belt, and as many as there are if nothing is said.
const PIECES_MAX: i64 = 100;
const PIECES: usize = 20;
/// How long a piece is if nothing is said.
const PIECE_LONG: i64 = 50;
/// Greatest count of an analog input.
const COUNTS_MAX: i64 = 1023;
/// More errors say nothing new.
const ERRORS_MAX: usize = 100;

/// A statement, with what follows its word.
struct Line<'a> {
    word: &'static str,
    rest: Cursor<'a>,
}

/// Reads a text: what could be understood, and what is wrong, in the order of the text.
pub(super) fn read(text: &str) -> (Description, Vec<Diagnostic>) {
    let mut errors = Vec::new();
    if text.len() > BYTES_MAX {
        let message = format!("a plant file has at most {BYTES_MAX} bytes");
        errors.push(Diagnostic::new(Code::TooMuch, Span::new(0, 1), message));
        return (Description::default(), errors);
    }
    let statements = statements(text, &mut errors);
    let mut plant = Description::default();
    // Names may be used before the line that makes them.
    let mut broken = Vec::new();
    for line in &statements {
        if let Err(error) = declare(&mut plant, line) {
            if error.code != Code::Duplicate {
                broken.push({ line.rest }.word().text);
            }
            errors.push(error);
        }
    }
    for line in &statements {
        let error = define(&mut plant, line).err();
        // What its own line says wrongly is not missing, too.
        errors.extend(error.filter(|error| {
            let name = error.span.text(text);
            error.code != Code::UnknownName
                || !broken.iter().any(|one| one.eq_ignore_ascii_case(name))
        }));
    }
    errors.sort_by_key(|error| (error.span.start, error.span.end));
    errors.truncate(ERRORS_MAX);
    (plant, errors)
}

fn statements<'a>(text: &'a str, errors: &mut Vec<Diagnostic>) -> Vec<Line<'a>> {
    let mut statements = Vec::new();
    for code in lines(text).filter(|line| !line.text.is_empty()) {
        let (word, rest) = code.split_word();
        let Some(row) = STATEMENTS.iter().find(|row| word.is(row.word)) else {
            errors.push(unknown(word));
            continue;
        };
        if statements.len() == STATEMENTS_MAX {
            let message = format!("a plant file has at most {STATEMENTS_MAX} statements");
            errors.push(wrong(Code::TooMuch, word, message));
            break;
        }
        statements.push(Line { word: row.word, rest: Cursor { rest, form: form(row.word) } });
    }
    statements
}

fn unknown(word: Piece<'_>) -> Diagnostic {
    let error = wrong(Code::Statement, word, format!("unknown statement {}", word.text));
    if word.text.starts_with("//") {
        return error.help("a comment begins with #");
    }
    let words = STATEMENTS.iter().map(|row| row.word);
    match nearest(word.text, words.clone()) {
        Some(word) => error.suggest(word),
        None => {
            let words: Vec<&str> = words.collect();
            error.help(format!("the statements are {}", words.join(", ")))
        }
    }
}

/// Takes the names that a statement makes.
fn declare(plant: &mut Description, line: &Line<'_>) -> Read<()> {
    let mut rest = line.rest;
    match line.word {
        "plant" => {
            let at = rest.rest;
            let title = rest.words()?;
            if plant.title != Words::default() {
                return Err(wrong(Code::Duplicate, at, "the plant has a title already"));
            }
            plant.title = title;
        }
        "outputs" => {
            rest.needs("inverted")?;
            plant.is_inverted = true;
        }
        "part" => {
            let name = new_name(plant, &mut rest)?;
            let range = rest.range()?;
            let start = start(&mut rest, range)?;
            plant.parts.push(Part { name, range, start });
        }
        "belt" => {
            let belt = belt(plant, &mut rest)?;
            plant.belts.push(belt);
        }
        "button" | "switch" | "slider" => {
            let control = control(plant, line.word, &mut rest)?;
            plant.controls.push(control);
        }
        "fault" => return fault(plant, rest),
        "count" => {
            let name = new_name(plant, &mut rest)?;
            let words = rest.words()?;
            plant.counts.push(Count { name, words, when: Condition::default() });
            // Its condition is read when all names are there.
            return Ok(());
        }
        _ => return Ok(()),
    }
    rest.end()
}

/// Takes a name that nothing else has.
fn new_name(plant: &Description, rest: &mut Cursor<'_>) -> Read<String> {
    let name = rest.name()?;
    let is_fault = |fault: &Fault| fault.name.eq_ignore_ascii_case(name.text);
    if plant.find(name.text).is_some() || plant.faults.iter().any(is_fault) {
        let message = format!("there is a {} already", name.text);
        return Err(wrong(Code::Duplicate, name, message));
    }
    Ok(name.text.to_string())
}

fn start(rest: &mut Cursor<'_>, (low, high): (i64, i64)) -> Read<i64> {
    if rest.takes("start") { rest.number_in(low, high) } else { Ok(low) }
}

fn belt(plant: &Description, rest: &mut Cursor<'_>) -> Read<Belt> {
    let name = new_name(plant, rest)?;
    let range = rest.range()?;
    let (mut pieces, mut long) = (PIECES, PIECE_LONG);
    if rest.takes("pieces") {
        pieces = rest.number_in(1, PIECES_MAX)? as usize;
    }
    if rest.takes("long") {
        long = rest.number_in(1, NUMBER_MAX)?;
    }
    let gap = if rest.takes("gap") { rest.number_in(0, NUMBER_MAX)? } else { 0 };
    Ok(Belt { name, range, pieces, long, gap })
}

fn control(plant: &Description, word: &str, rest: &mut Cursor<'_>) -> Read<Control> {
    let name = new_name(plant, rest)?;
    let words = rest.words()?;
    let (kind, range, start) = match word {
        "button" => (ControlKind::Button, (0, 1), 0),
        "switch" => (ControlKind::Switch, (0, 1), i64::from(rest.takes("on"))),
        _ => {
            let range = rest.range()?;
            (ControlKind::Slider, range, start(rest, range)?)
        }
    };
    Ok(Control { name, words, kind, range, start })
}

fn fault(plant: &mut Description, mut rest: Cursor<'_>) -> Read<()> {
    let name = new_name(plant, &mut rest)?;
    let words = rest.words()?;
    let effect = if rest.takes("stuck") {
        let word = rest.word();
        match point_of(word, "Ain") {
            Ok(channel) => Some(Effect::StuckAnalog(channel)),
            Err(_) => Some(Effect::Stuck(point_of(word, "I0.")?)),
        }
    } else if rest.takes("slow") {
        let output = point_of(rest.word(), "Q0.")?;
        let by_ms = if rest.rest.text.is_empty() { SLOW_MS } else { rest.time()? };
        Some(Effect::Slow(output, by_ms))
    } else {
        None
    };
    rest.end()?;
    match effect {
        Some(effect) => plant.faults.push(Fault { name, words, effect }),
        None => plant.controls.push(Control {
            name,
            words,
            kind: ControlKind::Fault,
            range: (0, 1),
            start: 0,
        }),
    }
    Ok(())
}

/// Takes what a statement says about things that have names by now.
fn define(plant: &mut Description, line: &Line<'_>) -> Read<()> {
    let mut rest = line.rest;
    match line.word {
        "count" => {
            let name = rest.name()?;
            rest.words()?;
            rest.needs("if")?;
            let when = condition(plant, rest.rest)?;
            let is_it = |count: &&mut Count| count.name == name.text;
            if let Some(count) = plant.counts.iter_mut().find(is_it) {
                count.when = when;
            }
        }
        "move" | "approach" | "follow" | "feed" | "hold" | "take" => {
            let motion = motion(plant, line.word, rest)?;
            plant.motions.push(motion);
        }
        "piece" => {
            let belt = plant.belt(rest.word())?;
            let (low, high) = plant.belts[belt].range;
            let at = rest.number_in(low, high - 1)?;
            rest.end()?;
            plant.pieces.push((belt, at));
        }
        "input" => {
            let word = rest.word();
            let input = point_of(word, "I0.")?;
            is_free(plant, input, word)?;
            rest.needs("if")?;
            let when = condition(plant, rest.rest)?;
            plant.inputs.push((input, when));
        }
        "encoder" => {
            let words = [rest.word(), rest.word()];
            let tracks = [point_of(words[0], "I0.")?, point_of(words[1], "I0.")?];
            for (track, word) in tracks.into_iter().zip(words) {
                is_free(plant, track, word)?;
            }
            if tracks[0] == tracks[1] {
                return Err(driven(words[1]).help("the tracks of an encoder are at two inputs"));
            }
            let part = plant.part(rest.word())?;
            rest.end()?;
            plant.encoders.push(Encoder { tracks, part });
        }
        "analog" => {
            let analog = analog(plant, rest)?;
            plant.analogs.push(analog);
        }
        "draw" => {
            let shape = shape(plant, rest)?;
            plant.shapes.push(shape);
        }
        _ => {}
    }
    Ok(())
}

/// An input that nothing else drives.
fn is_free(plant: &Description, input: u8, word: Piece<'_>) -> Read<()> {
    match plant.digital().any(|known| known == input) {
        false => Ok(()),
        true => {
            let help = "join what switches it by or, in one line";
            Err(driven(word).help(help).help("or another input is meant here"))
        }
    }
}

fn driven(word: Piece<'_>) -> Diagnostic {
    let message = format!("{} is driven by a line above already", word.text);
    wrong(Code::Duplicate, word, message)
}

fn motion(plant: &Description, word: &str, mut rest: Cursor<'_>) -> Read<Motion> {
    let name = rest.word();
    if name.text.is_empty() {
        return Err(rest.expected(name, "a name"));
    }
    let kind = match word {
        "move" => movement(plant, name, &mut rest)?,
        "approach" => {
            let part = plant.part(name)?;
            let (low, high) = plant.parts[part].range;
            let target = rest.number_in(low, high)?;
            rest.needs("in")?;
            MotionKind::Approach(part, target, rest.time()? as i64)
        }
        "follow" => {
            let part = plant.part(name)?;
            let output = point_of(rest.word(), "Q0.")?;
            rest.needs("in")?;
            MotionKind::Follow(part, output, rest.time()? as i64)
        }
        "feed" => {
            let belt = plant.belt(name)?;
            if rest.takes("when") {
                let when = condition(plant, rest.rest)?;
                return Ok(Motion { kind: MotionKind::FeedWhen(belt), when });
            }
            rest.needs("every")?;
            MotionKind::FeedEvery(belt, rest.time()?)
        }
        "hold" => {
            let belt = plant.belt(name)?;
            let (low, high) = plant.belts[belt].range;
            MotionKind::Hold(belt, rest.number_in(low, high)?)
        }
        _ => MotionKind::Take(plant.belt(name)?, rest.range()?),
    };
    Ok(Motion { kind, when: ending(plant, rest)? })
}

/// What moves so fast: a part, or the pieces of a belt.
fn movement(plant: &Description, name: Piece<'_>, rest: &mut Cursor<'_>) -> Read<MotionKind> {
    let subject = plant.subject(name)?;
    if let Subject::Part(part) = subject
        && let Some((by, is_down)) = speed_of(plant, rest)?
    {
        return Ok(MotionKind::MoveBy(part, by, is_down));
    }
    let at = rest.rest;
    let speed = rest.speed()?;
    match subject {
        Subject::Part(part) => Ok(MotionKind::Move(part, speed)),
        Subject::Belt(_) if speed < 0 => {
            let message = "pieces go forward only: a belt has no speed below 0";
            Err(wrong(Code::Number, at.split_word().0, message))
        }
        Subject::Belt(belt) => Ok(MotionKind::Carry(belt, speed)),
        _ => {
            let message = format!("{} is no part and no belt", name.text);
            Err(wrong(Code::UnknownName, name, message))
        }
    }
}

/// `+Speed/s`: the speed is the value of a part or a slider; nothing where a number is written.
fn speed_of(plant: &Description, rest: &mut Cursor<'_>) -> Read<Option<(Subject, bool)>> {
    let mut after = *rest;
    let word = after.word();
    let sign = if word.text.starts_with(['+', '-']) { 1 } else { 0 };
    let Some(len) = word.text.strip_suffix("/s").map(str::len).filter(|len| *len > sign) else {
        return Ok(None);
    };
    let name = word.part(sign..len);
    if !name.text.starts_with(|one: char| one.is_ascii_alphabetic()) {
        return Ok(None);
    }
    *rest = after;
    match plant.subject(name)? {
        by @ (Subject::Part(_) | Subject::Control(_)) => Ok(Some((by, word.text.starts_with('-')))),
        _ => Err(no_number(name)),
    }
}

fn no_number(name: Piece<'_>) -> Diagnostic {
    wrong(Code::UnknownName, name, format!("{} is no part and no slider", name.text))
}

/// `if CONDITION`, or nothing: always.
fn ending(plant: &Description, mut rest: Cursor<'_>) -> Read<Condition> {
    if rest.takes("if") {
        return condition(plant, rest.rest);
    }
    rest.end().map(|()| Condition::default())
}

fn analog(plant: &Description, mut rest: Cursor<'_>) -> Read<Analog> {
    let word = rest.word();
    let channel = point_of(word, "Ain")?;
    if plant.analogs.iter().any(|known| known.channel == channel) {
        let help = "it follows one part or slider: perhaps another analog input is meant here";
        return Err(driven(word).help(help));
    }
    let name = rest.word();
    let subject = plant.subject(name)?;
    let range = match subject {
        Subject::Part(part) => plant.parts[part].range,
        Subject::Control(control) => plant.controls[control].range,
        _ => return Err(no_number(name)),
    };
    let mut counts = (0, COUNTS_MAX);
    if !rest.rest.text.is_empty() {
        let at = rest.rest;
        counts = rest.range()?;
        if counts.0 < 0 || counts.1 > COUNTS_MAX {
            let message = format!("counts are 0..{COUNTS_MAX}");
            return Err(wrong(Code::Number, at.split_word().0, message));
        }
    }
    rest.end()?;
    Ok(Analog { channel, subject, range, counts })
}
