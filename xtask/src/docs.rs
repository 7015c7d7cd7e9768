//! Generated documentation: docs/instructions.md from the instruction table, and the README's diagram from the demo.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result, bail};
use awl_asm::cost::of_form;
use awl_asm::cost::typical::{self, Typical};
use awl_asm::hardware::REFUSED;
use plc_isa::{Form, Group, INSTRUCTIONS, Instruction, Kind, MODULE_NAMES, PowerFlow, WIDE_PREFIX};

use crate::bench::number;
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

const GROUPS: [(Group, &str); 20] = [
    (Group::Contact, "Contacts"),
    (Group::Coil, "Coils"),
    (Group::Stack, "Logic stack"),
    (Group::Compare, "Comparisons"),
    (Group::Math, "Integer arithmetic"),
    (Group::Real, "Reals"),
    (Group::Logic, "Logic operations"),
    (Group::Shift, "Shifts and rotations"),
    (Group::Move, "Moves"),
    (Group::Conversion, "Conversions"),
    (Group::Table, "Tables and blocks"),
    (Group::Text, "Strings and ASCII"),
    (Group::Timer, "Timers"),
    (Group::Counter, "Counters"),
    (Group::Control, "Program control"),
    (Group::Call, "Subroutines"),
    (Group::Sequence, "Sequence control"),
    (Group::Interrupt, "Interrupts"),
    (Group::InputOutput, "Points, high-speed counters, pulses"),
    (Group::Communication, "Clock and serial line"),
];

/// What Micro/WIN accepts (reference 1.10). `x` stands for = <> >= <= > <.
const MICRO_WIN: &str = "LD A O LDN AN ON LDI AI OI LDNI ANI ONI NOT EU ED ALD OLD LPS LDS LRD LPP = =I S SI R RI AENO NOP \
    TODR TODW TODRX TODWX XMT RCV NETR NETW GPA SPA LDBx ABx OBx LDWx AWx OWx LDDx ADx ODx LDRx ARx ORx LDSx ASx OSx \
    BTI ITB ITD ITS DTI DTR DTS ROUND TRUNC RTS BCDI IBCD ITA DTA RTA ATH HTA STI STD STR DECO ENCO SEG CTU CTD CTUD \
    HDEF HSC PLS +R -R *R /R SQRT SIN COS TAN LN EXP PID +I -I *I /I +D -D *D /D MUL DIV INCB INCW INCD DECB DECW DECD \
    INVB INVW INVD ANDB ANDW ANDD ORB ORW ORD XORB XORW XORD MOVB MOVW MOVD MOVR BMB BMW BMD SWAP BIR BIW FOR NEXT JMP \
    LBL LSCR SCRT SCRE CSCRE END STOP WDR DLED SLB SLW SLD SRB SRW SRD RLB RLW RLD RRB RRW RRD SHRB SLEN SCPY SSCPY SCAT \
    SFND CFND FILL ATT FNDx LIFO FIFO TON TONR TOF BITIM CITIM CALL ENI DISI ATCH DTCH CEVNT CRET CRETI";

/// Why an instruction of [`MICRO_WIN`] is missing, and what comes nearest.
fn reason(mnemonic: &str) -> String {
    let refused = REFUSED.iter().find(|refused| refused.mnemonic == mnemonic);
    refused.map_or_else(String::new, |refused| format!("{}: {}", refused.reason, refused.way))
}

fn page() -> String {
    let ([near, far], constant) = (typical::by_pointer(), typical::by_constant());
    let mut text = format!(
        "# Instructions\n\n\
         Generated from the instruction table by `cargo xtask docs`; do not edit.\n\n\
         *Stack*: values an instruction needs on the logic stack, and what it adds or removes.\n\
         *Box*: executed only while the top of the stack is 1, which it keeps.\n\
         *Bytes*: length of each encoded form, in the order the assembler tries them.\n\
         *Cycles*: of each form on the board with power flow, 16 to the microsecond, in bytecode. Before a colon stands the\n\
         module of the instruction ([docs/image.md](image.md)); its cycles go with values: what was seen with values as programs\n\
         have them ([docs/benchmarks.md](benchmarks.md)), operands in memory. A pointer adds {near},\n\
         to a timer or counter up to {far} and more where there are many, a constant {constant} at most.\n\n\
         Operands: **bit** I Q M SM S V T C L; **byte** IB QB MB SMB SB VB LB AC; **word** IW QW MW SMW SW VW LW T C AC AIW Ain;\n\
         **double word** and **real** ID QD MD SMD SD VD LD AC HC. Operands of module instructions can also be pointers (`*AC1`,\n\
         `*VD10`, `*LD0`). Outputs exclude inputs and SMB0 to SMB29.\n",
    );
    for (group, title) in GROUPS {
        let _ = write!(text, "\n## {title}\n\n");
        text.push_str("| AWL | also | operands | meaning | stack | bytes | cycles |\n|---|---|---|---|---|---|---|\n");
        for instruction in INSTRUCTIONS.iter().filter(|instruction| instruction.group == group) {
            row(instruction, &mut text);
        }
    }
    coverage(&mut text);
    text
}

