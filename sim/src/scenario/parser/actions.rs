//! The statements for what happens beside values that are set: `pulse`, `clock`, `receive`, `expect
//! sent`.

use awl_asm::Address;
use plc_isa::Area;
use plc_vm::TimeOfDay;

use super::super::SentExpectation;
use super::super::value::text_bytes;
use super::Parser;
use crate::action::Action;
use crate::operand::Operand;
use crate::piece::Piece;
use crate::problem::Problem;
use crate::pulse::{FREQUENCY_MAX_HZ, Pulse};

const PULSE_FORM: &str =
    "write pulse I0.0 1000Hz for 2s, pulse I0.0 50Hz 10 times, or pulse I0.0, I0.1 500Hz for 1s";
const CLOCK_FORM: &str = "write clock 2026-11-21 15:00:00";

impl<'a> Parser<'a, '_> {
    /// `pulse I0.0 1000Hz for 2s`; with two inputs the tracks of an encoder, `reverse` for its
    /// other direction.
    pub(super) fn pulse(&mut self, rest: Piece<'a>, at_ms: u64) {
        let Some((inputs, frequency, after)) = around_frequency(rest) else {
            let problem = Problem::new(rest.span(), "a frequency such as 1000Hz is missing");
            return self.problems.push(problem.help(PULSE_FORM));
        };
        let pieces = inputs.split(',');
        let (first, second) = match pieces[..] {
            [one] => (self.input(one), None),
            [one, two] => (self.input(one), Some((two, self.input(two)))),
            _ => return self.fail(inputs, "pulses come at one input or at two"),
        };
        let millihertz = self.millihertz(frequency);
        let (length, reverse) = without_reverse(after);
        let count = self.pulse_count(length, millihertz.unwrap_or(1000));
        let (Some(mut input), Some(millihertz), Some(count)) = (first, millihertz, count) else {
            return;
        };
        let mut second = match second {
            Some((_, None)) => return,
            Some((piece, Some(second))) if second == input => {
                return self.fail(piece, "an encoder has two different inputs");
            }
            Some((_, second)) => second,
            None => None,
        };
        match (reverse, &mut second) {
            (Some(_), Some(second)) => std::mem::swap(&mut input, second),
            (Some(word), None) => {
                return self.fail(word, "only pulses at two inputs have a direction");
            }
            (None, _) => {}
        }
        self.scenario.actions.push(Action::Pulse(Pulse {
            at_ms,
            input,
            second,
            millihertz,
            count,
        }));
        self.action_spans.push(inputs.span());
    }

    /// A bit of IB0.
    fn input(&mut self, name: Piece<'a>) -> Option<u8> {
        match self.operand(name)? {
            Operand::At(Address::Bit { area: Area::I, byte: 0, bit }) => Some(bit),
            operand => {
                self.fail(
                    name,
                    format!(
                        "{operand} is none of the inputs I0.0 to I0.7, which pulses can come at"
                    ),
                );
                None
            }
        }
    }

    fn millihertz(&mut self, word: Piece<'_>) -> Option<u64> {
        let lower = word.text.to_ascii_lowercase();
        let (number, decimals) = match lower.strip_suffix("khz") {
            Some(number) => (number, 6),
            None => (lower.trim_end_matches("hz"), 3),
        };
        let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
        let fraction = fraction.trim_end_matches('0');
        let digits = format!("{whole}{fraction:0<decimals$}");
        match digits.parse::<u64>() {
            Ok(millihertz)
                if fraction.len() <= decimals
                    && (1..=FREQUENCY_MAX_HZ * 1000).contains(&millihertz) =>
            {
                Some(millihertz)
            }
            _ => {
                self.fail(
                    word,
                    format!(
                        "{}: a frequency is 0.001Hz to {}kHz",
                        word.text,
                        FREQUENCY_MAX_HZ / 1000
                    ),
                );
                None
            }
        }
    }

    /// `for 2s` or `500 times`.
    fn pulse_count(&mut self, length: Piece<'a>, millihertz: u64) -> Option<u64> {
        let (first, more) = length.split_word();
        if first.text.eq_ignore_ascii_case("for") {
            return match Pulse::count_in(millihertz, self.lone_time(more)?) {
                0 => {
                    self.fail(more, "no whole pulse fits into this time");
                    None
                }
                count => Some(count),
            };
        }
        match first.text.parse() {
            Ok(count @ 1..=1_000_000_000) if more.text.eq_ignore_ascii_case("times") => Some(count),
            _ => {
                let problem = Problem::new(length.span(), "how long the pulses last is missing");
                self.problems.push(problem.help(PULSE_FORM));
                None
            }
        }
    }

    /// `receive "text"`.
    pub(super) fn receive(&mut self, rest: Piece<'a>, at_ms: u64) {
        if let Some(bytes) = self.text_alone(rest) {
            self.scenario.actions.push(Action::Receive { at_ms, bytes });
            self.action_spans.push(rest.span());
        }
    }

    /// `sent "text"` of an `expect`.
    pub(super) fn sent(&mut self, rest: Piece<'a>, at_ms: u64, line: usize) {
        if let Some(bytes) = self.text_alone(rest) {
            self.scenario.sent.push(SentExpectation { line, at_ms, bytes });
        }
    }

    fn text_alone(&mut self, text: Piece<'a>) -> Option<Vec<u8>> {
        if !text.text.starts_with('"') {
            self.fail(text, "a text in quotes is missing");
            return None;
        }
        text_bytes(text.text).map_err(|message| self.fail(text, message)).ok()
    }

    /// `clock 2026-11-21 15:00:00`.
    pub(super) fn clock(&mut self, rest: Piece<'a>, at_ms: u64) {
        let (date, time) = rest.split_word();
        let numbers = |text: &str, separator: char| -> Option<[u8; 3]> {
            let mut parts = text.split(separator).map(str::parse);
            let three = [parts.next()?.ok()?, parts.next()?.ok()?, parts.next()?.ok()?];
            parts.next().is_none().then_some(three)
        };
        let date = date.text.strip_prefix("20").and_then(|date| numbers(date, '-'));
        let found =
            date.zip(numbers(time.text, ':')).and_then(|(date, time)| TimeOfDay::new(date, time));
        match found {
            Some(time) => {
                self.scenario.actions.push(Action::SetClock { at_ms, time });
                self.action_spans.push(rest.span());
            }
            None => {
                let problem =
                    Problem::new(rest.span(), "this is no date of 2000 to 2099 with a time");
                self.problems.push(problem.help(CLOCK_FORM));
            }
        }
    }
}

