//! The standard functions that algorithms call.

use st::tree::{BinaryOperator, UnaryOperator};

use super::value::Value;
use crate::data_type::DataType;

/// The result of a function; `None` where there is no such function of so many arguments.
pub(super) fn call(name: &str, values: &[Value]) -> Option<Value> {
    let name = name.to_uppercase();
    let operator = operators().iter().find(|(text, _)| *text == name).map(|(_, found)| *found);
    if let (Some(operator), [first, rest @ ..]) = (operator, values) {
        return Some(rest.iter().fold(*first, |left, right| left.binary(operator, *right)));
    }
    if let Some((_, to)) = name.split_once("_TO_") {
        return Some(values.first()?.converted(DataType::of(to)?));
    }
    let is_better = |operator: BinaryOperator| {
        let first = *values.first()?;
        let all = values.iter().skip(1);
        let better = |best: Value, next: &Value| match next.binary(operator, best).is_true() {
            true => *next,
            false => best,
        };
        Some(all.fold(first, better))
    };
    match (name.as_str(), values) {
        ("ABS", [value]) => Some(match value {
            Value::Real(value) => Value::Real(value.abs()),
            value if value.whole() < 0 => value.unary(UnaryOperator::Minus),
            value => *value,
        }),
        ("NOT", [value]) => Some(value.unary(UnaryOperator::Not)),
        ("MOVE", [value]) => Some(*value),
        ("MIN", _) => is_better(BinaryOperator::Less),
        ("MAX", _) => is_better(BinaryOperator::Greater),
        ("LIMIT", [low, value, high]) => {
            let value = call("MAX", &[*value, *low])?;
            call("MIN", &[value, *high])
        }
        ("SEL", [which, left, right]) => Some(if which.is_true() { *right } else { *left }),
        ("TRUNC", [value]) => Some(Value::Real(value.real().trunc()).converted(DataType::Dint)),
        (_, [value]) => of_real(&name, value.real()),
        _ => None,
    }
}

/// Functions that are operators by another name.
fn operators() -> [(&'static str, BinaryOperator); 14] {
    use BinaryOperator::*;
    [
        ("ADD", Add),
        ("SUB", Subtract),
        ("MUL", Multiply),
        ("DIV", Divide),
        ("MOD", Modulo),
        ("AND", And),
        ("OR", Or),
        ("XOR", Xor),
        ("GT", Greater),
        ("GE", GreaterOrEqual),
        ("EQ", Equal),
        ("LE", LessOrEqual),
        ("LT", Less),
        ("NE", NotEqual),
    ]
}

/// Functions of one REAL. Without a result the argument stays.
fn of_real(name: &str, value: f32) -> Option<Value> {
    let result = match name {
        "SQRT" => value.sqrt(),
        "LN" => value.ln(),
        "LOG" => value.log10(),
        "EXP" => value.exp(),
        "SIN" => value.sin(),
        "COS" => value.cos(),
        "TAN" => value.tan(),
        "ASIN" => value.asin(),
        "ACOS" => value.acos(),
        "ATAN" => value.atan(),
        _ => return None,
    };
    Some(Value::Real(if result.is_finite() { result } else { value }))
}
