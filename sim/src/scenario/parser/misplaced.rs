//! Statements that are understood but for the place of a word or for a sign: what belongs there, in
//! the author's own words. What is in its place is read elsewhere.

use super::super::words::AFTER_TIME;
use super::sign::{foreign_sign, sign};
use super::{Moment, Parser, STATEMENTS, Times};
use crate::operand::Operand;
use crate::piece::Piece;
use crate::problem::Problem;
use crate::time::{TIME_MAX_MS, format_time, parse_time};
use awl_asm::suggest::nearest;

/// What lets time pass in other languages.
const WAITS: [&str; 6] = ["wait", "sleep", "delay", "pause", "after", "warte"];

/// `set I0.0`, in the words of other languages.
fn is_set(name: Piece<'_>) -> bool {
    let (word, rest) = name.split_word();
    let is_word = ["set", "let", "write", "force", "put"].iter().any(|known| word.is(known));
    is_word && !rest.text.is_empty()
}

/// `expect`, in the words of other languages.
pub(super) fn is_expect(word: Piece<'_>) -> bool {
    ["assert", "check", "verify", "require", "ensure"].iter().any(|known| word.is(known))
}

/// Whether it can follow a time.
fn is_after_time(word: Piece<'_>) -> bool {
    AFTER_TIME.iter().any(|row| word.is(row.word))
}

/// The time of a wait, and what is behind it.
fn wait<'a>(word: Piece<'a>, rest: Piece<'a>) -> Option<(Piece<'a>, Piece<'a>)> {
    let (time, statement) = rest.split_word();
    let is_one = WAITS.iter().any(|wait| word.is(wait)) && parse_time(time.text).is_ok();
    is_one.then_some((time, statement))
}

/// The other value of a bit, as it is written here; of what is no bit a word for it.
fn other_value(value: &str) -> &'static str {
    match value.to_ascii_uppercase().as_str() {
        "1" | "TRUE" | "ON" => "0",
        "0" | "FALSE" | "OFF" => "1",
        _ => "VALUE",
    }
}

/// The same assignments with the other values.
fn reverted(list: Piece<'_>) -> String {
    let one = |piece: Piece<'_>| {
        let (_, at, behind) = sign(piece)?;
        let value = other_value(piece.behind(behind).trim().text);
        Some(format!("{} = {value}", piece.part(0..at).trim().text))
    };
    list.split(',').into_iter().filter_map(one).collect::<Vec<_>>().join(", ")
}

/// `at 2s Q0.0 = 1`, to be written.
fn at(time: &str, statement: &str) -> String {
    format!("write at {time} {statement}")
}

/// The same after a wait of this time; without one the time is for the author to choose.
fn after_wait(waited: Option<&str>, statement: &str) -> String {
    match waited {
        Some(time) => at(&format!("+{time}"), statement),
        None => format!("{}, such as at 2s", at("TIME", statement)),
    }
}

/// What is behind a piece in the list that it begins.
fn behind<'a>(before: Piece<'a>, list: Piece<'a>) -> Piece<'a> {
    list.behind(before.start + before.text.len() - list.start).trim()
}

