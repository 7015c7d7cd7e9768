//! Generated documentation: docs/instructions.md from the instruction table, and the README's diagram from the demo.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result, bail};
use plc_isa::{Form, Group, INSTRUCTIONS, Instruction, Kind, PowerFlow};

use crate::demo;
use crate::process::root;

/// Writes the generated files, or only compares them.
pub fn run(check: bool) -> Result<()> {
    generated("docs/instructions.md", page().as_bytes(), check)?;
    generated("docs/station1.svg", &demo::diagram()?, check)
}

fn generated(file: &str, contents: &[u8], check: bool) -> Result<()> {
    let path = root().join(file);
    if !check {
        return fs::write(&path, contents).with_context(|| format!("cannot write {file}"));
    }
    if fs::read(&path).with_context(|| format!("cannot read {file}"))? != contents {
        bail!("{file} is not what the program says: run `cargo xtask docs`");
    }
    Ok(())
}

const GROUPS: [(Group, &str); 9] = [
    (Group::Contact, "Contacts"),
    (Group::Coil, "Coils"),
    (Group::Stack, "Logic stack"),
    (Group::Compare, "Comparisons"),
    (Group::Math, "Integer arithmetic"),
    (Group::Move, "Moves"),
    (Group::Timer, "Timers"),
    (Group::Counter, "Counters"),
    (Group::Control, "Program control"),
];

fn page() -> String {
    let mut text = String::from(
        "# Instructions\n\n\
         Generated from the instruction table by `cargo xtask docs`; do not edit.\n\n\
         *Stack*: values an instruction needs on the logic stack, and what it adds or removes.\n\
         *Box*: executed only while the top of the stack is 1, which it keeps.\n\
         *Bytes*: length of each encoded form, in the order the assembler tries them.\n\n\
         Operands: **bit** I Q M SM S V T C; **byte** IB QB MB SMB SB VB; **word** IW QW MW SMW SW VW T C AIW Ain.\n\
         Outputs exclude inputs and SMB0 to SMB29.\n",
    );
    for (group, title) in GROUPS {
        let _ = write!(text, "\n## {title}\n\n");
        text.push_str("| AWL | also | operands | meaning | stack | bytes |\n|---|---|---|---|---|---|\n");
        for instruction in INSTRUCTIONS.iter().filter(|instruction| instruction.group == group) {
            row(instruction, &mut text);
        }
    }
    text
}

fn row(instruction: &Instruction, text: &mut String) {
    let relation = if instruction.has_relation() { "x" } else { "" };
    let also: Vec<String> = instruction.mnemonics.iter().skip(1).map(|name| format!("`{name}{relation}`")).collect();
    let forms: Vec<String> = instruction.forms.iter().map(|form| form.encoded_len().to_string()).collect();
    let boxed = if instruction.power_flow == PowerFlow::Needed { " Box." } else { "" };
    let stack = instruction.stack;
    let _ = writeln!(
        text,
        "| `{}{relation}` | {} | {} | {}{boxed} | needs {}, {:+} | {} |",
        instruction.mnemonic(),
        also.join(" "),
        operands(instruction).replace('|', "\\|"),
        instruction.doc.trim(),
        stack.needs,
        stack.adds,
        forms.join(", "),
    );
}

/// Each operand with what its forms accept.
fn operands(instruction: &Instruction) -> String {
    let mut parts = Vec::new();
    for (index, name) in instruction.operand_names.iter().enumerate() {
        let mut accepted: Vec<String> = Vec::new();
        // Wide forms are general: they accept what the short forms accept.
        let short = instruction.forms.iter().filter(|form| !form.wide);
        for words in short.filter_map(|form| kind_at(form, index)).filter_map(words) {
            if !accepted.contains(&words) {
                accepted.push(words);
            }
        }
        if !accepted.is_empty() {
            parts.push(format!("{}: {}", awl_asm::select::operand_name(name), accepted.join(" or ")));
        }
    }
    parts.join("; ")
}

fn kind_at(form: &Form, index: usize) -> Option<Kind> {
    form.kinds.get(index).copied()
}

fn words(kind: Kind) -> Option<String> {
    let range = |kind: Kind| kind.range().map(|(least, most)| format!("{least} to {most}"));
    Some(match kind {
        Kind::PageBit | Kind::PageBitOut | Kind::FarBit | Kind::FarBitOut => "bit".into(),
        Kind::PageBitReset | Kind::FarBitReset => "bit".into(),
        Kind::Byte | Kind::ByteOut => "byte".into(),
        Kind::Word | Kind::WordOut => "word".into(),
        Kind::AnyInt => format!("word or {}", range(Kind::IntConst)?),
        Kind::AnyByte => format!("byte or {}", range(Kind::ByteConst)?),
        Kind::TimerSlot | Kind::TimerNumber => "T0 to T255".into(),
        Kind::CounterSlot | Kind::CounterNumber => "C0 to C255".into(),
        // The count that a short form leaves out stands in another form.
        Kind::One => return None,
        other => return range(other),
    })
}
