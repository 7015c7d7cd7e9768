//! What a program uses and a board lacks. How much of it fits is said where memory and image are
//! planned.

use plc_isa::{Area, Kind, Op, Profile};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Argument, Selected, operand_span, source_of, span_of};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Reports instructions that a board has no hardware for.
pub(crate) fn lacking(
    program: &Program,
    code: &[Selected],
    profile: &Profile,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let missing = code
        .iter()
        .filter(|_| !profile.has_events)
        .filter_map(|one| no_events(program, one, profile));
    let pins = code.iter().filter_map(|selected| no_pin(program, selected, profile));
    diagnostics.extend(missing.chain(pins));
}

/// An instruction that is for interrupt events, high-speed counters or pulse outputs.
fn no_events(program: &Program, selected: &Selected, profile: &Profile) -> Option<Diagnostic> {
    let is_counter = |argument| {
        matches!(argument, Argument::Bit(address) | Argument::Memory(address)
            if matches!(address, Address::HighSpeedCounter(_)))
    };
    let what = match selected.op {
        Op::Atch | Op::Dtch | Op::Cevnt => "interrupt events",
        Op::Pls => "pulse outputs",
        Op::Hdef | Op::Hsc => "high-speed counters",
        _ if selected.arguments().any(|(argument, _)| is_counter(argument)) => {
            "high-speed counters"
        }
        _ => return None,
    };
    let name = source_of(program, selected)?.mnemonic();
    let message = format!("{name}: {} has no {what}", profile.title);
    Some(Diagnostic::new(Code::Hardware, span_of(program, selected), message))
}

/// An immediate instruction with a point that has no pin.
fn no_pin(program: &Program, selected: &Selected, profile: &Profile) -> Option<Diagnostic> {
    let (area, way) = match selected.kinds.first()? {
        Kind::InputPoint => (Area::I, "inputs"),
        Kind::OutputPoint => (Area::Q, "outputs"),
        _ => return None,
    };
    let Argument::Bit(address @ Address::Bit { byte, bit, .. }) = selected.arguments[0] else {
        return None;
    };
    let (count, board, name) = (profile.points(area), profile.title, area.name());
    (byte > 0 || bit >= count).then(|| {
        let span = operand_span(program, selected, 0);
        let address = told(program, span, address);
        let message =
            format!("{address} has no pin on {board}: an immediate instruction needs one");
        let help = format!("{board}'s {way} are {name}0.0 to {name}0.{}", count - 1);
        Diagnostic::new(Code::Hardware, span, message).help(help)
    })
}
