//! The ways through an instruction list. Where one forks, both are followed to where they meet and
//! nothing of the accumulator is asked for: what is before that is written on both.

use std::mem::{replace, take};

use chart::model::{Code, Origin};
use diagnostics::xml::Places;
use st::names::is_name;

use super::super::operand::is_operand;
use super::super::reader::{Reader, Text};
use super::instructions::{Instruction, List};
use super::value::{Value, sign};
use crate::diagnostic::Code as ErrorCode;

/// Most characters of an instruction and of an expression, and of all statements.
const LENGTH_MAX: usize = 10_000;
const WRITTEN_MAX: usize = 1_000_000;
/// Most instructions that are followed, again on each way.
const FOLLOWED_MAX: usize = 20_000;
/// How many forks can be in each other.
const DEPTH_MAX: usize = 30;
const INDENT: &str = "    ";
/// Inputs of function blocks that were operators once.
const INPUTS: [&str; 8] = ["S1", "R1", "CLK", "CU", "CD", "PV", "IN", "PT"];
const WRITE_ST: &str = "write it as Structured Text (ST) in the tool it comes from";
const UNDEFINED: &str = "begin with LD: nothing is defined at the beginning and after CAL";

/// A bracket that is open: what was before it.
struct Bracket {
    left: Value,
    sign: &'static str,
    is_negated: bool,
}

/// What is known at an instruction.
struct State {
    value: Option<Value>,
    brackets: Vec<Bracket>,
    /// Where the way ends: forks in it meet before that.
    end: usize,
}

/// Writes statements of instructions.
pub(super) struct Translator<'t, 'f> {
    reader: &'t mut Reader<'f>,
    list: &'t List,
    places: Places,
    /// Where each instruction jumps to.
    targets: Vec<Option<usize>>,
    followed: usize,
    written: usize,
    depth: usize,
    pub(super) codes: Vec<Code>,
}

impl<'t, 'f> Translator<'t, 'f> {
    /// Reports jumps that are not read.
    pub(super) fn new(reader: &'t mut Reader<'f>, list: &'t List, text: &Text) -> Self {
        let places = Places::of(&text.text, text.span, reader.file);
        let (targets, codes) = (Vec::new(), Vec::new());
        let (followed, written, depth) = (0, 0, 0);
        let mut translator =
            Translator { reader, list, places, targets, followed, written, depth, codes };
        for (name, span) in &list.twice {
            let message = format!("label {name} is there twice");
            let place = translator.places.span(*span);
            translator.reader.error(
                ErrorCode::Twice,
                place,
                message,
                "labels have different names",
            );
        }
        let end = translator.end();
        translator.targets = (0..end).map(|at| translator.target(at)).collect();
        translator
    }

    /// The end of the list, which is reported where it is too large: nothing is read then.
    fn end(&mut self) -> usize {
        let all = &self.list.instructions;
        let length = |one: &Instruction| (one.span.end - one.span.start) as usize;
        let is_long = |(at, one): (usize, _)| at >= FOLLOWED_MAX || length(one) > LENGTH_MAX;
        let Some(at) = all.iter().enumerate().position(is_long) else { return all.len() };
        self.refuse(at, "this instruction list is too large to be read".to_owned(), WRITE_ST);
        0
    }

    /// All instructions, from the first to the last.
    pub(super) fn all(&mut self) {
        if let Some(value) = self.value() {
            self.dropped(&value);
        }
    }

    /// The same; returns what is in the accumulator then.
    pub(super) fn value(&mut self) -> Option<Value> {
        let end = self.targets.len();
        let value = self.way(0, end, None);
        self.comments(end);
        value
    }

    fn target(&mut self, at: usize) -> Option<usize> {
        let one = self.list.instructions.get(at)?;
        if !matches!(one.operator.as_str(), "JMP" | "JMPC" | "JMPCN") {
            return None;
        }
        match self.list.labels.get(&one.operand.to_uppercase()) {
            Some(target) if *target > at => return Some(*target),
            Some(_) => {
                let message = format!("{}: a jump backward is not read", one.operand);
                self.refuse(at, message, "a loop in Structured Text (ST) is WHILE, REPEAT or FOR");
            }
            None => self.refuse(at, format!("there is no label `{}`", one.operand), WRITE_ST),
        }
        None
    }

