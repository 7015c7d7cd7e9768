//! What is behind operands that are missing, too many or of another kind: mostly the habit of a
//! controller with accumulators or with boxes. That they are wrong is known already.

use std::fmt::Display;

use plc_isa::Area;

use crate::text::address::Address;
use crate::text::ast::{Instruction, Value};
use crate::text::foreign::{self, width::Width};

const NO_PULSE: &str = "an S7-200 has no pulse timers: set a bit with `EU` and `S M0.0, 1`, let \
     `TON T37, 20` run while it is 1, and reset it with `R M0.0, 1` when T37 is";

/// How an instruction is written that has not as many operands as it takes. `takes_real`: one of
/// them may be a real number.
pub(crate) fn way(source: &Instruction, wanted: usize, takes_real: bool) -> Option<String> {
    let name = source.mnemonic();
    let first = source.operands.first().and_then(|operand| match operand.value {
        Value::Address(address) => Some(address),
        _ => None,
    });
    if let (true, Some(Address::Timer(_))) = (name == "SI", first) {
        return Some(NO_PULSE.to_owned());
    }
    match (name, source.operands.len()) {
        ("S" | "R" | "SI" | "RI", 1) => {
            let bit = first.map_or("Q0.0".to_owned(), |address| address.to_string());
            Some(format!("the number of bits is named, too: `{name} {bit}, 1`"))
        }
        ("A" | "AN", 0) => {
            Some(format!("the bit is named: `{name} I0.1`; two branches are joined by `ALD`"))
        }
        ("O" | "ON", 0) => Some(format!(
            "the bit is named: `{name} I0.1`; two branches that begin with LD are joined by `OLD`"
        )),
        ("EU" | "ED", 1..) => {
            Some(format!("`{name}` is after the contact whose edge it tells: `LD I0.0`, `{name}`"))
        }
        ("LD" | "LDN" | "A" | "AN" | "O" | "ON" | "LDI" | "AI" | "OI", 2) => {
            let [one, other] = texts(source)?.try_into().ok()?;
            Some(format!(
                "one contact is on a line: `{name} {one}`, then `A {other}` if both are needed, or \
                 `O {other}` if one is enough"
            ))
        }
        ("=" | "=I", 2..) => {
            let lines: Vec<String> =
                texts(source)?.iter().map(|output| format!("`{name} {output}`")).collect();
            Some(format!("one output is on a line: {}", lines.join(", ")))
        }
        ("NOT", 1..) => Some("of one bit `LDN`, `AN` or `ON` take the inverted value".to_owned()),
        ("TON" | "TOF" | "TONR", 1) => {
            let timer = first.map_or("T37".to_owned(), |address| address.to_string());
            let base = match first {
                Some(Address::Timer(number)) => plc_isa::timer_resolution(number).ms(),
                _ => 100,
            };
            Some(format!(
                "the preset is named, too: `{name} {timer}, {}` is 2 s, {timer} counts {base} ms",
                2000 / base
            ))
        }
        ("FOR", 4) => Some(
            "FOR counts by ones: it may count the rounds, and the value is calculated inside, as \
             in `MOVW VW0, VW10`, `*I 2, VW10`"
                .to_owned(),
        ),
        ("CTU" | "CTD" | "CTUD", 1) => {
            let counter = first.map_or("C1".to_owned(), |address| address.to_string());
            Some(format!("the preset is named, too: `{name} {counter}, 10`"))
        }
        (_, 1) if wanted == 2 && is_shifting(name) => shifted(source),
        ("TON" | "TOF" | "TONR", 3) => fraction(source).map(|_| {
            format!("a preset is a whole number of counts: `{name} T37, 25` is 2.5 s")
        }),
        // Two constants side by side are none that an instruction has.
        (_, given) if given == wanted + 1 => {
            let real = || takes_real.then(|| fraction(source)).flatten();
            real().or_else(|| apart(source, wanted))
        }
        (_, 0) if wanted == 2 && is_calculating(name) => Some(
            "an S7-200 has no accumulators between load and transfer: both operands are named, the \
             second is the result, too"
                .to_owned(),
        ),
        _ => None,
    }
}

/// A number with a comma.
fn fraction(source: &Instruction) -> Option<String> {
    let number = |index: usize| match source.operands.get(index)?.value {
        Value::Constant(constant) => Some(constant.value),
        _ => None,
    };
    let (whole, digits) = (0..source.operands.len())
        .find_map(|index| Some((number(index)?, number(index + 1).filter(|&one| one >= 0)?)))?;
    Some(format!("a real number has a point: `{whole}.{digits}`"))
}

