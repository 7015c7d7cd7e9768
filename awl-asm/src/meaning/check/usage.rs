//! Who reads and writes what: the cross-reference, and the warnings that follow from it.

use std::collections::BTreeMap;

use plc_isa::{Area, Kind, Op, Role, TimerKind};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::parting::may_part;
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::{Program, Span};

/// One use of an address by an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Access {
    /// Index of the selected instruction.
    pub instruction: usize,
    /// Position of the operand.
    pub operand: usize,
    /// Whether it is written, which may include reading.
    pub writes: bool,
    /// Whether it is read.
    pub reads: bool,
}

/// The cross-reference: every address with its uses in program order.
#[derive(Debug, Default)]
pub struct Usage {
    /// By address; timers and counters once for bit and value.
    pub accesses: BTreeMap<Address, Vec<Access>>,
}

/// Collects the uses and reports timers and counters of two kinds, and what deserves a warning.
pub fn usage(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Usage {
    let mut usage = Usage::default();
    for (index, selected) in code.iter().enumerate() {
        for (operand, (argument, written)) in selected.arguments().enumerate() {
            let reads = selected.role(operand).is_none_or(Role::reads) || !written;
            if let Some((address, reads, writes)) = access_of(argument, reads, written) {
                let operand = selected.parameter.map_or(operand, usize::from);
                let access = Access { instruction: index, operand, writes, reads };
                usage.accesses.entry(address).or_default().push(access);
            }
        }
    }
    let check = Check { program, code, unknown: uncertain(code) };
    for (&address, accesses) in &usage.accesses {
        check.address(address, accesses, diagnostics);
    }
    usage
}

/// The address an argument names, and whether the instruction reads and writes it.
fn access_of(argument: Argument, reads: bool, written: bool) -> Option<(Address, bool, bool)> {
    match argument {
        // Local memory is another one in each unit.
        Argument::Bit(address) | Argument::Memory(address) | Argument::Indirect(address)
            if is_local(address) =>
        {
            None
        }
        Argument::Bit(address) | Argument::Memory(address) => Some((address, reads, written)),
        Argument::Indirect(address) => Some((address, true, false)),
        Argument::Pointer(address) => Some((address, false, false)),
        Argument::Timer(number) => Some((Address::Timer(number), false, true)),
        Argument::Counter(number) => Some((Address::Counter(number), false, true)),
        Argument::Parameter(..)
        | Argument::Constant(_)
        | Argument::Literal(_)
        | Argument::Real(_)
        | Argument::Text(_)
        | Argument::Number(_)
        | Argument::Label(_)
        | Argument::Routine(_)
        | Argument::Event(_)
        | Argument::None => None,
    }
}

fn is_local(address: Address) -> bool {
    matches!(
        address,
        Address::Bit { area: Area::L, .. }
            | Address::Byte { area: Area::L, .. }
            | Address::Word { area: Area::L, .. }
            | Address::Double { area: Area::L, .. }
    )
}

struct Check<'a> {
    program: &'a Program,
    code: &'a [Selected],
    /// The warnings that an instruction without its operands makes uncertain.
    unknown: Vec<Code>,
}

fn uncertain(code: &[Selected]) -> Vec<Code> {
    let bare = code.iter().filter(|selected| selected.arguments[0] == Argument::None);
    let warnings = bare.filter_map(|selected| match selected.op {
        Op::Ton | Op::Tof | Op::Tonr => Some(Code::TimerNeverStarted),
        Op::Ctu | Op::Ctd | Op::Ctud => Some(Code::CounterNeverCounts),
        _ => None,
    });
    warnings.collect()
}

