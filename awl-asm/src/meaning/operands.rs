//! What is behind operands of another kind than an instruction takes: mostly the habit of a
//! controller with accumulators or with boxes. That they are wrong is known already.

use plc_isa::Area;

use crate::meaning::operand_constants::{timer_first, way_of_constant, way_of_real};
use crate::meaning::operand_widths::way_of_width;
use crate::meaning::quoted::Quoted;
use crate::text::address::Address;
use crate::text::ast::Value;
use crate::text::foreign::width::Width;

/// How a pulse is made.
pub(super) const NO_PULSE: &str = "an S7-200 has no pulse timers: set a bit with `EU` and `S \
     M0.0, 1`, let `TON T37, 20` run while it is 1, and reset it with `R M0.0, 1` when T37 is";

/// What the kind of an operand tells that does not fit.
pub(crate) fn way_of_kind(quoted: Quoted<'_>, position: usize) -> Option<String> {
    let name = quoted.source.mnemonic();
    let address = match quoted.source.operands.get(position)?.value {
        Value::Address(address) => address,
        Value::Constant(constant) => return way_of_constant(quoted, position, constant),
        Value::Real(bits) => return way_of_real(quoted, f32::from_bits(bits)),
        Value::AddressOf(_) if position == 0 && name.starts_with("MOV") => {
            let pointer = quoted.operand(0)?;
            return Some(format!("a pointer is a double word: `MOVD {pointer}, VD10`"));
        }
        Value::Indirect(_) => return through_pointer(quoted, position),
        _ => return None,
    };
    let written = quoted.operand(position)?;
    of_bits(quoted, position, address, &written)
        .or_else(|| of_presets(quoted, position, address, &written))
        .or_else(|| of_values(quoted, position, address, &written))
}

/// What takes bits, and bits where something else is.
fn of_bits(quoted: Quoted<'_>, position: usize, address: Address, written: &str) -> Option<String> {
    let name = quoted.source.mnemonic();
    match (name, address) {
        ("MOVB" | "MOVW" | "MOVD" | "MOVR", Address::Bit { .. }) => Some(copied_bit(quoted)),
        ("ATCH" | "DTCH" | "CEVNT", Address::Bit { area: Area::I, byte: 0, bit: bit @ 0..4 }) => {
            let (rises, falls) = (2 * bit, 2 * bit + 1);
            Some(format!(
                "event {rises} is the rising edge of {written}, event {falls} the falling one"
            ))
        }
        ("SI", Address::Timer(_)) => Some(NO_PULSE.to_owned()),
        ("PLS", Address::Bit { .. }) => Some(format!(
            "`PLS` starts the pulse output 0 or 1; a bit that is 1 for one scan is `EU` after the \
             contact: `LD I0.0`, `EU`, `= {written}`"
        )),
        ("S" | "R", Address::Bit { .. }) if position == 1 => range(quoted, address),
        ("S" | "R" | "SI" | "RI", _) if position == 1 => {
            let first = quoted.operand(0)?;
            Some(format!("one operand is on a line: `{name} {first}, 1`, `{name} {written}, 1`"))
        }
        ("=" | "=I" | "S" | "R" | "SI" | "RI", _) if position == 0 => {
            first_bit(name, address, written)
        }
        ("LD" | "A" | "O" | "LDN" | "AN" | "ON", _) => value_as_contact(name, address, written),
        _ => None,
    }
}

/// What timers and counters take.
fn of_presets(
    quoted: Quoted<'_>,
    position: usize,
    address: Address,
    written: &str,
) -> Option<String> {
    let name = quoted.source.mnemonic();
    match (name, address) {
        ("TON" | "TOF" | "TONR" | "CTU" | "CTD" | "CTUD", Address::Byte { .. })
            if position == 1 =>
        {
            let first = quoted.operand(0)?;
            Some(format!("a preset is a word: `BTI {written}, VW10`, `{name} {first}, VW10`"))
        }
        ("TON" | "TOF" | "TONR" | "CTU" | "CTD" | "CTUD", Address::Double { .. })
            if position == 1 =>
        {
            let first = quoted.operand(0)?;
            Some(format!("a preset is a word: `DTI {written}, VW10`, `{name} {first}, VW10`"))
        }
        ("CTU" | "CTD" | "CTUD", Address::Timer(number)) if position == 0 => {
            Some(format!("a counter has the letter C: `{name} C{number}, 10`"))
        }
        ("TON" | "TOF" | "TONR", _) if position == 0 => Some(way_of_timer(quoted, address)),
        _ => None,
    }
}

/// How a high-speed counter gets another value.
fn new_value(counter: u8) -> String {
    let (control, value) = match counter {
        3 => (137, 138),
        _ => (37, 38),
    };
    format!(
        "a program only reads it: its new value is written by `MOVD 0, SMD{value}`, `MOVB \
         16#C0, SMB{control}`, `HSC {counter}`"
    )
}