/// The operands as they are written; `None` where one is nothing.
fn texts(source: &Instruction) -> Option<Vec<String>> {
    source.operands.iter().map(|operand| text(&operand.value)).collect()
}

fn text(value: &Value) -> Option<String> {
    Some(match value {
        Value::Address(address) => address.to_string(),
        Value::Constant(constant) => constant.value.to_string(),
        Value::Real(bits) => format!("{:?}", f32::from_bits(*bits)),
        Value::Indirect(address) => format!("*{address}"),
        Value::AddressOf(address) => format!("&{address}"),
        Value::Text(_) | Value::Unit(_) | Value::Invalid => return None,
    })
}

/// What has its result apart from its operands on other controllers and in boxes: a copy first.
fn apart(source: &Instruction, wanted: usize) -> Option<String> {
    let name = source.mnemonic();
    if name.starts_with("MOV") && wanted == 2 {
        return Some(format!(
            "`{name}` copies one value to one place; a second place takes a second `{name}`"
        ));
    }
    let code = foreign::apart(name, &texts(source)?)?;
    let lines: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
    Some(format!("the last operand is the result, too: {}", lines.join(", ")))
}

/// What a shift is without its count, or without what is shifted.
fn shifted(source: &Instruction) -> Option<String> {
    let name = source.mnemonic();
    match &source.operands.first()?.value {
        Value::Address(address) => Some(format!("the count is named, too: `{name} {address}, 1`")),
        value => {
            let (count, size) = (text(value)?, name.chars().last()?);
            Some(format!("what is shifted is named, too: `{name} V{size}0, {count}`"))
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

/// A constant that is too large, or where the result goes.
fn way_of_constant(source: &Instruction, position: usize, value: i64) -> Option<String> {
    let name = source.mnemonic();
    let fits = |least: i64, most: i64| (least..=most).contains(&value);
    match (name, position) {
        ("MOVB", 0) if fits(-0x8000, 0xFFFF) => {
            Some(format!("a byte has 0 to 255; a word takes it: `MOVW {value}, VW0`"))
        }
        ("MOVB" | "MOVW", 0) if fits(-0x8000_0000, 0xFFFF_FFFF) => {
            Some(format!("a double word takes it: `MOVD {value}, VD0`"))
        }
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
        ("TON" | "TOF" | "TONR", 0) if fits(0, 255) => {
            Some(match source.operands.get(1).map(|operand| &operand.value) {
                Some(Value::Address(timer @ Address::Timer(_))) => timer_first(name, timer, value),
                _ => format!("a timer has its letter: `{name} T{value}, 20`"),
            })
        }
        ("CTU" | "CTD" | "CTUD", 0) if fits(0, 255) => {
            Some(format!("a counter has its letter: `{name} C{value}, 10`"))
        }
        ("TON" | "TOF" | "TONR", 1) => Some(
            "a preset is at most 32767 counts, of 100 ms 3276.7 s: 60 s are `TON T37, 600`"
                .to_owned(),
        ),
        (_, 1) if name.starts_with(['+', '-', '*', '/']) => Some(format!(
            "the second operand is the result, the constant comes first: `{name} {value}, VW0`"
        )),
        ("MOVB" | "MOVW" | "MOVD" | "MOVR", 1) => {
            let target = source.operands.first().and_then(|operand| text(&operand.value))?;
            Some(format!("the second operand is where it goes: `{name} {value}, {target}`"))
        }
        _ => None,
    }
}

/// How a timer is started whose preset was in its place.
fn timer_first(name: &str, timer: impl Display, preset: impl Display) -> String {
    format!("the timer is first, then its preset: `{name} {timer}, {preset}`")
}

/// A real number where whole ones are.
fn way_of_real(source: &Instruction, value: f32) -> Option<String> {
    let name = source.mnemonic();
    let real = match name {
        "TON" | "TOF" | "TONR" => return preset_of_seconds(source, value),
        "LD" | "LDN" | "A" | "AN" | "O" | "ON" | "=" | "S" | "R" => {
            return Some(format!("an address begins with its area: `{name} I0.0`, `{name} Q0.0`"));
        }
        "MOVB" | "MOVW" | "MOVD" => "MOVR".to_owned(),
        "+I" | "-I" | "*I" | "/I" | "+D" | "-D" | "*D" | "/D" => format!("{}R", &name[..1]),
        _ => return None,
    };
    Some(format!("real numbers are in double words: `{real} {value:?}, VD0`"))
}

/// Seconds with a fraction, where the counts of a timer are.
fn preset_of_seconds(source: &Instruction, seconds: f32) -> Option<String> {
    let Value::Address(timer @ Address::Timer(number)) = source.operands.first()?.value else {
        return None;
    };
    let op = source.entry.op;
    let counts = foreign::operands::preset(op, timer, &format!("{seconds}s"))?.counts?;
    let (name, base) = (source.mnemonic(), plc_isa::timer_resolution(number).ms());
    Some(format!(
        "a preset is a number of counts of {base} ms: `{name} {timer}, {counts}` is {seconds} s"
    ))
}

/// A constant that is too large for the width of the address beside it.
fn wider(source: &Instruction, width: Width) -> Option<String> {
    let (most, target) = match width {
        Width::Byte => (0xFF, "VW0"),
        Width::Word => (0xFFFF, "VD0"),
        Width::Bit | Width::Double | Width::Real => return None,
    };
    let name = source.mnemonic();
    let constant = source.operands.iter().find_map(|operand| match operand.value {
        Value::Constant(constant) if constant.value > most || constant.value < -0x8000 => {
            Some(constant.value)
        }
        _ => None,
    })?;
    Some(format!("{constant} does not fit a {}: `{name} {constant}, {target}`", width.singular()))
}

/// The same instruction for operands of another width, or what makes one width of another.
fn way_of_width(source: &Instruction) -> Option<String> {
    let addresses = source.operands.iter().filter_map(|operand| match operand.value {
        Value::Address(address) => Some(address),
        _ => None,
    });
    let widths: Vec<(Address, Width)> = addresses
        .filter_map(|address| Some((address, Width::of_address(address)?)))
        .filter(|(_, width)| *width != Width::Bit)
        .collect();
    let name = source.mnemonic();
    let (_, width) = *widths.first()?;
    let has_real = source.operands.iter().any(|one| matches!(one.value, Value::Real(_)));
    if has_real && name.ends_with('R') {
        return Some("a real number is in a double word, such as VD0".to_owned());
    }
    if widths.iter().all(|(_, other)| *other == width) {
        if let Some(wider) = wider(source, width) {
            return Some(wider);
        }
        let sibling = width.sibling(name).filter(|sibling| *sibling != name)?;
        let relation = source.relation.map_or("", |relation| relation.symbol());
        return Some(format!("{} are taken by `{sibling}{relation}`", width.plural()));
    }
    let [(from, from_width), (to, to_width)] = widths[..] else { return None };
    if let (true, Some(part)) = (name.starts_with("MOV"), same_byte(from, to)) {
        return Some(part);
    }
    let conversion = match (from_width, to_width) {
        (Width::Byte, Width::Word) => "BTI",
        (Width::Word, Width::Byte) => "ITB",
        (Width::Word, Width::Double) => "ITD",
        (Width::Double, Width::Word) => "DTI",
        _ => return None,
    };
    let (from_words, to_words) = (from_width.singular(), to_width.singular());
    name.starts_with("MOV")
        .then(|| format!("`{conversion} {from}, {to}` makes a {to_words} of a {from_words}"))
}

/// A copy between inputs or outputs of which one is a byte and the other a word: all are meant to
/// be of one width, and no number is converted.
fn same_byte(from: Address, to: Address) -> Option<String> {
    let parts = |address| match address {
        Address::Byte { area, byte } | Address::Word { area, byte } => Some((area, byte)),
        _ => None,
    };
    let ((from_area, from_byte), (to_area, to_byte)) = (parts(from)?, parts(to)?);
    let is_point = |area| matches!(area, Area::I | Area::Q);
    (is_point(from_area) && is_point(to_area)).then(|| {
        let from = Address::Byte { area: from_area, byte: from_byte };
        let to = Address::Byte { area: to_area, byte: to_byte };
        format!("one byte is copied by `MOVB {from}, {to}`")
    })
}

/// The bits of a byte or word, where an instruction takes single ones.
fn first_bit(name: &str, address: Address) -> Option<String> {
    let (area, byte, bits) = match address {
        Address::Byte { area, byte } => (area, byte, 8),
        Address::Word { area, byte } => (area, byte, 16),
        Address::Double { area, byte } => (area, byte, 32),
        _ => return None,
    };
    let bit = Address::Bit { area, byte, bit: 0 };
    let letter = Width::of_address(address).map_or("W", Width::letter);
    Some(match name {
        "=" | "=I" => format!(
            "a coil writes one bit, such as `{name} {bit}`; all of {address} is written by \
             `MOV{letter} 5, {address}`"
        ),
        "S" | "SI" => format!("the {bits} bits of {address} are `{name} {bit}, {bits}`"),
        _ => format!(
            "the {bits} bits of {address} are `{name} {bit}, {bits}`; as a number it becomes 0 by \
             `MOV{letter} 0, {address}`"
        ),
    })
}

/// What the kind of an operand tells that does not fit.
pub(crate) fn way_of_kind(source: &Instruction, position: usize) -> Option<String> {
    let name = source.mnemonic();
    let address = match source.operands.get(position)?.value {
        Value::Address(address) => address,
        Value::Constant(constant) => return way_of_constant(source, position, constant.value),
        Value::Real(bits) => return way_of_real(source, f32::from_bits(bits)),
        Value::AddressOf(to) if position == 0 && name.starts_with("MOV") => {
            return Some(format!("a pointer is a double word: `MOVD &{to}, VD10`"));
        }
        _ => return None,
    };
    match (name, address) {
        ("MOVB" | "MOVW" | "MOVD" | "MOVR", Address::Bit { .. }) => {
            Some(format!("a bit is copied by a contact and a coil, as in `LD {address}`, `= M0.0`"))
        }
        ("ATCH" | "DTCH" | "CEVNT", Address::Bit { area: Area::I, byte: 0, bit: bit @ 0..4 }) => {
            let (rises, falls) = (2 * bit, 2 * bit + 1);
            Some(format!(
                "event {rises} is the rising edge of {address}, event {falls} the falling one"
            ))
        }
        ("MUL" | "DIV", Address::Word { .. }) if position == 1 => {
            let (sign, what) = if name == "MUL" { ('*', "product") } else { ('/', "quotient") };
            Some(format!(
                "a {what} that is a word, too, is made by `{sign}I`, as in `{sign}I VW0, {address}`"
            ))
        }
        ("SI", Address::Timer(_)) => Some(NO_PULSE.to_owned()),
        ("PLS", Address::Bit { .. }) => Some(format!(
            "`PLS` starts the pulse output 0 or 1; a bit that is 1 for one scan is `EU` after the \
             contact: `LD I0.0`, `EU`, `= {address}`"
        )),
        ("DTR", Address::Word { .. }) if position == 0 => Some(format!(
            "a word becomes a double word first: `ITD {address}, VD10`, `DTR VD10, VD10`"
        )),
        ("MOVR", Address::Word { .. } | Address::Byte { .. }) => {
            Some("a real number is in a double word, such as VD0".to_owned())
        }
        ("CTU" | "CTD" | "CTUD", Address::Timer(number)) if position == 0 => {
            Some(format!("a counter has the letter C: `{name} C{number}, 10`"))
        }
        ("=" | "=I" | "S" | "R" | "SI" | "RI", _) if position == 0 => first_bit(name, address),
        ("+I" | "-I" | "*I" | "/I", Address::Byte { .. }) => Some(format!(
            "an S7-200 calculates with words: `BTI {address}, VW10` makes a word of the byte"
        )),
        ("TON" | "TOF" | "TONR", _) if position == 0 => Some(way_of_timer(source, address)),
        ("MOVD", Address::Byte { .. } | Address::Word { .. }) if position == 0 => {
            let to = source.operands.get(1).and_then(|operand| text(&operand.value));
            let to = to.unwrap_or_else(|| "AC1".to_owned());
            Some(format!(
                "a pointer to it is `MOVD &{address}, {to}`; its value becomes a double word by `ITD`"
            ))
        }
        ("LD" | "A" | "O" | "LDN" | "AN" | "ON", _) => value_as_contact(name, address),
        _ => way_of_width(source),
    }
}

/// What is no timer, where the timer is named.
fn way_of_timer(source: &Instruction, address: Address) -> String {
    let name = source.mnemonic();
    let timer = if name == "TONR" { "T5" } else { "T37" };
    let preset = source.operands.get(1).map(|operand| &operand.value);
    match (address, preset) {
        (Address::Bit { .. }, _) => format!(
            "a timer is started, and its bit is a contact: `{name} {timer}, 20`, then \
             `LD {timer}`, `= {address}`"
        ),
        (Address::Counter(_), Some(Value::Constant(preset))) => format!(
            "a timer has the letter T: `{name} {timer}, {}`; a counter is `CTU {address}, {0}`",
            preset.value
        ),
        _ => timer_first(name, timer, address),
    }
}

/// A value where a contact has its bit.
fn value_as_contact(name: &str, address: Address) -> Option<String> {
    let letter = match address {
        Address::Byte { .. } => "B",
        Address::Word { .. } => "W",
        Address::Double { .. } => "D",
        _ => return None,
    };
    let contact = name.trim_end_matches('N');
    let way = format!("a value is compared, as in `{contact}{letter}> {address}, 5`");
    Some(match name {
        "A" | "O" => {
            let logic = if name == "A" { "AND" } else { "OR" };
            format!("{way}, or its bits are combined by `{logic}{letter} {address}, {address}`")
        }
        _ => way,
    })
}
