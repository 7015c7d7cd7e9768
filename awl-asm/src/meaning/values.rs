//! What the kinds of operands leave open: writing to what is read only, timer numbers, special
//! memory that lies in two pieces.

use plc_isa::{Area, TimerKind, TimerResolution, timer_family, timer_resolution};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::{is_placed_at, told};
use crate::meaning::selected::{Argument, Selected};
use crate::meaning::{hardware, limits};
use crate::text::address::Address;
use crate::text::ast::{self, Span};

/// Checks what the kinds leave open: writing to what is read only, and timer numbers.
pub(crate) fn check(
    program: &ast::Program,
    source: &ast::Instruction,
    selected: &Selected,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for ((argument, written), operand) in selected.arguments().zip(&source.operands) {
        if let (Argument::Bit(address) | Argument::Memory(address), true) = (argument, written) {
            diagnostics.extend(read_only(program, address, operand.span));
        }
    }
    if let (Some(kind), Argument::Timer(number)) =
        (TimerKind::started_by(selected.op), selected.arguments[0])
        && !kind.fits(number)
        && let Some(operand) = source.operands.first()
    {
        diagnostics.push(wrong_family(program, source.mnemonic(), number, kind, operand.span));
    }
    diagnostics.extend(limits::check(program, source, selected));
    for (argument, operand) in selected.arguments.iter().zip(&source.operands) {
        if let Argument::Bit(address) | Argument::Memory(address) = *argument {
            diagnostics.extend(torn(program, address, operand.span));
            diagnostics.extend(hardware::counter(address, operand.span));
        }
    }
    diagnostics.extend(hardware::refusal(source, selected));
}

/// Special memory lies in two pieces on the board.
fn torn(program: &ast::Program, address: Address, span: Span) -> Option<Diagnostic> {
    let (byte, len) = match address {
        Address::Word { area: Area::Sm, byte } => (byte, 2),
        Address::Double { area: Area::Sm, byte } => (byte, 4),
        _ => return None,
    };
    let border = Area::Sm.page_len();
    (byte < border && byte + len > border).then(|| {
        let address = told(program, span, address);
        let message = format!(
            "{address}: SMB{} and SMB{border} do not lie side by side on the Uno",
            border - 1
        );
        Diagnostic::new(Code::AddressRange, span, message).help(format!(
            "use one operand up to SMB{} and another from SMB{border} on",
            border - 1
        ))
    })
}

pub(crate) fn read_only(
    program: &ast::Program,
    address: Address,
    span: Span,
) -> Option<Diagnostic> {
    if !is_read_only(address) {
        return None;
    }
    let name = told(program, span, address);
    let message = match address {
        Address::Analog(_) => format!("{name} is an analog input: a program cannot write it"),
        Address::HighSpeedCounter(_) => {
            format!("{name} counts by itself: a program cannot write it")
        }
        _ => format!("{name} is written by the system: a program can only read SMB0 to SMB29"),
    };
    let way = match address {
        Address::Analog(_) => {
            "the analog outputs are `AQW0` and `AQW2`; values are kept in V memory"
        }
        Address::HighSpeedCounter(_) => "a new value is set by `HSC` with its SM bytes",
        _ => "keep the value in M or V memory; SMB30 and those above can be written",
    };
    Some(Diagnostic::new(Code::ReadOnly, span, message).label("read only").help(way))
}

/// Whether no program can write an address.
pub(crate) fn is_read_only(address: Address) -> bool {
    match address {
        Address::Bit { area, byte, .. }
        | Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => byte < area.first_writable(),
        Address::Analog(_) | Address::HighSpeedCounter(_) => true,
        Address::Timer(_)
        | Address::Counter(_)
        | Address::Accumulator(_)
        | Address::AnalogOutput(_) => false,
    }
}

fn wrong_family(
    program: &ast::Program,
    mnemonic: &str,
    number: u8,
    kind: TimerKind,
    span: Span,
) -> Diagnostic {
    let resolution = timer_resolution(number);
    let fitting: Vec<u8> = (0..=255)
        .filter(|&other| kind.fits(other) && timer_resolution(other) == resolution)
        .collect();
    let family = match timer_family(number) {
        plc_isa::TimerFamily::Tonr => "a TONR number",
        plc_isa::TimerFamily::TonTof => "a TON or TOF number",
    };
    let name = told(program, span, Address::Timer(number));
    let message = format!("{name} is {family}: {mnemonic} needs another one");
    let mut diagnostic = Diagnostic::new(Code::TimerFamily, span, message);
    if is_placed_at(program, span) {
        let kind = if kind == TimerKind::RetentiveOnDelay { " TONR" } else { "" };
        return diagnostic.help(format!(
            "its declaration says for what it is: `//# timer {name} {}ms{kind}`",
            resolution.ms()
        ));
    }
    diagnostic = diagnostic.help(format!(
        "with {}, {mnemonic} can use {}",
        resolution_words(resolution),
        ranges(&fitting)
    ));
    if let Some(first) = fitting.first() {
        diagnostic = diagnostic.suggest(format!("T{first}"));
    }
    diagnostic
}

fn resolution_words(resolution: TimerResolution) -> String {
    format!("{} ms", resolution.ms())
}

/// `T37-T63, T101-T255`
fn ranges(numbers: &[u8]) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut rest = numbers;
    while let Some(&first) = rest.first() {
        let run = rest.iter().zip(first..=255).take_while(|(a, b)| **a == *b).count();
        let last = rest[run - 1];
        parts.push(if run == 1 { format!("T{first}") } else { format!("T{first}-T{last}") });
        rest = &rest[run..];
    }
    parts.join(", ")
}
