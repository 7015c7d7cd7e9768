//! Bits that `=` writes in every scan, and S or R beside it, which then keep nothing.

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::parting::may_part;
use crate::meaning::check::rung::is_of_first_scan;
use crate::meaning::check::usage::{Access, Usage};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Warns of S, and of R before `=`; what is only for the first scan does no harm. An R after `=`
/// takes the bit back as long as it is executed, which is a use of its own.
pub fn mixed_coils(
    program: &Program,
    code: &[Selected],
    usage: &Usage,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (&address, accesses) in &usage.accesses {
        if !matches!(address, Address::Bit { area: Area::Q | Area::M | Area::V, .. }) {
            continue;
        }
        let op = |access: &Access| code.get(access.instruction).map(|selected| selected.op);
        let Some(coil) = accesses.iter().find(|access| op(access) == Some(Op::Assign)) else {
            continue;
        };
        let lost = |access: &&Access| {
            let is_before = access.instruction < coil.instruction;
            let is_lost = match op(access) {
                Some(Op::Set) => true,
                Some(Op::Reset) => is_before,
                _ => false,
            };
            is_lost && !is_of_first_scan(&code[..access.instruction])
        };
        // The nearest on each side: what may be between them parts those farther away, too.
        let at = accesses.partition_point(|access| access.instruction < coil.instruction);
        let before = accesses[..at].iter().rfind(lost);
        let after = accesses[at..].iter().find(lost);
        let parted = |access: &&Access| {
            let ends = [access.instruction, coil.instruction];
            may_part(program, code, ends[0].min(ends[1])..ends[0].max(ends[1]))
        };
        let lost = before.into_iter().chain(after).find(|access| !parted(access));
        if let Some(access) = lost {
            let name = code[access.instruction].op.instruction().mnemonic();
            let span = operand_span(program, &code[access.instruction], access.operand);
            let address = told(program, span, address);
            let message =
                format!("{address} does not stay as {name} leaves it: `=` writes it in every scan");
            diagnostics.push(
                Diagnostic::new(Code::MixedCoils, span, message)
                    .related(span_of(program, &code[coil.instruction]), "written here")
                    .help("use S and R alone, or `=` alone with a contact of the bit itself"),
            );
        }
    }
}
