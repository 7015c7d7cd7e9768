//! Words that ST and MATLAB have for the same: types and classes, operators, functions; and the
//! words that no variable can be called by.

use st::tree::BinaryOperator;

use crate::data_type::DataType;

/// The class of a type's values. INT and both kinds of real numbers are double.
pub(super) const fn class(of: DataType) -> &'static str {
    match of {
        DataType::Bool => "logical",
        DataType::Int | DataType::Real | DataType::Lreal => "double",
        DataType::Sint => "int8",
        DataType::Dint | DataType::Time => "int32",
        DataType::Lint => "int64",
        DataType::Usint | DataType::Byte => "uint8",
        DataType::Uint | DataType::Word => "uint16",
        DataType::Udint | DataType::Dword => "uint32",
        DataType::Ulint => "uint64",
        DataType::String => "char",
    }
}

/// The type that a class alone says; `None` where it is no class.
pub(super) fn type_of_class(word: &str) -> Option<DataType> {
    Some(match word {
        "logical" => DataType::Bool,
        "double" => DataType::Lreal,
        "int8" => DataType::Sint,
        "int32" => DataType::Dint,
        "int64" => DataType::Lint,
        "uint8" => DataType::Usint,
        "uint16" => DataType::Uint,
        "uint32" => DataType::Udint,
        "uint64" => DataType::Ulint,
        _ => return None,
    })
}

pub(super) const fn is_real(of: DataType) -> bool {
    matches!(of, DataType::Real | DataType::Lreal)
}

pub(super) const fn is_bits(of: DataType) -> bool {
    matches!(of, DataType::Byte | DataType::Word | DataType::Dword)
}

/// How strongly what is written binds in MATLAB, and in ST.
pub(super) const UNARY: u8 = 9;
/// A name, a number, a call, brackets.
pub(super) const WHOLE: u8 = 11;

/// An operator in MATLAB with how strongly it binds there; `None`: a function does it.
pub(super) const fn infix(operator: BinaryOperator) -> Option<(&'static str, u8)> {
    Some(match operator {
        BinaryOperator::Or => ("||", 1),
        BinaryOperator::And => ("&&", 2),
        BinaryOperator::Equal => ("==", 5),
        BinaryOperator::NotEqual => ("~=", 5),
        BinaryOperator::Less => ("<", 5),
        BinaryOperator::Greater => (">", 5),
        BinaryOperator::LessOrEqual => ("<=", 5),
        BinaryOperator::GreaterOrEqual => (">=", 5),
        BinaryOperator::Add => ("+", 7),
        BinaryOperator::Subtract => ("-", 7),
        BinaryOperator::Multiply => ("*", 8),
        BinaryOperator::Divide => ("/", 8),
        BinaryOperator::Power => ("^", 10),
        BinaryOperator::Modulo | BinaryOperator::Xor => return None,
    })
}

/// MATLAB's operators by how strongly they bind, the weakest first, and what ST has for them. Those
/// that work on elements do the same on one.
pub(super) const LEVELS: [&[(&str, BinaryOperator)]; 7] = [
    &[("||", BinaryOperator::Or)],
    &[("&&", BinaryOperator::And)],
    &[("|", BinaryOperator::Or)],
    &[("&", BinaryOperator::And)],
    &[
        ("==", BinaryOperator::Equal),
        ("~=", BinaryOperator::NotEqual),
        ("<=", BinaryOperator::LessOrEqual),
        (">=", BinaryOperator::GreaterOrEqual),
        ("<", BinaryOperator::Less),
        (">", BinaryOperator::Greater),
    ],
    &[("+", BinaryOperator::Add), ("-", BinaryOperator::Subtract)],
    &[
        ("*", BinaryOperator::Multiply),
        (".*", BinaryOperator::Multiply),
        ("/", BinaryOperator::Divide),
        ("./", BinaryOperator::Divide),
    ],
];

/// Functions that both have: in ST, in MATLAB, and how many arguments they take.
pub(super) const FUNCTIONS: [(&str, &str, usize); 14] = [
    ("ABS", "abs", 1),
    ("SQRT", "sqrt", 1),
    ("EXP", "exp", 1),
    ("SIN", "sin", 1),
    ("COS", "cos", 1),
    ("TAN", "tan", 1),
    ("ASIN", "asin", 1),
    ("ACOS", "acos", 1),
    ("ATAN", "atan", 1),
    ("LN", "log", 1),
    ("LOG", "log10", 1),
    ("LEN", "length", 1),
    ("MIN", "min", 2),
    ("MAX", "max", 2),
];

/// Whether a function has the type of its arguments, and not REAL.
pub(super) fn keeps_type(function: &str) -> bool {
    ["ABS", "MIN", "MAX", "LIMIT", "SEL"].contains(&function)
}

/// The vectors of states, now and before, and what algorithms are to be executed.
pub(super) const NOW: &str = "E";
pub(super) const BEFORE: &str = "CE";
pub(super) const WAITING: &str = "E_ALG";
pub(super) const RUNNING: &str = "E_RUN";

/// Words of MATLAB, and functions that are called by their name.
const TAKEN: [&str; 43] = [
    "break",
    "case",
    "catch",
    "classdef",
    "continue",
    "else",
    "elseif",
    "end",
    "for",
    "function",
    "global",
    "if",
    "otherwise",
    "parfor",
    "persistent",
    "return",
    "spmd",
    "switch",
    "try",
    "while",
    "true",
    "false",
    "logical",
    "double",
    "int8",
    "int32",
    "int64",
    "uint8",
    "uint16",
    "uint32",
    "uint64",
    "cast",
    "fix",
    "rem",
    "idivide",
    "xor",
    "bitand",
    "bitor",
    "bitxor",
    "bitcmp",
    "isempty",
    "isequal",
    "fcn",
];

/// Why a name cannot be one in MATLAB.
pub(super) fn why_not(name: &str) -> Option<&'static str> {
    let is_function = FUNCTIONS.iter().any(|(_, matlab, _)| *matlab == name);
    if name.starts_with("e_") || name.starts_with("v_") {
        return Some(
            "names that begin with `e_` or `v_` are those of events and variables outside",
        );
    }
    if name.starts_with('_') {
        return Some("a name begins with a letter there");
    }
    if [NOW, BEFORE, WAITING, RUNNING].contains(&name) {
        return Some("the text keeps its states and algorithms under this name");
    }
    (is_function || TAKEN.contains(&name)).then_some("MATLAB has a word of its own that is this")
}
