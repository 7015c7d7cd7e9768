//! What the manual says of an instruction besides its sentence: operands, flags, cycles, in words.
//! All of it follows from the instruction table and from what was measured.

use plc_isa::{Form, Instruction, Kind, MODULE_NAMES, Type, WIDE_PREFIX, Written};

use crate::meaning::select::operand_name;
use crate::output::cost::of_form;
use crate::output::cost::typical::{self, Typical};

/// What the bits of SMB1 mean, from SM1.0 on.
const FLAGS: [&str; 8] = [
    "the result is 0",
    "overflow, an illegal value, or the last bit shifted out",
    "the result is negative",
    "division by zero",
    "the table is full",
    "the table is empty",
    "no BCD",
    "no hexadecimal digit",
];

/// The bits of SMB1 that an instruction sets or resets, each with what it says.
pub fn flags(instruction: &Instruction) -> impl Iterator<Item = (String, &'static str)> {
    let flags = instruction.flags;
    let bits = FLAGS.iter().enumerate().filter(move |(bit, _)| flags >> bit & 1 != 0);
    bits.map(|(bit, &words)| (format!("SM1.{bit}"), words))
}

/// Cycles of each form, with the module where they belong to one.
pub fn cycles(instruction: &Instruction) -> String {
    let typical = typical::of_op(instruction.op).map_or("-".to_owned(), typical_cycles);
    if let Some(module) = instruction.module() {
        return format!(
            "*{}*: {typical}",
            MODULE_NAMES.get(usize::from(module)).copied().unwrap_or_default()
        );
    }
    let of_form = |form: &Form| match of_form(instruction.op, form.kinds) {
        Some([least, most]) => range(least.into(), most.into()),
        None => typical.clone(),
    };
    instruction.forms.iter().map(of_form).collect::<Vec<_>>().join(", ")
}

fn range(least: u32, most: u32) -> String {
    if least == most { grouped(least) } else { format!("{} to {}", grouped(least), grouped(most)) }
}

/// Cycles that go with values: without what each element takes, and that.
fn typical_cycles(Typical { on, each, .. }: Typical) -> String {
    let elements = each.map_or(0, |(cycles, _, usual)| cycles * usual);
    let [least, typical, most] = on.map(|cycles| cycles.saturating_sub(elements));
    // Where one stands for all, a range says enough.
    let text = match most - least {
        spread if spread * 4 > most => {
            format!("typically {}, {}", grouped(typical), range(least, most))
        }
        _ => range(least, most),
    };
    match each {
        Some((cycles, unit, _)) => format!("{text} + {cycles} per {unit}"),
        None => text,
    }
}

/// Each operand with what its forms accept.
pub fn operands(instruction: &Instruction) -> String {
    let mut parts = Vec::new();
    for (index, name) in instruction.operand_names.iter().enumerate() {
        let mut accepted: Vec<String> = Vec::new();
        // Wide forms are general: they accept what the short forms accept.
        let short = instruction.forms.iter().filter(|form| form.prefix != Some(WIDE_PREFIX));
        for words in short.filter_map(|form| kind_at(form, index)).filter_map(words) {
            if !accepted.contains(&words) {
                accepted.push(words);
            }
        }
        if !accepted.is_empty() {
            parts.push(format!("{}: {}", operand_name(name), accepted.join(" or ")));
        }
    }
    parts.join("; ")
}

fn kind_at(form: &Form, index: usize) -> Option<Kind> {
    form.kinds.get(index).copied()
}

fn words(kind: Kind) -> Option<String> {
    let memory = match kind.value_type() {
        Some(Type::Bit) => "bit",
        Some(Type::Byte) => "byte",
        Some(Type::Word) => "word",
        Some(Type::Double) => "double word",
        Some(Type::Real) => "real",
        Some(Type::Text) => "string",
        None => "",
    };
    let range = |kind: Kind| kind.range().map(|(least, most)| format!("{least} to {most}"));
    Some(match kind.written() {
        Written::Hidden => return None,
        // The count that a short form leaves out is in another form.
        Written::Constant(..) if kind == Kind::One => return None,
        Written::Constant(..) | Written::Number(_) | Written::Label => return range(kind),
        Written::Address => memory.into(),
        Written::Value if kind.is_reference() => format!("{memory} or constant"),
        Written::Value if kind.value_type() == Some(Type::Byte) => {
            format!("{memory} or {}", range(Kind::ByteConst)?)
        }
        Written::Value => format!("{memory} or {}", range(Kind::IntConst)?),
        Written::Timer => "T0 to T255".into(),
        Written::Counter => "C0 to C255".into(),
        Written::Input => "bit of I".into(),
        Written::Output => "bit of Q".into(),
        Written::Routine => "SBRn or INTn".into(),
        Written::Event => "number of an event".into(),
    })
}

/// A number with a comma after the thousands.
fn grouped(number: u32) -> String {
    match number {
        1000.. => format!("{},{:03}", grouped(number / 1000), number % 1000),
        _ => number.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plc_isa::Op;

    #[test]
    fn an_instruction_in_words() {
        let add = Op::AddInt.instruction();
        assert_eq!(operands(add), "IN1: word or -32768 to 32767; OUT: word");
        let bits: Vec<String> = flags(add).map(|(bit, _)| bit).collect();
        assert_eq!(bits, ["SM1.0", "SM1.1", "SM1.2"]);
        assert_eq!(grouped(1_234_005), "1,234,005");
    }
}
