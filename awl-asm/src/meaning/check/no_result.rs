//! Constants with which a calculation has no result: the divisor 0, the root of a negative number,
//! the logarithm of one that is not positive.

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::ast::Program;

/// Warns of each.
pub fn no_result(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    for selected in code {
        let Some((message, help)) = reason(selected) else { continue };
        let span = operand_span(program, selected, 0);
        diagnostics.push(Diagnostic::new(Code::NoResult, span, message).help(help));
    }
}

/// Why an instruction has no result, and what to do about it.
fn reason(selected: &Selected) -> Option<(&'static str, &'static str)> {
    let value = match selected.arguments[0] {
        Argument::Constant(value) => f64::from(value as i16),
        Argument::Literal(value) => f64::from(value),
        Argument::Real(bits) => f64::from(f32::from_bits(bits)),
        _ => return None,
    };
    let name = selected.op.instruction().mnemonic();
    match selected.op {
        _ if (name.starts_with('/') || name == "DIV") && value == 0.0 => Some((
            "a division by 0 has no result: SM1.3 becomes 1, and the second operand stays as it is",
            "the divisor is the first operand: `/I 2, VW0` halves VW0",
        )),
        Op::Sqrt if value < 0.0 => Some((
            "a negative number has no root: SM1.1 becomes 1, and the result is not written",
            "the root of a positive number is `SQRT 4.0, VD0`",
        )),
        Op::Ln if value <= 0.0 => Some((
            "the logarithm is that of a positive number: SM1.1 becomes 1, and the result is not \
             written",
            "such as `LN 2.0, VD0`",
        )),
        _ => None,
    }
}
