//! Generated files: docs/instructions.md and the grammars for editors from the tables of the
//! languages, the page of the boards from their profiles, the pages of the signal blocks, the words
//! that the IDE's page colours, and the README's diagram from the demo.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result, bail};
use awl_asm::cost::typical;
use awl_asm::manual;
use awl_asm::refused::REFUSED;
use plc_isa::{Group, INSTRUCTIONS, Instruction, PowerFlow};

use crate::process::root;
use crate::{block_pages, boards_page, demo, grammar, structured_grammar};

/// Writes the generated files, or only compares them.
pub fn run(check: bool) -> Result<()> {
    generated("docs/instructions.md", page().as_bytes(), check)?;
    generated(boards_page::FILE, boards_page::text().as_bytes(), check)?;
    generated(block_pages::FILE, block_pages::text()?.as_bytes(), check)?;
    // An extension of VS Code has all of its files in its own folder.
    for file in ["editors/awl.tmLanguage.json", "editors/vscode/awl.tmLanguage.json"] {
        generated(file, grammar::text().as_bytes(), check)?;
    }
    for file in ["editors/st.tmLanguage.json", "editors/vscode/st.tmLanguage.json"] {
        generated(file, structured_grammar::text().as_bytes(), check)?;
    }
    let words = "ide/page/src/editor/structured_words.ts";
    generated(words, structured_grammar::words().as_bytes(), check)?;
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

/// What Micro/WIN accepts (docs/s7-200.md 1.10). `x` stands for = <> >= <= > <.
const MICRO_WIN: &str = "LD A O LDN AN ON LDI AI OI LDNI ANI ONI NOT EU ED ALD OLD LPS LDS LRD LPP \
    = =I S SI R RI AENO NOP \
    TODR TODW TODRX TODWX XMT RCV NETR NETW GPA SPA LDBx ABx OBx LDWx AWx OWx LDDx ADx ODx LDRx \
    ARx ORx LDSx ASx OSx \
    BTI ITB ITD ITS DTI DTR DTS ROUND TRUNC RTS BCDI IBCD ITA DTA RTA ATH HTA STI STD STR DECO \
    ENCO SEG CTU CTD CTUD \
    HDEF HSC PLS +R -R *R /R SQRT SIN COS TAN LN EXP PID +I -I *I /I +D -D *D /D MUL DIV INCB INCW \
    INCD DECB DECW DECD \
    INVB INVW INVD ANDB ANDW ANDD ORB ORW ORD XORB XORW XORD MOVB MOVW MOVD MOVR BMB BMW BMD SWAP \
    BIR BIW FOR NEXT JMP \
    LBL LSCR SCRT SCRE CSCRE END STOP WDR DLED SLB SLW SLD SRB SRW SRD RLB RLW RLD RRB RRW RRD \
    SHRB SLEN SCPY SSCPY SCAT \
    SFND CFND FILL ATT FNDx LIFO FIFO TON TONR TOF BITIM CITIM CALL ENI DISI ATCH DTCH CEVNT CRET \
    CRETI";

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
         *Cycles*: of each form on the board with power flow, 16 to the microsecond, in bytecode. \
         Before a colon is the\n\
         module of the instruction ([docs/image.md](image.md)); its cycles go with values: what \
         was seen with values as programs\n\
         have them ([docs/benchmarks.md](benchmarks.md)), operands in memory. A pointer adds \
         {near},\n\
         to a timer or counter up to {far} and more where there are many, a constant {constant} at \
         most.\n\n\
         Operands: **bit** I Q M SM S V T C L; **byte** IB QB MB SMB SB VB LB AC; **word** IW QW \
         MW SMW SW VW LW T C AC AIW Ain;\n\
         **double word** and **real** ID QD MD SMD SD VD LD AC HC. Operands of module instructions \
         can also be pointers (`*AC1`,\n\
         `*VD10`, `*LD0`). Outputs exclude inputs and SMB0 to SMB29.\n",
    );
    for (group, title) in GROUPS {
        let _ = write!(text, "\n## {title}\n\n");
        text.push_str(
            "| AWL | also | operands | meaning | stack | bytes | cycles |\n\
            |---|---|---|---|---|---|---|\n",
        );
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
        "\n## Coverage\n\n{} of the {} mnemonics that Micro/WIN accepts (comparisons counted once \
            for all relations).\n",
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
    let also: Vec<String> =
        instruction.mnemonics.iter().skip(1).map(|name| format!("`{name}{relation}`")).collect();
    let forms: Vec<String> =
        instruction.forms.iter().map(|form| form.encoded_len().to_string()).collect();
    let boxed = if instruction.power_flow == PowerFlow::Needed { " Box." } else { "" };
    let stack = instruction.stack;
    let _ = writeln!(
        text,
        "| `{}{relation}` | {} | {} | {}{boxed} | needs {}, {:+} | {} | {} |",
        instruction.mnemonic(),
        also.join(" "),
        manual::operands(instruction).replace('|', "\\|"),
        instruction.doc.trim(),
        stack.needs,
        stack.adds,
        forms.join(", "),
        manual::cycles(instruction),
    );
}
