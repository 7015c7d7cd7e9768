//! Interrupt routines that are attached in a program that never permits interrupts.

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, span_of};
use crate::text::ast::Program;

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
