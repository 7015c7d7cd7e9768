//! What is behind constants that are too large or in the wrong place. That they are wrong is known
//! already.

use std::fmt::Display;

use plc_isa::{TimerKind, timer_resolution};

use crate::meaning::operand_widths::compared_with_real;
use crate::meaning::quoted::Quoted;
use crate::text::address::Address;
use crate::text::ast::{Constant, Value};
use crate::text::foreign;

/// A constant that is too large, or where the result goes.
pub(super) fn way_of_constant(
    quoted: Quoted<'_>,
    position: usize,
    constant: Constant,
) -> Option<String> {
    of_value(quoted, position, constant)
        .or_else(|| of_bits(quoted, position, constant.value))
        .or_else(|| of_preset(quoted, position, constant.value))
}

/// What instructions on bytes, words and double words have.
fn of_value(quoted: Quoted<'_>, position: usize, constant: Constant) -> Option<String> {
    let (name, value) = (quoted.source.mnemonic(), constant.value);
    let written = quoted.operand(position)?;
    let fits = |least: i64, most: i64| (least..=most).contains(&value);
    // What is beside it, if that is memory.
    let memory = |index: usize| match quoted.source.operands.get(index)?.value {
        Value::Address(_) | Value::Indirect(_) => quoted.operand(index),
        _ => None,
    };
    match (name, position) {
        ("MOVB" | "LDB" | "AB" | "OB", _)
            if fits(0x100, 0xFFFF) && characters(constant).is_some() =>
        {
            let text = characters(constant)?;
            Some(format!("a byte is one character; two are a word: `MOVW {text}, VW0`"))
        }
        ("LDB" | "AB" | "OB", _) => Some(byte_compared(quoted, position)),
        ("MOVB", 0) if fits(0, 0xFFFF) && is_interval(quoted) => Some(
            "the interval of a timed interrupt has 1 to 255 ms: for more the routine counts, such \
             as 5 of 100 ms, or T32 and T96 bring one: events 21 and 22"
                .to_owned(),
        ),
        ("MOVB", 0) if fits(-0x8000, 0xFFFF) => {
            Some(format!("a byte has 0 to 255; a word takes it: `MOVW {written}, VW0`"))
        }
        ("MOVB" | "MOVW", 0) if fits(-0x8000_0000, 0xFFFF_FFFF) => {
            Some(format!("a double word takes it: `MOVD {written}, VD0`"))
        }
        ("MOVD", 0) => Some(
            "a double word holds -2147483648 to 4294967295; a real number is greater: `MOVR \
             5.0E9, VD0`"
                .to_owned(),
        ),
        ("INCB" | "INCW" | "INCD" | "DECB" | "DECW" | "DECD", 0) => counted(name, &written),
        (_, 1) if name.starts_with(['+', '-', '*', '/']) => Some(format!(
            "the second operand is the result, the constant comes first: `{name} {written}, {}`",
            memory(0).unwrap_or_else(|| "VW0".to_owned())
        )),
        ("MOVB" | "MOVW" | "MOVD" | "MOVR", 1) => {
            let target = quoted.operand(0)?;
            Some(format!("the second operand is where it goes: `{name} {written}, {target}`"))
        }
        ("FILL", 1) => filled(quoted),
        _ => None,
    }
}