/// What instructions on bytes, words and double words take.
fn of_values(
    quoted: Quoted<'_>,
    position: usize,
    address: Address,
    written: &str,
) -> Option<String> {
    let name = quoted.source.mnemonic();
    match (name, address) {
        ("MOVD", Address::HighSpeedCounter(number)) if position == 1 => Some(new_value(number)),
        ("ROUND" | "TRUNC", Address::Word { .. }) if position == 1 => {
            let from = quoted.operand(0)?;
            Some(format!(
                "a double word becomes a word: `{name} {from}, AC0`, `DTI AC0, {written}`"
            ))
        }
        ("MUL" | "DIV", Address::Word { .. }) if position == 1 => {
            let (sign, what) = if name == "MUL" { ('*', "product") } else { ('/', "quotient") };
            let other = quoted.operand(0).unwrap_or_else(|| "VW0".to_owned());
            Some(format!(
                "a {what} that is a word, too, is made by `{sign}I`, as in `{sign}I {other}, \
                 {written}`"
            ))
        }
        ("DTR", Address::Word { .. }) if position == 0 => Some(format!(
            "a word becomes a double word first: `ITD {written}, VD10`, `DTR VD10, VD10`"
        )),
        (
            "SQRT" | "SIN" | "COS" | "TAN" | "LN" | "EXP",
            Address::Word { .. } | Address::Analog(_),
        ) if position == 0 => Some(format!(
            "it calculates with real numbers: `ITD {written}, AC0`, `DTR AC0, AC0`, then `{name} \
             AC0, VD10`"
        )),
        ("ROUND" | "TRUNC", Address::Word { .. }) if position == 0 => Some(format!(
            "{written} is a whole number already; `{name}` makes one of a real number in a double \
             word"
        )),
        ("MOVR", Address::Word { .. } | Address::Byte { .. }) => way_of_width(quoted)
            .or(Some("a real number is in a double word, such as VD0".to_owned())),
        ("+I" | "-I" | "*I" | "/I", Address::Byte { .. }) => Some(format!(
            "an S7-200 calculates with words: `BTI {written}, VW10` makes a word of the byte"
        )),
        ("MOVD", Address::Byte { .. } | Address::Word { .. }) if position == 0 => {
            let to = quoted.operand(1).unwrap_or_else(|| "AC1".to_owned());
            let value = match address {
                Address::Word { .. } => format!("by `ITD {written}, {to}`"),
                _ => format!("by `BTI {written}, AC0`, `ITD AC0, {to}`"),
            };
            Some(format!(
                "a pointer to it is `MOVD &{written}, {to}`; its value becomes a double word {value}"
            ))
        }
        (_, Address::Word { area, byte }) if position > 0 && is_count(quoted, position) => {
            let low = Address::Byte { area, byte: byte + 1 };
            match written == address.to_string() {
                true => Some(format!(
                    "a number of bits or elements is a byte: that of {written} \
                    is {low}"
                )),
                false => Some(format!(
                    "a number of bits or elements is a byte: `ITB {written}, VB10` makes one"
                )),
            }
        }
        (_, Address::Bit { .. }) => instead_of_bit(name, address, written),
        _ => way_of_width(quoted),
    }
}

/// Whether an operand says how many, and is the last one.
fn is_count(quoted: Quoted<'_>, position: usize) -> bool {
    let name = quoted.source.mnemonic();
    let counts = ["SL", "SR", "RL", "RR", "BM", "FILL", "SHRB", "S", "R", "SI", "RI"];
    let is_counting = counts.iter().any(|start| match start.len() {
        1 => name == *start,
        _ => name.starts_with(start),
    });
    is_counting && position + 1 == quoted.source.operands.len()
}

/// What is at the end of a pointer, where an instruction takes no pointer.
fn through_pointer(quoted: Quoted<'_>, position: usize) -> Option<String> {
    let (name, pointer) = (quoted.source.mnemonic(), quoted.operand(position)?);
    let is_bit = matches!(name, "LD" | "LDN" | "A" | "AN" | "O" | "ON" | "=" | "S" | "R");
    is_bit.then(|| {
        format!(
            "a pointer leads to bytes, words and double words: `MOVB {pointer}, VB10` copies the \
             byte, and `LD V10.0` is one of its bits"
        )
    })
}

