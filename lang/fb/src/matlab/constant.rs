//! Initial values: what MATLAB writes for a type, a size and a value, and back. The form of the
//! value is the type.

use diagnostics::Span;
use st::parser::parse_expression;
use st::tree::{Expression, ExpressionKind};

use super::vocabulary::{class, is_real, type_of_class};
use crate::data_type::DataType;

/// What a variable begins with.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Constant {
    pub(super) of_type: DataType,
    pub(super) size: Option<u32>,
    /// As ST writes it; `None`: zero.
    pub(super) initial: Option<String>,
}

impl Constant {
    /// As MATLAB writes it; `None` for an initial value that it has no form for.
    pub(super) fn code(&self) -> Option<String> {
        let of = self.of_type;
        let mut values = match &self.initial {
            None => Vec::new(),
            Some(text) => values(text, of)?,
        };
        let count = self.size.map_or(1, |size| size as usize);
        values.resize(count, zero(of));
        let values = match self.size {
            None => values.concat(),
            Some(_) => format!("[{}]", values.join(", ")),
        };
        Some(match of {
            DataType::Int | DataType::Real | DataType::String => values,
            _ => format!("{}({values})", class(of)),
        })
    }

    /// What a value says alone; `None` where it is none.
    pub(super) fn of_code(code: &str) -> Option<Constant> {
        let (class, inside) = match code.strip_suffix(')').and_then(|code| code.split_once('(')) {
            Some((class, inside)) => (Some(type_of_class(class.trim())?), inside.trim()),
            None => (None, code),
        };
        let list = inside.strip_prefix('[').and_then(|inside| inside.strip_suffix(']'));
        let values: Vec<&str> = list.map_or(vec![inside], |list| list.split([',', ' ']).collect());
        let values: Vec<&str> =
            values.into_iter().map(str::trim).filter(|one| !one.is_empty()).collect();
        let of_type = class.or_else(|| plain_type(&values))?;
        let written: Vec<String> =
            values.iter().map(|one| in_st(one, of_type)).collect::<Option<_>>()?;
        let is_zero = values.iter().all(|one| is_zero(one));
        let size = list.map(|_| u32::try_from(values.len()).unwrap_or(u32::MAX));
        let initial = match size {
            _ if is_zero => None,
            None => Some(written.concat()),
            Some(_) => Some(format!("[{}]", written.join(", "))),
        };
        (size != Some(0)).then_some(Constant { of_type, size, initial })
    }
}

fn is_zero(value: &str) -> bool {
    value == "'_'" || value == "false" || value.parse::<f64>() == Ok(0.0)
}

fn zero(of: DataType) -> String {
    match of {
        DataType::Real => "0.0",
        DataType::String => "'_'",
        _ => "0",
    }
    .to_owned()
}

/// The type of values without a class.
fn plain_type(values: &[&str]) -> Option<DataType> {
    let first = values.first()?;
    if first.starts_with('\'') {
        return Some(DataType::String);
    }
    let is_number = values.iter().all(|one| one.parse::<f64>().is_ok());
    let has_point = values.iter().any(|one| one.contains(['.', 'e', 'E']));
    is_number.then_some(if has_point { DataType::Real } else { DataType::Int })
}

fn in_st(value: &str, of: DataType) -> Option<String> {
    match of {
        DataType::Bool => match value {
            "true" | "1" => Some("TRUE".to_owned()),
            "false" | "0" => Some("FALSE".to_owned()),
            _ => None,
        },
        DataType::String => Some(value.to_owned()),
        _ => value.parse::<f64>().is_ok().then(|| value.to_owned()),
    }
}

/// The values of an initial value, as MATLAB writes numbers.
fn values(text: &str, of: DataType) -> Option<Vec<String>> {
    let whole = Span::new(0, text.len());
    let (expression, wrong) = parse_expression(text, whole);
    if wrong.is_empty()
        && let Some(ExpressionKind::List(all)) = expression.as_ref().map(|one| &one.kind)
    {
        let mut values = Vec::new();
        for (count, one) in all {
            let value = value(one, text, of)?;
            values.extend((0..*count).take(1000).map(|_| value.clone()));
        }
        return Some(values);
    }
    // As it was written before there were lists.
    if let Some(inside) = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')) {
        let parts = inside.split(',').map(|part| {
            let (expression, _) = parse_expression(part, Span::new(0, part.len()));
            value(&expression?, part, of)
        });
        return parts.collect();
    }
    Some(vec![value(&expression?, text, of)?]).filter(|_| wrong.is_empty())
}

fn value(expression: &Expression, text: &str, of: DataType) -> Option<String> {
    Some(match &expression.kind {
        ExpressionKind::Integer(value) if of == DataType::Bool => {
            i32::from(*value != 0).to_string()
        }
        ExpressionKind::Integer(value) if of == DataType::Real => format!("{value}.0"),
        ExpressionKind::Integer(value) => value.to_string(),
        ExpressionKind::Real(value) if is_real(of) => {
            let written = expression.span.text(text);
            let is_plain = written.parse::<f64>().is_ok() && written.contains(['.', 'e', 'E']);
            if is_plain { written.to_owned() } else { format!("{value:?}") }
        }
        ExpressionKind::Bool(value) if of == DataType::Bool => i32::from(*value).to_string(),
        ExpressionKind::Duration(ms) if of == DataType::Time => ms.to_string(),
        ExpressionKind::Typed(_, inside) => value(inside, text, of)?,
        ExpressionKind::Text(bytes) if of == DataType::String => {
            let is_plain = |byte: &u8| byte.is_ascii_graphic() && !b"'_\"%".contains(byte);
            let text = String::from_utf8(bytes.clone()).ok()?;
            match text.as_str() {
                "" => "'_'".to_owned(),
                text if text.bytes().all(|byte| is_plain(&byte)) => format!("'{text}'"),
                _ => return None,
            }
        }
        _ => return None,
    })
}
