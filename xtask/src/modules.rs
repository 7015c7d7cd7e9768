//! `cargo xtask modules`: from the sources in firmware/modules to the blobs in awl-asm/modules,
//! which the assembler puts into images. They are committed: hosts without the AVR toolchain
//! assemble programs, too.
//!
//! A blob: u16 offset of the jump table; for each of N routines its effect on the stack and the
//! offset of its operands' kinds; lists of kinds; for each routine the length of its operands, the
//! last routine's first; u16 length of the blob, u16 offset of the jump table, u8 bytes at the end
//! of data memory that it takes, u8 N; jump table; code.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use plc_isa::{
    AC_START, AIW_START, AQW_START, ARENA_START, COUNTER_SLOT_LEN, COUNTERS_MODULE, DATA_END,
    DATA_START, DIRECTORY_AT, ENO, EVENTS_MODULE, EVENTS_SEEN, FORCED, FREEPORT_MODULE, HC0, HC3,
    HEADER_LEN, Instruction, JUMP_TABLE, MODULE_NAMES, OPERANDS_MODULE, PULSES_MODULE, PowerFlow,
    REAL_MODULE, SLOT_START, SM_IN_V, SM_START, TIMER_SLOT_LEN, kind_numbers, module_instructions,
    packed_stack, state_at,
};

use crate::packages;
use crate::process::{root, run as run_command};

/// Bytes before the entries of the routines.
const OFFSET_LEN: usize = 2;
/// Bit in the length of a routine's operands: executed without power flow, too.
const ALWAYS: u8 = 0x80;

/// What others enter a module by, in the order of its jump table, after the routines.
fn entries_behind(number: u8) -> &'static [&'static str] {
    match number {
        REAL_MODULE => &[
            "real_add",
            "real_sub",
            "real_mul",
            "real_div",
            "real_from_int",
            "real_to_int",
            "real_from_fraction",
            "real_result",
        ],
        EVENTS_MODULE => &["events"],
        OPERANDS_MODULE => &["entry"],
        COUNTERS_MODULE => &["first_input", "second_input", "any_input"],
        PULSES_MODULE => &["cycle_end"],
        FREEPORT_MODULE => &["character", "sent", "timer"],
        _ => &[],
    }
}

/// Writes the modules whose sources are there, or only compares them.
pub fn run(check: bool) -> Result<()> {
    packages::ensure_installed(packages::AVR_LINKER)?;
    let mut failed = Vec::new();
    for (number, name) in (0..).zip(MODULE_NAMES) {
        let source = sources().join(name).with_extension("s");
        if source.exists()
            && let Err(error) = build(number, &source).and_then(|blob| keep(name, &blob, check))
        {
            eprintln!("{name}: {error:#}");
            failed.push(name);
        }
    }
    ensure!(failed.is_empty(), "not built: {}", failed.join(", "));
    Ok(())
}

fn sources() -> PathBuf {
    root().join("firmware/modules")
}

fn keep(name: &str, blob: &[u8], check: bool) -> Result<()> {
    let path = root().join("awl-asm/modules").join(name).with_extension("bin");
    if check {
        let kept = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        ensure!(
            kept == blob,
            "{} is not what its source says: run `cargo xtask modules`",
            path.display()
        );
        return Ok(());
    }
    println!("{name}: {} bytes", blob.len());
    fs::create_dir_all(path.parent().unwrap_or(&path))?;
    fs::write(&path, blob).with_context(|| format!("cannot write {}", path.display()))
}

fn build(number: u8, source: &Path) -> Result<Vec<u8>> {
    let text = text(number, source)?;
    let blob = assemble(&text, 0)?;
    // Programs differ in what is before a module.
    ensure!(blob == assemble(&text, 0x1000)?, "the code is not position independent");
    Ok(blob)
}

/// The module as assembly: what the loader and the engine read, and then the source.
fn text(number: u8, source: &Path) -> Result<String> {
    let instructions: Vec<_> = module_instructions(number).collect();
    let (entries, kinds) = entries(&instructions)?;
    let mut head = [entries, kinds].concat();
    if !(head.len() + instructions.len()).is_multiple_of(2) {
        head.push(0);
    }
    head.extend(instructions.iter().rev().map(|instruction| operands_len(instruction)));
    let mut text = "module:\n.word jump_table - module\n".to_owned();
    for byte in head {
        let _ = writeln!(text, ".byte {byte}");
    }
    let state = DATA_END - state_at(number);
    let _ = writeln!(
        text,
        ".word module_end - module, jump_table - module\n.byte {state}, {}\njump_table:",
        instructions.len()
    );
    for instruction in &instructions {
        let _ = writeln!(text, "rjmp {:?}", instruction.op);
    }
    for entry in entries_behind(number) {
        let _ = writeln!(text, "rjmp {entry}");
    }
    let _ = writeln!(text, ".include {:?}\n.balign 2, 0\nmodule_end:", source);
    for (name, value) in shared() {
        let _ = writeln!(
            text,
            ".if {name} != {value}\n.error \"{name} is not {value}, as plc-isa has it\"\n.endif"
        );
    }
    Ok(text)
}

