//! Standard functions of ST that MATLAB does not have: they are functions at the end of the text.

use super::vocabulary::{class, is_bits};
use crate::data_type::DataType;
use crate::interpreter::range;

/// The text of a function of ST by its name; `None`: there is none here.
pub(super) fn function(name: &str) -> Option<String> {
    let (head, body) = match name {
        "LIMIT" => ("LIMIT(low, in, high)", "min(max(in, low), high)".to_owned()),
        "TRUNC" => ("TRUNC(x)", "int32(fix(x))".to_owned()),
        "SEL" => {
            let head = "function y = SEL(which, first, second)";
            let body = "if which, y = second; else, y = first; end";
            return Some(format!("{head}\n{body}\nend\n"));
        }
        _ => {
            let (from, to) = types(name)?;
            return Some(format!("function y = {name}(x)\ny = {};\nend\n", conversion(from, to)?));
        }
    };
    Some(format!("function y = {head}\ny = {body};\nend\n"))
}

/// The type of the result of a function that is called by its name.
pub(super) fn result(name: &str) -> Option<DataType> {
    match name {
        "TRUNC" => Some(DataType::Dint),
        _ => types(name).map(|(_, to)| to),
    }
}

fn types(name: &str) -> Option<(DataType, DataType)> {
    let (from, to) = name.split_once("_TO_")?;
    DataType::of(from).zip(DataType::of(to))
}

fn conversion(from: DataType, to: DataType) -> Option<String> {
    let (low, high) = range(to).unwrap_or((0, 0));
    Some(match to {
        _ if from == DataType::String || to == DataType::String => return None,
        DataType::Bool => "x ~= 0".to_owned(),
        DataType::Real | DataType::Lreal => "double(x)".to_owned(),
        _ if is_bits(to) => format!("{}(mod(double(x), {}))", class(to), high + 1),
        // The low bits with their sign.
        _ if is_bits(from) => {
            let count = high - low + 1;
            format!("{}(mod(double(x) - ({low}), {count}) + ({low}))", class(to))
        }
        DataType::Int => format!("min(max(round(double(x)), {low}), {high})"),
        _ => format!("{}(x)", class(to)),
    })
}
