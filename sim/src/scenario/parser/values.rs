//! Values that are set: lists of assignments, once and repeated; strings as the bytes that they are
//! made of.

use awl_asm::Address;
use awl_asm::suggest::nearest;

use super::super::condition::{Comparison, Relation};
use super::super::value::{meant, parse_value, text_bytes};
use super::super::words::{AFTER_TIME, names};
use super::super::{Asked, Repeat, Setting};
use super::misplaced::is_expect;
use super::sign::sign;
use super::{LIST_FORM, Parser, Times};
use crate::operand::{Operand, Width};
use crate::piece::Piece;
use crate::problem::Problem;
use crate::range;

const EVERY_FORM: &str = "write every 2s I0.0 = 1 from 1s to 9s";
/// What can follow a time beside an assignment.
const WORDS_AFTER_TIME: [&str; 7] = names(&AFTER_TIME);
/// Most characters of a string.
const TEXT_MAX: usize = 254;

impl<'a> Parser<'a, '_> {
    /// `I0.0 = 1, Ain0 = 207`.
    pub(super) fn assignments(&mut self, list: Piece<'a>, times: Times) {
        if list.text.is_empty() {
            return self.fail(list, "nothing is set here: write operand = value");
        }
        if self.is_length_behind(list, times) {
            return;
        }
        for piece in list.split(',') {
            self.assignment(piece, times);
        }
    }

    /// `every`, behind the word.
    pub(super) fn every(&mut self, rest: Piece<'a>) {
        let (period, rest) = rest.split_word();
        let period_ms = self.time(period);
        if period_ms == Some(0) {
            self.fail(period, "a period is 1ms or longer");
        }
        let (word, behind) = rest.split_word();
        let is_keyword = WORDS_AFTER_TIME.iter().any(|keyword| word.is(keyword));
        // With a sign behind it, it is a symbol.
        if (is_keyword && !behind.text.starts_with('=')) || word.is("from") {
            let problem = Problem::new(word.span(), "every repeats values that are set");
            return self.problems.push(problem.help(EVERY_FORM));
        }
        self.opening = format!("every {}", period.text);
        let (list, window) = self.window(rest);
        let (at_ms, to_ms) = window.unwrap_or((0, None));
        let repeat = Repeat { period_ms: period_ms.unwrap_or(1), to_ms };
        self.assignments(list, Times { at_ms, repeat: Some(repeat) });
    }

    fn assignment(&mut self, piece: Piece<'a>, times: Times) {
        let Some((relation, at, behind)) = sign(piece) else {
            return self.fail_list(piece, LIST_FORM);
        };
        let (name, value) = (piece.part(0..at).trim(), piece.behind(behind).trim());
        let is_told = self.is_set_by_a_word(piece, name)
            || self.is_foreign_sign(piece, "sets no value: a value is set by = alone");
        if is_told {
            return;
        }
        if sign(value).is_some() {
            return self.fail(piece, LIST_FORM);
        }
        let Some(operand) = self.operand(name) else { return };
        if relation != Relation::Equal {
            let problem = Problem::new(piece.span(), "a value is set by =");
            return self.problems.push(problem.help("only conditions compare, as in expect"));
        }
        if value.text.starts_with('"') {
            for (operand, value) in self.text(name, value, operand).unwrap_or_default() {
                self.set(name, times, operand, value);
            }
            return;
        }
        let operand = meant(value.text, operand);
        match parse_value(value.text, operand) {
            Ok(value) => self.set(name, times, operand, value),
            Err(message) if value.text.contains("..") || range::meant(value.text).is_some() => {
                self.problems
                    .push(Problem::new(value.span(), message).help("only expect takes a range"));
            }
            Err(message) => self.fail(value, message),
        }
    }

    fn set(&mut self, name: Piece<'a>, times: Times, operand: Operand, value: i32) {
        let Times { at_ms, repeat } = times;
        self.ask(name, Asked::Set(operand));
        let (for_scan, span) = (false, name.span());
        self.scenario.settings.push(Setting { at_ms, repeat, operand, value, for_scan, span });
    }

    /// `event Vote, Reset`: bits that are 1 for one scan.
    pub(super) fn events(&mut self, list: Piece<'a>, at_ms: u64) {
        for name in list.split(',') {
            let Some(operand) = self.operand(name) else { continue };
            if operand.width() != Width::Bit {
                let problem =
                    Problem::new(name.span(), format!("{}: an event is a bit", name.text));
                let help = format!("a value is set by =: {} {} = 5", self.opening, name.text);
                self.problems.push(problem.help(help));
                continue;
            }
            self.ask(name, Asked::Set(operand));
            let (repeat, value, for_scan, span) = (None, 1, true, name.span());
            self.scenario.settings.push(Setting { at_ms, repeat, operand, value, for_scan, span });
        }
    }

    /// What is no comparison of a list: perhaps a word that was misspelt.
    pub(super) fn fail_list(&mut self, piece: Piece<'a>, form: &str) {
        if !self.fail_misspelt(piece) {
            self.fail(piece, form);
        }
    }

    fn fail_misspelt(&mut self, piece: Piece<'a>) -> bool {
        let (first, rest) = piece.split_word();
        let meant = match rest.text {
            "" => None,
            _ if is_expect(first) => Some("expect"),
            _ => nearest(first.text, WORDS_AFTER_TIME),
        };
        if let Some(word) = meant {
            let problem = Problem::new(first.span(), format!("unknown word {}", first.text));
            self.problems.push(problem.did_you_mean(Some(word)));
        }
        meant.is_some()
    }

    pub(super) fn operand(&mut self, name: Piece<'a>) -> Option<Operand> {
        if name.text.is_empty() {
            self.fail(name, "an operand is missing");
            return None;
        }
        match Operand::parse(name.text, self.context.symbols) {
            Ok(operand) => match (self.context.has_operand)(operand) {
                Ok(()) => {
                    self.operand_spans.push(name.span());
                    return Some(operand);
                }
                Err(error) => self.fail(name, error.to_string()),
            },
            Err(_) if self.fail_misspelt(name) => {}
            Err(error) => self
                .problems
                .push(Problem::new(name.span(), error.message).did_you_mean(error.suggestion)),
        }
        None
    }

    /// A string is its length and its characters, byte by byte from the operand on.
    fn text(
        &mut self,
        name: Piece<'a>,
        value: Piece<'a>,
        operand: Operand,
    ) -> Option<Vec<(Operand, i32)>> {
        let Operand::At(Address::Byte { area, byte }) = operand else {
            self.fail(value, format!("a string is in bytes, and {operand} is none"));
            return None;
        };
        let bytes = match text_bytes(value.text) {
            Ok(bytes) if bytes.len() <= TEXT_MAX => bytes,
            Ok(_) => {
                self.fail(value, format!("a string has at most {TEXT_MAX} characters"));
                return None;
            }
            Err(message) => {
                self.fail(value, message);
                return None;
            }
        };
        let mut cells = Vec::new();
        for (byte, value) in (byte..).zip([bytes.len() as u8].into_iter().chain(bytes)) {
            let operand = Operand::At(Address::Byte { area, byte });
            if let Err(error) = (self.context.has_operand)(operand) {
                self.fail(name, error.to_string());
                return None;
            }
            cells.push((operand, i32::from(value)));
        }
        Some(cells)
    }

    /// A string in a condition: its bytes, of which the first has the name as written.
    pub(super) fn text_comparison(
        &mut self,
        name: Piece<'a>,
        value: Piece<'a>,
        operand: Operand,
    ) -> Option<Vec<Comparison>> {
        let cells = self.text(name, value, operand)?;
        let comparison = |(index, (operand, value)): (usize, (Operand, i32))| {
            let name = if index == 0 { name.text.to_string() } else { operand.to_string() };
            Comparison { operand, name, relation: Relation::Equal, values: value..=value }
        };
        Some(cells.into_iter().enumerate().map(comparison).collect())
    }
}
