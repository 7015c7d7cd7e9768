//! Reads scenario text, line by line. Finds all errors, runs nothing.

mod actions;
mod conditions;
mod misplaced;
mod plant;
mod sign;
mod values;
mod whole;

use std::ops::Range;

use super::words::{self, names};
use super::{Asked, Context, Reading, Repeat, SCAN_MS, Scenario};
use crate::piece::{Piece, lines};
use crate::problem::Problem;
use crate::time::{TIME_MAX_MS, parse_time};
use plant::is_about_plant;

const STATEMENTS: [&str; 10] = names(&words::STATEMENTS);

const LIST_FORM: &str = "write operand = value, several separated by commas";

/// When something is expected, and in which line that is written.
#[derive(Clone, Copy)]
struct Moment {
    line: usize,
    at_ms: u64,
    /// 0: at once.
    within_ms: u64,
}

/// When a value is set.
#[derive(Clone, Copy)]
struct Times {
    at_ms: u64,
    repeat: Option<Repeat>,
}

struct Parser<'a, 'c> {
    context: Context<'c>,
    refuses: &'c dyn Fn(Asked) -> Option<String>,
    scenario: Scenario,
    problems: Vec<Problem>,
    /// Where is what is expected, parallel to those lists.
    expectation_spans: Vec<Range<usize>>,
    rule_spans: Vec<Range<usize>>,
    action_spans: Vec<Range<usize>>,
    /// Names and values of what is set in the plant.
    handling_spans: Vec<(Range<usize>, Range<usize>)>,
    plant_expectation_spans: Vec<Range<usize>>,
    operand_spans: Vec<Range<usize>>,
    seen: Vec<&'a str>,
    /// The time of the last `at`, from which relative times count.
    at_ms: u64,
    /// How the statement begins, for errors: `at 2s`, `every 500ms`.
    opening: String,
    /// The time of a wait, as other languages have it, in the line before.
    waited: Option<&'a str>,
}

pub(super) fn read<'c>(
    origin: &str,
    text: &str,
    context: Context<'c>,
    refuses: &'c dyn Fn(Asked) -> Option<String>,
) -> Reading {
    let mut parser = Parser {
        context,
        refuses,
        scenario: Scenario { origin: origin.to_string(), ..Scenario::default() },
        problems: Vec::new(),
        expectation_spans: Vec::new(),
        rule_spans: Vec::new(),
        action_spans: Vec::new(),
        handling_spans: Vec::new(),
        plant_expectation_spans: Vec::new(),
        operand_spans: Vec::new(),
        seen: Vec::new(),
        at_ms: 0,
        opening: String::new(),
        waited: None,
    };
    for (number, code) in (1..).zip(lines(text)) {
        match code.text.find("//") {
            // Programs and scenarios lie side by side, but their comments differ.
            Some(at) if !code.text[..at].contains('"') && !is_program(code) => {
                parser.fail(code.behind(at), "a comment in a scenario begins with #");
            }
            _ if code.text.is_empty() => {}
            _ => parser.statement(code, number),
        }
    }
    parser.check_times();
    parser.check_plant_inputs();
    parser.check_plant();
    parser.problems.sort_by_key(|problem| problem.span.start);
    let Parser { scenario, problems, operand_spans: operands, .. } = parser;
    Reading { scenario, problems, operands }
}

/// The plant file that a scenario names, before anything else of it can be read.
pub fn plant_file_of(text: &str) -> Option<&str> {
    let line = lines(text).find(|line| line.split_word().0.is("plant"))?;
    crate::plant::file_of(line.split_word().1.text)
}

/// The files that a scenario names as its program, before anything else of it can be read.
pub fn program_of(text: &str) -> Vec<&str> {
    let line = lines(text).find(|line| is_program(*line));
    line.map_or_else(Vec::new, |line| files(line.split_word().1))
}

fn files(list: Piece<'_>) -> Vec<&str> {
    list.split(',').into_iter().map(|file| unquoted(file.text)).collect()
}

fn is_program(line: Piece<'_>) -> bool {
    line.split_word().0.is("program")
}

fn unquoted(text: &str) -> &str {
    text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text)
}

