//! Statements one after the other; assignments.

use super::Generator;
use super::memory::literal;
use super::simple::has_computed_index;
use super::writer::Storage;
use crate::model::{
    Expression, ExpressionKind, Place, Root, Statement, StatementKind, Step, Type, Value, Variable,
};

impl Generator<'_> {
    /// The statements of a body.
    pub(super) fn body(&mut self, statements: &[Statement]) {
        for statement in statements {
            let in_use = self.writer.in_use();
            self.begin(statement.span);
            self.statement(statement);
            self.writer.release(in_use);
        }
    }

    fn statement(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Element(element) => self.begin_element(element),
            StatementKind::AddElapsed(place) => self.add_elapsed(place),
            StatementKind::Assign(place, value) => self.assign(place, value),
            StatementKind::If(arms, otherwise) => self.if_statement(arms, otherwise),
            StatementKind::Case(selector, arms, otherwise) => {
                self.case(selector, arms, otherwise);
            }
            StatementKind::For(one) => self.for_loop(one),
            StatementKind::While(condition, body) => self.while_loop(condition, body),
            StatementKind::Repeat(body, condition) => self.repeat(body, condition),
            StatementKind::Exit | StatementKind::Continue | StatementKind::Return => {
                let label = self.target_of(&statement.kind);
                self.writer.always_jump(label);
            }
            StatementKind::Call(call) => self.block_call(call),
            StatementKind::Routine(name, arguments) => self.routine_call(name, arguments),
        }
    }

    /// The label that EXIT, CONTINUE or RETURN goes to.
    pub(super) fn target_of(&mut self, kind: &StatementKind) -> u16 {
        let innermost = self.frame.loops.last().copied();
        match (kind, innermost) {
            (StatementKind::Exit, Some((exit, _))) => exit,
            (StatementKind::Continue, Some((_, next))) => next,
            _ => match self.frame.end {
                Some(label) => label,
                None => {
                    let label = self.writer.new_label();
                    self.frame.end = Some(label);
                    label
                }
            },
        }
    }

    pub(super) fn assign(&mut self, place: &Place, value: &Expression) {
        if !place.of_type.is_elementary() {
            if let ExpressionKind::Read(from) = &value.kind {
                self.copy_whole(from, place, &place.of_type.clone());
            }
            return;
        }
        if place.of_type == Type::Bool && !has_computed_index(place) {
            let found = self.locate(place);
            if found.storage == Storage::Bit
                && let ExpressionKind::Constant(known) = &value.kind
            {
                let mnemonic = if *known == Value::Bool(true) { "S" } else { "R" };
                self.writer.boxed(mnemonic, &format!("{}, 1", found.text));
                return;
            }
        }
        self.store(place, value);
    }

    /// Copies a structure or array, member by member, element by element.
    pub(super) fn copy_whole(&mut self, from: &Place, to: &Place, kind: &Type) {
        let inner = |place: &Place, step: Step, of_type: &Type| {
            let mut place = place.clone();
            place.steps.push(step);
            place.of_type = of_type.clone();
            place
        };
        match kind {
            Type::Struct(structure) => {
                for (at, member) in structure.members.iter().enumerate() {
                    let [from, to] =
                        [from, to].map(|one| inner(one, Step::Member(at), &member.of_type));
                    self.copy_whole(&from, &to, &member.of_type);
                }
            }
            Type::Array(array) => {
                for at in 0..array.count() {
                    let indexes = indexes_of(at as i64, &array.bounds);
                    let [from, to] =
                        [from, to].map(|one| inner(one, Step::Element(indexes.clone()), &array.of));
                    self.copy_whole(&from, &to, &array.of);
                }
            }
            _ => {
                let read = ExpressionKind::Read(from.clone());
                let span = diagnostics::Span::default();
                let of_type = kind.base().clone();
                self.store(to, &Expression { kind: read, of_type, span });
            }
        }
    }

    /// Gives a variable of the unit its initial value.
    pub(super) fn initialise(&mut self, at: usize, variable: &Variable) {
        let place =
            Place { root: Root::Local(at), steps: Vec::new(), of_type: variable.of_type.clone() };
        self.initialise_place(&place, &variable.of_type, &variable.initial);
    }

    fn initialise_place(&mut self, place: &Place, kind: &Type, value: &Value) {
        match (kind, value) {
            (Type::Struct(structure), Value::List(values)) => {
                for (at, (member, value)) in structure.members.iter().zip(values).enumerate() {
                    let mut inner = place.clone();
                    inner.steps.push(Step::Member(at));
                    inner.of_type = member.of_type.clone();
                    self.initialise_place(&inner, &member.of_type, value);
                }
            }
            (Type::Array(array), Value::List(values)) => {
                for (at, value) in (0i64..).zip(values) {
                    let mut inner = place.clone();
                    inner.steps.push(Step::Element(indexes_of(at, &array.bounds)));
                    inner.of_type = array.of.clone();
                    self.initialise_place(&inner, &array.of, value);
                }
            }
            (Type::Bool, _) => {
                let found = self.locate(place);
                let is_on = *value == Value::Bool(true);
                match found.storage {
                    Storage::Bit => {
                        let mnemonic = if is_on { "S" } else { "R" };
                        self.writer.boxed(mnemonic, &format!("{}, 1", found.text));
                    }
                    _ => {
                        let text = if is_on { "1" } else { "0" };
                        self.copy(Storage::Byte, text, &found.text);
                    }
                }
            }
            (Type::Block(..) | Type::Invalid, _) => {}
            (Type::String(_), Value::Text(text)) => {
                let operands = format!("{}, {}", self.text_constant(text), self.locate(place).text);
                self.writer.boxed("SCPY", &operands);
            }
            _ => {
                let found = self.locate(place);
                self.copy(found.storage, &literal(value, kind), &found.text);
            }
        }
    }
}

/// The indexes of an element by its number in the row.
fn indexes_of(mut at: i64, bounds: &[(i64, i64)]) -> Vec<Expression> {
    let mut indexes = Vec::new();
    for (low, high) in bounds.iter().rev() {
        let size = high - low + 1;
        let kind = ExpressionKind::Constant(Value::Int(low + at % size));
        at /= size;
        indexes.push(Expression { kind, of_type: Type::Int, span: diagnostics::Span::default() });
    }
    indexes.reverse();
    indexes
}
