//! The standard functions as people read about them: what each takes, gives and means; the standard
//! blocks as text. The checker knows how they are computed.

use crate::model::ELEMENTARY;

/// The standard blocks, in Structured Text.
pub const BLOCKS: &str = include_str!("blocks.st");

/// A standard function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Standard {
    /// Its name.
    pub name: &'static str,
    /// Its parameters with their types, as in a declaration.
    pub parameters: &'static [(&'static str, &'static str)],
    /// The type of its result.
    pub result: &'static str,
    /// What it does.
    pub doc: &'static str,
    /// A call.
    pub example: &'static str,
}

const NUMBER: &str = "INT, DINT or REAL";
const BITS: &str = "BYTE, WORD or DWORD";
const COMMON: &str = "their common type";
const AS_IN: &str = "the type of IN";
const ANY: &str = "any elementary type";
const REAL: &[(&str, &str)] = &[("IN", "REAL")];
const TWO_NUMBERS: &[(&str, &str)] = &[("IN1", NUMBER), ("IN2", NUMBER)];
const TWO_VALUES: &[(&str, &str)] = &[("IN1", ANY), ("IN2", ANY)];
const TWO_BITS: &[(&str, &str)] = &[("IN1", "BOOL or a bit string"), ("IN2", "the same")];
const TEXT: &str = "STRING";
const TWO_TEXTS: &[(&str, &str)] = &[("IN1", TEXT), ("IN2", TEXT)];
const SHIFT: &[(&str, &str)] = &[("IN", BITS), ("N", "INT")];

macro_rules! rows {
    ($($name:ident $parameters:expr, $result:expr, $doc:literal, $example:literal;)+) => {
        &[$(Standard {
            name: stringify!($name),
            parameters: $parameters,
            result: $result,
            doc: $doc,
            example: $example,
        },)+]
    };
}

/// All but the conversions.
pub const FUNCTIONS: &[Standard] = rows! {
    ABS &[("IN", NUMBER)], AS_IN, "The value without its sign", "ABS(-5)";
    SQRT REAL, "REAL", "The square root; of a number below 0 that number", "SQRT(2.0)";
    LN REAL, "REAL", "The natural logarithm; of 0 and below the number itself", "LN(2.0)";
    LOG REAL, "REAL", "The logarithm to the base of 10; of 0 and below the number itself",
        "LOG(2.0)";
    EXP REAL, "REAL", "e to the power of IN", "EXP(1.0)";
    EXPT &[("IN1", "REAL"), ("IN2", NUMBER)], "REAL", "IN1 to the power of IN2, as `**`",
        "EXPT(2.0, 3)";
    SIN REAL, "REAL", "The sine of an angle in radians", "SIN(1.0)";
    COS REAL, "REAL", "The cosine of an angle in radians", "COS(1.0)";
    TAN REAL, "REAL", "The tangent of an angle in radians", "TAN(1.0)";
    ASIN REAL, "REAL", "The angle in radians with this sine", "ASIN(0.5)";
    ACOS REAL, "REAL", "The angle in radians with this cosine", "ACOS(0.5)";
    ATAN REAL, "REAL", "The angle in radians with this tangent", "ATAN(0.5)";
    TRUNC REAL, "DINT", "The number without what is after its point", "TRUNC(2.7)";
    MIN TWO_NUMBERS, COMMON, "The lowest of its arguments, two or more", "MIN(3, 5)";
    MAX TWO_NUMBERS, COMMON, "The highest of its arguments, two or more", "MAX(3, 5)";
    LIMIT &[("MN", NUMBER), ("IN", NUMBER), ("MX", NUMBER)], COMMON,
        "IN, but MN at least and MX at most", "LIMIT(0, 120, 100)";
    SEL &[("G", "BOOL"), ("IN0", ANY), ("IN1", "the same")], COMMON,
        "IN1 if G is TRUE, else IN0", "SEL(TRUE, 3, 5)";
    MUX &[("K", "INT"), ("IN0", ANY), ("IN1", "the same")], COMMON,
        "The argument with the number K, from 0 on; the nearest for any other K", "MUX(1, 3, 5)";
    SHL SHIFT, AS_IN, "The bits moved left by N, zeros come in", "SHL(16#1, 3)";
    SHR SHIFT, AS_IN, "The bits moved right by N, zeros come in", "SHR(16#8, 3)";
    ROL SHIFT, AS_IN, "The bits moved left by N, those that leave come in again", "ROL(16#1, 3)";
    ROR SHIFT, AS_IN, "The bits moved right by N, those that leave come in again", "ROR(16#8, 3)";
    ADD TWO_NUMBERS, COMMON, "As `+`, of two or more", "ADD(1, 2)";
    SUB TWO_NUMBERS, COMMON, "As `-`", "SUB(5, 2)";
    MUL TWO_NUMBERS, COMMON, "As `*`, of two or more", "MUL(3, 2)";
    DIV TWO_NUMBERS, COMMON, "As `/`; by zero it is IN1", "DIV(7, 2)";
    MOD TWO_NUMBERS, COMMON, "As the operator MOD: what is left of a division", "MOD(7, 2)";
    AND TWO_BITS, COMMON, "As the operator AND, of two or more", "AND(TRUE, FALSE)";
    OR TWO_BITS, COMMON, "As the operator OR, of two or more", "OR(TRUE, FALSE)";
    XOR TWO_BITS, COMMON, "As the operator XOR, of two or more", "XOR(TRUE, FALSE)";
    GT TWO_VALUES, "BOOL", "Whether each argument is above the next", "GT(3, 2)";
    GE TWO_VALUES, "BOOL", "Whether each argument is the next or above", "GE(3, 2)";
    EQ TWO_VALUES, "BOOL", "Whether all arguments are equal", "EQ(3, 3)";
    LE TWO_VALUES, "BOOL", "Whether each argument is the next or below", "LE(2, 3)";
    LT TWO_VALUES, "BOOL", "Whether each argument is below the next", "LT(2, 3)";
    NE TWO_VALUES, "BOOL", "Whether two values differ", "NE(2, 3)";
    LEN &[("IN", TEXT)], "INT", "How many characters a text has", "LEN('pump')";
    LEFT &[("IN", TEXT), ("L", "INT")], TEXT, "The first L characters", "LEFT('pump', 2)";
    RIGHT &[("IN", TEXT), ("L", "INT")], TEXT, "The last L characters", "RIGHT('pump', 2)";
    MID &[("IN", TEXT), ("L", "INT"), ("P", "INT")], TEXT,
        "L characters from position P on, which counts from 1", "MID('pump', 2, 3)";
    CONCAT TWO_TEXTS, TEXT, "One text after the other, two or more", "CONCAT('pump', ' 1')";
    INSERT &[("IN1", TEXT), ("IN2", TEXT), ("P", "INT")], TEXT, "IN1 with IN2 after position P",
        "INSERT('pump', 'lum', 1)";
    DELETE &[("IN", TEXT), ("L", "INT"), ("P", "INT")], TEXT,
        "The text without L characters from position P on", "DELETE('pump', 1, 2)";
    REPLACE &[("IN1", TEXT), ("IN2", TEXT), ("L", "INT"), ("P", "INT")], TEXT,
        "IN1 with IN2 in place of L characters from position P on", "REPLACE('pump', 'ra', 1, 2)";
    FIND TWO_TEXTS, "INT", "The first position of IN2 in IN1, 0 if it is not in it",
        "FIND('pump', 'm')";
    MOVE &[("IN", ANY)], AS_IN, "The value as it is", "MOVE(5)";
};