/// What contacts, coils and segments have.
fn of_bits(quoted: Quoted<'_>, position: usize, value: i64) -> Option<String> {
    let name = quoted.source.mnemonic();
    let fits = |least: i64, most: i64| (least..=most).contains(&value);
    match (name, position) {
        ("LSCR" | "SCRT", 0) if fits(0, 255) => Some(format!(
            "a segment has the bit of its step: `{name} S{}.{}`",
            value / 8,
            value % 8
        )),
        ("LD" | "LDN" | "A" | "AN" | "O" | "ON", 0) if fits(0, 1) => {
            let is_on = (value == 1) != name.ends_with('N');
            let bit = if is_on { "`LD SM0.0` is always 1" } else { "`LDN SM0.0` is always 0" };
            Some(format!("a contact reads a bit; {bit}"))
        }
        ("S" | "R" | "SI" | "RI", 1) if value <= 0 => {
            let bit = quoted.operand(0)?;
            let other =
                if name.starts_with('S') { name.replace('S', "R") } else { name.replace('R', "S") };
            let (does, undoes) = if name.starts_with('S') { ("1", "0") } else { ("0", "1") };
            Some(format!(
                "it is the number of bits: `{name} {bit}, 1` makes one {does}, `{other} {bit}, 1` \
                 makes it {undoes}"
            ))
        }
        ("S" | "R" | "SI" | "RI", 1) => Some(format!(
            "at most 255 bits are {} at a time: `{name} {}, 255`; words are written by `FILL 0, \
             VW0, 10`",
            if name.starts_with('S') { "set" } else { "reset" },
            quoted.operand(0)?
        )),
        _ => None,
    }
}

/// What timers and counters have.
fn of_preset(quoted: Quoted<'_>, position: usize, value: i64) -> Option<String> {
    let name = quoted.source.mnemonic();
    let fits = |least: i64, most: i64| (least..=most).contains(&value);
    match (name, position) {
        ("TON" | "TOF" | "TONR", 0) if fits(0, 255) => {
            Some(match quoted.source.operands.get(1).map(|operand| &operand.value) {
                Some(Value::Address(timer @ Address::Timer(_))) => {
                    timer_first(name, quoted.address(*timer), value)
                }
                _ => format!("a timer has its letter: `{name} T{value}, 20`"),
            })
        }
        ("CTU" | "CTD" | "CTUD", 0) if fits(0, 255) => {
            Some(match quoted.source.operands.get(1).map(|operand| &operand.value) {
                Some(Value::Address(counter @ Address::Counter(_))) => format!(
                    "the counter is first, then its preset: `{name} {}, {value}`",
                    quoted.address(*counter)
                ),
                _ => format!("a counter has its letter: `{name} C{value}, 10`"),
            })
        }
        ("CTU" | "CTD" | "CTUD", 1) => Some(
            "a counter counts to 32767 at most; more are counted in a double word: `EU`, \
             `INCD VD0`"
                .to_owned(),
        ),
        ("TON" | "TOF" | "TONR", 1) => Some(
            "a preset is at most 32767 counts, of 100 ms 3276.7 s: 60 s are `TON T37, 600`; longer \
             is a timer that starts itself again, `LDN T37`, `TON T37, 600`, and a counter of it: \
             `LD T37`, `LDN I0.0`, `CTU C1, 60` is an hour"
                .to_owned(),
        ),
        _ => None,
    }
}

/// Whether it goes to the interval of timed interrupt 0 or 1.
fn is_interval(quoted: Quoted<'_>) -> bool {
    let target = quoted.source.operands.get(1).map(|operand| &operand.value);
    matches!(target, Some(Value::Address(Address::Byte { area: plc_isa::Area::Sm, byte: 34 | 35 })))
}

/// `FILL VW0, 0, 10`: the value is first.
fn filled(quoted: Quoted<'_>) -> Option<String> {
    let [Value::Address(_), Value::Constant(one), Value::Constant(other)] = [0, 1, 2]
        .map(|index| quoted.source.operands.get(index).map(|operand| &operand.value))
        .map(|value| value.cloned().unwrap_or(Value::Invalid))
    else {
        return None;
    };
    // Nobody fills no words.
    let (value, count) = if other.value == 0 { (other, one) } else { (one, other) };
    let target = quoted.operand(0)?;
    Some(format!(
        "the value is first, then the first word, then how many: `FILL {}, {target}, {}`",
        value.value, count.value
    ))
}

