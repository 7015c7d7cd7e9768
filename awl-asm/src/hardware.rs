//! What an S7-200 has and an Uno has not: says so at assembly, with the reason and the nearest way that works.

use std::collections::BTreeSet;

use plc_isa::{DIGITAL_INPUTS, DIGITAL_OUTPUTS, Op};

use crate::address::Address;
use crate::ast::{Instruction, Program, Span, Value};
use crate::check::span_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::modules;
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
        (Op::Pls, [Argument::Number(0), ..]) => {
            let message = "PLS 0: Q0.0 is pin D8, behind which no timer makes pulses";
            Some(
                Diagnostic::new(Code::Hardware, span(0), message).help("use PLS 1: Q0.1 is pin D9, SMB76 and SMB77 on"),
            )
        }
        (Op::Pls, [Argument::Number(output @ 2..), ..]) => {
            let message = format!("{output}: an S7-200 has the pulse outputs 0 and 1, the Uno has 1");
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

/// The modes whose inputs have pins: HSC0 takes I0.0, I0.1 and for the reset I0.2, HSC3 has I0.1 alone.
fn counter_mode(counter: u8, mode: u8, span: Span) -> Option<Diagnostic> {
    let (possible, words): (&[u8], _) = match counter {
        0 => (
            &[0, 1, 3, 4, 6, 7, 9, 10],
            "0 and 1 (pulses), 3 and 4 (direction at I0.1), 6 and 7 (up and down), 9 and 10 (A and B)",
        ),
        _ => (&[0], "0 (pulses)"),
    };
    if possible.contains(&mode) {
        return None;
    }
    let message = format!("mode {mode}: HSC{counter} has no inputs for it");
    let code = if mode > 12 { Code::ConstantRange } else { Code::Hardware };
    Some(Diagnostic::new(code, span, message).help(format!("HSC{counter} has the modes {words}")))
}

/// The pulse output and the analog output of one pin in one program.
pub(crate) fn shared_pin(program: &Program, code: &[Selected]) -> Option<Diagnostic> {
    let writes_analog = |selected: &&Selected| {
        selected.arguments().any(|(argument, _)| argument == Argument::Memory(Address::AnalogOutput(0)))
    };
    let analog = code.iter().find(writes_analog)?;
    let pulses = code.iter().find(|selected| selected.op == Op::Pls && selected.arguments[0] == Argument::Number(1))?;
    let message = "PLS 1 and AQW0 are both at pin D9";
    let diagnostic = Diagnostic::new(Code::Hardware, span_of(program, pulses), message);
    Some(diagnostic.related(span_of(program, analog), "AQW0 here").help("AQW2 is at pin D10"))
}

/// Instructions that the board's firmware lacks, each where it stands first.
pub(crate) fn not_on_board(program: &Program, code: &[Selected]) -> Vec<Diagnostic> {
    let mut seen = BTreeSet::new();
    let missing = code.iter().filter(|selected| is_missing_on_board(selected.op) && seen.insert(selected.op));
    let diagnostic = |selected: &Selected| {
        let name = selected.op.instruction().mnemonic();
        let message = format!("{name}: the board does not have this instruction yet, the simulator runs it");
        Diagnostic::new(Code::NotOnBoard, span_of(program, selected), message)
    };
    missing.map(diagnostic).collect()
}

/// Whether there is no machine code for an instruction of a module.
fn is_missing_on_board(op: Op) -> bool {
    let instruction = op.instruction();
    let (Some(module), Some(form)) = (instruction.module(), instruction.forms.first()) else { return false };
    form.first_token >= modules::routines(module)
}

/// The events of an Uno.
fn has_event(event: u8) -> bool {
    matches!(event, 0..=12 | 21..=23 | 27 | 28 | 32)
}

fn no_event(event: u8, span: Span) -> Option<Diagnostic> {
    if has_event(event) {
        return None;
    }
    let counter = "use HSC0 with the events 12, 27 and 28, or HSC3 with event 32";
    let (what, way) = match event {
        13..=15 => ("HSC1", counter),
        16..=18 => ("HSC2", counter),
        19 | 20 => ("the end of a pulse output", "ask for the end in SM66.7 or SM76.7"),
        24..=26 => ("port 1", "the Uno has port 0 with the events 8, 9 and 23"),
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
