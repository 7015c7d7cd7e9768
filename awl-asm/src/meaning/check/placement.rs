//! Which instructions may be in which unit.

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::meaning::units::Units;
use crate::text::address::Address;
use crate::text::ast::{Program, UnitKind};

/// Reports instructions that are in the wrong unit, and sequence instructions for other bits than
/// those of S.
pub fn placement(
    program: &Program,
    code: &[Selected],
    units: &Units,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for part in &units.parts {
        let serves_interrupts = part.id.kind == UnitKind::Interrupt || !part.polls;
        for selected in code.get(part.code.clone()).unwrap_or(&[]) {
            let name = selected.op.instruction().mnemonic();
            let wrong = match (selected.op, part.id.kind) {
                (Op::End | Op::Eni | Op::Disi | Op::Hdef | Op::Lscr, _) if serves_interrupts => {
                    Some((
                        format!("{name} is not allowed while an interrupt is served"),
                        "move it to the main program",
                    ))
                }
                (Op::End, UnitKind::Subroutine) => Some((
                    "END ends the main program only".into(),
                    "CRET returns from a subroutine",
                )),
                (Op::Cret, UnitKind::Main) => Some((
                    "CRET returns from a subroutine only".into(),
                    "END ends the main program for this scan",
                )),
                (Op::Cret, UnitKind::Interrupt) => Some((
                    "CRET returns from a subroutine only".into(),
                    "CRETI returns from an interrupt routine",
                )),
                (Op::Creti, UnitKind::Main | UnitKind::Subroutine) => Some((
                    "CRETI returns from an interrupt routine only".into(),
                    "CRET returns from a subroutine",
                )),
                _ => None,
            };
            if let Some((message, help)) = wrong {
                diagnostics.push(
                    Diagnostic::new(Code::WrongUnit, span_of(program, selected), message)
                        .help(help),
                );
            }
            sequence_bit(program, selected, diagnostics);
        }
    }
}

fn sequence_bit(program: &Program, selected: &Selected, diagnostics: &mut Vec<Diagnostic>) {
    let (Op::Lscr | Op::Scrt, Argument::Bit(address)) = (selected.op, selected.arguments[0]) else {
        return;
    };
    if matches!(address, Address::Bit { area: Area::S, .. }) {
        return;
    }
    let name = selected.op.instruction().mnemonic();
    let message = format!("{name} takes a bit of S here, found {address}");
    let diagnostic =
        Diagnostic::new(Code::OperandKind, operand_span(program, selected, 0), message);
    diagnostics.push(
        diagnostic
            .label("wrong kind of operand")
            .help("S0.0 to S31.7 stand for the steps of a sequence"),
    );
}