/// A counting instruction with how much it should count.
fn counted(name: &str, value: &str) -> Option<String> {
    let (sign, size) = (if name.starts_with("INC") { '+' } else { '-' }, name.chars().last()?);
    let (verb, link, letter) = match sign {
        '+' => ("adds", "added", size),
        _ => ("takes away", "taken away", size),
    };
    let sum = match letter {
        'D' => format!("`{sign}D {value}, VD0`"),
        _ => format!("`{sign}I {value}, VW0`"),
    };
    Some(format!(
        "it {verb} 1, and names what it counts: `{name} V{size}0`; another number is {link} by {sum}"
    ))
}

/// A byte that is compared with what no byte is.
fn byte_compared(quoted: Quoted<'_>, position: usize) -> String {
    let name = quoted.source.mnemonic();
    let relation = quoted.source.relation.map_or("=", |relation| relation.symbol());
    let word = format!("{}W", name.trim_end_matches('B'));
    let of = |index: usize| quoted.operand(index).unwrap_or_default();
    let compared = match position {
        0 => format!("`{word}{relation} {}, VW10`", of(0)),
        _ => format!("`{word}{relation} VW10, {}`", of(1)),
    };
    format!(
        "a byte has 0 to 255 and no sign: `BTI {}, VW10` makes a word of it, {compared} compares \
         that",
        of(1 - position.min(1))
    )
}

/// The two characters that a constant may have been written as.
fn characters(constant: Constant) -> Option<String> {
    let bytes = u16::try_from(constant.value).ok()?.to_be_bytes();
    let is_text = constant.is_pattern && bytes.iter().all(u8::is_ascii_alphanumeric);
    is_text.then(|| format!("'{}{}'", char::from(bytes[0]), char::from(bytes[1])))
}

/// A real number where whole ones are.
pub(super) fn way_of_real(quoted: Quoted<'_>, value: f32) -> Option<String> {
    let name = quoted.source.mnemonic();
    let real = match name {
        "TON" | "TOF" | "TONR" => return preset_of_seconds(quoted, value),
        "CTU" | "CTD" | "CTUD" => {
            return Some(format!(
                "a counter counts whole numbers: `{name} {}, {}`",
                quoted.operand(0)?,
                value.round()
            ));
        }
        "LD" | "LDN" | "A" | "AN" | "O" | "ON" | "=" | "S" | "R" => {
            return Some(format!("an address begins with its area: `{name} I0.0`, `{name} Q0.0`"));
        }
        "MOVB" | "MOVW" | "MOVD" => "MOVR".to_owned(),
        "+I" | "-I" | "*I" | "/I" | "+D" | "-D" | "*D" | "/D" => format!("{}R", &name[..1]),
        "LDB" | "LDW" | "LDD" | "AB" | "AW" | "AD" | "OB" | "OW" | "OD" => {
            return compared_with_real(quoted, value);
        }
        _ => return None,
    };
    Some(format!("real numbers are in double words: `{real} {value:?}, VD0`"))
}

/// Seconds with a fraction, where the counts of a timer are.
fn preset_of_seconds(quoted: Quoted<'_>, seconds: f32) -> Option<String> {
    let op = quoted.source.entry.op;
    let Value::Address(timer @ Address::Timer(number)) = quoted.source.operands.first()?.value
    else {
        return None;
    };
    TimerKind::started_by(op)?;
    let counts = foreign::operands::preset(op, timer, &format!("{seconds}s"))?.counts?;
    let (name, base) = (quoted.source.mnemonic(), timer_resolution(number).ms());
    Some(format!(
        "a preset is a number of counts of {base} ms: `{name} {}, {counts}` is {seconds} s",
        quoted.address(timer)
    ))
}

/// How a timer is started whose preset was in its place.
pub(super) fn timer_first(name: &str, timer: impl Display, preset: impl Display) -> String {
    format!("the timer is first, then its preset: `{name} {timer}, {preset}`")
}
