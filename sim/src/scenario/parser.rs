//! Reads scenario text, line by line. Finds all errors, runs nothing.

mod actions;

use std::ops::Range;

use super::value::{meant, parse_value, parse_values, text_bytes};
use super::{Context, Expectation, SCAN_MS, Scenario, Setting};
use crate::action::Action;
use crate::operand::Operand;
use crate::plant::{self, Signals};
use crate::problem::{Problem, Problems};
use crate::time::{format_time, parse_time};
use awl_asm::Address;
use awl_asm::suggest::nearest;

const STATEMENTS: [&str; 4] = ["scan", "at", "run", "plant"];
/// Most characters of a string.
const TEXT_MAX: usize = 254;
/// What can follow a time beside an assignment.
const WORDS_AFTER_TIME: [&str; 4] = ["expect", "pulse", "clock", "receive"];

/// A stretch of the text that knows where it stands.
#[derive(Clone, Copy)]
struct Piece<'a> {
    text: &'a str,
    start: usize,
}

impl<'a> Piece<'a> {
    fn span(self) -> Range<usize> {
        // At least one column wide, so that there is a caret where something is missing.
        self.start..self.start + self.text.len().max(1)
    }

    fn part(self, range: Range<usize>) -> Piece<'a> {
        Piece { text: &self.text[range.clone()], start: self.start + range.start }
    }

    fn trim(self) -> Piece<'a> {
        let text = self.text.trim_start();
        let start = self.start + self.text.len() - text.len();
        Piece { text: text.trim_end(), start }
    }

    /// The first word, and what follows it; both without blanks around.
    fn split_word(self) -> (Piece<'a>, Piece<'a>) {
        let piece = self.trim();
        let end = piece.text.find(char::is_whitespace).unwrap_or(piece.text.len());
        (piece.part(0..end), piece.part(end..piece.text.len()).trim())
    }

    /// Cuts at a character that does not stand in quotes.
    fn split(self, separator: char) -> Vec<Piece<'a>> {
        let mut pieces = Vec::new();
        let (mut from, mut quoted) = (0, false);
        for (at, c) in self.text.char_indices() {
            quoted ^= c == '"';
            if c == separator && !quoted {
                pieces.push(self.part(from..at).trim());
                from = at + c.len_utf8();
            }
        }
        pieces.push(self.part(from..self.text.len()).trim());
        pieces
    }
}

struct Parser<'a, 'c> {
    context: Context<'c>,
    scenario: Scenario,
    problems: Vec<Problem>,
    /// Where the names of set operands and of expected ones stand, parallel to those lists.
    setting_spans: Vec<Range<usize>>,
    expectation_spans: Vec<Range<usize>>,
    action_spans: Vec<Range<usize>>,
    seen: Vec<&'a str>,
}

pub(super) fn parse(origin: &str, text: &str, context: Context<'_>) -> Result<Scenario, Problems> {
    let mut parser = Parser {
        context,
        scenario: Scenario { origin: origin.to_string(), ..Scenario::default() },
        problems: Vec::new(),
        setting_spans: Vec::new(),
        expectation_spans: Vec::new(),
        action_spans: Vec::new(),
        seen: Vec::new(),
    };
    let mut start = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let code = Piece { text: without_comment(line), start }.trim();
        match code.text.find("//") {
            // Programs and scenarios lie side by side, but their comments differ.
            Some(at) if !code.text[..at].contains('"') => {
                parser.fail(code.part(at..code.text.len()), "a comment in a scenario begins with #");
            }
            _ if code.text.is_empty() => {}
            _ => parser.statement(code, index + 1),
        }
        start += line.len();
    }
    parser.check_times();
    parser.check_plant_inputs();
    let mut list = parser.problems;
    if list.is_empty() {
        return Ok(parser.scenario);
    }
    list.sort_by_key(|problem| problem.span.start);
    Err(Problems { origin: origin.to_string(), text: text.to_string(), list })
}

/// The line up to a `#` that neither stands in quotes nor belongs to a number such as `16#FF`.
fn without_comment(line: &str) -> &str {
    let mut quoted = false;
    for (at, c) in line.char_indices() {
        quoted ^= c == '"';
        if c == '#' && !quoted && !is_radix_sign(line, at) {
            return &line[..at];
        }
    }
    line
}

