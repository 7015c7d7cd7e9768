//! The names of a plant file and the points of the Uno: what they stand for.

use awl_asm::suggest::nearest;

use super::cursor::{Read, wrong};
use super::diagnostic::{Code, Diagnostic};
use super::model::{Belt, Description, Subject};
use crate::piece::Piece;

/// Points of a kind: of inputs, outputs, analog inputs.
const POINTS: u8 = 6;

impl Description {
    /// All names with what they stand for, in the order of the file for each kind.
    pub(super) fn names(&self) -> Vec<(String, Subject)> {
        let mut names = Vec::new();
        for (index, part) in self.parts.iter().enumerate() {
            names.push((part.name.clone(), Subject::Part(index)));
        }
        for (index, Belt { name, .. }) in self.belts.iter().enumerate() {
            names.push((name.clone(), Subject::Belt(index)));
            names.push((format!("{name}.out"), Subject::Out(index)));
            names.push((format!("{name}.taken"), Subject::Taken(index)));
        }
        for (index, control) in self.controls.iter().enumerate() {
            names.push((control.name.clone(), Subject::Control(index)));
        }
        for (index, count) in self.counts.iter().enumerate() {
            names.push((count.name.clone(), Subject::Count(index)));
        }
        names
    }

    /// What a word stands for.
    pub(super) fn subject(&self, word: Piece<'_>) -> Read<Subject> {
        if let Some(output) = point(word.text, "Q0.") {
            return Ok(Subject::Output(output));
        }
        self.find(word.text).ok_or_else(|| unknown(word, &self.names(), "a name"))
    }

    /// What a name stands for, in any letter case.
    pub(super) fn find(&self, word: &str) -> Option<Subject> {
        let is = |name: &str| name.eq_ignore_ascii_case(word);
        if let Some(part) = self.parts.iter().position(|part| is(&part.name)) {
            return Some(Subject::Part(part));
        }
        let (bare, suffix) = word.split_once('.').unwrap_or((word, ""));
        let belt = self.belts.iter().position(|belt| belt.name.eq_ignore_ascii_case(bare));
        match (belt, suffix.to_ascii_lowercase().as_str()) {
            (Some(belt), "") if bare == word => return Some(Subject::Belt(belt)),
            (Some(belt), "out") => return Some(Subject::Out(belt)),
            (Some(belt), "taken") => return Some(Subject::Taken(belt)),
            _ => {}
        }
        let control = self.controls.iter().position(|control| control.is_named(word));
        let count = || self.counts.iter().position(|count| is(&count.name));
        control.map(Subject::Control).or_else(|| count().map(Subject::Count))
    }

    /// The part of this name.
    pub(super) fn part(&self, word: Piece<'_>) -> Read<usize> {
        match self.subject(word)? {
            Subject::Part(part) => Ok(part),
            _ => Err(self.other(word, "part", |subject| matches!(subject, Subject::Part(_)))),
        }
    }

    /// The belt of this name.
    pub(super) fn belt(&self, word: Piece<'_>) -> Read<usize> {
        match self.subject(word)? {
            Subject::Belt(belt) => Ok(belt),
            _ => Err(self.other(word, "belt", |subject| matches!(subject, Subject::Belt(_)))),
        }
    }

    fn other(&self, word: Piece<'_>, kind: &str, is_it: fn(&Subject) -> bool) -> Diagnostic {
        let names = self.names().into_iter().filter(|(_, subject)| is_it(subject));
        let names: Vec<String> = names.map(|(name, _)| name).collect();
        let message = format!("{} is no {kind}", word.text);
        let help = match names.is_empty() {
            true => format!("there is none: a line `{kind} NAME ...` makes one"),
            false => format!("there are: {}", names.join(", ")),
        };
        wrong(Code::UnknownName, word, message).help(help)
    }
}

fn unknown(word: Piece<'_>, names: &[(String, Subject)], what: &str) -> Diagnostic {
    if word.text.is_empty() {
        return wrong(Code::Statement, word, format!("{what} is missing"));
    }
    let is_point = word.text.len() > 1
        && word.text.starts_with(['I', 'Q', 'i', 'q'])
        && word.text[1..].starts_with(|c: char| c.is_ascii_digit());
    if is_point {
        let message = format!("{} is no output that a plant sees", word.text);
        let help = "a plant sees Q0.0 to Q0.5; it drives inputs by lines `input I0.0 if ...`";
        return wrong(Code::Point, word, message).help(help);
    }
    let error = wrong(Code::UnknownName, word, format!("there is no {}", word.text));
    match nearest(word.text, names.iter().map(|(name, _)| name.as_str())) {
        Some(name) => error.suggest(name),
        None => error.help("part, belt, button, switch, slider, fault and count make names"),
    }
}

/// The number of a point, such as the 3 of `I0.3` after `I0.`, in any letter case.
fn point(text: &str, prefix: &str) -> Option<u8> {
    let (head, number) = text.split_at_checked(prefix.len())?;
    let is_one = head.eq_ignore_ascii_case(prefix) && number.len() == 1;
    number.parse().ok().filter(|&number: &u8| is_one && number < POINTS)
}

/// A point of this kind, by its number.
pub(super) fn point_of(word: Piece<'_>, prefix: &str) -> Read<u8> {
    point(word.text, prefix).ok_or_else(|| {
        let message = match word.text {
            "" => "a point is missing".to_string(),
            text => format!("{text} is none of the points here"),
        };
        let help = format!("there are {prefix}0 to {prefix}{}", POINTS - 1);
        wrong(Code::Point, word, message).help(help)
    })
}