/// Constants of interface.inc that plc-isa has, too.
fn shared() -> [(&'static str, u16); 26] {
    [
        ("JUMP_TABLE", JUMP_TABLE),
        ("DATA_START", DATA_START),
        ("DATA_END", DATA_END),
        ("ARENA_START", ARENA_START),
        ("RESULT_BITS", SM_START + 1),
        ("ERROR_BITS", SM_START + 4),
        ("ENO", ENO),
        ("ACCUMULATORS", AC_START),
        ("ANALOG_INPUTS", AIW_START),
        ("ANALOG_OUTPUTS", AQW_START),
        ("TIMER_SLOT_LEN", TIMER_SLOT_LEN),
        ("COUNTER_SLOT_LEN", COUNTER_SLOT_LEN),
        ("IMAGE", SLOT_START),
        ("IMAGE_HEADER_LEN", HEADER_LEN),
        ("IMAGE_DIRECTORY", SLOT_START + DIRECTORY_AT),
        ("HIGH_SPEED_COUNTER_0", HC0),
        ("HIGH_SPEED_COUNTER_3", HC3),
        ("SEEN", EVENTS_SEEN),
        ("FORCED_INPUTS", FORCED),
        ("FORCED_OUTPUTS", FORCED + 2),
        ("SPECIAL_IN_RANGES", SM_IN_V),
        ("EVENTS_STATE", state_at(EVENTS_MODULE)),
        ("COUNTERS_STATE", state_at(COUNTERS_MODULE)),
        ("PULSES_STATE", state_at(PULSES_MODULE)),
        ("FREEPORT_STATE", state_at(FREEPORT_MODULE)),
        ("OPERANDS_MODULE", u16::from(OPERANDS_MODULE)),
    ]
}

/// The entries of the routines and the lists of kinds after them, which many routines share.
fn entries(instructions: &[&Instruction]) -> Result<(Vec<u8>, Vec<u8>)> {
    let kinds_at = OFFSET_LEN + 2 * instructions.len();
    let (mut entries, mut kinds) = (Vec::new(), Vec::new());
    for (routine, instruction) in instructions.iter().enumerate() {
        let form = instruction.forms.first().context("an instruction without a form")?;
        ensure!(
            usize::from(form.first_token) == routine,
            "the routines are not numbered from 0 on"
        );
        let list: Vec<u8> = kind_numbers(instruction).collect();
        let at = kinds.windows(list.len()).position(|window| window == list).unwrap_or_else(|| {
            kinds.extend_from_slice(&list);
            kinds.len() - list.len()
        });
        entries.extend([
            packed_stack(instruction),
            u8::try_from(kinds_at + at).context("too many kinds")?,
        ]);
    }
    Ok((entries, kinds))
}

fn operands_len(instruction: &Instruction) -> u8 {
    let len: u8 =
        instruction.forms.iter().flat_map(|form| form.kinds).map(|kind| kind.stored_len()).sum();
    if instruction.power_flow == PowerFlow::Always { len | ALWAYS } else { len }
}

/// The bytes of an assembly text that begins at an address of flash.
fn assemble(text: &str, start: u16) -> Result<Vec<u8>> {
    let folder = root().join("target/modules");
    fs::create_dir_all(&folder)?;
    let [text_file, elf, bytes] =
        ["module.s", "module.elf", "module.bin"].map(|name| folder.join(name));
    fs::write(&text_file, text)?;
    let mut gcc = Command::new("avr-gcc");
    gcc.args(["-mmcu=atmega328p", "-nostartfiles", "-nostdlib", "-x", "assembler"]);
    gcc.arg(format!("-Wl,-Ttext={start:#x},--entry={start:#x}"));
    gcc.arg(format!("-Wa,-I{}", sources().display())).arg(&text_file).arg("-o").arg(&elf);
    run_command(&mut gcc)?;
    run_command(
        Command::new("avr-objcopy").args(["-O", "binary", "-j", ".text"]).args([&elf, &bytes]),
    )?;
    let bytes = fs::read(&bytes)?;
    if bytes.is_empty() {
        bail!("nothing was assembled");
    }
    Ok(bytes)
}
