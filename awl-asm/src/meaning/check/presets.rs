//! Timers and counters that have nothing to wait for: a preset of 0 or less, a counter whose reset
//! is always 1, a fine timer that resets itself before anything has seen its bit.

use std::collections::HashMap;

use plc_isa::{Area, Op, TimerKind, TimerResolution, timer_resolution};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::rung::contacts;
use crate::meaning::quoted::{short, told};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Warns of each.
pub fn presets(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let first_reads = first_reads(code);
    for (index, selected) in code.iter().enumerate() {
        match selected.arguments[0] {
            Argument::Timer(number) if TimerKind::started_by(selected.op).is_some() => {
                let address = Address::Timer(number);
                diagnostics.extend(no_time(program, selected, address));
                diagnostics.extend(unseen(program, code, index, &first_reads));
            }
            Argument::Counter(number) if is_counter(selected.op) => {
                let address = Address::Counter(number);
                diagnostics.extend(no_time(program, selected, address));
                diagnostics.extend(held(program, &code[..index], selected, address));
            }
            _ => {}
        }
    }
}

/// Where the bit of each timer is read first.
fn first_reads(code: &[Selected]) -> HashMap<u8, usize> {
    let mut first = HashMap::new();
    for (index, selected) in code.iter().enumerate() {
        for argument in selected.arguments {
            if let Argument::Bit(Address::Timer(number)) = argument {
                first.entry(number).or_insert(index);
            }
        }
    }
    first
}

fn is_counter(op: Op) -> bool {
    matches!(op, Op::Ctu | Op::Ctd | Op::Ctud)
}

/// A preset that is reached from the beginning.
fn no_time(program: &Program, selected: &Selected, address: Address) -> Option<Diagnostic> {
    let Argument::Constant(preset) = selected.arguments[1] else { return None };
    let preset = preset as i16;
    if preset > 0 {
        return None;
    }
    let name = told(program, operand_span(program, selected, 0), address);
    let short = short(program, operand_span(program, selected, 0), address);
    let mnemonic = selected.op.instruction().mnemonic();
    let (message, help) = match address {
        Address::Timer(number) => {
            let base = timer_resolution(number).ms();
            (
                format!("{name} has nothing to wait for: its preset is {preset}"),
                format!(
                    "it is a number of {base} ms: `{mnemonic} {short}, {}` is 2 s",
                    2000 / base
                ),
            )
        }
        _ => (
            format!("{name} has nothing to count: its preset is {preset}"),
            format!("its bit is 1 after as many counts as that: `{mnemonic} {short}, 10`"),
        ),
    };
    let span = operand_span(program, selected, 1);
    Some(Diagnostic::new(Code::NoPreset, span, message).help(help))
}

/// A counter whose last contact is always 1: it is reset, or loaded, in every scan.
fn held(
    program: &Program,
    before: &[Selected],
    selected: &Selected,
    address: Address,
) -> Option<Diagnostic> {
    let last = before.last()?;
    let always = Argument::Bit(Address::Bit { area: Area::Sm, byte: 0, bit: 0 });
    if last.op != Op::Ld || last.arguments[0] != always {
        return None;
    }
    let name = told(program, operand_span(program, selected, 0), address);
    let (does, verb) = if selected.op == Op::Ctd { ("loads", "load") } else { ("resets", "reset") };
    let message = format!("{name} never counts: what {does} it is always 1");
    Some(
        Diagnostic::new(Code::AlwaysReset, span_of(program, last), message)
            .related(span_of(program, selected), "the counter")
            .help(format!(
                "the last load before it {does} it, such as `LD I0.1`; `LDN SM0.0`, which is \
                 always 0, does not {verb} it ever"
            )),
    )
}

/// A timer of 1 or 10 ms that its own bit stops, and whose bit is only read further down: it is 0
/// again there.
fn unseen(
    program: &Program,
    code: &[Selected],
    index: usize,
    first_reads: &HashMap<u8, usize>,
) -> Option<Diagnostic> {
    let selected = code.get(index).filter(|selected| selected.op == Op::Ton)?;
    let Argument::Timer(number) = selected.arguments[0] else { return None };
    if timer_resolution(number) == TimerResolution::Ms100 {
        return None;
    }
    let bit = Argument::Bit(Address::Timer(number));
    let reads = |one: &Selected| one.arguments.contains(&bit);
    let own = contacts(&code[..index]).iter().find(|contact| reads(contact))?;
    if !matches!(own.op, Op::Ldn | Op::An) {
        return None;
    }
    let start = index - contacts(&code[..index]).len();
    let is_seen = first_reads.get(&number).is_some_and(|&first| first < start);
    let reader = code[index + 1..].iter().find(|one| reads(one)).filter(|_| !is_seen)?;
    let short = short(program, operand_span(program, selected, 0), Address::Timer(number));
    let message = format!(
        "{short} stops itself before its bit is read: it counts {} ms, not scans",
        timer_resolution(number).ms()
    );
    Some(
        Diagnostic::new(Code::UnseenTimer, operand_span(program, own, 0), message)
            .related(span_of(program, reader), "here it is 0 again")
            .help(
                "an output takes the place of the timer's bit: `LDN M0.0`, the timer, then `LD` of \
                 the timer, `= M0.0`; or a timer of 100 ms such as T37",
            ),
    )
}
