//! Words and double words that share some of their bytes: VW0 and VW1; bits that are written inside
//! of a number that is counted: M0.0 and MW0. That a value has parts with
//! names of their own, VD0 and VW2, is common and no mistake.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::usage::{Access, Usage};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::Program;

/// A value that a program names.
struct Named {
    address: Address,
    bytes: Range<u16>,
    access: Access,
}

/// Warns of values that overlap in part, one of which is written: the later of both in the text.
pub fn overlap(
    program: &Program,
    code: &[Selected],
    usage: &Usage,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut areas: BTreeMap<Area, Vec<Named>> = BTreeMap::new();
    for (&address, accesses) in &usage.accesses {
        let Some((area, bytes)) = address.bytes().filter(|(_, bytes)| bytes.len() > 1) else {
            continue;
        };
        let write = accesses.iter().find(|access| access.writes);
        if let (Some(&access), Area::V | Area::M) = (write.or(accesses.first()), area) {
            areas.entry(area).or_default().push(Named { address, bytes, access });
        }
    }
    counted_bits(program, code, usage, diagnostics);
    let span = |of: &Named| operand_span(program, &code[of.access.instruction], of.access.operand);
    let name = |of: &Named| told(program, span(of), of.address);
    for named in areas.values_mut() {
        named.sort_by_key(|one| one.bytes.start);
        let pairs = named.iter().enumerate().flat_map(|(index, one)| {
            let after = named[index + 1..].iter();
            let inside = after.take_while(|next| next.bytes.start < one.bytes.end);
            inside.map(move |next| (one, next))
        });
        for (one, next) in pairs {
            // The next begins inside the one and goes on after it.
            let crosses = one.bytes.start < next.bytes.start && one.bytes.end < next.bytes.end;
            if !crosses || !(one.access.writes || next.access.writes) {
                continue;
            }
            let (first, second) = match one.access.instruction <= next.access.instruction {
                true => (one, next),
                false => (next, one),
            };
            let (a, b) = (name(first), name(second));
            let message =
                format!("{b} and {a} share bytes: what is written to one changes the other");
            let use_of = if first.access.writes { "written" } else { "read" };
            let len = if matches!(second.address, Address::Word { .. }) { "two" } else { "four" };
            diagnostics.push(
                Diagnostic::new(Code::Overlap, span(second), message)
                    .related(span(first), format!("{a} is {use_of} here"))
                    .help(format!(
                        "{b} takes {len} bytes; numbers of words go by two, of double words by four"
                    )),
            );
        }
    }
}

/// Warns of a bit that is written inside of a value that is counted with.
fn counted_bits(
    program: &Program,
    code: &[Selected],
    usage: &Usage,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut counted: HashMap<(Area, u16), (Address, Access)> = HashMap::new();
    for (&address, accesses) in &usage.accesses {
        let Some((area, bytes)) = address.bytes() else { continue };
        let counts = |access: &&Access| {
            access.writes && access.reads && is_counting(code[access.instruction].op)
        };
        if let (Area::V | Area::M, Some(&access)) = (area, accesses.iter().find(counts)) {
            counted.extend(bytes.map(|byte| ((area, byte), (address, access))));
        }
    }
    for (&bit, accesses) in usage.accesses.iter().filter(|_| !counted.is_empty()) {
        let Address::Bit { area, byte, .. } = bit else { continue };
        let written = accesses.iter().find(|access| access.writes);
        let around = counted.get(&(area, byte));
        let (Some(written), Some((value, counting))) = (written, around) else { continue };
        let span = operand_span(program, &code[written.instruction], written.operand);
        let there = operand_span(program, &code[counting.instruction], counting.operand);
        let (a, b) = (told(program, there, *value), told(program, span, bit));
        let message = format!(
            "{b} is a bit of {a}, which is a number: what is written to one changes the other"
        );
        diagnostics.push(
            Diagnostic::new(Code::Overlap, span, message)
                .related(there, format!("{a} is counted with here"))
                .help("a bit of its own is in a byte that no number takes"),
        );
    }
}

/// Whether an instruction takes its operand for a number, and changes it.
fn is_counting(op: Op) -> bool {
    let name = op.instruction().mnemonic();
    ["INC", "DEC", "+", "-", "*", "/"].iter().any(|start| name.starts_with(start))
}
