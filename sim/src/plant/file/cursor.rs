//! A line of a plant file, word by word. What the words mean is said elsewhere.

use diagnostics::Span;

use super::diagnostic::{Code, Diagnostic};
use crate::piece::Piece;
use crate::plant::Words;
use crate::range;
use crate::time::parse_time;

/// Greatest number that can be written, and least but for its sign.
pub(super) const NUMBER_MAX: i64 = 1_000_000;
/// Most characters of a text.
const TEXT_MAX: usize = 120;
/// Longest name.
const NAME_MAX: usize = 40;

/// Something read, or what is wrong with it.
pub(super) type Read<T> = Result<T, Diagnostic>;

/// An error at a piece of the text.
pub(super) fn wrong(code: Code, at: Piece<'_>, message: impl Into<String>) -> Diagnostic {
    let span = at.span();
    Diagnostic::new(code, Span::new(span.start, span.end), message)
}

/// What is left of a line.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    pub(super) rest: Piece<'a>,
    /// How the statement is written, for errors.
    pub(super) form: &'static str,
}

impl<'a> Cursor<'a> {
    /// That something else is missing or too much here.
    pub(super) fn expected(&self, at: Piece<'_>, what: &str) -> Diagnostic {
        let message = match at.text {
            "" => format!("{what} is missing"),
            text => format!("{what} is missing before {text}"),
        };
        wrong(Code::Statement, at, message).help(format!("write {}", self.form))
    }

