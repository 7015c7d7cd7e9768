//! What is behind operands that are missing or too many: mostly the habit of a controller with
//! accumulators or with boxes. That their number is wrong is known already.

use crate::meaning::operands::NO_PULSE;
use crate::meaning::quoted::Quoted;
use crate::text::address::Address;
use crate::text::ast::{Operand, Statement, Value};
use crate::text::foreign;

/// Most contacts of a branch that are shown.
const BRANCH_MAX: usize = 8;

/// How an instruction is written that has not as many operands as it takes. `takes_real`: one of
/// them may be a real number.
pub(crate) fn way(quoted: Quoted<'_>, wanted: usize, takes_real: bool) -> Option<String> {
    of_bits(quoted)
        .or_else(|| of_branches(quoted))
        .or_else(|| of_presets(quoted))
        .or_else(|| of_values(quoted, wanted, takes_real))
}

/// The first operand if it is an address.
fn first(quoted: Quoted<'_>) -> Option<Address> {
    match quoted.source.operands.first()?.value {
        Value::Address(address) => Some(address),
        _ => None,
    }
}

/// The first operand if it is an address, or what is usual in its place.
fn first_or(quoted: Quoted<'_>, usual: &str) -> String {
    let written = first(quoted).and_then(|_| quoted.operand(0));
    written.unwrap_or_else(|| usual.to_owned())
}

/// What contacts and coils have.
fn of_bits(quoted: Quoted<'_>) -> Option<String> {
    let (name, given) = (quoted.source.mnemonic(), quoted.source.operands.len());
    if let ("SI", Some(Address::Timer(_))) = (name, first(quoted)) {
        return Some(NO_PULSE.to_owned());
    }
    match (name, given) {
        ("S" | "R" | "SI" | "RI", 1) => Some(format!(
            "the number of bits is named, too: `{name} {}, 1`",
            first_or(quoted, "Q0.0")
        )),
        ("S" | "R" | "SI" | "RI", 3..) => {
            let bits = (0..).zip(&quoted.source.operands).filter(|(_, operand)| {
                matches!(operand.value, Value::Address(Address::Bit { .. }))
            });
            let lines: Vec<String> = bits
                .filter_map(|(index, _)| Some(format!("`{name} {}, 1`", quoted.operand(index)?)))
                .collect();
            (lines.len() > 1).then(|| format!("each bit is on a line: {}", lines.join(", ")))
        }
        ("LN", 1) => first(quoted)
            .map(|_| format!("a contact that is inverted is `LDN {}`", first_or(quoted, ""))),
        ("EU" | "ED", 1..) => {
            Some(format!("`{name}` is after the contact whose edge it tells: `LD I0.0`, `{name}`"))
        }
        ("END" | "CEND", 1..) => {
            Some("leave the line out: a program ends with its last line".to_owned())
        }
        ("LD" | "LDN" | "A" | "AN" | "O" | "ON" | "LDI" | "AI" | "OI", 2) => {
            let [one, other] = quoted.operands()?.try_into().ok()?;
            Some(format!(
                "one contact is on a line: `{name} {one}`, then `A {other}` if both are needed, or \
                 `O {other}` if one is enough"
            ))
        }
        ("=" | "=I", 2..) => Some(outputs(quoted)),
        ("NOT", 1..) => Some("of one bit `LDN`, `AN` or `ON` take the inverted value".to_owned()),
        _ => None,
    }
}

/// What joins branches, and branches that are joined otherwise.
fn of_branches(quoted: Quoted<'_>) -> Option<String> {
    let (name, given) = (quoted.source.mnemonic(), quoted.source.operands.len());
    match (name, given) {
        ("A" | "AN", 0) => {
            Some(format!("the bit is named: `{name} I0.1`; two branches are joined by `ALD`"))
        }
        ("O" | "ON", 0) => Some(next_branch(quoted)),
        ("OLD" | "ALD", 1..) => {
            let contact = if name == "OLD" { "O" } else { "A" };
            Some(format!(
                "it joins two branches and has no operand; a single contact is `{contact} {}`",
                quoted.operand(0)?
            ))
        }
        ("ORB", 0) => Some(
            "two branches that begin with LD are joined by `OLD`; `ORB` is the or of bytes"
                .to_owned(),
        ),
        ("ANDB", 0) => Some(
            "two branches that begin with LD are joined by `ALD`; `ANDB` is the and of bytes"
                .to_owned(),
        ),
        _ => None,
    }
}