/// A bit that is copied like a value.
fn copied_bit(quoted: Quoted<'_>) -> String {
    let constant = quoted.source.operands.first().map(|operand| &operand.value);
    if let (Some(Value::Constant(constant)), Some(bit)) = (constant, quoted.operand(1)) {
        let is_on = constant.value != 0;
        let [now, other] = if is_on { ["S", "R"] } else { ["R", "S"] };
        let [does, undoes] = if is_on { ["on", "off"] } else { ["off", "on"] };
        return format!(
            "{bit} is one bit: `{now} {bit}, 1` switches it {does}, `{other} {bit}, 1` {undoes}, \
             `= {bit}` writes what the contacts before it give"
        );
    }
    let bits = [0, 1].map(|index| {
        let operand = quoted.source.operands.get(index)?;
        let is_bit = matches!(operand.value, Value::Address(Address::Bit { .. }));
        quoted.operand(index).filter(|_| is_bit)
    });
    let line = match bits {
        [Some(from), Some(to)] => format!("`LD {from}`, `= {to}`"),
        [Some(from), None] if from != "M0.0" => format!("`LD {from}`, `= M0.0`"),
        [Some(from), None] => format!("`LD {from}`, `= Q0.0`"),
        [None, Some(to)] if to != "I0.0" => format!("`LD I0.0`, `= {to}`"),
        [None, _] => "`LD I0.1`, `= Q0.0`".to_owned(),
    };
    format!("a bit is copied by a contact and a coil, as in {line}")
}

/// The last bit where the number of bits belongs: `S Q0.0, Q0.3`.
fn range(quoted: Quoted<'_>, last: Address) -> Option<String> {
    let Value::Address(first) = quoted.source.operands.first()?.value else { return None };
    let (name, written) = (quoted.source.mnemonic(), quoted.operands()?);
    let count = bits_between(first, last)?;
    Some(format!(
        "the second operand is the number of bits: `{name} {}, {count}` takes {} to {}",
        written.first()?,
        written.first()?,
        written.get(1)?
    ))
}

/// Bits from one to the other, both counted.
fn bits_between(first: Address, last: Address) -> Option<u32> {
    let number = |address| match address {
        Address::Bit { area, byte, bit } => Some((area, u32::from(byte) * 8 + u32::from(bit))),
        _ => None,
    };
    let ((first_area, first), (last_area, last)) = (number(first)?, number(last)?);
    let count = last.checked_sub(first)? + 1;
    (first_area == last_area && count <= 255).then_some(count)
}

/// A bit where a number is: the byte, word or double word that it is in.
fn instead_of_bit(name: &str, bit: Address, written: &str) -> Option<String> {
    let Address::Bit { area, byte, .. } = bit else { return None };
    let (what, address) = match name.chars().last()? {
        'B' => ("a byte", Address::Byte { area, byte }),
        'W' | 'I' => ("a word", Address::Word { area, byte: byte & !1 }),
        'D' | 'R' => ("a double word", Address::Double { area, byte: byte & !3 }),
        _ => return None,
    };
    match written == bit.to_string() {
        true => Some(format!("`{name}` works on {what}, such as {address}; {written} is one bit")),
        false => Some(format!("`{name}` works on {what}; {written} is one bit")),
    }
}

/// The bits of a byte or word, where an instruction takes single ones.
fn first_bit(name: &str, address: Address, written: &str) -> Option<String> {
    let (area, byte, bits) = match address {
        Address::Byte { area, byte } => (area, byte, 8),
        Address::Word { area, byte } => (area, byte, 16),
        Address::Double { area, byte } => (area, byte, 32),
        _ => return None,
    };
    let letter = Width::of_address(address).map_or("W", Width::letter);
    if written != address.to_string() {
        let value = if matches!(name, "R" | "RI") { 0 } else { 5 };
        return Some(format!(
            "`{name}` takes single bits; all of {written} is written by `MOV{letter} {value}, \
             {written}`"
        ));
    }
    let bit = Address::Bit { area, byte, bit: 0 };
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

/// What is no timer, where the timer is named.
fn way_of_timer(quoted: Quoted<'_>, address: Address) -> String {
    let (name, written) = (quoted.source.mnemonic(), quoted.address(address));
    let timer = if name == "TONR" { "T5" } else { "T37" };
    let preset = quoted.source.operands.get(1).map(|operand| &operand.value);
    match (address, preset) {
        (Address::Bit { .. }, _) => format!(
            "a timer is started, and its bit is a contact: `{name} {timer}, 20`, then \
             `LD {timer}`, `= {written}`"
        ),
        (Address::Counter(_), Some(Value::Constant(preset))) => format!(
            "a timer has the letter T: `{name} {timer}, {}`; a counter is `CTU {written}, {0}`",
            preset.value
        ),
        (_, Some(Value::Address(own @ Address::Timer(_)))) => {
            timer_first(name, quoted.address(*own), written)
        }
        _ => timer_first(name, timer, written),
    }
}

/// A value where a contact has its bit.
fn value_as_contact(name: &str, address: Address, written: &str) -> Option<String> {
    let letter = match address {
        Address::Byte { .. } => "B",
        Address::Word { .. } => "W",
        Address::Double { .. } => "D",
        _ => return None,
    };
    let contact = name.trim_end_matches('N');
    let way = format!("a value is compared, as in `{contact}{letter}> {written}, 5`");
    Some(match name {
        "A" | "O" => {
            let logic = if name == "A" { "AND" } else { "OR" };
            format!("{way}, or its bits are combined by `{logic}{letter} {written}, {written}`")
        }
        _ => way,
    })
}
