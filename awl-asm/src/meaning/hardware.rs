//! What an S7-200 has and an Uno has not: says so at assembly, with the reason and the nearest way
//! that works.

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, span_of};
use crate::text::address::Address;
use crate::text::ast::{Instruction, Program, Span};

/// A high-speed counter that the Uno lacks.
pub(crate) fn counter(address: Address, span: Span) -> Option<Diagnostic> {
    match address {
        Address::HighSpeedCounter(number @ (1 | 2 | 4 | 5)) => Some(no_counter(number, span)),
        _ => None,
    }
}

fn no_counter(number: u8, span: Span) -> Diagnostic {
    let message = format!(
        "HSC{number}: the Uno has the high-speed counters HSC0 on I0.0 and HSC3 on I0.1 only"
    );
    Diagnostic::new(Code::Hardware, span, message).help("use HSC0 or HSC3 and its special memory")
}

/// What the board cannot do of an instruction whose operands are right by themselves.
pub(crate) fn refusal(source: &Instruction, selected: &Selected) -> Option<Diagnostic> {
    let span =
        |index: usize| source.operands.get(index).map(|operand| operand.span).unwrap_or_default();
    match (selected.op, selected.arguments) {
        (Op::Atch, [_, Argument::Event(event), ..]) => no_event(event, span(1)),
        (Op::Dtch | Op::Cevnt, [Argument::Event(event), ..]) => no_event(event, span(0)),
        (Op::Hdef, [Argument::Number(counter), Argument::Number(mode), ..]) => {
            high_speed_counter(counter, span(0)).or_else(|| counter_mode(counter, mode, span(1)))
        }
        (Op::Hsc, [Argument::Number(counter), ..]) => high_speed_counter(counter, span(0)),
        (Op::Pls, [Argument::Number(0), ..]) => {
            let message = "PLS 0: Q0.0 is pin D8, after which no timer makes pulses";
            Some(
                Diagnostic::new(Code::Hardware, span(0), message)
                    .help("use PLS 1: Q0.1 is pin D9, SMB76 and SMB77 on"),
            )
        }
        (Op::Pls, [Argument::Number(output @ 2..), ..]) => {
            let message =
                format!("{output}: an S7-200 has the pulse outputs 0 and 1, the Uno has 1");
            Some(Diagnostic::new(Code::ConstantRange, span(0), message))
        }
        (Op::Xmt | Op::Rcv, [_, Argument::Number(port @ 1..), ..]) => {
            let message = format!("port {port}: the Uno has one serial line, port 0");
            Some(Diagnostic::new(Code::Hardware, span(1), message).suggest("0"))
        }
        _ => None,
    }
}

fn high_speed_counter(counter: u8, span: Span) -> Option<Diagnostic> {
    match counter {
        0 | 3 => None,
        1..=5 => Some(no_counter(counter, span)),
        _ => {
            let message = format!(
                "{counter}: an S7-200 has the high-speed counters 0 to 5, the Uno has 0 and 3"
            );
            Some(Diagnostic::new(Code::ConstantRange, span, message))
        }
    }
}

/// The modes whose inputs have pins: HSC0 takes I0.0, I0.1 and for the reset I0.2, HSC3 has I0.1
/// alone.
fn counter_mode(counter: u8, mode: u8, span: Span) -> Option<Diagnostic> {
    let (possible, words): (&[u8], _) = match counter {
        0 => (
            &[0, 1, 3, 4, 6, 7, 9, 10],
            "0 and 1 (pulses), 3 and 4 (direction at I0.1), 6 and 7 (up and down), 9 and 10 (A \
             and B)",
        ),
        _ => (&[0], "0 (pulses)"),
    };
    if possible.contains(&mode) {
        return None;
    }
    let message = match mode {
        0..=12 => format!("mode {mode}: HSC{counter} has no inputs for it"),
        _ => format!("{mode}: high-speed counters have the modes 0 to 12"),
    };
    let code = if mode > 12 { Code::ConstantRange } else { Code::Hardware };
    Some(Diagnostic::new(code, span, message).help(format!("HSC{counter} has the modes {words}")))
}

