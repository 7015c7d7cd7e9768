//! From a program image back to AWL that assembles to the same bytes.

mod frames;
mod operands;

use std::fmt::Write as _;

use plc_isa::{
    CRC_LEN, DEFAULT_WATCHDOG_MS, Decoded, INITIAL_HEAD_LEN, ImageError, LOCALS_IN_V, LineSettings,
    Op, Parity, Program, ProgramMemory, STACK_LEVELS, Settings, decode, verify,
};

use crate::assemble::assemble;
use crate::meaning::selected::is_contact;
use crate::output::disassemble::frames::{Frames, Parameter};
use crate::output::disassemble::operands::Writer;
use crate::plan::demand::v_range;
use crate::source::Source;
use crate::text::address::range_text;
use crate::text::ast::{Section, UnitId, UnitKind};

/// An instruction as text.
#[derive(Debug, Clone)]
pub struct TextLine {
    /// Offset in the image.
    pub at: u16,
    /// The instruction.
    pub decoded: Decoded,
    /// The unit it belongs to: 0 is the main program, then the routines in the order of their
    /// table.
    pub unit: u8,
    /// Its AWL, without comment; empty for hidden instructions.
    pub text: String,
}

/// The whole image as AWL.
pub fn disassemble(image: &[u8]) -> Result<String, ImageError> {
    let program = verify(image)?;
    let text = whole_text(&program, &[]);
    // V memory that no operand names must be asked for.
    let planned: Vec<(u16, u16)> = program.plan().v_ranges().collect();
    let named = Source::new("disassembly", text.clone())
        .map(|source| assemble(&source, Vec::new()).demand.v_ranges);
    Ok(if named.is_ok_and(|named| named == planned) {
        text
    } else {
        whole_text(&program, &planned)
    })
}

/// The text with these ranges of V memory asked for.
fn whole_text<P: ProgramMemory>(program: &Program<P>, memory: &[(u16, u16)]) -> String {
    let mut text = String::new();
    settings(program, &mut text);
    for &(first, len) in memory.iter().filter(|&&(first, _)| first < LOCALS_IN_V) {
        let _ = writeln!(text, "//# memory {}", v_range(first, len));
    }
    let lines = instructions(program);
    let routines = program.plan().header.routines;
    let frames = Frames::of(program, &decoded(program));
    for unit in 0..=routines {
        let id = unit_id(program, unit);
        if routines > 0 {
            header(id, frames.parameters(unit), &mut text);
        }
        let start = lines.partition_point(|line| line.unit < unit);
        let end = lines.partition_point(|line| line.unit <= unit);
        unit_text(lines.get(start..end).unwrap_or(&[]), &mut text);
        if routines > 0 {
            let _ = writeln!(text, "END_{}_BLOCK", block(id));
        }
    }
    data_block(program, &mut text);
    text
}

fn unit_id<P: ProgramMemory>(program: &Program<P>, unit: u8) -> UnitId {
    match unit.checked_sub(1).map(|index| program.plan().routine_name(index)) {
        None => UnitId { kind: UnitKind::Main, number: 1 },
        Some((true, number)) => UnitId { kind: UnitKind::Interrupt, number },
        Some((false, number)) => UnitId { kind: UnitKind::Subroutine, number },
    }
}

fn block(id: UnitId) -> &'static str {
    match id.kind {
        UnitKind::Main => "ORGANIZATION",
        UnitKind::Subroutine => "SUBROUTINE",
        UnitKind::Interrupt => "INTERRUPT",
    }
}

/// The header of a block with the declarations of its parameters.
fn header(id: UnitId, parameters: &[Parameter], text: &mut String) {
    let name = if id.kind == UnitKind::Main {
        "MAIN".to_owned()
    } else {
        format!("{}_{}", id.kind.letters(), id.number)
    };
    let _ = writeln!(text, "\n{}_BLOCK {name}:{id}", block(id));
    for (section, keyword) in
        [(Section::In, "VAR_INPUT"), (Section::InOut, "VAR_IN_OUT"), (Section::Out, "VAR_OUTPUT")]
    {
        let mut is_open = false;
        for (number, parameter) in
            (1..).zip(parameters).filter(|(_, parameter)| parameter.section == section)
        {
            if !is_open {
                let _ = writeln!(text, "{keyword}");
                is_open = true;
            }
            let _ = writeln!(text, "P_{number}:{};", parameter.kind.name());
        }
        if is_open {
            text.push_str("END_VAR\n");
        }
    }
    text.push_str("BEGIN\n");
}

