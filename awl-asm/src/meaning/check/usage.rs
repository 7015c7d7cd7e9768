//! Who reads and writes what: the cross-reference, and the warnings that follow from it.

use std::collections::BTreeMap;

use plc_isa::{Area, Kind, Op, Profile, Role, TimerKind};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::parting::may_part;
use crate::meaning::quoted::{short, told};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::{Program, Span};
use crate::text::boards::way;

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
    let mut check = Check { program, code, unknown: uncertain(code), unread: [None; 2] };
    check.unread = [
        unread(&check, &usage, |address| matches!(address, Address::Timer(_))),
        unread(&check, &usage, |address| matches!(address, Address::Counter(_))),
    ];
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
    address.area() == Some(Area::L)
}

struct Check<'a> {
    program: &'a Program,
    code: &'a [Selected],
    /// The warnings that an instruction without its operands makes uncertain.
    unknown: Vec<Code>,
    /// The one timer and the one counter that is started and never read, with what starts it.
    unread: [Option<(Address, usize)>; 2],
}

/// The one timer or counter that is started and never read, and the first access to it; `None` if
/// there are several.
fn unread(
    check: &Check<'_>,
    usage: &Usage,
    is_kind: impl Fn(Address) -> bool,
) -> Option<(Address, usize)> {
    let starts = |access: &Access| {
        access.operand == 0
            && (TimerKind::started_by(check.op(access)).is_some()
                || matches!(check.op(access), Op::Ctu | Op::Ctd | Op::Ctud))
    };
    let mut unread = usage.accesses.iter().filter_map(|(&address, accesses)| {
        let start = accesses.iter().find(|access| starts(access))?;
        let is_read = accesses.iter().any(|access| access.reads);
        (is_kind(address) && !is_read).then_some((address, start.instruction))
    });
    unread.next().filter(|_| unread.next().is_none())
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

/// A timer or counter that may have been forgotten.
#[derive(Clone, Copy)]
struct Never {
    /// What never happens to it.
    verb: &'static str,
    code: Code,
    address: Address,
}

impl Check<'_> {
    fn span(&self, access: &Access) -> Span {
        operand_span(self.program, &self.code[access.instruction], access.operand)
    }

    /// The address of an access as the text names it there, and in short.
    fn told(&self, access: &Access, address: Address) -> String {
        told(self.program, self.span(access), address)
    }

    fn short(&self, access: &Access, address: Address) -> String {
        short(self.program, self.span(access), address)
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
        let address = Address::Timer(number);
        let starts = |access: &&Access| {
            TimerKind::started_by(self.op(access)).is_some() && access.operand == 0
        };
        self.one_kind(address, accesses, starts, Code::TimerTwoKinds, diagnostics);
        let help = |name: &str| match TimerKind::OnDelay.fits(number) {
            true => format!("start it with TON or TOF, for example `TON {name}, 10`"),
            false => format!("start it with TONR, for example `TONR {name}, 10`"),
        };
        let never = Never { verb: "started", code: Code::TimerNeverStarted, address };
        self.never_started(never, help, accesses, starts, diagnostics);
    }

    fn counter(&self, number: u8, accesses: &[Access], diagnostics: &mut Vec<Diagnostic>) {
        let address = Address::Counter(number);
        let counts = |access: &&Access| {
            matches!(self.op(access), Op::Ctu | Op::Ctd | Op::Ctud) && access.operand == 0
        };
        self.one_kind(address, accesses, counts, Code::CounterTwoKinds, diagnostics);
        let help =
            |name: &str| format!("count it with CTU, CTD or CTUD, for example `CTU {name}, 10`");
        let never = Never { verb: "counted", code: Code::CounterNeverCounts, address };
        self.never_started(never, help, accesses, counts, diagnostics);
    }

    /// Two kinds are an error; the same kind twice is a warning.
    fn one_kind(
        &self,
        address: Address,
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
            let what = if two_kinds == Code::TimerTwoKinds { "a timer" } else { "a counter" };
            let (name, short) = (self.told(other, address), self.short(other, address));
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
                    "`CTUD {short}, 10` counts up and down: before it are `LD` of what counts up, \
                     `LD` of what counts down, `LD` of what resets"
                )),
                Code::TimerTwoKinds if code == two_kinds => diagnostic.help(
                    "each is a timer of its own: another number for one of them, such as T38",
                ),
                _ => diagnostic.help(format!(
                    "another number for one of them, or both conditions in one rung before one \
                     {first_name}"
                )),
            });
        }
    }

    fn never_started(
        &self,
        Never { verb, code, address }: Never,
        help: impl Fn(&str) -> String,
        accesses: &[Access],
        starts: impl Fn(&&Access) -> bool,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        // An instruction whose operands were wrong may have been the one.
        if accesses.iter().any(|access| starts(&access)) || self.unknown.contains(&code) {
            return;
        }
        let is_coil = |access: &&Access| self.op(access) == Op::Assign;
        let (first, what) = match accesses.iter().find(is_coil) {
            Some(coil) => (coil, "written as a bit"),
            None => match accesses.iter().find(|access| access.reads) {
                Some(read) => (read, "read"),
                None => return,
            },
        };
        let message = format!("{} is {what} here, but never {verb}", self.told(first, address));
        let help = help(&self.short(first, address));
        let mut diagnostic = Diagnostic::new(code, self.span(first), message);
        let other = self.unread[usize::from(code != Code::TimerNeverStarted)];
        // Where a word is, is its value, such as another preset.
        let arguments = self.code[first.instruction].arguments;
        let is_bit = arguments.contains(&Argument::Bit(address));
        if let Some((other, start)) = other.filter(|_| is_bit) {
            let span = operand_span(self.program, &self.code[start], 0);
            let other = short(self.program, span, other);
            diagnostic = diagnostic
                .related(span, format!("{other} is {verb} here and never read"))
                .help(format!("if {other} is meant, it is `{other}` here, too"));
        }
        diagnostics.push(diagnostic.help(help));
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
            let message = format!(
                "{} is written by `=` a second time: only the last one counts",
                self.told(other, address)
            );
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
            "{} is an input: what is written here lasts until inputs are read again",
            self.told(written, address)
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
            let address = self.told(first, address);
            let message = format!("{address} has no pin on {board}: {effect}");
            let mut diagnostic = Diagnostic::new(Code::NoSuchPin, self.span(first), message)
                .help(format!("{board}'s {direction} are {name}0.0 to {name}0.{}", count - 1));
            let has_pin = |other: &Profile| byte == 0 && bit < other.points(area);
            diagnostic.help.extend(way(self.program.profile, has_pin));
            diagnostics.push(diagnostic);
        }
    }
}
