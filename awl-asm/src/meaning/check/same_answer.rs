//! Comparisons of an analog input with a number that it never reaches: their answer is always the
//! same.

use plc_isa::{AnalogInput, Relation};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Warns of each.
pub fn same_answer(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    for selected in code {
        let Some(relation) = selected.relation else { continue };
        let (input, input_index, number, is_first) = match selected.arguments {
            [Argument::Memory(Address::Analog(input)), Argument::Constant(number), ..] => {
                (input, 0, number as i16, true)
            }
            [Argument::Constant(number), Argument::Memory(Address::Analog(input)), ..] => {
                (input, 1, number as i16, false)
            }
            _ => continue,
        };
        let most = match input {
            AnalogInput::Scaled(_) => AnalogInput::SCALED_MAX as i16,
            AnalogInput::Raw(_) => AnalogInput::RAW_MAX as i16,
        };
        let holds = |value: i16| match is_first {
            true => relation.holds(value, number),
            false => relation.holds(number, value),
        };
        let is_same = match relation {
            Relation::Equal | Relation::NotEqual => !(0..=most).contains(&number),
            _ => holds(0) == holds(most),
        };
        if !is_same {
            continue;
        }
        let name =
            told(program, operand_span(program, selected, input_index), Address::Analog(input));
        let answer = if holds(0) { "always" } else { "never" };
        let span = operand_span(program, selected, 1 - input_index);
        let message = format!("{name} has 0 to {most}: this is {answer} true");
        let mut warning = Diagnostic::new(Code::SameAnswer, span, message);
        if let AnalogInput::Raw(channel) = input {
            let scaled = AnalogInput::Scaled(channel);
            warning = warning.help(format!(
                "the same input with 0 to {} is `{}`",
                AnalogInput::SCALED_MAX,
                Address::Analog(scaled)
            ));
        }
        diagnostics.push(warning.help("compare it with a number between its ends"));
    }
}