    /// The next word, or text in quotes; empty at the end.
    pub(super) fn word(&mut self) -> Piece<'a> {
        let piece = self.rest.trim();
        let end = match piece.text.strip_prefix('"') {
            Some(text) => text.find('"').map_or(piece.text.len(), |at| at + 2),
            None => piece.text.find(char::is_whitespace).unwrap_or(piece.text.len()),
        };
        self.rest = piece.behind(end).trim();
        piece.part(0..end)
    }

    /// Takes the next word if it is this one.
    pub(super) fn takes(&mut self, word: &str) -> bool {
        let mut after = *self;
        let is_next = after.word().is(word);
        if is_next {
            *self = after;
        }
        is_next
    }

    /// This word must come.
    pub(super) fn needs(&mut self, word: &str) -> Read<()> {
        let next = self.rest;
        if self.takes(word) { Ok(()) } else { Err(self.expected(next, word)) }
    }

    /// Nothing may be left.
    pub(super) fn end(&mut self) -> Read<()> {
        match self.rest.text {
            "" => Ok(()),
            text => {
                let message = format!("{text} is too much here");
                Err(wrong(Code::Statement, self.rest, message).help(format!("write {}", self.form)))
            }
        }
    }

    /// A new name.
    pub(super) fn name(&mut self) -> Read<Piece<'a>> {
        let word = self.word();
        let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let is_name = word.text.starts_with(|c: char| c.is_ascii_alphabetic())
            && word.text.chars().all(is_letter)
            && word.text.len() <= NAME_MAX;
        if word.text.is_empty() {
            return Err(self.expected(word, "a name"));
        }
        if !is_name {
            let message = format!("{} is no name", word.text);
            let help = format!("a name has letters of A to Z, digits and _, at most {NAME_MAX}");
            return Err(wrong(Code::Statement, word, message).help(help));
        }
        if ["if", "and", "or", "not"].iter().any(|known| word.is(known)) {
            let message = format!("{} joins conditions and is no name", word.text);
            return Err(wrong(Code::Statement, word, message));
        }
        Ok(word)
    }

    /// `"Door" de "Tor" es "Puerta"`.
    pub(super) fn words(&mut self) -> Read<Words> {
        let en = self.text()?;
        let mut words = Words { en, de: None, es: None };
        if self.takes("de") {
            words.de = Some(self.text()?);
        }
        if self.takes("es") {
            words.es = Some(self.text()?);
        }
        Ok(words)
    }

    fn text(&mut self) -> Read<String> {
        let word = self.word();
        let Some(text) = word.text.strip_prefix('"') else {
            return Err(self.expected(word, "a text in quotes"));
        };
        let Some(text) = text.strip_suffix('"') else {
            return Err(wrong(
                Code::Statement,
                word,
                "the quote at the end of this text is missing",
            ));
        };
        let count = text.chars().count();
        match count {
            0 => Err(wrong(Code::Statement, word, "this text is empty")),
            1..=TEXT_MAX => Ok(text.to_string()),
            _ => {
                let message = format!("this text has {count} characters");
                Err(wrong(Code::TooMuch, word, message).help(format!("at most {TEXT_MAX}")))
            }
        }
    }

    /// A time in milliseconds, at least 1.
    pub(super) fn time(&mut self) -> Read<u64> {
        let word = self.word();
        if word.text.is_empty() {
            return Err(self.expected(word, "a time, such as 500ms or 2s"));
        }
        let ms = parse_time(word.text).map_err(|message| wrong(Code::Number, word, message))?;
        const HOUR_MS: u64 = 3_600_000;
        match ms {
            1..=HOUR_MS => Ok(ms),
            _ => Err(wrong(Code::Number, word, format!("{}: a time is 1ms to 1h here", word.text))),
        }
    }

    /// A whole number, which the form calls so.
    fn number(&mut self, name: &str) -> Read<i64> {
        let word = self.word();
        // A word is what comes after a number that is not there.
        if !word.text.starts_with(|c: char| c.is_ascii_digit() || !c.is_alphanumeric() && c != '"')
        {
            return Err(self.expected(word, name));
        }
        number(word, word.text)
    }

    /// A whole number between these.
    pub(super) fn number_in(&mut self, low: i64, high: i64) -> Read<i64> {
        self.named_in("a number", low, high)
    }

    /// The same for a number that the form calls so.
    pub(super) fn named_in(&mut self, name: &str, low: i64, high: i64) -> Read<i64> {
        let before = self.rest;
        let number = self.number(name)?;
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        let at = before.trim().split_word().0;
        Err(wrong(Code::Number, at, format!("{number}: a number from {low} to {high} is wanted")))
    }

    /// `0..100`, the first one smaller.
    pub(super) fn range(&mut self) -> Read<(i64, i64)> {
        let word = self.word();
        let Some((low, high)) = word.text.split_once("..").filter(|_| !word.text.contains("..."))
        else {
            return Err(self.no_range(word));
        };
        let (low, high) = (number(word, low)?, number(word, high)?);
        if low >= high {
            let message = format!("{}: the first number of a range is the smaller one", word.text);
            return Err(wrong(Code::Number, word, message));
        }
        Ok((low, high))
    }

    /// What is wrong with a word that is to be a range, or to begin one: `0-100`, `0 to 100`.
    fn no_range(&self, word: Piece<'a>) -> Diagnostic {
        let (joint, rest) = self.rest.split_word();
        let end = rest.split_word().0;
        let ends = [word, joint, end].map(|piece| piece.start + piece.text.len() - word.start);
        let texts = [
            word.text.to_string(),
            format!("{}{}", word.text, joint.text),
            format!("{} {} {}", word.text, joint.text, end.text),
        ];
        let found = texts.iter().zip(ends).find_map(|(text, end)| Some((range::meant(text)?, end)));
        let Some((meant, end)) = found else {
            return self.expected(word, "a range such as 0..100");
        };
        let span = Span::new(word.start, word.start + end);
        Diagnostic::new(Code::Statement, span, "a range is written with two points").suggest(meant)
    }

    /// `+500/s`, in thousandths.
    pub(super) fn speed(&mut self) -> Read<i64> {
        let word = self.word();
        let form = || {
            let message = format!("{} is no speed", word.text);
            wrong(Code::Number, word, message).help("write +250/s, -0.5/s: units in a second")
        };
        if word.text.is_empty() {
            return Err(self.expected(word, "a speed such as +250/s"));
        }
        let digits = word.text.strip_suffix("/s").ok_or_else(form)?;
        let (sign, digits) = match digits.strip_prefix('-') {
            Some(digits) => (-1, digits),
            None => (1, digits.strip_prefix('+').unwrap_or(digits)),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, "0"));
        let is_digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !is_digits(whole) || !is_digits(fraction) || fraction.len() > 3 {
            return Err(form());
        }
        let thousandths = format!("{whole}{fraction:0<3}").parse::<i64>().ok();
        match thousandths {
            Some(speed) if (1..=NUMBER_MAX * 1000).contains(&speed) => Ok(sign * speed),
            _ => {
                let message =
                    format!("{}: a speed is 0.001/s to {NUMBER_MAX}/s, up or down", word.text);
                Err(wrong(Code::Number, word, message))
            }
        }
    }
}

/// A whole number, written here.
pub(super) fn number(at: Piece<'_>, text: &str) -> Read<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        let what = if text.is_empty() { at.text } else { text };
        let error = wrong(Code::Number, at, format!("{what} is no whole number"));
        return Err(match range::meant(at.text) {
            Some(range) => error.suggest(range),
            None => error,
        });
    }
    match text.parse::<i64>() {
        Ok(number) if number.abs() <= NUMBER_MAX => Ok(number),
        _ => {
            let message = format!("{text}: numbers are -{NUMBER_MAX} to {NUMBER_MAX}");
            Err(wrong(Code::Number, at, message))
        }
    }
}