fn unit_text(lines: &[TextLine], text: &mut String) {
    let starts = networks(lines);
    let mut number = 0;
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.text.is_empty()) {
        if starts.get(index).copied().unwrap_or(false) {
            number += 1;
            let _ = write!(text, "\nNETWORK {number}\n");
        }
        text.push_str(&line.text);
        text.push('\n');
    }
}

/// What V memory holds before the first scan.
fn data_block<P: ProgramMemory>(program: &Program<P>, text: &mut String) {
    const BYTES_IN_LINE: u16 = 16;
    let (mut at, end) = (program.plan().initial_at, program.code_at());
    if at == end {
        return;
    }
    text.push_str("\nDATA_BLOCK\n");
    while at < end {
        let (first, len) = (program.memory().word(at), u16::from(program.memory().byte(at + 2)));
        at += INITIAL_HEAD_LEN;
        for start in (0..len).step_by(usize::from(BYTES_IN_LINE)) {
            let bytes = (start..len.min(start + BYTES_IN_LINE))
                .map(|index| program.memory().byte(at + index).to_string());
            let _ = writeln!(text, "VB{} {}", first + start, bytes.collect::<Vec<_>>().join(", "));
        }
        at += len;
    }
    text.push_str("END_DATA_BLOCK\n");
}

/// The instructions of all units with offset and unit.
fn decoded<P: ProgramMemory>(program: &Program<P>) -> Vec<(u16, u8, Decoded)> {
    let end = program.plan().header.total_len - CRC_LEN;
    let (mut next, mut unit) = (program.code_at(), 0u8);
    let mut all = Vec::new();
    // A verified image decodes to its end; machine code is not looked at.
    while next < end && program.entry().is_none() {
        let Ok(decoded) = decode(program.memory(), next) else { break };
        all.push((next, unit, decoded));
        next += decoded.len;
        unit += u8::from(matches!(decoded.op, Op::MainEnd | Op::Ret));
    }
    all
}

/// The instructions of a program, hidden ones included.
pub fn instructions<P: ProgramMemory>(program: &Program<P>) -> Vec<TextLine> {
    let decoded = decoded(program);
    let frames = Frames::of(program, &decoded);
    let mut writer = Writer::new(program, &frames, &decoded);
    let line = |&(at, unit, decoded): &(u16, u8, Decoded)| {
        let text = writer.instruction(unit, at, &decoded);
        TextLine { at, decoded, unit, text }
    };
    decoded.iter().map(line).collect()
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
    let inverted =
        [points('I', settings.invert_inputs), points('Q', settings.invert_outputs)].concat();
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
    let modbus = modbus_text(&settings);
    if !modbus.is_empty() {
        let _ = writeln!(text, "//# modbus{modbus}");
    }
    // A line each: their order and number are part of the image.
    for range in plan.retained() {
        let _ = writeln!(text, "//# retain {}", range_text(range.area, range.first, range.count));
    }
}

/// What the setting `modbus` must say; empty where everything is as it is without it.
fn modbus_text(settings: &Settings) -> String {
    let mut text = String::new();
    if settings.modbus_address != Settings::DEFAULT.modbus_address {
        let _ = write!(text, " address {}", settings.modbus_address);
    }
    let line = LineSettings::of_byte(settings.line);
    if let Some(rate) = LineSettings::RATES.get(usize::from(line.rate)).filter(|_| line.rate != 0) {
        let _ = write!(text, " baud {rate}");
    }
    text.push_str(match line.parity {
        Parity::None => "",
        Parity::Even => " parity even",
        Parity::Odd => " parity odd",
    });
    text
}

/// Which instructions can start a network: a load after an output, LBL and NEXT, as long as
/// nothing after reaches for a value from before.
fn networks(lines: &[TextLine]) -> Vec<bool> {
    let mut starts = vec![false; lines.len()];
    // The network starts so far with the depth they are at; the innermost last.
    let mut open: Vec<(usize, u32)> = vec![(0, 0)];
    let mut depth: u32 = 0;
    let mut after_output = true;
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.text.is_empty()) {
        let (op, stack) = (line.decoded.op, line.decoded.stack);
        let may_start =
            stack.needs == 0 && (stack.adds > 0 || matches!(op, Op::Lbl | Op::Next | Op::Scre));
        if after_output && may_start {
            open.push((index, depth));
        }
        while open.len() > 1
            && open.last().is_some_and(|&(_, base)| held(depth, base) < u32::from(stack.needs))
        {
            open.pop();
        }
        if matches!(op, Op::Lbl | Op::For | Op::Next) {
            // Only the top of the stack is certain from here on: what came before is settled.
            settle(&mut open, &mut starts);
            depth = 1;
        } else {
            depth = depth.saturating_add_signed(i32::from(stack.adds));
        }
        after_output = !is_contact(op);
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
