//! Operations on known values, as the language means them (docs/structured-text.md).

use crate::model::{BinaryOperator, Function, Type, Value};

/// An operation on two values of a type; the left one where it is not executed.
pub(crate) fn binary(operator: BinaryOperator, kind: &Type, left: &Value, right: &Value) -> Value {
    use BinaryOperator::*;
    match (left, right) {
        (Value::Bool(a), Value::Bool(b)) => Value::Bool(match operator {
            And => a & b,
            Or => a | b,
            Xor | NotEqual => a ^ b,
            Equal => a == b,
            _ => *a,
        }),
        (Value::Int(a), Value::Int(b)) => whole(operator, kind, *a, *b),
        (Value::Real(a), Value::Real(b)) => real(operator, *a, *b),
        _ => left.clone(),
    }
}

fn whole(operator: BinaryOperator, kind: &Type, a: i64, b: i64) -> Value {
    use BinaryOperator::*;
    if let Some(answer) = operator.compare(a, b) {
        return Value::Bool(answer);
    }
    let (low, high) = kind.range().unwrap_or((i64::MIN, i64::MAX));
    let executed = match operator {
        Add => a.checked_add(b),
        Subtract => a.checked_sub(b),
        Multiply => a.checked_mul(b),
        Divide => a.checked_div(b),
        Modulo => Some(if b == 0 { a } else { a % b }),
        And => Some(a & b),
        Or => Some(a | b),
        Xor => Some(a ^ b),
        _ => None,
    };
    Value::Int(executed.filter(|value| (low..=high).contains(value)).unwrap_or(a))
}

fn real(operator: BinaryOperator, a: f32, b: f32) -> Value {
    use BinaryOperator::*;
    if let Some(answer) = operator.compare(a, b) {
        return Value::Bool(answer);
    }
    let executed = match operator {
        Add => a + b,
        Subtract => a - b,
        Multiply => a * b,
        Divide if b == 0.0 => a,
        Divide => a / b,
        _ => a,
    };
    Value::Real(if executed.is_finite() { executed } else { a })
}

/// `base ** exponent` where the exponent is a whole number up to 64; the base where there is no
/// result.
pub(crate) fn power(base: f32, exponent: f32) -> Option<f32> {
    let count = exponent.abs();
    if count.fract() != 0.0 || count > 64.0 {
        return None;
    }
    let product = (0..count as u32).fold(1.0, |product, _| product * f64::from(base));
    let result = (if exponent < 0.0 { 1.0 / product } else { product }) as f32;
    Some(if result.is_finite() { result } else { base })
}

/// The opposite number; the same where there is none.
pub(crate) fn negate(kind: &Type, value: &Value) -> Value {
    match value {
        Value::Int(a) => {
            let (low, high) = kind.range().unwrap_or((i64::MIN, i64::MAX));
            Value::Int(Some(-a).filter(|b| (low..=high).contains(b)).unwrap_or(*a))
        }
        Value::Real(a) => Value::Real(-a),
        other => other.clone(),
    }
}

/// NOT.
pub(crate) fn not(kind: &Type, value: &Value) -> Value {
    match (value, kind.range()) {
        (Value::Bool(a), _) => Value::Bool(!a),
        (Value::Int(a), Some((_, high))) => Value::Int(!a & high),
        _ => value.clone(),
    }
}

/// A conversion.
pub(crate) fn convert(from: &Type, to: &Type, value: &Value) -> Value {
    match (value, to) {
        (Value::Bool(a), Type::Real) => Value::Real(f32::from(u8::from(*a))),
        (Value::Bool(a), _) => Value::Int((*a).into()),
        (Value::Int(a), Type::Bool) => Value::Bool(*a != 0),
        (Value::Real(a), Type::Bool) => Value::Bool(*a != 0.0),
        (Value::Int(a), Type::Real) => Value::Real(*a as f32),
        (Value::Real(a), _) => nearest(to, a.round() as i64),
        (Value::Int(a), _) if to.is_bits() || from.is_bits() => bits(to, *a),
        (Value::Int(a), _) => nearest(to, *a),
        (Value::List(_) | Value::Text(_), _) => value.clone(),
    }
}

fn nearest(to: &Type, value: i64) -> Value {
    let (low, high) = to.range().unwrap_or((i64::MIN, i64::MAX));
    Value::Int(value.clamp(low, high))
}

/// The low bits of a number, read as one of the target.
fn bits(to: &Type, value: i64) -> Value {
    let (low, high) = to.range().unwrap_or((i64::MIN / 2, i64::MAX / 2));
    Value::Int((value - low).rem_euclid(high - low + 1) + low)
}

/// A standard function of known values; `None` of those that are left to the program.
pub(crate) fn function(function: Function, kind: &Type, arguments: &[Value]) -> Option<Value> {
    use BinaryOperator::{Greater, Less};
    match (function, arguments) {
        (Function::Abs, [Value::Int(a)]) if *a < 0 => Some(negate(kind, &Value::Int(*a))),
        (Function::Abs, [Value::Real(a)]) => Some(Value::Real(a.abs())),
        (Function::Abs, [a]) => Some(a.clone()),
        (Function::Trunc, [Value::Real(a)]) => Some(nearest(&Type::Dint, a.trunc() as i64)),
        (Function::Sel, [Value::Bool(g), a, b]) => Some(if *g { b.clone() } else { a.clone() }),
        (Function::Min | Function::Max, [first, rest @ ..]) => {
            let relation = if function == Function::Min { Less } else { Greater };
            let best = rest.iter().fold(first, |best, next| {
                let is_better = binary(relation, kind, next, best) == Value::Bool(true);
                if is_better { next } else { best }
            });
            Some(best.clone())
        }
        _ => None,
    }
}