/// What timers, counters and their like have.
fn of_presets(quoted: Quoted<'_>) -> Option<String> {
    let (name, given) = (quoted.source.mnemonic(), quoted.source.operands.len());
    match (name, given) {
        ("TON" | "TOF" | "TONR", 1) => {
            let base = match first(quoted) {
                Some(Address::Timer(number)) => plc_isa::timer_resolution(number).ms(),
                _ => 100,
            };
            let timer = first_or(quoted, "T37");
            Some(format!(
                "the preset is named, too: `{name} {timer}, {}` is 2 s, {timer} counts {base} ms",
                2000 / base
            ))
        }
        ("TON" | "TOF" | "TONR", 3..) => timer_of_more(quoted),
        ("CTU" | "CTD" | "CTUD", 1) => {
            Some(format!("the preset is named, too: `{name} {}, 10`", first_or(quoted, "C1")))
        }
        ("HDEF", 1) => Some(format!(
            "the mode is named, too: `HDEF {}, 0` counts the pulses of one input up or down, as \
             its control byte says",
            quoted.operand(0)?
        )),
        ("SHRB", 2) => Some(
            "what is shifted in is named, then the first bit of the register, then its length: \
             `SHRB I0.1, V0.0, 8`"
                .to_owned(),
        ),
        ("FOR", 4) => Some(
            "FOR counts by ones: it may count the rounds, and the value is calculated inside, as \
             in `MOVW VW0, VW10`, `*I 2, VW10`"
                .to_owned(),
        ),
        _ => None,
    }
}

/// What instructions on bytes, words and double words have.
fn of_values(quoted: Quoted<'_>, wanted: usize, takes_real: bool) -> Option<String> {
    let (name, given) = (quoted.source.mnemonic(), quoted.source.operands.len());
    match (name, given) {
        ("INCB" | "INCW" | "INCD" | "DECB" | "DECW" | "DECD", 2) => more_than_one(quoted),
        ("MUL" | "DIV", 3) => {
            let sign = if name == "MUL" { "*I" } else { "/I" };
            let code = foreign::apart(sign, &quoted.operands()?)?;
            let lines: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
            Some(format!("of words that is {}; `{name}` makes a double word", lines.join(", ")))
        }
        (_, 1) if wanted == 2 && is_shifting(name) => shifted(quoted),
        ("MOVR" | "+R" | "-R" | "*R" | "/R", 3) if has_split_number(quoted) => Some(
            "a real number has no comma in it, and a point before its fraction, such as 1000.5"
                .to_owned(),
        ),
        // Two constants side by side are none that an instruction has.
        _ if given == wanted + 1 => {
            let real = || takes_real.then(|| fraction(quoted)).flatten();
            real().or_else(|| apart(quoted, wanted))
        }
        (_, 0) if wanted == 2 && is_calculating(name) => Some(
            "an S7-200 has no accumulators between load and transfer: both operands are named, the \
             second is the result, too"
                .to_owned(),
        ),
        _ => None,
    }
}

/// `O` as STEP 7 has it: the contacts after it are a branch of their own.
fn next_branch(quoted: Quoted<'_>) -> String {
    let name = quoted.source.mnemonic();
    let after = quoted.program.statements.get(quoted.statement as usize + 1..).unwrap_or(&[]);
    let mut branch = Vec::new();
    for (index, statement) in (quoted.statement + 1..).zip(after) {
        let Statement::Instruction(source) = statement else { break };
        let contact = source.mnemonic();
        let next = Quoted { source, statement: index, ..quoted };
        let (true, Some(bit)) = (matches!(contact, "A" | "AN"), next.operand(0)) else { break };
        branch.push(match (branch.is_empty(), contact) {
            (true, "A") => format!("`LD {bit}`"),
            (true, _) => format!("`LDN {bit}`"),
            (false, _) => format!("`{contact} {bit}`"),
        });
    }
    if branch.is_empty() || branch.len() > BRANCH_MAX {
        return format!(
            "the next branch begins with `LD`, and `OLD` after it joins the two; a single bit is \
             named: `{name} I0.1`"
        );
    }
    format!(
        "leave it out: the next branch begins with `LD`, and `OLD` after it joins the two: {}, \
         `OLD`",
        branch.join(", ")
    )
}

/// A timer with more than its number and preset: an input as in a box, a decimal comma, a value as
/// other makers have it.
fn timer_of_more(quoted: Quoted<'_>) -> Option<String> {
    let name = quoted.source.mnemonic();
    let values: Vec<&Value> = quoted.source.operands.iter().map(|one| &one.value).collect();
    let base = |number: u8| plc_isa::timer_resolution(number).ms();
    match values.as_slice() {
        [Value::Address(Address::Timer(_)), Value::Address(Address::Bit { .. }), ..]
        | [Value::Address(Address::Bit { .. }), Value::Address(Address::Timer(_)), ..] => {
            let is_first = matches!(values[0], Value::Address(Address::Bit { .. }));
            let [input, timer] = if is_first { [0, 1] } else { [1, 0] };
            Some(format!(
                "the input of a timer is the contact before it: `LD {}`, then `{name} {}, {}`",
                quoted.operand(input)?,
                quoted.operand(timer)?,
                quoted.operand(2)?
            ))
        }
        [
            Value::Address(Address::Timer(number)),
            Value::Constant(counts),
            Value::Constant(last),
        ] if last.value == 0 && counts.value >= 100 => {
            let (timer, base) = (quoted.operand(0)?, base(*number));
            let ms = counts.value.saturating_mul(base.into());
            Some(format!(
                "a timer has its number and its preset: `{name} {timer}, {}`, which is {} s, as \
                 {timer} counts {base} ms",
                counts.value,
                ms as f64 / 1000.0
            ))
        }
        _ => fraction(quoted)
            .map(|_| format!("a preset is a whole number of counts: `{name} T37, 25` is 2.5 s")),
    }
}