impl Check<'_> {
    fn span(&self, access: &Access) -> Span {
        operand_span(self.program, &self.code[access.instruction], access.operand)
    }

    fn op(&self, access: &Access) -> Op {
        self.code[access.instruction].op
    }

    fn address(&self, address: Address, accesses: &[Access], diagnostics: &mut Vec<Diagnostic>) {
        match address {
            Address::Timer(number) => self.timer(number, accesses, diagnostics),
            Address::Counter(number) => self.counter(number, accesses, diagnostics),
            Address::Bit { area: Area::Q, .. } => {
                self.assigned_twice(address, accesses, diagnostics);
                self.pin(address, accesses, diagnostics);
            }
            Address::Bit { area: Area::I, .. }
            | Address::Byte { area: Area::I, .. }
            | Address::Word { area: Area::I, .. }
            | Address::Double { area: Area::I, .. } => {
                self.input_written(address, accesses, diagnostics);
                self.pin(address, accesses, diagnostics);
            }
            Address::Byte { area: Area::Q, .. }
            | Address::Word { area: Area::Q, .. }
            | Address::Double { area: Area::Q, .. } => {
                self.pin(address, accesses, diagnostics);
            }
            _ => {}
        }
    }

    fn timer(&self, number: u8, accesses: &[Access], diagnostics: &mut Vec<Diagnostic>) {
        let name = format!("T{number}");
        let starts = |access: &&Access| {
            TimerKind::started_by(self.op(access)).is_some() && access.operand == 0
        };
        self.one_kind(&name, "a timer", accesses, starts, Code::TimerTwoKinds, diagnostics);
        let help = match TimerKind::OnDelay.fits(number) {
            true => format!("start it with TON or TOF, for example `TON {name}, 10`"),
            false => format!("start it with TONR, for example `TONR {name}, 10`"),
        };
        self.never_started(
            &name,
            "started",
            help,
            accesses,
            starts,
            Code::TimerNeverStarted,
            diagnostics,
        );
    }

    fn counter(&self, number: u8, accesses: &[Access], diagnostics: &mut Vec<Diagnostic>) {
        let name = format!("C{number}");
        let counts = |access: &&Access| {
            matches!(self.op(access), Op::Ctu | Op::Ctd | Op::Ctud) && access.operand == 0
        };
        self.one_kind(&name, "a counter", accesses, counts, Code::CounterTwoKinds, diagnostics);
        let help = format!("count it with CTU, CTD or CTUD, for example `CTU {name}, 10`");
        self.never_started(
            &name,
            "counted",
            help,
            accesses,
            counts,
            Code::CounterNeverCounts,
            diagnostics,
        );
    }

    /// Two kinds are an error; the same kind twice is a warning.
    fn one_kind(
        &self,
        name: &str,
        what: &str,
        accesses: &[Access],
        starts: impl Fn(&&Access) -> bool,
        two_kinds: Code,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let mut starting = accesses.iter().filter(starts);
        let Some(first) = starting.next() else { return };
        let first_name = self.op(first).instruction().mnemonic();
        for other in starting {
            let other_name = self.op(other).instruction().mnemonic();
            let (code, message) = if other_name == first_name {
                (Code::StartedTwice, format!("{name} is executed by {first_name} in two places"))
            } else {
                (
                    two_kinds,
                    format!(
                        "{name} is used by {first_name} and by {other_name}: {what} can be only \
                         one of them"
                    ),
                )
            };
            let diagnostic = Diagnostic::new(code, self.span(other), message)
                .related(self.span(first), format!("{first_name} here"));
            diagnostics.push(match two_kinds {
                Code::CounterTwoKinds if code == two_kinds => diagnostic.help(format!(
                    "`CTUD {name}, 10` counts up and down: before it are `LD` of what counts up, \
                     `LD` of what counts down, `LD` of what resets"
                )),
                Code::TimerTwoKinds if code == two_kinds => diagnostic.help(
                    "each is a timer of its own: another number for one of them, such as T38",
                ),
                _ => diagnostic,
            });
        }
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "one rule for timers and counters, which differ in words only"
    )]
    fn never_started(
        &self,
        name: &str,
        verb: &str,
        help: String,
        accesses: &[Access],
        starts: impl Fn(&&Access) -> bool,
        code: Code,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let first_read = accesses.iter().find(|access| access.reads);
        // An instruction whose operands were wrong may have been the one.
        let is_started =
            accesses.iter().any(|access| starts(&access)) || self.unknown.contains(&code);
        if let (Some(read), false) = (first_read, is_started) {
            let message = format!("{name} is read here, but never {verb}");
            diagnostics.push(Diagnostic::new(code, self.span(read), message).help(help));
        }
    }

    fn assigned_twice(
        &self,
        address: Address,
        accesses: &[Access],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let mut coils = accesses.iter().filter(|access| self.op(access) == Op::Assign);
        let Some(mut first) = coils.next() else { return };
        for other in coils {
            if may_part(self.program, self.code, first.instruction..other.instruction) {
                first = other;
                continue;
            }
            let message =
                format!("{address} is written by `=` a second time: only the last one counts");
            diagnostics.push(
                Diagnostic::new(Code::OutputTwice, self.span(other), message)
                    .related(span_of(self.program, &self.code[first.instruction]), "first here")
                    .help("combine the conditions with O, or use S and R"),
            );
        }
    }

    fn input_written(
        &self,
        address: Address,
        accesses: &[Access],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let Some(written) = accesses.iter().find(|access| access.writes) else { return };
        let message = format!(
            "{address} is an input: what is written here lasts until inputs are read again"
        );
        let output = match address {
            Address::Bit { byte, bit, .. } => Some(Address::Bit { area: Area::Q, byte, bit }),
            _ => None,
        };
        let diagnostic = Diagnostic::new(Code::InputWritten, self.span(written), message);
        let diagnostic = match output {
            Some(output) => {
                let meant = match self.op(written) {
                    op @ (Op::Set | Op::Reset) => {
                        format!("{} {output}, 1", op.instruction().mnemonic())
                    }
                    Op::Assign => format!("= {output}"),
                    // What else writes a bit has further operands.
                    _ => output.to_string(),
                };
                diagnostic.help(format!("an output is Q: `{meant}`"))
            }
            None => diagnostic,
        };
        diagnostics.push(
            diagnostic
                .help("the next scan begins with the inputs as they are at the pins")
                .help("a value that shall stay belongs into M or V memory"),
        );
    }

    fn pin(&self, address: Address, accesses: &[Access], diagnostics: &mut Vec<Diagnostic>) {
        let (area, byte, bit) = match address {
            Address::Bit { area, byte, bit } => (area, byte, bit),
            Address::Byte { area, byte }
            | Address::Word { area, byte }
            | Address::Double { area, byte } => (area, byte, 0),
            _ => return,
        };
        let (direction, effect) = match area {
            Area::I => ("inputs", "it always reads 0"),
            _ => ("outputs", "nothing is switched by it"),
        };
        let (board, count) = (self.program.profile.title, self.program.profile.points(area));
        // Of an input that is written that is said already; an immediate instruction is an error.
        let is_written = accesses.iter().any(|access| access.writes);
        let is_immediate = |access: &Access| {
            let kinds = self.code.get(access.instruction).map_or(&[][..], |one| one.kinds);
            kinds.iter().any(|kind| matches!(kind, Kind::InputPoint | Kind::OutputPoint))
        };
        let first = accesses.iter().find(|access| !is_immediate(access));
        let first = first.filter(|_| area == Area::Q || !is_written);
        if let (Some(first), true) = (first, byte > 0 || bit >= count) {
            let name = area.name();
            let message = format!("{address} has no pin on {board}: {effect}");
            diagnostics.push(
                Diagnostic::new(Code::NoSuchPin, self.span(first), message)
                    .help(format!("{board}'s {direction} are {name}0.0 to {name}0.{}", count - 1)),
            );
        }
    }
}