/// What is before the frequency, the frequency, and what is after it.
fn around_frequency(piece: Piece<'_>) -> Option<(Piece<'_>, Piece<'_>, Piece<'_>)> {
    let mut quoted = false;
    let mut from = 0;
    for (at, c) in piece.text.char_indices().chain([(piece.text.len(), ' ')]) {
        quoted ^= c == '"';
        if !c.is_whitespace() || quoted {
            continue;
        }
        let word = &piece.text[from..at];
        let is_frequency = word.to_ascii_lowercase().ends_with("hz")
            && word.starts_with(|c: char| c.is_ascii_digit());
        if is_frequency {
            let (before, behind) =
                (piece.part(0..from).trim(), piece.part(at..piece.text.len()).trim());
            return Some((before, piece.part(from..at), behind));
        }
        from = at + c.len_utf8().min(piece.text.len() - at);
    }
    None
}

/// The text without `reverse` at its end, and that word.
fn without_reverse(piece: Piece<'_>) -> (Piece<'_>, Option<Piece<'_>>) {
    const WORD: &str = "reverse";
    let Some(at) =
        piece.text.len().checked_sub(WORD.len()).filter(|&at| piece.text.is_char_boundary(at))
    else {
        return (piece, None);
    };
    match piece.text[at..].eq_ignore_ascii_case(WORD) {
        true => (piece.part(0..at).trim(), Some(piece.part(at..piece.text.len()))),
        false => (piece, None),
    }
}