/// The pulse output and an analog output in one program: the same timer makes both.
pub(crate) fn shared_timer(program: &Program, code: &[Selected]) -> Option<Diagnostic> {
    let output = |selected: &Selected| {
        selected.arguments().find_map(|(argument, is_written)| match argument {
            Argument::Memory(Address::AnalogOutput(channel)) if is_written => Some(channel),
            Argument::Pointer(Address::AnalogOutput(channel)) => Some(channel),
            _ => None,
        })
    };
    let (analog, channel) = code.iter().find_map(|selected| Some((selected, output(selected)?)))?;
    let pulses = code
        .iter()
        .find(|selected| selected.op == Op::Pls && selected.arguments[0] == Argument::Number(1))?;
    let address = Address::AnalogOutput(channel);
    let message = format!("PLS 1 and {address} need the same timer of the Uno");
    let diagnostic = Diagnostic::new(Code::Hardware, span_of(program, pulses), message);
    let diagnostic = diagnostic.related(span_of(program, analog), format!("{address} here"));
    Some(diagnostic.help(
        "AQW0 without AQW2 is what PWM of PLS 1 does too: SMB77, SMW78 and \
        SMW80 set cycle and width",
    ))
}

/// An analog output and the digital output at the same pin in one program.
pub(crate) fn shared_pins(program: &Program, code: &[Selected]) -> Vec<Diagnostic> {
    let writer = |wanted: Argument| {
        let writes =
            |selected: &&Selected| selected.arguments().any(|written| written == (wanted, true));
        code.iter().find(writes)
    };
    let profile = program.profile;
    let shared = |channel: u8| {
        let (analog, bit) = (
            Address::AnalogOutput(channel),
            Address::Bit { area: Area::Q, byte: 0, bit: channel + 1 },
        );
        let (written, digital) = (writer(Argument::Memory(analog))?, writer(Argument::Bit(bit))?);
        let pin = profile.output_pins.get(usize::from(channel) + 1)?;
        let message = format!("{bit} and {analog} are the same pin of {}, {pin}", profile.title);
        let diagnostic = Diagnostic::new(Code::Hardware, span_of(program, digital), message);
        let diagnostic = diagnostic.related(span_of(program, written), format!("{analog} here"));
        let last = profile.digital_outputs() - 1;
        let help = format!("the other digital outputs, Q0.0 and Q0.3 to Q0.{last}, share nothing");
        Some(diagnostic.help(help))
    };
    (0..profile.analog_outputs).filter_map(shared).collect()
}

/// The events of an Uno.
fn has_event(event: u8) -> bool {
    matches!(event, 0..=12 | 20..=23 | 27 | 28 | 32)
}

fn no_event(event: u8, span: Span) -> Option<Diagnostic> {
    if has_event(event) {
        return None;
    }
    let counter = "use HSC0 with the events 12, 27 and 28, or HSC3 with event 32";
    let (what, way) = match event {
        13..=15 => ("HSC1", counter),
        16..=18 => ("HSC2", counter),
        19 => ("pulse output 0", "use pulse output 1 with event 20"),
        24..=26 => ("port 1", "the Uno has port 0 with the events 8, 9 and 23"),
        29..=31 => ("HSC4", counter),
        33 => ("HSC5", counter),
        _ => {
            let message = format!("{event}: an S7-200 has the events 0 to 33");
            let help = "such as 0 for the rising edge of I0.0, 1 for its falling one, 10 for the \
                        time in SMB34, 21 for T32, 8 for a character that is received";
            return Some(Diagnostic::new(Code::Event, span, message).help(help));
        }
    };
    let message = format!("event {event} is of {what}, which the Uno lacks");
    Some(Diagnostic::new(Code::Event, span, message).help(way))
}
