//! `cargo xtask size`: flash, SRAM and stack of the firmware, compared with their budgets.
//!
//! Flash and variables are read from the ELF. The deepest stack is measured on the virtual board:
//! `tests/tests/stack.rs` paints the free SRAM, runs every program there is, and looks how much
//! paint is left.

use std::fs;

use anyhow::{Context, Result, ensure};
use object::{Object, ObjectSection, ObjectSymbol};
use plc_isa::{DATA_LEN, SLOT_START};

use crate::process::{WITH_BOARD, cargo, run as run_command};
use crate::{budgets, firmware, packages};

/// Prints all figures; fails if one misses its budget.
pub fn run() -> Result<()> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    let result = gate();
    let mut stack = cargo();
    stack.args(["test", "--quiet", "--workspace", "--test", "stack"]).args(WITH_BOARD);
    run_command(stack.args(["--", "--nocapture"]))?;
    result
}

/// What the ELF alone tells. The stack has its test.
pub fn gate() -> Result<()> {
    let path = firmware::build()?;
    let bytes = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let elf = object::File::parse(&*bytes).context("the firmware is no ELF")?;
    let size = |name| elf.section_by_name(name).map_or(0, |section| section.size());
    let (text, data) = (size(".text"), size(".data"));
    let variables = data + size(".bss") + size(".noinit");
    let mut missed = 0;
    for (name, value, budget) in [
        ("flash", text + data, budgets::FIRMWARE_FLASH_MAX),
        ("initial values in SRAM", data, budgets::FIRMWARE_DATA_MAX),
        ("variables in SRAM", variables, budgets::FIRMWARE_VARIABLES_MAX),
    ] {
        let verdict = if value <= budget { "good" } else { "MISSED" };
        missed += usize::from(value > budget);
        println!("{name:<24} {value:>6} bytes   budget <= {budget:<6} {verdict}");
    }
    println!("beside them: data memory {DATA_LEN} bytes, program slot from {SLOT_START:#06x}");
    ensure!(missed == 0, "{missed} budgets missed");
    let panics = elf
        .symbols()
        .filter_map(|symbol| symbol.name().ok())
        .find(|name| name.contains("9panicking"));
    ensure!(panics.is_none(), "the firmware can panic: {}", panics.unwrap_or_default());
    println!("no panic in the firmware's own code");
    Ok(())
}
