//! From a program image back to AWL that assembles to the same bytes.

use std::fmt::Write as _;

use plc_isa::{
    AnalogInput, Area, Bit, DEFAULT_WATCHDOG_MS, Decoded, Group, ImageError, Kind, Op, Operand, Program, ProgramMemory,
    Region, Retained, STACK_LEVELS, verify,
};

use crate::address::Address;

/// An instruction as text.
#[derive(Debug, Clone)]
pub struct TextLine {
    /// Offset in the image.
    pub at: u16,
    /// The instruction.
    pub decoded: Decoded,
    /// Its AWL, without comment; empty for hidden instructions.
    pub text: String,
}

/// The whole image as AWL.
pub fn disassemble(image: &[u8]) -> Result<String, ImageError> {
    let program = verify(image)?;
    let lines = instructions(&program);
    let mut text = String::new();
    settings(&program, &mut text);
    let starts = networks(&lines);
    let mut number = 0;
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.text.is_empty()) {
        if starts.get(index).copied().unwrap_or(false) {
            number += 1;
            let _ = write!(text, "\nNETWORK {number}\n");
        }
        text.push_str(&line.text);
        text.push('\n');
    }
    Ok(text)
}

/// The instructions of a program, hidden ones included.
pub fn instructions<P: ProgramMemory>(program: &Program<P>) -> Vec<TextLine> {
    let line = |(at, decoded)| TextLine { at, decoded, text: instruction_text(program, &decoded) };
    program.instructions().map(line).collect()
}

/// One instruction as AWL.
pub fn instruction_text<P: ProgramMemory>(program: &Program<P>, decoded: &Decoded) -> String {
    let instruction = decoded.op.instruction();
    if instruction.group == Group::Hidden {
        return String::new();
    }
    let relation = decoded.relation().map_or("", |relation| relation.symbol());
    let mnemonic = format!("{}{relation}", instruction.mnemonic());
    let operands: Vec<String> = decoded
        .operands()
        .filter(|(kind, _)| kind.is_written())
        .map(|(kind, operand)| operand_text(program, kind, operand))
        .collect();
    if operands.is_empty() { mnemonic } else { format!("{mnemonic:<6} {}", operands.join(", ")) }
}

fn operand_text<P: ProgramMemory>(program: &Program<P>, kind: Kind, operand: Operand) -> String {
    match (kind, operand) {
        (Kind::TimerSlot, Operand::Number(slot)) => format!("T{}", program.plan().timer(slot).number),
        (Kind::CounterSlot, Operand::Number(slot)) => format!("C{}", program.plan().counter(slot).number),
        (Kind::TimerNumber, Operand::Number(number)) => format!("T{number}"),
        (Kind::CounterNumber, Operand::Number(number)) => format!("C{number}"),
        (Kind::LabelIndex, Operand::Number(index)) => {
            // The label's number stands behind its token.
            let at = program.plan().label(index);
            program.memory().byte(at + 1).to_string()
        }
        (_, Operand::Number(number)) => number.to_string(),
        (Kind::IntConst | Kind::WordConst | Kind::AnyInt, Operand::Constant(value)) => (value as i16).to_string(),
        (_, Operand::Constant(value)) => value.to_string(),
        (_, Operand::Bit(bit)) => bit_text(program, bit),
        (Kind::Byte | Kind::ByteOut | Kind::AnyByte, Operand::Memory(at)) => memory_text(program, at, false),
        (_, Operand::Memory(at)) => memory_text(program, at, true),
        (_, Operand::Relation(_) | Operand::Offset(_)) => String::new(),
    }
}

fn bit_text<P: ProgramMemory>(program: &Program<P>, bit: Bit) -> String {
    match program.plan().region(bit.address) {
        Some(Region::Byte { area: Area::T, byte, .. }) => Address::Timer((byte * 8) as u8 + bit.bit).to_string(),
        Some(Region::Byte { area: Area::C, byte, .. }) => Address::Counter((byte * 8) as u8 + bit.bit).to_string(),
        Some(Region::Byte { area, byte, .. }) => Address::Bit { area, byte, bit: bit.bit }.to_string(),
        _ => String::new(),
    }
}

