//! IF, CASE and loops: bodies that hang on power flow, and jumps over others.

use diagnostics::Span;

use super::Generator;
use super::compare::relation;
use super::logic::Logic;
use super::memory::{literal, storage};
use super::values::{has_instructions, known};
use super::writer::Storage;
use crate::check::each_assignment;
use crate::model::{
    BinaryOperator, CaseArm, Expression, ExpressionKind, ForLoop, Statement, StatementKind, Type,
    Value, each_statement,
};

/// FOR and NEXT in each other at most (docs/errors/E0011.md).
const LOOPS_MAX: usize = 8;

/// A condition and its statements.
type Arm<'s> = (Choice<'s>, &'s [Statement]);

/// What decides about an arm.
#[derive(Clone)]
enum Choice<'s> {
    /// A condition.
    If(&'s Expression),
    /// Labels of CASE, about an operand of a type.
    Labels(&'s Type, String, &'s [(i64, i64)]),
}

impl Generator<'_> {
    pub(super) fn if_statement(
        &mut self,
        arms: &[(Expression, Vec<Statement>)],
        otherwise: &[Statement],
    ) {
        let arms: Vec<Arm> =
            arms.iter().map(|(condition, body)| (Choice::If(condition), body.as_slice())).collect();
        self.arms(&arms, otherwise);
    }

    pub(super) fn case(
        &mut self,
        selector: &Expression,
        arms: &[CaseArm],
        otherwise: &[Statement],
    ) {
        if otherwise.is_empty() && arms.len() > 2 {
            self.arms_by_themselves(selector, arms);
            return;
        }
        let operand = self.operand(selector);
        let kind = &selector.of_type;
        let chosen: Vec<Arm> = arms
            .iter()
            .map(|(labels, body)| (Choice::Labels(kind, operand.clone(), labels), body.as_slice()))
            .collect();
        self.arms(&chosen, otherwise);
    }

    /// Without ELSE each arm is a rung of its own, about a selector that stays as it was.
    fn arms_by_themselves(&mut self, selector: &Expression, arms: &[CaseArm]) {
        let storage = self.storage_of(selector);
        let mut operand = self.operand(selector);
        let all_but_last = arms.split_last().map_or(&[][..], |(_, before)| before);
        if all_but_last.iter().any(|(_, body)| self.may_write(body, selector)) {
            let kept = self.writer.temporary(storage);
            self.copy(storage, &operand, &kept);
            operand = kept;
        }
        for (labels, body) in arms {
            let choice = Choice::Labels(&selector.of_type, operand.clone(), labels);
            let arm = [(choice, body.as_slice())];
            if self.are_simple(&[body], 1) {
                self.powered(&arm, &[]);
            } else {
                self.jumped(&arm, &[]);
            }
        }
    }

    /// Whether statements may change what an expression reads.
    fn may_write(&self, body: &[Statement], expression: &Expression) -> bool {
        let mut is_written = false;
        each_statement(body, &mut |statement| {
            // Blocks write global variables, subroutines whatever they like.
            let is_call =
                matches!(statement.kind, StatementKind::Call(_) | StatementKind::Routine(..));
            is_written |= is_call;
        });
        each_assignment(body, &mut |place, _| {
            is_written |= self.reads(expression, &self.locate(place).text);
        });
        is_written
    }

    fn arms(&mut self, arms: &[Arm], otherwise: &[Statement]) {
        // CASE without a label.
        if arms.is_empty() {
            return self.body(otherwise);
        }
        let bodies: Vec<&[Statement]> =
            arms.iter().map(|(_, body)| *body).chain([otherwise]).collect();
        let is_plain = arms.iter().skip(1).all(|(choice, _)| match choice {
            Choice::If(condition) => self.is_plain(condition),
            Choice::Labels(..) => true,
        });
        // Where every arm has only a few boxes, they hang on conditions one after the other.
        let are_simple = bodies.iter().all(|body| self.are_simple(&[body], 1));
        if is_plain && are_simple && bodies.len() <= 9 {
            self.powered(arms, otherwise);
        } else {
            self.jumped(arms, otherwise);
        }
    }

    fn decide(&mut self, choice: &Choice) -> Logic {
        match choice {
            Choice::If(condition) => self.lower(condition),
            Choice::Labels(kind, operand, labels) => {
                let kind = (*kind, storage(kind, false));
                let one = |word, value: i64| {
                    relation(kind, word, operand, &literal(&Value::Int(value), kind.0), Some(value))
                };
                let mut any: Vec<Logic> = labels
                    .iter()
                    .map(|&(low, high)| match low == high {
                        true => one("=", low),
                        false => Logic::All(vec![one(">=", low), one("<=", high)]),
                    })
                    .collect();
                if any.len() == 1 { any.remove(0) } else { Logic::Any(any) }
            }
        }
    }

    /// Every body hangs on the power flow of its condition, and on that none before was met.
    fn powered(&mut self, arms: &[Arm], otherwise: &[Statement]) {
        let last = arms.len() - 1;
        let place = self.writer.place();
        for (at, (choice, body)) in arms.iter().enumerate() {
            if at > 0
                && let Choice::If(condition) = choice
            {
                self.go_on(condition.span);
            }
            let logic = self.decide(choice);
            let has_more = at < last || !otherwise.is_empty();
            if at == 0 {
                self.load(&logic);
            } else {
                if has_more {
                    self.writer.logic("LPS", "", false);
                }
                self.and(&logic);
            }
            self.guarded(body, !has_more);
            if has_more {
                self.writer.go_on_at(&place);
                self.writer.logic("NOT", "", false);
                if at > 0 {
                    self.writer.logic("ALD", "", false);
                }
            }
        }
        self.guarded(otherwise, true);
        self.writer.go_on_at(&place);
        self.writer.forget();
    }

    /// Statements that hang on the top of the stack, which stays unless they are the last that do.
    fn guarded(&mut self, body: &[Statement], are_last: bool) {
        let before = self.writer.guard(true);
        for (at, statement) in body.iter().enumerate() {
            let in_use = self.writer.in_use();
            self.go_on(statement.span);
            match &statement.kind {
                StatementKind::Assign(place, value) => self.assign(place, value),
                StatementKind::If(arms, otherwise) => {
                    self.nested(arms, otherwise, are_last && at + 1 == body.len());
                }
                StatementKind::AddElapsed(place) => self.add_elapsed(place),
                kind => {
                    let label = self.target_of(kind);
                    self.writer.jump(label);
                }
            }
            self.writer.release(in_use);
        }
        self.writer.guard(before);
    }

    /// IF on power flow: the top of the stack is as before afterwards, unless nothing follows.
    fn nested(
        &mut self,
        arms: &[(Expression, Vec<Statement>)],
        otherwise: &[Statement],
        is_last: bool,
    ) {
        if !is_last {
            self.writer.logic("LPS", "", false);
        }
        let last = arms.len().saturating_sub(1);
        let place = self.writer.place();
        for (at, (condition, body)) in arms.iter().enumerate() {
            if at > 0 {
                self.go_on(condition.span);
            }
            let logic = self.lower(condition);
            let has_more = at < last || !otherwise.is_empty();
            if has_more {
                self.writer.logic("LPS", "", false);
            }
            self.and(&logic);
            self.guarded(body, is_last && !has_more);
            if has_more {
                self.writer.go_on_at(&place);
                self.writer.logic("NOT", "", false);
                self.writer.logic("ALD", "", false);
            }
        }
        self.guarded(otherwise, is_last);
        if !is_last {
            self.writer.go_on_at(&place);
            self.writer.logic("LPP", "", false);
        }
    }

    /// Bodies are jumped over where their conditions are not met.
    fn jumped(&mut self, arms: &[Arm], otherwise: &[Statement]) {
        let end = self.writer.new_label();
        let last = arms.len() - 1;
        let mut needs_end = false;
        let place = self.writer.place();
        for (at, (choice, body)) in arms.iter().enumerate() {
            let in_use = self.writer.in_use();
            if at > 0
                && let Choice::If(condition) = choice
            {
                self.begin(condition.span);
            }
            let logic = self.decide(choice);
            let has_more = at < last || !otherwise.is_empty();
            let next = if has_more { self.writer.new_label() } else { end };
            needs_end |= !has_more;
            self.jump_unless(logic, next);
            self.body(body);
            self.writer.go_on_at(&place);
            if has_more {
                if !leaves(body) {
                    self.writer.always_jump(end);
                    needs_end = true;
                }
                self.writer.label(next);
            }
            self.writer.release(in_use);
        }
        self.body(otherwise);
        self.writer.go_on_at(&place);
        if needs_end {
            self.writer.label(end);
        }
        self.writer.forget();
    }

    fn jump_unless(&mut self, logic: Logic, label: u16) {
        match logic {
            Logic::Known(true) => {}
            Logic::Known(false) => self.writer.always_jump(label),
            logic => {
                self.load(&logic.negated());
                self.writer.jump(label);
                self.writer.forget();
            }
        }
    }

    fn in_loop(&mut self, exit: u16, next: u16, body: &[Statement]) {
        let place = self.writer.place();
        self.frame.loops.push((exit, next));
        self.body(body);
        self.frame.loops.pop();
        self.writer.go_on_at(&place);
    }

    pub(super) fn while_loop(&mut self, condition: &Expression, body: &[Statement]) {
        let (start, exit) = (self.writer.new_label(), self.writer.new_label());
        self.writer.power();
        self.writer.label(start);
        let logic = self.lower(condition);
        self.jump_unless(logic, exit);
        self.in_loop(exit, start, body);
        self.writer.always_jump(start);
        self.writer.label(exit);
    }

    pub(super) fn repeat(&mut self, body: &[Statement], condition: &Expression) {
        let (start, next) = (self.writer.new_label(), self.writer.new_label());
        let exit = self.writer.new_label();
        self.writer.power();
        self.writer.label(start);
        self.in_loop(exit, next, body);
        self.begin(condition.span);
        self.writer.power();
        self.writer.label(next);
        let logic = self.lower(condition);
        self.jump_unless(logic, start);
        self.writer.label(exit);
    }

    pub(super) fn for_loop(&mut self, one: &ForLoop) {
        let found = self.locate(&one.variable);
        let storage = found.storage;
        let variable = found.text;
        if self.writer.open_loops < LOOPS_MAX && counts_by_instruction(one, storage) {
            self.for_next(one, &variable);
            return;
        }
        let to = self.first_and_last(one, storage, &variable);
        let (start, next) = (self.writer.new_label(), self.writer.new_label());
        let exit = self.writer.new_label();
        let past = if one.by > 0 { ">" } else { "<" };
        let is_entered = enters(one);
        if !is_entered {
            let kind = (one.variable.of_type.base(), storage);
            self.load(&relation(kind, past, &variable, &to, known(&one.to)));
            self.writer.jump(exit);
            self.writer.forget();
        }
        self.writer.power();
        self.writer.label(start);
        self.in_loop(exit, next, &one.body);
        self.writer.power();
        self.writer.label(next);
        self.next_pass(one, &variable, &to, storage, exit);
        self.writer.always_jump(start);
        self.writer.label(exit);
    }

    /// FOR and NEXT of the controller; the variable ends one too high there.
    fn for_next(&mut self, one: &ForLoop, variable: &str) {
        let (from, to) = (self.operand(&one.from), self.operand(&one.to));
        self.writer.boxed("FOR", &format!("{variable}, {from}, {to}"));
        self.writer.forget();
        self.writer.open_loops += 1;
        let next = self.writer.new_label();
        self.in_loop(next, next, &one.body);
        let continues = any(&one.body, &|kind| matches!(kind, StatementKind::Continue));
        if continues {
            self.writer.power();
            self.writer.label(next);
        }
        self.writer.open_loops -= 1;
        self.writer.next();
        self.writer.boxed("DECW", variable);
    }

    /// Sets the variable to its first value, and gives the last one as an operand that stays.
    fn first_and_last(&mut self, one: &ForLoop, storage: Storage, variable: &str) -> String {
        if let ExpressionKind::Constant(value) = &one.to.kind {
            self.into(&one.from, variable);
            return literal(value, &one.to.of_type);
        }
        // Both are evaluated before the variable, which they may read, is written.
        let last = self.writer.temporary(storage);
        self.into(&one.to, &last);
        self.into(&one.from, variable);
        last
    }

    /// Leaves the loop where the next value is past the end, else sets it.
    fn next_pass(&mut self, one: &ForLoop, variable: &str, to: &str, storage: Storage, exit: u16) {
        let kind = one.variable.of_type.base();
        if one.by == 1 || one.by == -1 {
            let at_end = if one.by > 0 { ">=" } else { "<=" };
            self.load(&relation((kind, storage), at_end, variable, to, known(&one.to)));
            self.writer.jump(exit);
            self.writer.forget();
            let letter = storage.letter();
            let mnemonic = if one.by > 0 { format!("INC{letter}") } else { format!("DEC{letter}") };
            self.writer.boxed(&mnemonic, variable);
            return;
        }
        let next = self.writer.temporary(storage);
        self.copy(storage, variable, &next);
        self.add_step(kind, one.by, storage, &next);
        // Where there is no such number, it stays as it was, and the end is reached.
        let past = if one.by > 0 { ">" } else { "<" };
        let is_past = relation((kind, storage), past, &next, to, known(&one.to));
        let has_none = relation((kind, storage), "=", &next, variable, None);
        self.load(&Logic::Any(vec![is_past, has_none]));
        self.writer.jump(exit);
        self.writer.forget();
        self.copy(storage, &next, variable);
    }
}

