//! Values, and what operators and conversions make of them, as docs/structured-text.md says: what
//! has no result leaves the left operand.

use st::tree::{BinaryOperator, UnaryOperator};

use crate::data_type::DataType;

/// A value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// BOOL
    Bool(bool),
    /// A whole number, bits or milliseconds, with their type.
    Whole(DataType, i64),
    /// REAL
    Real(f32),
    /// A literal, which takes the type of what it meets.
    Literal(i64),
}

impl Value {
    /// What a variable of a type has without an initial value.
    pub fn zero(of_type: DataType) -> Value {
        Value::Literal(0).to(of_type)
    }

    /// The number; 0 and 1 of a BOOL, the whole part of a REAL.
    pub fn whole(self) -> i64 {
        match self {
            Value::Bool(value) => value.into(),
            Value::Whole(_, value) | Value::Literal(value) => value,
            Value::Real(value) => value as i64,
        }
    }

    /// The number as a REAL.
    pub fn real(self) -> f32 {
        match self {
            Value::Real(value) => value,
            other => other.whole() as f32,
        }
    }

    /// Whether it is TRUE.
    pub fn is_true(self) -> bool {
        self.whole() != 0
    }

    /// The same value in a type that takes it.
    pub fn to(self, of_type: DataType) -> Value {
        match of_type {
            DataType::Bool => Value::Bool(self.is_true()),
            DataType::Real | DataType::Lreal => Value::Real(self.real()),
            _ => Value::Whole(of_type, self.whole()),
        }
    }

    /// What `A_TO_B` makes of it.
    pub fn converted(self, to: DataType) -> Value {
        let Some((low, high)) = range(to) else { return self.to(to) };
        if to == DataType::Bool {
            return self.to(to);
        }
        let is_number = |of: DataType| of == DataType::Time || !is_bits(of);
        match self {
            Value::Real(real) => {
                Value::Whole(to, f64::from(real.round()).clamp(low as f64, high as f64) as i64)
            }
            Value::Whole(from, value) if is_number(from) && is_number(to) => {
                Value::Whole(to, value.clamp(low, high))
            }
            other => Value::Whole(to, cut(other.whole(), low, high)),
        }
    }

    /// What an operator before it makes of it.
    pub fn unary(self, operator: UnaryOperator) -> Value {
        match (operator, self) {
            (UnaryOperator::Not, Value::Bool(value)) => Value::Bool(!value),
            (UnaryOperator::Not, Value::Whole(of, value)) => {
                let (low, high) = range(of).unwrap_or((0, 0));
                Value::Whole(of, cut(!value, low, high))
            }
            (UnaryOperator::Minus, Value::Real(value)) => Value::Real(-value),
            (UnaryOperator::Minus, Value::Literal(value)) => Value::Literal(-value),
            (UnaryOperator::Minus, Value::Whole(of, value)) => {
                Value::Whole(of, fitting(of, -value).unwrap_or(value))
            }
            (_, other) => other,
        }
    }

    /// What an operator between two makes of them.
    pub fn binary(self, operator: BinaryOperator, right: Value) -> Value {
        match (self, right) {
            (Value::Real(_), _) | (_, Value::Real(_)) => {
                of_reals(operator, self.real(), right.real())
            }
            (Value::Bool(left), _) => of_bits(operator, left, right.is_true()),
            (_, Value::Bool(right)) => of_bits(operator, self.is_true(), right),
            _ if operator == BinaryOperator::Power => of_reals(operator, self.real(), right.real()),
            _ => of_wholes(operator, self, right),
        }
    }
}

/// Lowest and highest value of a type of whole numbers.
pub fn range(of_type: DataType) -> Option<(i64, i64)> {
    Some(match of_type {
        DataType::Bool => (0, 1),
        DataType::Sint => (i8::MIN.into(), i8::MAX.into()),
        DataType::Usint | DataType::Byte => (0, u8::MAX.into()),
        DataType::Int => (i16::MIN.into(), i16::MAX.into()),
        DataType::Uint | DataType::Word => (0, u16::MAX.into()),
        DataType::Dint | DataType::Time => (i32::MIN.into(), i32::MAX.into()),
        DataType::Udint | DataType::Dword => (0, u32::MAX.into()),
        _ => return None,
    })
}

fn is_bits(of_type: DataType) -> bool {
    matches!(of_type, DataType::Byte | DataType::Word | DataType::Dword)
}

fn fitting(of_type: DataType, value: i64) -> Option<i64> {
    let (low, high) = range(of_type)?;
    (low..=high).contains(&value).then_some(value)
}

/// The low bits that a type has.
fn cut(value: i64, low: i64, high: i64) -> i64 {
    (value - low).rem_euclid(high - low + 1) + low
}

fn of_bits(operator: BinaryOperator, left: bool, right: bool) -> Value {
    Value::Bool(match operator {
        BinaryOperator::And => left && right,
        BinaryOperator::Or => left || right,
        BinaryOperator::Equal => left == right,
        _ => left != right,
    })
}

fn compared<T: PartialOrd + Copy>(operator: BinaryOperator, left: T, right: T) -> Value {
    Value::Bool(operator.compare(left, right).unwrap_or(left != right))
}

fn of_reals(operator: BinaryOperator, left: f32, right: f32) -> Value {
    let result = match operator {
        BinaryOperator::Add => left + right,
        BinaryOperator::Subtract => left - right,
        BinaryOperator::Multiply => left * right,
        BinaryOperator::Divide => left / right,
        BinaryOperator::Power => left.powf(right),
        _ => return compared(operator, left, right),
    };
    Value::Real(if result.is_finite() { result } else { left })
}

/// The type of the result: of two types the one that has all values of the other.
fn common(left: Value, right: Value) -> DataType {
    match (left, right) {
        (Value::Whole(DataType::Time, _), _) => DataType::Time,
        (Value::Whole(a, _), Value::Whole(b, _)) => match (range(a), range(b)) {
            (Some((low, high)), Some((least, most))) if least <= low && high <= most => b,
            _ => a,
        },
        (Value::Whole(of, _), _) | (_, Value::Whole(of, _)) => of,
        (left, right) => {
            let fits = |value: Value| fitting(DataType::Int, value.whole()).is_some();
            if fits(left) && fits(right) { DataType::Int } else { DataType::Dint }
        }
    }
}

fn of_wholes(operator: BinaryOperator, left: Value, right: Value) -> Value {
    let of_type = common(left, right);
    let (a, b) = (left.whole(), right.whole());
    let result = match operator {
        BinaryOperator::Add => a.checked_add(b),
        BinaryOperator::Subtract => a.checked_sub(b),
        BinaryOperator::Multiply => a.checked_mul(b),
        BinaryOperator::Divide => a.checked_div(b),
        BinaryOperator::Modulo => Some(a.checked_rem(b).unwrap_or(a)),
        BinaryOperator::And => Some(a & b),
        BinaryOperator::Or => Some(a | b),
        BinaryOperator::Xor => Some(a ^ b),
        _ => return compared(operator, a, b),
    };
    Value::Whole(of_type, result.and_then(|result| fitting(of_type, result)).unwrap_or(a))
}