impl<'a> Parser<'a, '_> {
    fn fail(&mut self, piece: Piece<'_>, message: impl Into<String>) {
        self.problems.push(Problem::new(piece.span(), message));
    }

    /// What the machine does not do is an error at its place.
    fn ask(&mut self, piece: Piece<'_>, asked: Asked) {
        if let Some(why) = (self.refuses)(asked) {
            self.fail(piece, why);
        }
    }

    fn statement(&mut self, code: Piece<'a>, line: usize) {
        let (word, rest) = code.split_word();
        let waited = self.waited.take();
        match word.text.to_ascii_lowercase().as_str() {
            "at" => self.at(rest, line),
            "every" => self.every(rest),
            "always" => self.rule(rest, true, line),
            "never" => self.rule(rest, false, line),
            "scan" if self.is_first(word) => self.scan(rest),
            "run" if self.is_first(word) => self.scenario.run_ms = self.lone_time(rest),
            "until" if self.is_first(word) => self.until(rest, line),
            "plant" if self.is_first(word) => self.plant(rest),
            "program" if self.is_first(word) => self.program(rest),
            "goal" if self.is_first(word) => self.goal(rest),
            "scan" | "run" | "until" | "plant" | "program" | "goal" => {}
            _ => self.unknown_statement(code, waited),
        }
    }

    /// `run` and `until` both say how the run ends: one of them is enough.
    fn is_first(&mut self, word: Piece<'a>) -> bool {
        let is_end = |word: &str| ["run", "until"].iter().any(|end| word.eq_ignore_ascii_case(end));
        let is_same = |seen: &&&str| word.is(seen) || (is_end(seen) && is_end(word.text));
        let before = self.seen.iter().find(is_same).copied();
        if let Some(before) = before {
            let article = if before.eq_ignore_ascii_case("until") { "an" } else { "a" };
            self.fail(word, format!("there is {article} {before} statement above already"));
        }
        self.seen.push(word.text);
        before.is_none()
    }

    fn program(&mut self, rest: Piece<'a>) {
        if rest.text.is_empty() {
            return self.fail(rest, "a file is missing: write program motor.awl");
        }
        let files = files(rest);
        if files.contains(&"") {
            return self.fail(rest, "a file is missing: write program main.awl, sbr0.awl");
        }
        self.scenario.program = files.into_iter().map(str::to_string).collect();
    }

    fn scan(&mut self, rest: Piece<'a>) {
        match self.lone_time(rest) {
            Some(ms) if SCAN_MS.contains(&ms) => {
                self.ask(rest, Asked::Scan(ms));
                self.scenario.scan_ms = Some(ms);
            }
            Some(_) => self.fail(rest, format!("{}: a scan takes 1ms to 60s", rest.text)),
            None => {}
        }
    }

    fn lone_time(&mut self, rest: Piece<'a>) -> Option<u64> {
        let (word, more) = rest.split_word();
        let time = self.time(word);
        if !more.text.is_empty() {
            self.fail(more, "nothing may follow the time in this statement");
        }
        time
    }

    fn time(&mut self, word: Piece<'_>) -> Option<u64> {
        if word.text.is_empty() {
            self.fail(word, "a time is missing, such as 500ms or 2s");
            return None;
        }
        parse_time(word.text).map_err(|message| self.fail(word, message)).ok()
    }

    /// The time of an `at`; `+500ms` is counted from the `at` before.
    fn at_time(&mut self, word: Piece<'a>) -> Option<u64> {
        let Some(relative) = word.text.strip_prefix('+') else { return self.time(word) };
        let at_ms = self.at_ms + self.time(word.behind(word.text.len() - relative.len()))?;
        if at_ms > TIME_MAX_MS {
            self.fail(word, "this is later than 1000 days (86400000s)");
            return None;
        }
        Some(at_ms)
    }

    fn at(&mut self, rest: Piece<'a>, line: usize) {
        let (time_word, rest) = rest.split_word();
        // With a wrong time the rest is still checked; the time is reported already.
        let at_ms = self.at_time(time_word).unwrap_or(0);
        self.at_ms = at_ms;
        self.opening = format!("at {}", time_word.text);
        let (word, after_word) = rest.split_word();
        let moment = Moment { line, at_ms, within_ms: 0 };
        let asked = [("pulse", Asked::Pulse), ("clock", Asked::Clock), ("receive", Asked::Receive)];
        if let Some((_, asked)) = asked.into_iter().find(|(name, _)| word.is(name)) {
            self.ask(word, asked);
        }
        match word.text.to_ascii_lowercase().as_str() {
            "pulse" => self.pulse(after_word, at_ms),
            "clock" => self.clock(after_word, at_ms),
            "receive" => self.receive(after_word, at_ms),
            "expect" => self.expect(after_word, moment),
            "plant" if is_about_plant(word, after_word) => {
                self.ask(word, Asked::Plant);
                self.handle(after_word, at_ms);
            }
            // With a sign behind it, it is a symbol.
            "event" if !after_word.text.starts_with('=') => self.events(after_word, at_ms),
            "within" if !after_word.text.starts_with('=') => self.within(after_word, moment),
            _ => self.assignments(rest, Times { at_ms, repeat: None }),
        }
    }
}