impl Standard {
    /// The function of a name, in any letter case.
    pub fn find(name: &str) -> Option<&'static Standard> {
        FUNCTIONS.iter().find(|one| one.name.eq_ignore_ascii_case(name))
    }
}

/// The names of all conversions from a type to another, `INT_TO_REAL`, and to one, `TO_REAL`.
pub fn conversions() -> impl Iterator<Item = String> {
    let names = || ELEMENTARY.iter().map(|(name, _)| *name);
    let pairs = names().flat_map(move |from| names().map(move |to| (from, to)));
    let pairs = pairs.filter(|(from, to)| from != to);
    let of_texts = [
        "TO_STRING",
        "INT_TO_STRING",
        "DINT_TO_STRING",
        "REAL_TO_STRING",
        "STRING_TO_INT",
        "STRING_TO_DINT",
        "STRING_TO_REAL",
    ];
    let of_texts = of_texts.into_iter().map(str::to_owned);
    let all = pairs.map(|(from, to)| format!("{from}_TO_{to}")).chain(of_texts);
    names().map(|to| format!("TO_{to}")).chain(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Around, compile};
    use diagnostics::Source;

    #[test]
    fn every_example_is_a_call() {
        for one in FUNCTIONS {
            assert!(one.example.starts_with(one.name), "{}", one.name);
            let kind = match one.result {
                "BOOL" => "BOOL",
                "REAL" => "REAL",
                "STRING" => "STRING",
                _ if one.example.contains("16#") => "WORD",
                _ if one.example.ends_with("FALSE)") => "BOOL",
                _ => "DINT",
            };
            let call = one.example;
            let text = format!("PROGRAM Main VAR x : {kind}; END_VAR\nx := {call};\nEND_PROGRAM\n");
            let compiled = compile(&[Source::new("t.st", text).unwrap()], &Around::default());
            assert!(compiled.awl.is_some(), "{call}: {:?}", compiled.diagnostics);
        }
    }
}