impl<'a> Parser<'a, '_> {
    /// A line that begins with no statement, after a wait of this time.
    pub(super) fn unknown_statement(&mut self, code: Piece<'a>, waited: Option<&'a str>) {
        let (word, rest) = code.split_word();
        let unknown = format!("unknown statement {}", word.text);
        let (message, help) = if word.text.starts_with(|c: char| c.is_ascii_digit()) {
            (unknown, format!("a time is after at: at {} {}", word.text, rest.text))
        } else if let Some((time, statement)) = wait(word, rest) {
            let help = match statement.text {
                "" => {
                    self.waited = Some(time.text);
                    format!("begin the next line with at +{}", time.text)
                }
                statement => at(&format!("+{}", time.text), statement),
            };
            (format!("there is no {}: each line says when it happens", word.text), help)
        } else if is_expect(word) {
            (unknown, after_wait(waited, &format!("expect {}", rest.text)))
        } else if is_after_time(word) && !rest.text.is_empty() {
            (format!("{} is after `at TIME`", word.text), after_wait(waited, code.text))
        } else if let Some(list) = self.assigned(code) {
            ("a value is set after `at TIME`".to_string(), after_wait(waited, list.text))
        } else {
            let [first @ .., last] = STATEMENTS;
            let help = format!("the statements are {} and {last}", first.join(", "));
            let problem = Problem::new(word.span(), unknown).help(help);
            return self.problems.push(problem.did_you_mean(nearest(word.text, STATEMENTS)));
        };
        self.problems.push(Problem::new(word.span(), message).help(help));
    }

    /// What is set in a line without a time, if that is what it does.
    fn assigned(&self, code: Piece<'a>) -> Option<Piece<'a>> {
        let (_, at, _) = sign(code)?;
        let is_known = Operand::parse(code.part(0..at).trim().text, self.context.symbols).is_ok();
        let after_word = is_set(code).then(|| code.split_word().1);
        if is_known { Some(code) } else { after_word }
    }

    /// `set I0.0 = 1` of a list: whether it was told.
    pub(super) fn is_set_by_a_word(&mut self, piece: Piece<'a>, name: Piece<'a>) -> bool {
        let is_one = is_set(name) && Operand::parse(name.text, self.context.symbols).is_err();
        if is_one {
            let (word, rest) = piece.split_word();
            let help = format!("write {} {}", self.opening, rest.text);
            let problem = Problem::new(word.span(), "a value is set without a word");
            self.problems.push(problem.help(help));
        }
        is_one
    }

    /// `expect Q0.0 = 1 within 3s`, `... for 3s`, `... after 3s`: whether it was told.
    pub(super) fn is_time_behind(&mut self, list: Piece<'a>, moment: Moment) -> bool {
        const WORDS: [&str; 5] = ["within", "before", "by", "for", "after"];
        let Some((before, word, time)) = list.split_after_comparison(&WORDS) else { return false };
        let Ok(ms) = parse_time(time.text) else { return false };
        let (begin, end) = (moment.at_ms, (moment.at_ms + ms).min(TIME_MAX_MS));
        let (begin, end) = (format_time(begin), format_time(end));
        let (opening, list_text, limit) = (&self.opening, before.text, time.text);
        let (message, help) = match word {
            "for" => {
                ("expect looks once", format!("write always {list_text} from {begin} to {end}"))
            }
            "after" => ("the time is before expect", at(&end, &format!("expect {list_text}"))),
            _ => {
                let help = format!("write {opening} within {limit} expect {list_text}");
                ("the time within which it is expected is before expect", help)
            }
        };
        let span = behind(before, list).span();
        self.problems.push(Problem::new(span, message).help(help));
        true
    }

    /// `at 1s I0.0 = 1 for 2s`, `every 2s I0.0 = 1 for 1s`: whether it was told.
    pub(super) fn is_length_behind(&mut self, list: Piece<'a>, times: Times) -> bool {
        const WORDS: [&str; 3] = ["for", "until", "to"];
        let Some((before, word, time)) = list.split_after_comparison(&WORDS) else { return false };
        let Ok(ms) = parse_time(time.text) else { return false };
        let end_ms = if word == "for" { times.at_ms + ms } else { ms };
        let (end, back) = (format_time(end_ms.min(TIME_MAX_MS)), reverted(before));
        let line = match times.repeat {
            Some(_) => format!("{} {back} from {end}", self.opening),
            None => format!("at {end} {back}"),
        };
        let span = behind(before, list).span();
        let problem = Problem::new(span, "a value stays until it is set again");
        self.problems.push(problem.help(format!("add a line: {line}")));
        true
    }

    /// `Q0.0 == 1` and the like: whether it was told, with these words about the sign.
    pub(super) fn is_foreign_sign(&mut self, piece: Piece<'_>, words: &str) -> bool {
        let Some((_, at, end)) = sign(piece) else { return false };
        let Some((written, meant)) = foreign_sign(piece, at) else { return false };
        // A name may end with such a sign.
        let is_name = Operand::parse(piece.part(0..at).trim().text, self.context.symbols).is_ok();
        if is_name && written.start + written.text.len() == piece.start + end {
            return false;
        }
        let problem = Problem::new(written.span(), format!("{} {words}", written.text));
        self.problems.push(problem.did_you_mean(Some(meant.symbol())));
        true
    }
}