    /// Reports an instruction, once.
    fn refuse(&mut self, at: usize, message: String, help: &str) {
        let Some(one) = self.list.instructions.get(at) else { return };
        let place = self.places.span(one.span);
        let is_it = |other: &crate::Diagnostic| other.span == place && other.message == message;
        if !self.reader.diagnostics.iter().any(is_it) {
            self.reader.error(ErrorCode::OtherLanguage, place, message, help);
        }
    }

    fn push(&mut self, at: usize, text: &str) {
        let span = self.list.instructions.get(at).map(|one| self.places.span(one.span));
        let text = format!("{}{text}", INDENT.repeat(self.depth));
        self.written += text.len();
        self.codes.push(Code { text, origin: Origin(span.unwrap_or_default()) });
    }

    fn comments(&mut self, at: usize) {
        let list = self.list;
        let first = list.comments.partition_point(|(before, _)| *before < at);
        let here = list.comments.get(first..).unwrap_or_default().iter();
        for (_, comment) in here.take_while(|(before, _)| *before == at) {
            for line in comment.lines().filter(|line| !line.trim().is_empty()) {
                self.push(at, &format!("// {}", line.trim()));
            }
        }
    }

    /// Reports the result of a function that nothing asks for: its call would be lost.
    fn dropped(&mut self, value: &Value) {
        if let Some(at) = value.call {
            let message = "nothing asks for the result of this call".to_owned();
            self.refuse(at, message, "store it with ST; function blocks are called with CAL");
        }
    }

    /// Follows instructions up to an end; returns what is in the accumulator there.
    fn way(&mut self, from: usize, end: usize, value: Option<Value>) -> Option<Value> {
        let list = self.list;
        let mut state = State { value, brackets: Vec::new(), end };
        let mut at = from;
        while let Some(one) = list.instructions.get(at).filter(|_| at < end) {
            self.followed += 1;
            if self.followed > FOLLOWED_MAX || self.written > WRITTEN_MAX {
                self.refuse(at, "jumps lead over each other too often".to_owned(), WRITE_ST);
                return None;
            }
            self.comments(at);
            at = self.instruction(at, one, &mut state);
        }
        if !state.brackets.is_empty() {
            let message = "a bracket is not closed before the end or a label".to_owned();
            self.refuse(at.saturating_sub(1), message, "`)` has a line of its own");
        }
        state.value
    }

    /// Follows an instruction; returns the next one.
    fn instruction(&mut self, at: usize, one: &Instruction, state: &mut State) -> usize {
        let operator = one.operator.as_str();
        match operator {
            "LD" | "LDN" => {
                let value = self.operand(at, one);
                let value = if operator == "LDN" { value.negated() } else { value };
                self.set(state, Some(value));
            }
            "NOT" if one.operand.is_empty() => {
                let value = self.asked(at, state).negated();
                state.value = Some(value);
            }
            ")" if one.operand.is_empty() => self.close(at, state),
            _ if sign(operator).is_some() => self.binary(at, one, state),
            "ST" | "STN" | "S" | "R" | "CAL" | "CALC" | "CALCN" | "JMP" | "JMPC" | "JMPCN"
            | "RET" | "RETC" | "RETCN" => return self.statement(at, one, state),
            _ if INPUTS.contains(&operator) => {
                let message = format!("{operator}: an input of a function block as an operator");
                self.refuse(at, message, "call the function block: `CAL Count(CU := Pulse)`");
            }
            _ if is_name(operator) => self.function(at, one, state),
            _ => {
                self.refuse(at, format!("`{operator}` is no operator that is read"), WRITE_ST);
            }
        }
        at + 1
    }

    fn set(&mut self, state: &mut State, value: Option<Value>) {
        if let Some(before) = replace(&mut state.value, value) {
            self.dropped(&before);
        }
    }

    fn operand(&mut self, at: usize, one: &Instruction) -> Value {
        if !is_operand(&one.operand) {
            let message = match one.operand.as_str() {
                "" => format!("{} has no operand", one.operator),
                other => format!("`{other}` is no operand that is read"),
            };
            self.refuse(at, message, "an operand is a variable, an address or a literal");
        }
        Value::primary(&one.operand)
    }

    /// What is in the accumulator, which has to be defined.
    fn asked(&mut self, at: usize, state: &mut State) -> Value {
        if let Some(value) = state.value.take() {
            return value;
        }
        if let Some(one) = self.list.instructions.get(at) {
            let message = format!("{}: what is in the accumulator is not defined", one.operator);
            self.refuse(at, message, UNDEFINED);
        }
        Value::default()
    }

