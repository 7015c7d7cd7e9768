//! What an S7-200 has and an Uno has not: says so at assembly, with the reason and the nearest way that works.

use plc_isa::{DIGITAL_INPUTS, DIGITAL_OUTPUTS, Op};

use crate::address::Address;
use crate::ast::{Instruction, Span, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::select::{Argument, Selected};

/// Instructions that no Uno can execute: mnemonic, reason, nearest way.
const REFUSED: [(&str, &str, &str); 4] = [
    ("NETR", "there is no PPI network behind the Uno's serial line", "send and receive with XMT and RCV"),
    ("NETW", "there is no PPI network behind the Uno's serial line", "send and receive with XMT and RCV"),
    ("GPA", "there is no PPI network behind the Uno's serial line, so it has no address", "leave the instruction out"),
    ("SPA", "there is no PPI network behind the Uno's serial line, so it has no address", "leave the instruction out"),
];

/// Instructions that could be, but are not: mnemonic, and what is there instead.
const MISSING: [(&str, &str); 2] = [
    ("TODRX", "uno200's clock knows no daylight saving time: read it with TODR"),
    ("TODWX", "uno200's clock knows no daylight saving time: set it with TODW"),
];

/// The words that begin such instructions.
pub(crate) fn refused_words() -> impl Iterator<Item = &'static str> {
    REFUSED.iter().map(|&(word, ..)| word).chain(MISSING.iter().map(|&(word, _)| word))
}

/// Why an instruction cannot be executed; `word` is its mnemonic.
pub(crate) fn refused(word: &str, span: Span) -> Option<Diagnostic> {
    if let Some((name, instead)) = MISSING.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)) {
        let message = format!("{name} is an S7-200 instruction that uno200 does not have");
        return Some(Diagnostic::new(Code::NotSupported, span, message).help(*instead));
    }
    let (name, reason, way) = REFUSED.iter().find(|(name, ..)| name.eq_ignore_ascii_case(word))?;
    Some(Diagnostic::new(Code::Hardware, span, format!("{name}: {reason}")).help(*way))
}

/// A high-speed counter that the Uno lacks.
pub(crate) fn counter(address: Address, span: Span) -> Option<Diagnostic> {
    match address {
        Address::HighSpeedCounter(number @ (1 | 2 | 4 | 5)) => Some(no_counter(number, span)),
        _ => None,
    }
}

fn no_counter(number: u8, span: Span) -> Diagnostic {
    let message = format!("HSC{number}: the Uno has the high-speed counters HSC0 on I0.0 and HSC3 on I0.1 only");
    Diagnostic::new(Code::Hardware, span, message).help("use HSC0 or HSC3 and its special memory")
}

/// What is wrong with operands that fit no form because the board is smaller than an S7-200.
pub(crate) fn misfit(source: &Instruction) -> Option<Diagnostic> {
    let operand = source.operands.first()?;
    let (area, count, way) = match source.mnemonic {
        "LDI" | "LDNI" | "AI" | "ANI" | "OI" | "ONI" => ("I", DIGITAL_INPUTS, "inputs"),
        "=I" | "SI" | "RI" => ("Q", DIGITAL_OUTPUTS, "outputs"),
        _ => return None,
    };
    let Value::Address(address @ Address::Bit { area: found, byte, bit }) = operand.value else { return None };
    (found.name() == area && (byte > 0 || bit >= count)).then(|| {
        let message = format!("{address} has no pin on the Uno: an immediate instruction needs one");
        let help = format!("the Uno's {way} are {area}0.0 to {area}0.{}", count - 1);
        Diagnostic::new(Code::Hardware, operand.span, message).help(help)
    })
}

/// What the board cannot do of an instruction whose operands are right by themselves.
pub(crate) fn refusal(source: &Instruction, selected: &Selected) -> Option<Diagnostic> {
    let span = |index: usize| source.operands.get(index).map(|operand| operand.span).unwrap_or_default();
    match (selected.op, selected.arguments) {
        (Op::Atch, [_, Argument::Event(event), ..]) => no_event(event, span(1)),
        (Op::Dtch | Op::Cevnt, [Argument::Event(event), ..]) => no_event(event, span(0)),
        (Op::Hdef, [Argument::Number(counter), Argument::Number(mode), ..]) => {
            high_speed_counter(counter, span(0)).or_else(|| counter_mode(counter, mode, span(1)))
        }
        (Op::Hsc, [Argument::Number(counter), ..]) => high_speed_counter(counter, span(0)),
        (Op::Pls, [Argument::Number(output @ 2..), ..]) => {
            let message = format!("{output}: PLS has the outputs 0 and 1");
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
            let message = format!("{counter}: an S7-200 has the high-speed counters 0 to 5, the Uno has 0 and 3");
            Some(Diagnostic::new(Code::ConstantRange, span, message))
        }
    }
}

/// Modes of the counters with one input for the pulses. HSC0 can have its direction at I0.1, which is HSC3's otherwise.
fn counter_mode(counter: u8, mode: u8, span: Span) -> Option<Diagnostic> {
    let (possible, words): (&[u8], _) = match counter {
        0 => (&[0, 3, 6, 9], "0 (pulses), 3 (direction at I0.1), 6 (up and down) and 9 (A and B)"),
        _ => (&[0], "0 (pulses)"),
    };
    if possible.contains(&mode) {
        return None;
    }
    let message = format!("mode {mode}: the Uno has no pins for it");
    let code = if mode > 12 { Code::ConstantRange } else { Code::Hardware };
    Some(Diagnostic::new(code, span, message).help(format!("HSC{counter} has the modes {words}")))
}

/// The events of an Uno.
fn has_event(event: u8) -> bool {
    matches!(event, 0..=12 | 21..=23 | 27 | 32)
}

fn no_event(event: u8, span: Span) -> Option<Diagnostic> {
    if has_event(event) {
        return None;
    }
    let counter = "use HSC0 with the events 12 and 27, or HSC3 with event 32";
    let (what, way) = match event {
        13..=15 => ("HSC1", counter),
        16..=18 => ("HSC2", counter),
        19 | 20 => ("the end of a pulse output", "ask for the end in SM66.7 or SM76.7"),
        24..=26 => ("port 1", "the Uno has port 0 with the events 8, 9 and 23"),
        28 => ("the external reset of HSC0", "reset the counter with HSC, for example at an event of I0.2"),
        29..=31 => ("HSC4", counter),
        33 => ("HSC5", counter),
        _ => {
            let message = format!("{event}: an S7-200 has the events 0 to 33");
            return Some(Diagnostic::new(Code::Event, span, message));
        }
    };
    let message = format!("event {event} is of {what}, which the Uno lacks");
    Some(Diagnostic::new(Code::Event, span, message).help(way))
}