/// A counting instruction with how much it should count.
fn more_than_one(quoted: Quoted<'_>) -> Option<String> {
    let Value::Constant(_) = quoted.source.operands.get(1)?.value else {
        return apart(quoted, 1);
    };
    let name = quoted.source.mnemonic();
    let (verb, sign) = if name.starts_with("INC") { ("adds", '+') } else { ("takes away", '-') };
    let letter = if name.ends_with('D') { 'D' } else { 'I' };
    let (target, number) = (quoted.operand(0)?, quoted.operand(1)?);
    Some(format!("it {verb} 1; another number is `{sign}{letter} {number}, {target}`"))
}

/// Coils for several outputs; a number is how many bits S takes.
fn outputs(quoted: Quoted<'_>) -> String {
    let name = quoted.source.mnemonic();
    let outputs: Vec<String> = (0..)
        .zip(&quoted.source.operands)
        .filter(|(_, operand)| matches!(operand.value, Value::Address(_)))
        .filter_map(|(index, _)| quoted.operand(index))
        .collect();
    let lines: Vec<String> = outputs.iter().map(|output| format!("`{name} {output}`")).collect();
    match outputs.as_slice() {
        [one] => format!("a coil has no number of bits: `{name} {one}`"),
        _ => format!("one output is on a line: {}", lines.join(", ")),
    }
}

/// Whether a whole number is before a real one: a comma between thousands.
fn has_split_number(quoted: Quoted<'_>) -> bool {
    let is_split = |pair: &[Operand]| {
        matches!(
            pair,
            [Operand { value: Value::Constant(_), .. }, Operand { value: Value::Real(_), .. }]
        )
    };
    quoted.source.operands.windows(2).any(is_split)
}

/// A number with a comma.
fn fraction(quoted: Quoted<'_>) -> Option<String> {
    let number = |index: usize| match quoted.source.operands.get(index)?.value {
        Value::Constant(constant) => Some(constant.value),
        _ => None,
    };
    let (whole, digits) = (0..quoted.source.operands.len())
        .find_map(|index| Some((number(index)?, number(index + 1).filter(|&one| one >= 0)?)))?;
    Some(format!("a real number has a point: `{whole}.{digits}`"))
}

/// What has its result apart from its operands on other controllers and in boxes: a copy first.
fn apart(quoted: Quoted<'_>, wanted: usize) -> Option<String> {
    let name = quoted.source.mnemonic();
    if name.starts_with("MOV") && wanted == 2 {
        return Some(format!(
            "`{name}` copies one value to one place; a second place takes a second `{name}`"
        ));
    }
    let code = foreign::apart(name, &quoted.operands()?)?;
    let lines: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
    Some(format!("the last operand is the result, too: {}", lines.join(", ")))
}

/// What a shift is without its count, or without what is shifted.
fn shifted(quoted: Quoted<'_>) -> Option<String> {
    let (name, operand) = (quoted.source.mnemonic(), quoted.operand(0)?);
    match quoted.source.operands.first()?.value {
        Value::Address(_) => Some(format!("the count is named, too: `{name} {operand}, 1`")),
        _ => {
            let size = name.chars().last()?;
            Some(format!("what is shifted is named, too: `{name} V{size}0, {operand}`"))
        }
    }
}

/// Shifts and rotations of one value: `SLW` and its like.
fn is_shifting(name: &str) -> bool {
    let starts = ["SL", "SR", "RL", "RR"].iter().any(|start| name.starts_with(start));
    starts && name.len() == 3 && name.ends_with(['B', 'W', 'D'])
}

/// Whether an instruction calculates with its first operand and the result.
fn is_calculating(name: &str) -> bool {
    name.starts_with(['+', '-', '*', '/'])
        || ["AND", "OR", "XOR", "MUL", "DIV", "SL", "SR", "RL", "RR", "BTI", "ITB", "ITD", "DTI"]
            .iter()
            .chain(&["DTR", "ROUND", "TRUNC", "SQRT", "SIN", "COS", "TAN", "LN", "EXP", "MOV"])
            .any(|start| name.starts_with(start))
}