    /// The same as a condition or what is stored: a call in it is not lost any more.
    fn used(&mut self, at: usize, state: &mut State) -> Value {
        Value { call: None, ..self.asked(at, state) }
    }

    fn binary(&mut self, at: usize, one: &Instruction, state: &mut State) {
        let Some((sign, is_negated)) = sign(&one.operator) else { return };
        let left = self.asked(at, state);
        if one.is_open {
            state.brackets.push(Bracket { left, sign, is_negated });
            state.value = (!one.operand.is_empty()).then(|| self.operand(at, one));
            return;
        }
        let right = self.operand(at, one);
        let right = if is_negated { right.negated() } else { right };
        self.join(at, left.with(sign, right), state);
    }

    fn close(&mut self, at: usize, state: &mut State) {
        let Some(Bracket { left, sign, is_negated }) = state.brackets.pop() else {
            return self.refuse(at, "no bracket is open here".to_owned(), "such as `AND( a`");
        };
        let right = self.asked(at, state);
        let right = if is_negated { right.negated() } else { right };
        self.join(at, left.with(sign, right), state);
    }

    /// What an operation gives, if it is not too long.
    fn join(&mut self, at: usize, value: Value, state: &mut State) {
        let is_long = value.text.len() > LENGTH_MAX;
        if is_long {
            let message = "this expression is too long to be read".to_owned();
            self.refuse(at, message, "store parts of it in variables");
        }
        state.value = Some(if is_long { Value::default() } else { value });
    }

    /// The call of a function: what is in the accumulator is its first argument, unless all of them
    /// are in brackets.
    fn function(&mut self, at: usize, one: &Instruction, state: &mut State) {
        let name = &one.word;
        let text = if one.operand.starts_with('(') {
            self.set(state, None);
            format!("{name}{}", one.operand)
        } else {
            let first = self.used(at, state);
            let mut arguments = vec![first.text];
            if !one.operand.is_empty() {
                for argument in one.operand.split(',').map(str::trim) {
                    let part = Instruction { operand: argument.to_owned(), ..one.clone() };
                    arguments.push(self.operand(at, &part).text);
                }
            }
            format!("{name}({})", arguments.join(", "))
        };
        self.join(at, Value { call: Some(at), ..Value::primary(&text) }, state);
    }

    /// Follows an instruction that does more than compute; returns the next one.
    fn statement(&mut self, at: usize, one: &Instruction, state: &mut State) -> usize {
        if !state.brackets.is_empty() {
            let message = format!("{} is inside of a bracket", one.operator);
            self.refuse(at, message, "a bracket has operands and operators alone");
            return at + 1;
        }
        match one.operator.as_str() {
            "ST" | "STN" => self.store(at, one, state),
            "CAL" => {
                let call = self.call(at);
                self.push(at, &call);
                self.set(state, None);
            }
            "RET" => return self.leave(at, state),
            "RETC" | "RETCN" => {
                let value = self.used(at, state);
                let is_taken = one.operator == "RETC";
                match value.constant() {
                    Some(known) if known == is_taken => return self.leave(at, state),
                    Some(_) => {}
                    None => {
                        let asked = if is_taken { value } else { value.negated() };
                        self.push(at, &format!("IF {} THEN", asked.text));
                        self.push(at, &format!("{INDENT}RETURN;"));
                        self.push(at, "END_IF;");
                    }
                }
                state.value = Some(Value::of(!is_taken));
            }
            "JMP" => return self.destination(at),
            "JMPC" | "JMPCN" => {
                let value = self.used(at, state);
                let is_taken = one.operator == "JMPC";
                if let Some(known) = value.constant() {
                    state.value = Some(value);
                    return if known == is_taken { self.destination(at) } else { at + 1 };
                }
                let target = self.destination(at);
                let next = if is_taken { [target, at + 1] } else { [at + 1, target] };
                return self.fork(at, &value, [Vec::new(), Vec::new()], next, state);
            }
            _ => return self.conditional(at, state),
        }
        at + 1
    }

    /// Where a jump leads to; those that are wrong are reported already.
    fn destination(&self, at: usize) -> usize {
        self.targets.get(at).copied().flatten().unwrap_or(at + 1)
    }

    /// The end of the way.
    fn leave(&mut self, at: usize, state: &mut State) -> usize {
        self.push(at, "RETURN;");
        self.set(state, None);
        state.end
    }