impl Generator<'_> {
    /// Adds the step of a loop, which of types without sign may be negative.
    fn add_step(&mut self, kind: &Type, by: i64, storage: Storage, to: &str) {
        if has_instructions(kind) {
            let sign = if storage == Storage::Double { 'D' } else { 'I' };
            self.writer.boxed(&format!("+{sign}"), &format!("{by}, {to}"));
            return;
        }
        let (operator, by) = match kind.is_unsigned() && by < 0 {
            true => (BinaryOperator::Subtract, -by),
            false => (BinaryOperator::Add, by),
        };
        let step = ExpressionKind::Constant(Value::Int(by));
        let step = Expression { kind: step, of_type: kind.clone(), span: Span::default() };
        let operand = self.operand(&step);
        self.operate(operator, &step, &operand, to);
    }
}

/// Whether the first pass is known to be there.
fn enters(one: &ForLoop) -> bool {
    match (&one.from.kind, &one.to.kind) {
        (ExpressionKind::Constant(Value::Int(a)), ExpressionKind::Constant(Value::Int(b))) => {
            if one.by > 0 { a <= b } else { a >= b }
        }
        _ => false,
    }
}

/// Whether a loop is one of FOR and NEXT: by one up to a number that is not the highest, and left
/// at its end alone.
fn counts_by_instruction(one: &ForLoop, storage: Storage) -> bool {
    let has_end =
        matches!(one.to.kind, ExpressionKind::Constant(Value::Int(to)) if to < i16::MAX.into());
    let is_left =
        any(&one.body, &|kind| matches!(kind, StatementKind::Exit | StatementKind::Return));
    storage == Storage::Word && one.by == 1 && enters(one) && has_end && !is_left
}

fn any(body: &[Statement], is_wanted: &dyn Fn(&StatementKind) -> bool) -> bool {
    let mut found = false;
    each_statement(body, &mut |statement| found |= is_wanted(&statement.kind));
    found
}

/// Whether nothing follows statements.
fn leaves(body: &[Statement]) -> bool {
    let last = body.last().map(|statement| &statement.kind);
    matches!(last, Some(StatementKind::Exit | StatementKind::Continue | StatementKind::Return))
}
