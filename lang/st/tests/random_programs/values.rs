//! Values of the naive evaluator and what operators make of them: each operation looks at the types
//! of its operands when it gets there.

use st::tree::{BinaryOperator, UnaryOperator};

use super::texts;

/// Types of whole numbers and bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Byte,
    Word,
    Dword,
    Sint,
    Usint,
    Int,
    Uint,
    Dint,
    Udint,
    Time,
}

impl Kind {
    pub fn of(name: &str) -> Option<Kind> {
        Some(match name {
            "BYTE" => Kind::Byte,
            "WORD" => Kind::Word,
            "DWORD" => Kind::Dword,
            "SINT" => Kind::Sint,
            "USINT" => Kind::Usint,
            "INT" => Kind::Int,
            "UINT" => Kind::Uint,
            "DINT" => Kind::Dint,
            "UDINT" => Kind::Udint,
            "TIME" => Kind::Time,
            _ => return None,
        })
    }

    pub fn range(self) -> (i64, i64) {
        match self {
            Kind::Byte | Kind::Usint => (0, 0xFF),
            Kind::Word | Kind::Uint => (0, 0xFFFF),
            Kind::Dword | Kind::Udint => (0, 0xFFFF_FFFF),
            Kind::Sint => (-128, 127),
            Kind::Int => (-32768, 32767),
            Kind::Dint | Kind::Time => (-2147483648, 2147483647),
        }
    }

    pub fn is_bits(self) -> bool {
        matches!(self, Kind::Byte | Kind::Word | Kind::Dword)
    }
}

/// A value with its type.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Bool(bool),
    Number(Kind, i64),
    Real(f32),
    /// Characters of Windows-1252.
    Text(Vec<u8>),
    /// A literal that takes the type of what it meets.
    Open(i64),
}

pub fn whole(value: &Value) -> i64 {
    match value {
        Value::Number(_, value) | Value::Open(value) => *value,
        other => panic!("no whole number: {other:?}"),
    }
}

pub fn as_type(value: Value, name: &str) -> Value {
    match (name, value) {
        ("BOOL", Value::Open(value)) => Value::Bool(value != 0),
        ("REAL", Value::Open(value)) => Value::Real(value as f32),
        (_, Value::Open(value) | Value::Number(_, value)) => match Kind::of(name) {
            Some(kind) => Value::Number(kind, value),
            None => Value::Open(value),
        },
        (_, value) => value,
    }
}

pub fn unary(operator: UnaryOperator, value: Value) -> Value {
    match (operator, value) {
        (UnaryOperator::Not, Value::Bool(value)) => Value::Bool(!value),
        (UnaryOperator::Not, Value::Number(kind, value)) => {
            Value::Number(kind, kind.range().1 - value)
        }
        (UnaryOperator::Minus, Value::Real(value)) => Value::Real(-value),
        (UnaryOperator::Minus, Value::Number(kind, value)) => {
            let (low, _) = kind.range();
            Value::Number(kind, if value == low { value } else { -value })
        }
        (UnaryOperator::Minus, Value::Open(value)) => Value::Open(-value),
        other => panic!("not evaluated: {other:?}"),
    }
}

pub fn binary(operator: BinaryOperator, left: Value, right: Value) -> Value {
    use BinaryOperator::*;
    match (left, right) {
        (Value::Bool(a), Value::Bool(b)) => Value::Bool(match operator {
            And => a && b,
            Or => a || b,
            Xor | NotEqual => a != b,
            Equal => a == b,
            other => panic!("BOOL {other:?}"),
        }),
        (Value::Text(a), Value::Text(b)) => Value::Bool(match operator {
            Equal => a == b,
            NotEqual => a != b,
            other => panic!("STRING {other:?}"),
        }),
        (Value::Real(a), Value::Real(b)) => of_reals(operator, a, b),
        (Value::Real(a), b) => of_reals(operator, a, whole(&b) as f32),
        (a, Value::Real(b)) => of_reals(operator, whole(&a) as f32, b),
        (left, right) => of_numbers(operator, &left, &right),
    }
}