fn memory_text<P: ProgramMemory>(program: &Program<P>, at: u16, word: bool) -> String {
    let address = match program.plan().region(at) {
        Some(Region::Byte { area, byte, .. }) if word => Address::Word { area, byte },
        Some(Region::Byte { area, byte, .. }) => Address::Byte { area, byte },
        Some(Region::Analog(input @ (AnalogInput::Scaled(_) | AnalogInput::Raw(_)))) => Address::Analog(input),
        Some(Region::TimerValue(number)) => Address::Timer(number),
        Some(Region::CounterValue(number)) => Address::Counter(number),
        None => return String::new(),
    };
    address.to_string()
}

fn settings<P: ProgramMemory>(program: &Program<P>, text: &mut String) {
    let plan = program.plan();
    let name: String = plan.name().map(char::from).collect();
    let settings = plan.header.settings;
    let _ = writeln!(text, "//# name \"{name}\"");
    let points = |area: char, bits: u8| -> Vec<String> {
        (0..8).filter(|bit| bits >> bit & 1 != 0).map(|bit| format!("{area}0.{bit}")).collect()
    };
    let pullup = points('I', settings.pullup);
    if !pullup.is_empty() {
        let _ = writeln!(text, "//# pullup {}", pullup.join(", "));
    }
    let inverted = [points('I', settings.invert_inputs), points('Q', settings.invert_outputs)].concat();
    if !inverted.is_empty() {
        let _ = writeln!(text, "//# invert {}", inverted.join(", "));
    }
    if settings.watchdog_ms != DEFAULT_WATCHDOG_MS {
        let _ = writeln!(text, "//# watchdog {}ms", settings.watchdog_ms);
    }
    if settings.scan_ms != 0 {
        let _ = writeln!(text, "//# scan {}ms", settings.scan_ms);
    }
    if settings.filter != 0 {
        let _ = writeln!(text, "//# filter {}", 1u32 << settings.filter);
    }
    // A line each: their order and number are part of the image.
    for range in plan.retained() {
        let _ = writeln!(text, "//# retain {}", retained_text(range));
    }
}

/// `VB0-VB31`, `C3`.
pub fn retained_text(range: Retained) -> String {
    let letter = match range.area {
        Area::V => "VB",
        Area::M => "MB",
        other => other.name(),
    };
    match range.count {
        1 => format!("{letter}{}", range.first),
        count => format!("{letter}{}-{letter}{}", range.first, range.first + count - 1),
    }
}

/// Which instructions can start a network: a load behind an output, LBL and NEXT, as long as nothing
/// behind reaches for a value from before.
fn networks(lines: &[TextLine]) -> Vec<bool> {
    let mut starts = vec![false; lines.len()];
    // The network starts so far with the depth they stand at; the innermost last.
    let mut open: Vec<(usize, u32)> = vec![(0, 0)];
    let mut depth: u32 = 0;
    let mut after_output = true;
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.text.is_empty()) {
        let (op, stack) = (line.decoded.op, line.decoded.stack);
        let group = op.instruction().group;
        let may_start = stack.needs == 0 && (stack.adds > 0 || matches!(op, Op::Lbl | Op::Next));
        if after_output && may_start {
            open.push((index, depth));
        }
        while open.len() > 1 && open.last().is_some_and(|&(_, base)| held(depth, base) < u32::from(stack.needs)) {
            open.pop();
        }
        if matches!(op, Op::Lbl | Op::For | Op::Next) {
            // Only the top of the stack is certain from here on: what came before is settled.
            settle(&mut open, &mut starts);
            depth = 1;
        } else {
            depth = depth.saturating_add_signed(i32::from(stack.adds));
        }
        after_output = !matches!(group, Group::Contact | Group::Compare | Group::Stack);
    }
    settle(&mut open, &mut starts);
    starts
}

fn held(depth: u32, base: u32) -> u32 {
    depth.saturating_sub(base).min(u32::from(STACK_LEVELS))
}

fn settle(open: &mut Vec<(usize, u32)>, starts: &mut [bool]) {
    for (index, _) in open.drain(..) {
        if let Some(start) = starts.get_mut(index) {
            *start = true;
        }
    }
    open.push((usize::MAX, 0));
}
