//! Which statements can hang on the power flow of a condition: those that boxes alone execute.

use super::Generator;
use super::values::has_instructions;
use super::writer::Storage;
use crate::model::{
    BinaryOperator, Expression, ExpressionKind, Function, Place, Statement, StatementKind, Step,
    Type,
};

/// Boxes that hang on a condition at most; more are jumped over.
const WEIGHT_MAX: usize = 8;
/// Conditions in each other at most.
const LEVELS_MAX: usize = 2;

impl Generator<'_> {
    /// Whether statements can hang on power flow.
    pub(super) fn are_simple(&self, bodies: &[&[Statement]], level: usize) -> bool {
        let weights: Option<Vec<usize>> =
            bodies.iter().map(|body| self.weight(body, level)).collect();
        weights.is_some_and(|weights| weights.iter().sum::<usize>() <= WEIGHT_MAX)
    }

    /// How many boxes; `None` where there is more than boxes.
    fn weight(&self, body: &[Statement], level: usize) -> Option<usize> {
        let weights = body.iter().map(|one| self.weight_of(one, level));
        weights.sum()
    }

    fn weight_of(&self, statement: &Statement, level: usize) -> Option<usize> {
        match &statement.kind {
            StatementKind::Assign(place, value) => self.weight_of_assignment(place, value),
            StatementKind::If(arms, otherwise) if level < LEVELS_MAX => {
                let mut sum = 1 + self.weight(otherwise, level + 1)?;
                for (condition, body) in arms {
                    if !self.is_plain(condition) {
                        return None;
                    }
                    sum += 1 + self.weight(body, level + 1)?;
                }
                Some(sum)
            }
            StatementKind::AddElapsed(_) => Some(2),
            StatementKind::Exit | StatementKind::Continue | StatementKind::Return => {
                (level == 1).then_some(1)
            }
            _ => None,
        }
    }

    fn weight_of_assignment(&self, place: &Place, value: &Expression) -> Option<usize> {
        let is_text = matches!(place.of_type, Type::String(_));
        if has_computed_index(place) || !place.of_type.is_elementary() || is_text {
            return None;
        }
        if place.of_type == Type::Bool {
            let is_bit = self.locate(place).storage == Storage::Bit;
            let is_known = matches!(value.kind, ExpressionKind::Constant(_));
            return (is_bit && is_known).then_some(1);
        }
        self.boxes_of(value)
    }

    /// How many boxes compute a value; `None` where it takes more than boxes.
    fn boxes_of(&self, value: &Expression) -> Option<usize> {
        match &value.kind {
            ExpressionKind::Constant(_) => Some(1),
            ExpressionKind::Read(place) => (!has_computed_index(place)).then_some(1),
            ExpressionKind::Negate(inside) | ExpressionKind::Not(inside)
                if value.of_type != Type::Bool =>
            {
                Some(self.boxes_of(inside)? + 1)
            }
            ExpressionKind::Binary(operator, left, right)
                if !operator.is_comparison()
                    && value.of_type != Type::Bool
                    && has_instructions(&value.of_type) =>
            {
                let more = if *operator == BinaryOperator::Modulo { 4 } else { 0 };
                Some(self.boxes_of(left)? + self.boxes_of(right)? + more)
            }
            ExpressionKind::Standard(
                Function::Sqrt
                | Function::Ln
                | Function::Exp
                | Function::Sin
                | Function::Cos
                | Function::Tan,
                arguments,
            ) => Some(self.boxes_of(arguments.first()?)? + 1),
            ExpressionKind::Convert(inside) => {
                let widens = inside.of_type.widens_to(&value.of_type)
                    || inside.of_type == Type::Int && value.of_type == Type::Time;
                if widens { Some(self.boxes_of(inside)? + 3) } else { None }
            }
            _ => None,
        }
    }

    /// Whether a condition needs nothing to be computed before.
    pub(super) fn is_plain(&self, condition: &Expression) -> bool {
        match &condition.kind {
            ExpressionKind::Constant(_) => true,
            ExpressionKind::Read(place) => !has_computed_index(place),
            ExpressionKind::Not(inside) => self.is_plain(inside),
            ExpressionKind::Binary(operator, left, right) if operator.is_comparison() => {
                left.of_type != Type::Bool && self.is_operand(left) && self.is_operand(right)
            }
            ExpressionKind::Binary(BinaryOperator::And | BinaryOperator::Or, left, right) => {
                self.is_plain(left) && self.is_plain(right)
            }
            _ => false,
        }
    }

    /// Whether a value is an operand as it is.
    fn is_operand(&self, value: &Expression) -> bool {
        match &value.kind {
            ExpressionKind::Constant(_) => true,
            ExpressionKind::Read(place) => {
                !has_computed_index(place) && self.locate(place).storage == self.storage_of(value)
            }
            _ => false,
        }
    }
}

pub(super) fn has_computed_index(place: &Place) -> bool {
    place.steps.iter().any(|step| match step {
        Step::Element(indexes) => {
            indexes.iter().any(|index| !matches!(index.kind, ExpressionKind::Constant(_)))
        }
        Step::Member(_) => false,
    })
}