    fn store(&mut self, at: usize, one: &Instruction, state: &mut State) {
        let target = self.operand(at, one);
        let value = self.used(at, state);
        let is_negated = one.operator == "STN";
        let stored = if is_negated { value.negated() } else { value };
        self.push(at, &format!("{} := {};", target.text, stored.text));
        // What was computed may have changed with what it was stored in.
        state.value = Some(if is_negated { target.negated() } else { target });
    }

    /// The call of a function block.
    fn call(&mut self, at: usize) -> String {
        let operand = self.list.instructions.get(at).map_or("", |one| one.operand.as_str());
        let (name, arguments) = operand.split_once('(').unwrap_or((operand, ")"));
        if !is_operand(name.trim()) || !arguments.ends_with(')') {
            let message = format!("`{operand}` is no call that is read");
            self.refuse(at, message, "such as `CAL Pause(IN := Start, PT := T#1s)`");
        }
        format!("{}({arguments};", name.trim())
    }

    /// Instructions after each other that ask for what is in the accumulator, as one IF: they may
    /// change what it was computed from.
    fn conditional(&mut self, first: usize, state: &mut State) -> usize {
        let list = self.list;
        let value = self.used(first, state);
        let (mut at, mut lines) = (first, [Vec::new(), Vec::new()]);
        while let Some(one) = list.instructions.get(at).filter(|_| at < state.end) {
            let (is_true, line) = match one.operator.as_str() {
                "S" => (true, format!("{} := TRUE;", self.operand(at, one).text)),
                "R" => (true, format!("{} := FALSE;", self.operand(at, one).text)),
                "CALC" => (true, self.call(at)),
                "CALCN" => (false, self.call(at)),
                _ => break,
            };
            let [when_true, when_false] = &mut lines;
            if is_true { when_true } else { when_false }.push((at, line));
            at += 1;
        }
        self.fork(first, &value, lines, [at, at], state)
    }

    /// Two ways, if what is in the accumulator is TRUE and if not: the lines that each begins with,
    /// and its next instruction. Returns where they meet.
    fn fork(
        &mut self,
        at: usize,
        value: &Value,
        lines: [Vec<(usize, String)>; 2],
        next: [usize; 2],
        state: &mut State,
    ) -> usize {
        let [first, second] = next;
        let meeting = self.meeting(first.min(second), first.max(second), state.end);
        if self.depth >= DEPTH_MAX {
            self.refuse(at, format!("more than {DEPTH_MAX} jumps over each other"), WRITE_ST);
            return meeting;
        }
        let before = take(&mut self.codes);
        self.depth += 1;
        let [when_true, when_false] = lines;
        let when_true = self.branch(when_true, first, meeting, true);
        let when_false = self.branch(when_false, second, meeting, false);
        self.depth -= 1;
        self.codes = before;
        let (value, then, other) = match when_true.is_empty() {
            true => (value.clone().negated(), when_false, when_true),
            false => (value.clone(), when_true, when_false),
        };
        if !then.is_empty() {
            self.push(at, &format!("IF {} THEN", value.text));
            self.codes.extend(then);
            if !other.is_empty() {
                self.push(at, "ELSE");
                self.codes.extend(other);
            }
            self.push(at, "END_IF;");
        }
        meeting
    }

    fn branch(
        &mut self,
        lines: Vec<(usize, String)>,
        from: usize,
        end: usize,
        value: bool,
    ) -> Vec<Code> {
        for (at, line) in lines {
            self.push(at, &line);
        }
        if let Some(value) = self.way(from, end, Some(Value::of(value))) {
            self.dropped(&value);
        }
        take(&mut self.codes)
    }

    /// Where all ways from an instruction on have met, not before `least`, and nothing is asked
    /// for that is in the accumulator.
    fn meeting(&self, from: usize, least: usize, end: usize) -> usize {
        let (mut reach, mut seen) = (least, from);
        for at in least..end {
            let passed = self.targets.get(seen..at).unwrap_or_default();
            reach = passed.iter().flatten().copied().fold(reach, usize::max);
            seen = seen.max(at);
            if at >= reach && self.is_free(at) {
                return at;
            }
        }
        end
    }

    /// Whether an instruction asks for nothing that is in the accumulator.
    fn is_free(&self, mut at: usize) -> bool {
        while let Some(one) = self.list.instructions.get(at) {
            match (one.operator.as_str(), self.targets.get(at).copied().flatten()) {
                ("JMP", Some(target)) => at = target,
                (operator, _) => {
                    return one.depth == 0 && matches!(operator, "LD" | "LDN" | "CAL" | "RET");
                }
            }
        }
        true
    }
}
