//! Conditions and the statements that check them: `expect`, `within`, `always`, `never`, `until`.

use super::super::condition::{Comparison, Condition, Relation, is_order};
use super::super::value::{meant, parse_compared};
use super::super::{Asked, Expectation, Rule, Until};
use super::plant::is_about_plant;
use super::sign::sign;
use super::{LIST_FORM, Moment, Parser};
use crate::piece::Piece;
use crate::problem::Problem;
use crate::range;

const CONDITION_FORM: &str = "write operand = value, several joined by and, or";
const UNTIL_FORM: &str = "write until Q0.0 = 1 or 10s";
/// What is sent is kept until an expectation takes it, and is no value.
const SENT_FORM: &str = "what is sent is looked at by at 2s expect sent \"text\" alone";

/// `sent "text"`, which is not the symbol `sent`.
fn is_sent(piece: Piece<'_>) -> bool {
    let (word, rest) = piece.split_word();
    word.is("sent") && !rest.text.starts_with(['=', '<', '>'])
}

impl<'a> Parser<'a, '_> {
    /// What follows `expect`: conditions, or what was sent.
    pub(super) fn expect(&mut self, list: Piece<'a>, moment: Moment) {
        if list.text.is_empty() {
            return self.fail(list, format!("nothing is expected here: {LIST_FORM}"));
        }
        if self.is_time_behind(list, moment) {
            return;
        }
        for piece in list.split(',') {
            let (word, rest) = piece.split_word();
            if is_about_plant(word, rest) {
                self.ask(word, Asked::Plant);
                self.expect_plant(rest, moment);
                continue;
            }
            match (is_sent(piece), moment.within_ms) {
                (true, 0) => {
                    self.ask(piece, Asked::Sent);
                    self.sent(piece.split_word().1, moment.at_ms, moment.line);
                }
                (true, _) => self.fail(piece, SENT_FORM),
                (false, _) => self.expectation(piece, moment),
            }
        }
    }

    fn expectation(&mut self, piece: Piece<'a>, moment: Moment) {
        let Some(condition) = self.condition(piece) else { return };
        let Moment { line, at_ms, within_ms } = moment;
        let conditions = match <[_; 1]>::try_from(condition.0) {
            // Each says what is wrong with it. What has time must be true at one time.
            Ok([all]) if within_ms == 0 => {
                all.into_iter().map(|comparison| Condition(vec![vec![comparison]])).collect()
            }
            Ok([all]) => vec![Condition(vec![all])],
            Err(any) => vec![Condition(any)],
        };
        for condition in conditions {
            self.expectation_spans.push(piece.span());
            let expectation = Expectation { line, at_ms, within_ms, condition };
            self.scenario.expectations.push(expectation);
        }
    }

    /// `within 500ms expect ...`, behind the first word.
    pub(super) fn within(&mut self, rest: Piece<'a>, moment: Moment) {
        let (limit, rest) = rest.split_word();
        let Some(within_ms) = self.time(limit) else { return };
        let (word, list) = rest.split_word();
        if !word.is("expect") {
            let list = if rest.text.is_empty() { "Q0.0 = 1" } else { rest.text };
            let help = format!("write {} within {} expect {list}", self.opening, limit.text);
            return self.problems.push(Problem::new(word.span(), "expect is missing").help(help));
        }
        self.expect(list, Moment { within_ms, ..moment });
    }

    /// `always` and `never`, behind that word.
    pub(super) fn rule(&mut self, rest: Piece<'a>, wanted: bool, line: usize) {
        let (condition, window) = self.window(rest);
        let (Some(condition), Some((from_ms, to_ms))) = (self.condition(condition), window) else {
            return;
        };
        self.rule_spans.push(rest.span());
        self.scenario.rules.push(Rule { line, wanted, condition, from_ms, to_ms });
    }

    /// `until`, behind the word.
    pub(super) fn until(&mut self, rest: Piece<'a>, line: usize) {
        let mut before = rest;
        let mut limit = None;
        while let Some((_, _, last)) = before.split_after_comparison(&["or"]) {
            (before, limit) = (last, Some(last));
        }
        let limit = limit.filter(|last| sign(*last).is_none());
        let Some(limit) = limit else {
            let problem = Problem::new(rest.span(), "a time is missing at which the run ends");
            return self.problems.push(problem.help(UNTIL_FORM));
        };
        let condition = rest.part(0..limit.start - rest.start).trim();
        let condition = condition.part(0..condition.text.len() - "or".len()).trim();
        let (condition, limit_ms) = (self.condition(condition), self.lone_time(limit));
        if let (Some(condition), Some(limit_ms)) = (condition, limit_ms) {
            self.scenario.until = Some(Until { line, condition, limit_ms });
        }
    }

    /// What is before `from 1s to 5s`, and these times. Each may be missing.
    pub(super) fn window(&mut self, rest: Piece<'a>) -> (Piece<'a>, Option<(u64, Option<u64>)>) {
        let Some((before, _, _)) = rest.split_after_comparison(&["from", "to"]) else {
            return (rest, Some((0, None)));
        };
        let mut words = rest.behind(before.start + before.text.len() - rest.start).trim();
        let (mut from_ms, mut to_ms) = (Some(0), Some(None));
        let (word, after) = words.split_word();
        if word.is("from") {
            let (time, after) = after.split_word();
            from_ms = self.time(time);
            words = after;
        }
        let (word, after) = words.split_word();
        if word.is("to") {
            to_ms = self.lone_time(after).map(Some);
        } else if !word.text.is_empty() {
            self.fail(words, "nothing may follow here but to and a time");
        }
        let window = from_ms.zip(to_ms);
        if let Some((from_ms, Some(to_ms))) = window
            && to_ms <= from_ms
        {
            self.fail(after, "no scan is between these times");
            return (before, None);
        }
        (before, window)
    }

    /// Comparisons joined by `and` and `or`. All of them are read, and what is wrong is told.
    pub(super) fn condition(&mut self, piece: Piece<'a>) -> Option<Condition> {
        let mut any = vec![Vec::new()];
        let mut is_sound = true;
        let mut rest = piece;
        loop {
            let cut = rest.split_after_comparison(&["and", "or"]);
            let comparisons = self.comparison(cut.map_or(rest, |(first, _, _)| first));
            is_sound &= comparisons.is_some();
            any.last_mut()?.extend(comparisons.unwrap_or_default());
            match cut {
                Some((_, "or", behind)) => {
                    any.push(Vec::new());
                    rest = behind;
                }
                Some((_, _, behind)) => rest = behind,
                None => return is_sound.then_some(Condition(any)),
            }
        }
    }

    /// One comparison; of a string that of each of its bytes.
    fn comparison(&mut self, piece: Piece<'a>) -> Option<Vec<Comparison>> {
        let Some((relation, at, behind)) = sign(piece) else {
            self.fail_list(piece, CONDITION_FORM);
            return None;
        };
        if self.is_foreign_sign(piece, "is no sign of a comparison") {
            return None;
        }
        let (name, value) = (piece.part(0..at).trim(), piece.behind(behind).trim());
        if sign(value).is_some() {
            let is_list = piece.split(',').len() > 1;
            self.fail(piece, if is_list { CONDITION_FORM } else { LIST_FORM });
            return None;
        }
        let operand = self.operand(name)?;
        if value.text.starts_with('"') {
            if relation != Relation::Equal {
                self.fail(
                    value,
                    format!("a text is compared by = and not by {}", relation.symbol()),
                );
                return None;
            }
            return self.text_comparison(name, value, operand);
        }
        let operand = meant(value.text, operand);
        match parse_compared(value.text, relation, operand) {
            Ok(values) => {
                let name = name.text.to_string();
                Some(vec![Comparison { operand, name, relation, values }])
            }
            Err(message) => {
                let range = range::meant(value.text).filter(|_| !is_order(relation));
                let message = match range {
                    Some(_) => format!("{} is no value and no range", value.text),
                    None => message,
                };
                self.problems.push(Problem::new(value.span(), message).did_you_mean(range));
                None
            }
        }
    }
}
