//! Interrupt routines that are attached and never executed: interrupts are not permitted, or the
//! time between them is not set.

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::Program;

/// The special bytes with the intervals of the events 10 and 11, in milliseconds.
const INTERVALS: [(u8, u16); 2] = [(10, 34), (11, 35)];

/// Warns of each ATCH of a timed event whose interval nothing sets.
pub fn intervals(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    for (event, byte) in INTERVALS {
        let is_it =
            |one: &&Selected| one.op == Op::Atch && one.arguments[1] == Argument::Event(event);
        let Some(attached) = code.iter().find(is_it) else { continue };
        if code.iter().any(|selected| writes(selected, byte)) {
            continue;
        }
        let message = format!("event {event} never comes: SMB{byte} does not say how often");
        let help = format!("`MOVB 100, SMB{byte}` before it makes it every 100 ms (1 to 255)");
        let span = operand_span(program, attached, 1);
        diagnostics.push(Diagnostic::new(Code::NoInterval, span, message).help(help));
    }
}

/// Whether an instruction may write a special byte.
fn writes(selected: &Selected, byte: u16) -> bool {
    selected.arguments().any(|(argument, written)| match argument {
        Argument::Bit(Address::Bit { area: Area::Sm, .. }) => written,
        // A block of bytes may begin before it.
        Argument::Memory(
            Address::Byte { area: Area::Sm, byte: first }
            | Address::Word { area: Area::Sm, byte: first }
            | Address::Double { area: Area::Sm, byte: first },
        ) => written && first <= byte,
        Argument::Pointer(
            Address::Byte { area: Area::Sm, .. }
            | Address::Word { area: Area::Sm, .. }
            | Address::Double { area: Area::Sm, .. },
        ) => true,
        _ => false,
    })
}

/// Warns of the first ATCH where no ENI is: what it attaches is never executed.
pub fn permission(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let first = |op: Op| code.iter().find(|selected| selected.op == op);
    let (Some(attached), None) = (first(Op::Atch), first(Op::Eni)) else { return };
    // What is no routine is reported already.
    if !matches!(attached.arguments[0], Argument::Routine(_)) {
        return;
    }
    let span = span_of(program, attached);
    let message = "the program never permits interrupts: what is attached here is never executed";
    diagnostics.push(
        Diagnostic::new(Code::NeverPermitted, span, message)
            .help("`ENI` on the line after it permits them"),
    );
}