/// Any digits before and a digit behind make it a number, so that `8#7` is an error and not an 8 with a comment.
fn is_radix_sign(line: &str, at: usize) -> bool {
    line[..at].ends_with(|c: char| c.is_ascii_digit()) && line[at + 1..].starts_with(|c: char| c.is_ascii_hexdigit())
}

/// `sent "text"`, which is not the symbol `sent`.
fn is_sent(piece: Piece<'_>) -> bool {
    let (word, rest) = piece.split_word();
    word.text.eq_ignore_ascii_case("sent") && !rest.text.starts_with('=')
}

impl<'a> Parser<'a, '_> {
    fn fail(&mut self, piece: Piece<'_>, message: impl Into<String>) {
        self.problems.push(Problem::new(piece.span(), message));
    }

    fn statement(&mut self, code: Piece<'a>, line: usize) {
        let (word, rest) = code.split_word();
        match word.text.to_ascii_lowercase().as_str() {
            "at" => self.at(rest, line),
            "scan" if self.is_first(word) => self.scan(rest),
            "run" if self.is_first(word) => self.scenario.run_ms = self.lone_time(rest),
            "plant" if self.is_first(word) => self.plant(rest),
            "scan" | "run" | "plant" => {}
            _ => {
                let problem = Problem::new(word.span(), format!("unknown statement {}", word.text));
                let problem = problem.help("the statements are scan, at, run and plant");
                self.problems.push(problem.did_you_mean(nearest(word.text, STATEMENTS)));
            }
        }
    }

    fn is_first(&mut self, word: Piece<'a>) -> bool {
        let is_first = !self.seen.iter().any(|seen| seen.eq_ignore_ascii_case(word.text));
        if !is_first {
            self.fail(word, format!("there is a {} statement above already", word.text));
        }
        self.seen.push(word.text);
        is_first
    }

    fn scan(&mut self, rest: Piece<'a>) {
        match self.lone_time(rest) {
            Some(ms) if SCAN_MS.contains(&ms) => self.scenario.scan_ms = Some(ms),
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

    fn plant(&mut self, rest: Piece<'a>) {
        match plant::parse_spec(rest.text) {
            Ok(spec) => self.scenario.plant = Some(spec),
            Err(problems) => self.problems.extend(problems.into_iter().map(|mut problem| {
                problem.span = problem.span.start + rest.start..problem.span.end + rest.start;
                problem
            })),
        }
    }

    fn at(&mut self, rest: Piece<'a>, line: usize) {
        let (time_word, rest) = rest.split_word();
        // With a wrong time the rest is still checked; the time is reported already.
        let at_ms = self.time(time_word).unwrap_or(0);
        let (word, after_word) = rest.split_word();
        match word.text.to_ascii_lowercase().as_str() {
            "pulse" => return self.pulse(after_word, at_ms),
            "clock" => return self.clock(after_word, at_ms),
            "receive" => return self.receive(after_word, at_ms),
            _ => {}
        }
        let is_expect = word.text.eq_ignore_ascii_case("expect");
        let list = if is_expect { after_word } else { rest };
        if list.text.is_empty() {
            let what = if is_expect { "expected" } else { "set" };
            return self.fail(list, format!("nothing is {what} here: write operand = value"));
        }
        for piece in list.split(',') {
            if is_expect && is_sent(piece) {
                self.sent(piece.split_word().1, at_ms, line);
            } else {
                self.assignment(piece, is_expect, at_ms, line);
            }
        }
    }

    fn assignment(&mut self, piece: Piece<'a>, is_expect: bool, at_ms: u64, line: usize) {
        let sides = piece.split('=');
        let [name, value] = sides[..] else {
            let (first, rest) = piece.split_word();
            let misspelt = if rest.text.is_empty() { None } else { nearest(first.text, WORDS_AFTER_TIME) };
            if let Some(word) = misspelt {
                let problem = Problem::new(first.span(), format!("unknown word {}", first.text));
                return self.problems.push(problem.did_you_mean(Some(word)));
            }
            return self.fail(piece, "write operand = value, several separated by commas");
        };
        let Some(operand) = self.operand(name) else { return };
        if value.text.starts_with('"') {
            return self.text(name, value, operand, is_expect, at_ms, line);
        }
        let operand = meant(value.text, operand);
        if is_expect {
            match parse_values(value.text, operand) {
                Ok(values) => {
                    let name_text = name.text.to_string();
                    self.expectation_spans.push(name.span());
                    self.scenario.expectations.push(Expectation { line, at_ms, operand, name: name_text, values });
                }
                Err(message) => self.fail(value, message),
            }
        } else {
            match parse_value(value.text, operand) {
                Ok(value) => {
                    self.setting_spans.push(name.span());
                    self.scenario.settings.push(Setting { at_ms, operand, value });
                }
                Err(message) if value.text.contains("..") => {
                    self.problems.push(Problem::new(value.span(), message).help("only expect takes a range"));
                }
                Err(message) => self.fail(value, message),
            }
        }
    }

    /// A string is its length and its characters, byte by byte from the operand on.
    fn text(&mut self, name: Piece<'a>, value: Piece<'a>, operand: Operand, is_expect: bool, at_ms: u64, line: usize) {
        let Operand::At(Address::Byte { area, byte }) = operand else {
            return self.fail(value, format!("a string stands in bytes, and {operand} is none"));
        };
        let bytes = match text_bytes(value.text) {
            Ok(bytes) if bytes.len() <= TEXT_MAX => bytes,
            Ok(_) => return self.fail(value, format!("a string has at most {TEXT_MAX} characters")),
            Err(message) => return self.fail(value, message),
        };
        for (number, value) in (byte..).zip([bytes.len() as u8].into_iter().chain(bytes)) {
            let operand = Operand::At(Address::Byte { area, byte: number });
            if let Err(error) = (self.context.has_operand)(operand) {
                return self.fail(name, error.to_string());
            }
            let value = i32::from(value);
            if is_expect {
                self.expectation_spans.push(name.span());
                let name = if number == byte { name.text.to_string() } else { operand.to_string() };
                self.scenario.expectations.push(Expectation { line, at_ms, operand, name, values: value..=value });
            } else {
                self.setting_spans.push(name.span());
                self.scenario.settings.push(Setting { at_ms, operand, value });
            }
        }
    }

    fn operand(&mut self, name: Piece<'a>) -> Option<Operand> {
        if name.text.is_empty() {
            self.fail(name, "an operand is missing");
            return None;
        }
        match Operand::parse(name.text, self.context.symbols) {
            Ok(operand) => match (self.context.has_operand)(operand) {
                Ok(()) => return Some(operand),
                Err(error) => self.fail(name, error.to_string()),
            },
            Err(error) => {
                let (first, rest) = name.split_word();
                let misspelt = if rest.text.is_empty() { None } else { nearest(first.text, WORDS_AFTER_TIME) };
                let problem = match misspelt {
                    Some(word) => {
                        Problem::new(first.span(), format!("unknown word {}", first.text)).did_you_mean(Some(word))
                    }
                    None => Problem::new(name.span(), error.message).did_you_mean(error.suggestion),
                };
                self.problems.push(problem);
            }
        }
        None
    }

    /// An expectation that the run ends before would never be checked.
    fn check_times(&mut self) {
        let Some(run_ms) = self.scenario.run_ms else { return };
        for (expectation, span) in self.scenario.expectations.iter().zip(&self.expectation_spans) {
            if expectation.at_ms > run_ms {
                let (at, run) = (format_time(expectation.at_ms), format_time(run_ms));
                let message = format!("expected at {at}, but the run ends at {run}: this would never be checked");
                self.problems.push(Problem::new(span.clone(), message));
            }
        }
    }

    /// Two drivers on one input would make its value a matter of luck.
    fn check_plant_inputs(&mut self) {
        let Some(spec) = self.context.plant.or(self.scenario.plant.as_ref()) else { return };
        let Ok(plant) = spec.build() else { return };
        let signals: Signals = plant.signals();
        for (setting, span) in self.scenario.settings.iter().zip(&self.setting_spans) {
            if signals.contain(setting.operand) {
                let message = format!("{} is driven by the plant {}", setting.operand, spec.name);
                self.problems.push(Problem::new(span.clone(), message).help("drive the inputs that the plant leaves"));
            }
        }
        for (action, span) in self.scenario.actions.iter().zip(&self.action_spans) {
            let Action::Pulse(pulse) = action else { continue };
            if (0..8).any(|input| signals.digital >> input & 1 == 1 && pulse.drives(input)) {
                let message = format!("inputs of these pulses are driven by the plant {}", spec.name);
                self.problems.push(Problem::new(span.clone(), message).help("drive the inputs that the plant leaves"));
            }
        }
    }
}