/// How much of what Micro/WIN accepts there is.
fn coverage(text: &mut String) {
    let has = |name: &str| {
        let is = |instruction: &Instruction, mnemonic: &str| match name.strip_suffix('x') {
            Some(stem) => stem == mnemonic && instruction.has_relation(),
            None => name == mnemonic && !instruction.has_relation(),
        };
        INSTRUCTIONS.iter().any(|row| row.mnemonics.iter().any(|mnemonic| is(row, mnemonic)))
    };
    let names: Vec<&str> = MICRO_WIN.split_ascii_whitespace().collect();
    let missing: Vec<&str> = names.iter().copied().filter(|name| !has(name)).collect();
    let _ = write!(
        text,
        "\n## Coverage\n\n{} of the {} mnemonics that Micro/WIN accepts (comparisons counted once for all relations).\n",
        names.len() - missing.len(),
        names.len()
    );
    if !missing.is_empty() {
        text.push_str("\n| missing | why |\n|---|---|\n");
    }
    for name in missing {
        let _ = writeln!(text, "| `{name}` | {} |", reason(name));
    }
}

fn row(instruction: &Instruction, text: &mut String) {
    let relation = if instruction.has_relation() { "x" } else { "" };
    let also: Vec<String> = instruction.mnemonics.iter().skip(1).map(|name| format!("`{name}{relation}`")).collect();
    let forms: Vec<String> = instruction.forms.iter().map(|form| form.encoded_len().to_string()).collect();
    let boxed = if instruction.power_flow == PowerFlow::Needed { " Box." } else { "" };
    let stack = instruction.stack;
    let _ = writeln!(
        text,
        "| `{}{relation}` | {} | {} | {}{boxed} | needs {}, {:+} | {} | {} |",
        instruction.mnemonic(),
        also.join(" "),
        operands(instruction).replace('|', "\\|"),
        instruction.doc.trim(),
        stack.needs,
        stack.adds,
        forms.join(", "),
        cycles(instruction),
    );
}

/// Cycles of each form, with the module where they belong to one.
fn cycles(instruction: &Instruction) -> String {
    let typical = typical::of_op(instruction.op).map_or("-".to_owned(), typical_cycles);
    if let Some(module) = instruction.module() {
        return format!("*{}*: {typical}", MODULE_NAMES.get(usize::from(module)).copied().unwrap_or_default());
    }
    let of_form = |form: &Form| match of_form(instruction.op, form.kinds) {
        Some([least, most]) => range(least.into(), most.into()),
        None => typical.clone(),
    };
    instruction.forms.iter().map(of_form).collect::<Vec<_>>().join(", ")
}

fn range(least: u32, most: u32) -> String {
    let text = |cycles: u32| number(cycles.into());
    if least == most { text(least) } else { format!("{} to {}", text(least), text(most)) }
}

/// Cycles that go with values: without what each element takes, and that.
fn typical_cycles(Typical { on, each, .. }: Typical) -> String {
    let elements = each.map_or(0, |(cycles, _, usual)| cycles * usual);
    let [least, typical, most] = on.map(|cycles| cycles.saturating_sub(elements));
    // Where one stands for all, a range says enough.
    let text = match most - least {
        spread if spread * 4 > most => format!("typically {}, {}", number(typical.into()), range(least, most)),
        _ => range(least, most),
    };
    match each {
        Some((cycles, unit, _)) => format!("{text} + {cycles} per {unit}"),
        None => text,
    }
}

/// Each operand with what its forms accept.
fn operands(instruction: &Instruction) -> String {
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
        Kind::InputPoint => "bit of I".into(),
        Kind::OutputPoint => "bit of Q".into(),
        Kind::ByteIn => "byte or constant".into(),
        Kind::WordIn => "word or constant".into(),
        Kind::DoubleIn => "double word or constant".into(),
        Kind::RealIn => "real or constant".into(),
        Kind::TextIn => "string or constant".into(),
        Kind::ByteTo | Kind::BytesAt => "byte".into(),
        Kind::WordTo | Kind::WordsAt => "word".into(),
        Kind::DoubleTo | Kind::DoublesAt => "double word".into(),
        Kind::RealTo => "real".into(),
        Kind::TextTo => "string".into(),
        Kind::Routine => "SBRn or INTn".into(),
        Kind::Event => "number of an event".into(),
        // The count that a short form leaves out stands in another form.
        Kind::One => return None,
        other => return range(other),
    })
}