pub fn of_reals(operator: BinaryOperator, a: f32, b: f32) -> Value {
    use BinaryOperator::*;
    let result = match operator {
        Add => a + b,
        Subtract => a - b,
        Multiply => a * b,
        Divide if b == 0.0 => a,
        Divide => a / b,
        _ => {
            return Value::Bool(match operator {
                Less => a < b,
                Greater => a > b,
                LessOrEqual => a <= b,
                GreaterOrEqual => a >= b,
                Equal => a == b,
                _ => a != b,
            });
        }
    };
    Value::Real(if result.is_finite() { result } else { a })
}

/// The type of two whole numbers.
pub fn common(left: &Value, right: &Value) -> Kind {
    match (left, right) {
        (Value::Number(Kind::Time, _), _) => Kind::Time,
        (&Value::Number(a, _), &Value::Number(b, _)) => {
            let is_wider = (b.range().1 - b.range().0) > (a.range().1 - a.range().0);
            if is_wider { b } else { a }
        }
        (&Value::Number(a, _), _) => a,
        (_, &Value::Number(b, _)) => b,
        (a, b) => {
            let fits = |value: &Value| (-32768..=32767).contains(&whole(value));
            if fits(a) && fits(b) { Kind::Int } else { Kind::Dint }
        }
    }
}

pub fn of_numbers(operator: BinaryOperator, left: &Value, right: &Value) -> Value {
    use BinaryOperator::*;
    let kind = common(left, right);
    let (a, b) = (whole(left), whole(right));
    let result = match operator {
        Add => Some(a + b),
        Subtract => Some(a - b),
        Multiply => a.checked_mul(b),
        Divide => (b != 0).then(|| a / b),
        Modulo => (b != 0).then(|| a % b),
        And => Some(a & b),
        Or => Some(a | b),
        Xor => Some(a ^ b),
        Power => panic!("no power"),
        _ => {
            return Value::Bool(match operator {
                Less => a < b,
                Greater => a > b,
                LessOrEqual => a <= b,
                GreaterOrEqual => a >= b,
                Equal => a == b,
                _ => a != b,
            });
        }
    };
    let (low, high) = kind.range();
    Value::Number(kind, result.filter(|value| (low..=high).contains(value)).unwrap_or(a))
}

pub fn convert(value: Value, to: &str) -> Value {
    let Some(kind) = Kind::of(to) else {
        return match (to, value) {
            ("BOOL", Value::Real(value)) => Value::Bool(value != 0.0),
            ("BOOL", value) => Value::Bool(whole(&value) != 0),
            ("STRING", value) => Value::Text(whole(&value).to_string().into_bytes()),
            (_, Value::Text(text)) => Value::Real(texts::real(&text)),
            (_, Value::Bool(value)) => Value::Real(if value { 1.0 } else { 0.0 }),
            (_, value) => Value::Real(whole(&value) as f32),
        };
    };
    let (low, high) = kind.range();
    match value {
        Value::Text(text) => Value::Number(kind, texts::whole(&text, kind)),
        Value::Bool(value) => Value::Number(kind, value.into()),
        Value::Real(value) => {
            Value::Number(kind, (f64::from(value).round() as i64).clamp(low, high))
        }
        Value::Number(from, value) if from.is_bits() || kind.is_bits() => {
            let size = high - low + 1;
            let low_bits = value.rem_euclid(size);
            Value::Number(kind, if low_bits > high { low_bits - size } else { low_bits })
        }
        Value::Number(_, value) | Value::Open(value) => Value::Number(kind, value.clamp(low, high)),
    }
}

pub fn shift(name: &str, value: Value, count: i64) -> Value {
    let Value::Number(kind, bits) = value else { panic!("no bits") };
    let (_, highest) = kind.range();
    let width = 64 - highest.leading_zeros() as i64;
    let mut bits = bits;
    for _ in 0..count.clamp(0, if name.starts_with('S') { width } else { 32767 }) {
        bits = match name {
            "SHL" => bits << 1 & highest,
            "SHR" => bits >> 1,
            "ROL" => bits << 1 & highest | bits >> (width - 1),
            _ => bits >> 1 | (bits & 1) << (width - 1),
        };
    }
    Value::Number(kind, bits)
}
