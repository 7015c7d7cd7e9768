//! Values that are known at compile time: initial values, labels, bounds.

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{ExpressionKind, Type, Value};
use crate::names::Named;
use crate::tree;

impl Checker<'_> {
    /// A whole number that must be known.
    pub(super) fn constant_whole(&mut self, text: &tree::Expression) -> Option<i64> {
        let found = self.expression(text, None);
        match (&found.kind, &found.of_type) {
            (_, Type::Invalid) => None,
            (ExpressionKind::Constant(Value::Int(value)), _) => Some(*value),
            _ => {
                let message = "a constant whole number is needed here";
                self.error(Code::BadConstant, text.span, message);
                None
            }
        }
    }

    /// A value of a type that must be known.
    pub(super) fn constant(&mut self, text: &tree::Expression, wanted: &Type) -> Option<Value> {
        let found = self.value_of(text, wanted);
        match found.kind {
            ExpressionKind::Constant(value) => Some(value),
            _ if found.of_type == Type::Invalid => None,
            _ => {
                let message = "a value that is known at compile time is needed here";
                let help = "constants and what is computed from them";
                self.report(Diagnostic::new(Code::BadConstant, text.span, message).help(help));
                None
            }
        }
    }

    /// The initial value of a variable; what is not written is as in `around`. What is wrong is
    /// reported.
    pub(super) fn initial_value(
        &mut self,
        text: &tree::Expression,
        wanted: &Type,
        around: Value,
    ) -> Value {
        match (&text.kind, wanted) {
            (_, Type::Invalid) => Value::Int(0),
            (tree::ExpressionKind::List(list), Type::Array(array)) => {
                let mut values = Vec::new();
                for (count, value) in list {
                    let one = self.initial_value(value, &array.of, array.initial.clone());
                    let left = array.count().saturating_sub(values.len());
                    if *count < 0 || *count as usize > left {
                        let message = format!("the array has {} elements", array.count());
                        self.error(Code::BadConstant, value.span, message);
                        break;
                    }
                    values.extend(std::iter::repeat_n(one, *count as usize));
                }
                if let Value::List(all) = around {
                    values.extend(all.into_iter().skip(values.len()));
                }
                Value::List(values)
            }
            (tree::ExpressionKind::Members(members), Type::Struct(kind)) => {
                let mut values = match around {
                    Value::List(values) => values,
                    _ => Vec::new(),
                };
                for (name, value) in members {
                    let same =
                        |member: &crate::model::Member| upper(&member.name) == upper(&name.text);
                    let Some(at) = kind.members.iter().position(same) else {
                        let message = format!("{}: {} has no such member", name.text, kind.name);
                        self.error(Code::UnknownName, name.span, message);
                        continue;
                    };
                    let Some(member) = kind.members.get(at) else { continue };
                    let of = Named::Member(upper(&kind.name), upper(&member.name));
                    self.note(name.span, of, false);
                    let Some(slot) = values.get(at).cloned() else { continue };
                    let found = self.initial_value(value, &member.of_type, slot);
                    if let Some(slot) = values.get_mut(at) {
                        *slot = found;
                    }
                }
                Value::List(values)
            }
            (_, Type::Array(_)) => {
                let message = "the values of an array are in brackets";
                let found = Diagnostic::new(Code::WrongType, text.span, message);
                self.report(found.help("such as `[1, 2, 3(0)]`"));
                around
            }
            (_, Type::Struct(_) | Type::Block(..)) => {
                let message = "the values of a structure or instance are `(a := 1, b := 2)`";
                self.error(Code::WrongType, text.span, message);
                around
            }
            _ => self.constant(text, wanted).unwrap_or(around),
        }
    }
}
