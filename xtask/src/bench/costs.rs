//! Writes awl-asm/src/output/cost/modules.rs from figures: what the assembler and
//! docs/instructions.md say about instructions whose time goes with values. It measures nothing.

use std::fmt::Write as _;

use anyhow::{Context, Result, ensure};
use awl_asm::cost::of_form;
use plc_isa::{INSTRUCTIONS, Instruction, Op};

use super::record::{INTERPRETER, Record, TYPICAL, find};

/// The rows that say what a pointer and a constant add: beside the first; and a pointer to what is
/// looked for longest.
const DIRECT: &str = "MOVD VD4, VD8";
const BY_POINTER: [&str; 2] = ["MOVD *AC1, VD8", "MOVD VD8, *AC1"];
const FAR: (&str, &str) = ("MOVW *AC1, VW4", "MOVW *AC1, VW4 // a counter");
const OF_CONSTANT: [&str; 2] = ["MOVD 5, VD8", "MOVD 100000, VD8"];

/// The file.
pub fn table(records: &[Record]) -> Result<String> {
    let typical = |name: &str| {
        let record = find(records, INTERPRETER, TYPICAL, name)
            .with_context(|| format!("{name} is not measured"))?;
        Ok::<u32, anyhow::Error>(record.max as u32)
    };
    let direct = typical(DIRECT)?;
    let most_more = |names: [&str; 2]| {
        let found = names.iter().map(|name| typical(name)).collect::<Result<Vec<u32>>>()?;
        Ok::<u32, anyhow::Error>(found.into_iter().max().unwrap_or(direct).saturating_sub(direct))
    };
    let (pointer, constant) = (most_more(BY_POINTER)?, most_more(OF_CONSTANT)?);
    let far = pointer + typical(FAR.1)?.saturating_sub(typical(FAR.0)?);
    let mut text = format!(
        "//! What was measured of instructions whose time goes with values. Written by `cargo \
            xtask bench`;\n//! do not edit.\n\n\
         use plc_isa::Op;\n\nuse super::typical::{{Typical, of}};\n\n\
         /// What a pointer adds, to V memory and to a counter, and a constant at most.\n\
         pub(super) const POINTER: [u32; 2] = [{pointer}, {far}];\n\
         pub(super) const CONSTANT: u32 = {constant};\n\npub(super) const TABLE: &[Typical] = &[\n"
    );
    let mut seen: Vec<Op> = Vec::new();
    for record in records.iter().filter(|record| record.what == TYPICAL) {
        let Some(row) = instruction(&record.name) else {
            let is_known = INSTRUCTIONS.iter().any(|row| is_named(row, &record.name));
            ensure!(is_known, "what is {}?", record.name);
            // Its forms have cycles of their own, which do not go with values.
            continue;
        };
        let op = row.op;
        // The first row of an instruction is the one with operands in memory.
        if !seen.contains(&op) {
            seen.push(op);
            line(&mut text, op, records, &record.name, pointer)?;
        }
    }
    Ok(text + "];\n")
}

/// A line of the table, without what pointers add.
fn line(text: &mut String, op: Op, records: &[Record], name: &str, pointer: u32) -> Result<()> {
    // A star also begins the name of a multiplication.
    let pointers = pointer * name.matches("*AC").count() as u32;
    let of = |what: &str| find(records, INTERPRETER, what, name);
    let (range, typical) =
        of("cycles").zip(of(TYPICAL)).with_context(|| format!("{name} is not measured"))?;
    let [least, typical, most] =
        [range.min, typical.max, range.max].map(|cycles| (cycles as u32).saturating_sub(pointers));
    let off = of("without power flow").map_or(0, |record| record.max as u32);
    let each = records.iter().filter(|record| record.name == name).find_map(Record::each);
    let each = match each.filter(|(cycles, ..)| *cycles > 0.0) {
        Some((cycles, unit, usual)) => format!("Some(({cycles}, {unit:?}, {usual}))"),
        None => "None".to_string(),
    };
    writeln!(text, "    of(Op::{op:?}, {off}, [{least}, {typical}, {most}], {each}),")?;
    Ok(())
}

/// The instruction of a row: of those with its mnemonic the one of a module, or the one whose forms
/// have no cycles of their own.
pub fn instruction(name: &str) -> Option<&'static Instruction> {
    let is = |row: &&Instruction| is_named(row, name);
    let is_apart =
        |row: &&Instruction| row.forms.iter().all(|form| of_form(row.op, form.kinds).is_none());
    let of_module = INSTRUCTIONS.iter().filter(is).find(|row| row.module().is_some());
    of_module.or_else(|| INSTRUCTIONS.iter().filter(is).find(is_apart))
}

/// Whether the name of a row begins with the mnemonic of an instruction.
fn is_named(row: &Instruction, name: &str) -> bool {
    let word = name.split_whitespace().next().unwrap_or_default().trim_end_matches("{x}");
    let stem = if row.has_relation() { word.trim_end_matches(['=', '<', '>']) } else { word };
    row.mnemonic() == stem
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::record::{HEAD, parse_all};

    #[test]
    fn rows_name_their_instructions() {
        let op = |name: &str| instruction(name).map(|row| row.op);
        assert_eq!(op("+I *AC1, VW6"), Some(Op::AddIntAny));
        assert_eq!(op("LDB{x} *AC1, VB4"), Some(Op::LoadByteAny));
        assert_eq!(op("LDS= VB0, VB100"), Some(Op::LoadText));
        assert_eq!(op("=I Q0.1"), Some(Op::AssignImmediate));
        assert_eq!(op("FND= VW2, VW260, VW262"), Some(Op::Fnd));
        assert_eq!(op("CALL Part"), Some(Op::Call));
        assert_eq!(op("TON T37, 5"), None);
    }

    #[test]
    fn a_line_is_without_pointers() {
        let lines = [
            "x,interpreter,cycles,221,221,,\"MOVD VD4, VD8\"",
            "x,interpreter,typical cycles,221,221,20,\"MOVD VD4, VD8\"",
            "x,interpreter,typical cycles,219,219,20,\"MOVD 5, VD8\"",
            "x,interpreter,typical cycles,228,228,20,\"MOVD 100000, VD8\"",
            "x,interpreter,typical cycles,341,341,34,\"MOVD *AC1, VD8\"",
            "x,interpreter,typical cycles,339,339,34,\"MOVD VD8, *AC1\"",
            "x,interpreter,typical cycles,338,338,,\"MOVW *AC1, VW4\"",
            "x,interpreter,cycles,338,338,,\"MOVW *AC1, VW4\"",
            "x,interpreter,typical cycles,449,449,,\"MOVW *AC1, VW4 // a counter\"",
            "x,interpreter,cycles,400,420,,\"*I *AC1, VW6\"",
            "x,interpreter,typical cycles,410,410,51,\"*I *AC1, VW6\"",
            "x,interpreter,without power flow,61,61,,\"*I *AC1, VW6\"",
            "x,interpreter,each word of 8,9,9,,\"*I *AC1, VW6\"",
        ];
        let text = table(&parse_all(&format!("{HEAD}\n{}", lines.join("\n"))).unwrap()).unwrap();
        assert!(
            text.contains("POINTER: [u32; 2] = [120, 231];") && text.contains("CONSTANT: u32 = 7;"),
            "{text}"
        );
        assert!(text.contains("    of(Op::Movd, 0, [221, 221, 221], None),\n"), "{text}");
        assert!(
            text.contains("    of(Op::MulIntAny, 61, [280, 290, 300], Some((9, \"word\", 8))),\n"),
            "{text}"
        );
    }
}
