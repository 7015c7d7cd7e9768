//! Local memory that is read and that nothing writes: often an input with a small l in place of the
//! capital I.

use plc_isa::Area;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::meaning::units::Units;
use crate::text::address::Address;
use crate::text::ast::{Program, UnitKind};

/// Warns of the first read of local memory in a unit without parameters that writes none of it.
pub fn local_reads(
    program: &Program,
    code: &[Selected],
    units: &Units,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for part in units.parts.iter().filter(|part| part.id.kind != UnitKind::Subroutine) {
        let part = code.get(part.code.clone()).unwrap_or(&[]);
        let local = || part.iter().flat_map(local_uses);
        // What comes from a pointer is written by an instruction that is not in the text.
        if local().any(|one| one.is_written) {
            continue;
        }
        let Some(LocalUse { selected, index, address, .. }) = local().next() else { continue };
        let message = format!("{address} is local memory, and nothing writes it");
        let meant = address.to_string().replacen('L', "I", 1);
        let span = operand_span(program, selected, index);
        diagnostics.push(
            Diagnostic::new(Code::NeverWritten, span, message)
                .help(format!("an input has the letter I: `{meant}`")),
        );
    }
}

/// One use of local memory.
struct LocalUse<'c> {
    selected: &'c Selected,
    /// The number of the operand.
    index: usize,
    address: Address,
    is_written: bool,
}

fn local_uses(selected: &Selected) -> impl Iterator<Item = LocalUse<'_>> {
    selected.arguments().enumerate().filter_map(move |(index, (argument, is_written))| {
        match argument {
            Argument::Bit(address) | Argument::Memory(address)
                if address.area() == Some(Area::L) =>
            {
                Some(LocalUse { selected, index, address, is_written })
            }
            _ => None,
        }
    })
}
