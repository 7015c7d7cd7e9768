//! The words of the language: what each is for, and what is written with it.

use st::model::{ELEMENTARY, Type};
use st::standard::{Standard, conversions};

/// A word with which something begins.
pub(super) struct Word {
    pub word: &'static str,
    /// What it is for.
    pub doc: &'static str,
    /// What is written; something comes in place of each `|`.
    pub template: &'static str,
}

macro_rules! words {
    ($($word:literal $doc:literal $template:literal;)+) => {
        &[$(Word { word: $word, doc: $doc, template: $template },)+]
    };
}

/// At file level.
pub(super) const FILE: &[Word] = words! {
    "PROGRAM" "runs once a scan" "PROGRAM |Main\nVAR\n    |\nEND_VAR\n\n|\nEND_PROGRAM\n";
    "FUNCTION_BLOCK" "has instances, which keep their variables"
        "FUNCTION_BLOCK |\nVAR_INPUT\n    |\nEND_VAR\nVAR_OUTPUT\n    |\nEND_VAR\n\n|\nEND_FUNCTION_BLOCK\n";
    "FUNCTION" "gives a value, and changes nothing else"
        "FUNCTION | : INT\nVAR_INPUT\n    |\nEND_VAR\n\n|\nEND_FUNCTION\n";
    "TYPE" "names types" "TYPE\n    | : |;\nEND_TYPE\n";
    "VAR_GLOBAL" "variables that all units see" "VAR_GLOBAL\n    |\nEND_VAR\n";
};

/// Before the statements of a unit.
pub(super) const SECTIONS: &[Word] = words! {
    "VAR" "variables of the unit" "VAR\n    |\nEND_VAR\n";
    "VAR_INPUT" "values that a call gives" "VAR_INPUT\n    |\nEND_VAR\n";
    "VAR_OUTPUT" "values that a call gives back" "VAR_OUTPUT\n    |\nEND_VAR\n";
    "VAR_IN_OUT" "variables that a call gives and gets back" "VAR_IN_OUT\n    |\nEND_VAR\n";
    "VAR_TEMP" "variables that begin anew in each call" "VAR_TEMP\n    |\nEND_VAR\n";
    "VAR_EXTERNAL" "global variables that are used" "VAR_EXTERNAL\n    |\nEND_VAR\n";
};

/// Where a statement begins.
pub(super) const STATEMENTS: &[Word] = words! {
    "IF" "the first condition that is TRUE chooses" "IF | THEN\n    |\nEND_IF;";
    "ELSIF" "another condition of IF" "ELSIF | THEN\n    |";
    "ELSE" "without any other choice" "ELSE\n    |";
    "CASE" "chooses by a whole number or a name" "CASE | OF\n    |:\n        |\nEND_CASE;";
    "FOR" "repeats while a variable counts" "FOR | := 1 TO | DO\n    |\nEND_FOR;";
    "WHILE" "repeats while a condition is TRUE" "WHILE | DO\n    |\nEND_WHILE;";
    "REPEAT" "repeats until a condition is TRUE" "REPEAT\n    |\nUNTIL | END_REPEAT;";
    "EXIT" "leaves the innermost loop" "EXIT;";
    "CONTINUE" "begins the next pass of the innermost loop" "CONTINUE;";
    "RETURN" "leaves the program, function or block" "RETURN;";
};

/// In types.
pub(super) const TYPES: &[Word] = words! {
    "ARRAY" "elements of one type" "ARRAY[|1..|] OF |";
    "STRUCT" "members with types of their own" "STRUCT\n    |\nEND_STRUCT";
};

/// In expressions.
pub(super) const VALUES: &[Word] = words! {
    "TRUE" "1 as a BOOL" "TRUE";
    "FALSE" "0 as a BOOL" "FALSE";
    "NOT" "the opposite of a BOOL, of each bit of a bit string" "NOT |";
    "AND" "whether both are TRUE; of bit strings each bit" "AND |";
    "OR" "whether one of them is TRUE; of bit strings each bit" "OR |";
    "XOR" "whether they differ; of bit strings each bit" "XOR |";
    "MOD" "what is left of a division" "MOD |";
};

/// Words inside of what others begin.
const MORE: &[Word] = words! {
    "THEN" "after it comes what IF and ELSIF do" "";
    "OF" "after it come the choices of CASE, or the type of an array's elements" "";
    "TO" "the last value of FOR" "";
    "BY" "the step of FOR" "";
    "DO" "after it comes what a loop repeats" "";
    "UNTIL" "the condition that ends REPEAT" "";
    "AT" "the address of a variable, `Lamp AT %Q0.0 : BOOL`" "";
    "CONSTANT" "values that are never written" "";
    "RETAIN" "values are kept without power" "";
    "NON_RETAIN" "values begin anew with power" "";
};

/// What a word of the language means, in Markdown.
pub(super) fn explained(word: &str) -> Option<String> {
    let all = [FILE, SECTIONS, STATEMENTS, TYPES, VALUES, MORE];
    let is_it = |row: &&Word| row.word.eq_ignore_ascii_case(word);
    let found = all.into_iter().flatten().find(is_it);
    // Some operators are functions, too.
    if let Some(row) = found {
        return Some(format!("**{}**: {}", row.word, row.doc));
    }
    if let Some(standard) = Standard::find(word) {
        return Some(standard_words(standard));
    }
    let upper = word.to_uppercase();
    if let Some((name, kind)) = ELEMENTARY.iter().find(|(name, _)| *name == upper) {
        return Some(format!("**{name}**: {}", type_words(kind)));
    }
    if let Some(end) = upper.strip_prefix("END_") {
        let ends = all.into_iter().flatten().any(|row| row.word == end);
        return ends.then(|| format!("**{upper}**: ends what {end} begins"));
    }
    let conversion = conversions().find(|name| *name == upper)?;
    let to = conversion.rsplit_once("TO_").map_or("", |(_, to)| to);
    Some(format!("**{conversion}**: the value as {to}; docs/structured-text.md says how"))
}

/// A standard function.
pub(super) fn standard_words(one: &Standard) -> String {
    let parameters = one.parameters.iter().map(|(name, kind)| format!("\n* {name} : {kind}"));
    let (name, doc, example) = (one.name, one.doc, one.example);
    let parameters: String = parameters.collect();
    format!("**{name}**: {doc}\n{parameters}\n* gives {}\n\n`{example}`", one.result)
}

/// What values a type has.
pub(super) fn type_words(kind: &Type) -> String {
    match (kind, kind.range()) {
        (Type::Bool, _) => "FALSE or TRUE".to_owned(),
        (Type::Real, _) => "numbers with a point, IEEE 754 single".to_owned(),
        (Type::Time, _) => "durations, `T#1m30s`, to the millisecond".to_owned(),
        (_, Some((_, high))) if kind.is_bits() => format!("bits, 0 to 16#{high:X}"),
        (_, Some((low, high))) => format!("whole numbers, {low} to {high}"),
        _ => String::new(),
    }
}
