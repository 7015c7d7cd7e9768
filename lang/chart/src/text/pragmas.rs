//! Pragmas: what IEC 61131-3 has no words for. Places of elements, and the elements of GRAFCET.

use awl_asm::suggest::nearest;
use diagnostics::Span;

use super::reader::Reader;
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::model::{
    Code, Forcing, Instance, Origin, Position, Situation, Step, StepKind, Transition,
};

/// The words that begin pragmas.
const WORDS: [&str; 10] =
    ["grafcet", "at", "coarse", "macro", "enclosing", "linked", "force", "if", "on", "crossing"];

/// Most evolutions in a scan that a chart can ask for.
const EVOLUTIONS_MOST: u16 = 1_000;

/// What a pragma says beside that a chart is by the rules of GRAFCET; `None`: not that.
pub(super) fn grafcet(text: &str) -> Option<&str> {
    let (word, rest) = parts(text);
    (word == "grafcet").then_some(rest)
}

fn inside(text: &str) -> &str {
    text.strip_prefix('{').and_then(|text| text.strip_suffix('}')).unwrap_or("").trim()
}

/// The first word of a pragma, in lower case, and what is after it.
fn parts(text: &str) -> (String, &str) {
    let text = inside(text);
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    (word.to_lowercase(), rest.trim())
}

/// `120 40`
fn position(rest: &str) -> Option<Position> {
    let mut numbers = rest.split([' ', ',', '\t']).filter(|part| !part.is_empty());
    let (x, y) = (numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?);
    numbers.next().is_none().then_some(Position { x, y })
}

/// Names between commas; `None` where one is empty.
fn names(rest: &str) -> Option<Vec<String>> {
    let all = rest.split(',').map(|name| name.trim().to_owned());
    let all: Vec<String> = all.collect();
    all.iter().all(|name| is_name(name)).then_some(all)
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// `G2 (S3, S4)`, `G2 ()`, `G2 *`, `G2 INIT`
fn forcing(rest: &str, span: Span) -> Option<Forcing> {
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    let (chart, rest) = rest.split_at(end);
    let rest = rest.trim();
    let situation = match rest.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        Some(list) if list.trim().is_empty() => Situation::Steps(Vec::new()),
        Some(list) => Situation::Steps(names(list)?),
        None if rest == "*" => Situation::Current,
        None if rest.eq_ignore_ascii_case("init") => Situation::Initial,
        None => return None,
    };
    let chart = Some(chart.to_owned()).filter(|name| is_name(name))?;
    Some(Forcing { chart, situation, origin: Origin(span) })
}

impl Reader<'_> {
    /// How often a chart evolves in a scan at most, as its pragma says: `{grafcet evolutions 50}`.
    pub(super) fn evolutions_max(&mut self, pragma: Span) -> Option<u16> {
        let rest = grafcet(pragma.text(self.text)).filter(|rest| !rest.is_empty())?;
        let mut words = rest.split_whitespace();
        let is_named = words.next().is_some_and(|word| word.eq_ignore_ascii_case("evolutions"));
        let number = words.next().and_then(|number| number.parse().ok());
        let number = number.filter(|_| is_named && words.next().is_none());
        let found = number.filter(|number| (1..=EVOLUTIONS_MOST).contains(number));
        if found.is_none() {
            let message = format!("{}: no number of evolutions", pragma.text(self.text));
            let help = format!(
                "a GRAFCET evolves 1 to {EVOLUTIONS_MOST} times in a scan: {{grafcet evolutions 50}}"
            );
            self.report(Diagnostic::new(ErrorCode::Pragma, pragma, message).help(help));
        }
        found
    }

    /// Gives a step, and the last instance of its block, what pragmas say.
    pub(super) fn step_pragmas(&mut self, step: &mut Step) {
        for span in std::mem::take(&mut self.pending_pragmas) {
            let (word, rest) = parts(span.text(self.text));
            let is_known = match word.as_str() {
                "at" => position(rest).map(|at| step.at = Some(at)).is_some(),
                "coarse" if rest.is_empty() => {
                    step.coarse = Some(Origin(span));
                    true
                }
                "linked" if rest.is_empty() => {
                    step.is_linked = true;
                    true
                }
                "macro" if is_name(rest) => {
                    step.kind = StepKind::Macro(rest.to_owned());
                    true
                }
                "enclosing" => {
                    names(rest).map(|names| step.kind = StepKind::Enclosing(names)).is_some()
                }
                "force" => forcing(rest, span).map(|one| step.forcings.push(one)).is_some(),
                "if" | "on" => match step.block.last_mut().filter(|_| !rest.is_empty()) {
                    Some(instance) => self.conditional(instance, &word, span, rest),
                    None => false,
                },
                _ => false,
            };
            if !is_known {
                self.unknown_pragma(span, "a step");
            }
        }
    }

    fn conditional(&mut self, instance: &mut Instance, word: &str, span: Span, rest: &str) -> bool {
        let place = if word == "if" { &mut instance.condition } else { &mut instance.event };
        let is_first = place.is_none();
        *place = Some(self.code_in(span, rest));
        is_first
    }

    /// The code at the end of a pragma.
    fn code_in(&self, span: Span, rest: &str) -> Code {
        let text = span.text(self.text);
        let start = span.start as usize + text.rfind(rest).unwrap_or(0);
        Code { text: rest.to_owned(), origin: Origin(Span::new(start, start + rest.len())) }
    }

    /// Gives a transition what pragmas say.
    pub(super) fn transition_pragmas(&mut self, transition: &mut Transition) {
        for span in std::mem::take(&mut self.pending_pragmas) {
            let (word, rest) = parts(span.text(self.text));
            let is_known = match word.as_str() {
                "at" => position(rest).map(|at| transition.at = Some(at)).is_some(),
                "crossing" if !rest.is_empty() && transition.crossing.is_none() => {
                    transition.crossing = Some(self.code_in(span, rest));
                    true
                }
                _ => false,
            };
            if !is_known {
                self.unknown_pragma(span, "a transition");
            }
        }
    }

    pub(super) fn unknown_pragma(&mut self, span: Span, of: &str) {
        let text = span.text(self.text);
        let (word, _) = parts(text);
        let message = format!("{text}: no pragma of {of}");
        let mut found = Diagnostic::new(ErrorCode::Pragma, span, message);
        if WORDS.contains(&word.as_str()) {
            found = found.help(match word.as_str() {
                "grafcet" => "{grafcet} stands before the first element of a chart",
                "at" => "a place is two whole numbers: {at 120 40}",
                "macro" => "a macro-step names the action with its chart: {macro Wash}",
                "enclosing" => "an enclosing step names charts: {enclosing G2, G3}",
                "force" => {
                    "an order names a chart and a situation: {force G2 (S3)}, {force G2 INIT}"
                }
                "if" | "on" => "{if a} and {on a} stand after an action of a step, once",
                "linked" | "coarse" => "{linked} and {coarse} belong to a step",
                _ => "{crossing Count := Count + 1;} belongs to a transition, once",
            });
        } else {
            let near = nearest(&word, WORDS).map(|near| text.replacen(&word, near, 1));
            found.suggestion = near;
        }
        self.report(found);
    }
}
