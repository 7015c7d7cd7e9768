//! Finds for each parsed instruction the entry of the instruction table that its operands fit. No flow, no memory plan.

use std::collections::HashMap;
use std::sync::LazyLock;

use plc_isa::{
    Area, INSTRUCTIONS, Instruction, Kind, Op, Relation, TimerKind, TimerResolution, timer_family, timer_resolution,
};

use crate::address::Address;
use crate::ast::{self, Span, Statement, UnitId, Value};
use crate::calls;
use crate::diagnostic::{Code, Diagnostic};
use crate::fit::{fit_all, fit_beginning};
use crate::hardware;
use crate::limits;
use crate::misfit::misfit;
pub use crate::misfit::operand_name;
use crate::pointers;

/// An operand whose kind is settled, but not its place in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Argument {
    /// A bit, including those of timers and counters.
    Bit(Address),
    /// A byte, word or double word in memory; timers and counters stand for their current values.
    Memory(Address),
    /// What the pointer in this double word leads to.
    Indirect(Address),
    /// A bit, byte, word or double word in the local memory of another unit: a parameter in a call.
    Parameter(UnitId, Address),
    /// A constant of a core instruction as it is stored.
    Constant(u16),
    /// A constant of a module instruction, extended to a double word.
    Literal(i32),
    /// A real constant: the bits of an IEEE single.
    Real(u32),
    /// A text constant: the number of the operand that holds it.
    Text(u8),
    /// A pointer to this address as a constant.
    Pointer(Address),
    /// A level, count, label or other number.
    Number(u8),
    /// A timer that is started or reset.
    Timer(u8),
    /// A counter that counts or is reset.
    Counter(u8),
    /// A subroutine or interrupt routine.
    Routine(UnitId),
    /// An interrupt event.
    Event(u8),
    /// No operand.
    None,
}

/// Most operands that stand in the text of an instruction.
pub const ARGUMENTS_MAX: usize = 4;

/// An instruction whose table entry is known.
#[derive(Debug, Clone, Copy)]
pub struct Selected {
    /// The instruction.
    pub op: Op,
    /// Its comparison, if it is one.
    pub relation: Option<Relation>,
    /// Its operands in the order of the text.
    pub arguments: [Argument; ARGUMENTS_MAX],
    /// The kinds of a form that takes them, those included that are not written.
    pub kinds: &'static [Kind],
    /// Which of them it writes through, a bit each.
    pub written: u8,
    /// Its number among the statements of the program.
    pub statement: u32,
    /// For what is copied for a call, or from where a pointer leads: the number of the operand of the text.
    pub parameter: Option<u8>,
}

impl Selected {
    /// The operands in use, with whether each is written through.
    pub fn arguments(&self) -> impl Iterator<Item = (Argument, bool)> + '_ {
        let in_use = self.arguments.iter().take_while(|&&argument| argument != Argument::None);
        in_use.enumerate().map(|(index, &argument)| (argument, self.written >> index & 1 != 0))
    }

    /// The kinds of the operands in use.
    pub fn written_kinds(&self) -> impl Iterator<Item = Kind> + '_ {
        self.kinds.iter().copied().filter(|kind| kind.is_written())
    }
}

static BY_MNEMONIC: LazyLock<HashMap<&'static str, Vec<&'static Instruction>>> = LazyLock::new(|| {
    let mut map: HashMap<_, Vec<_>> = HashMap::new();
    for instruction in INSTRUCTIONS.iter().filter(|instruction| !instruction.mnemonics.is_empty()) {
        map.entry(instruction.mnemonic()).or_default().push(instruction);
    }
    map
});

/// Selects every instruction of a program. One whose operands do not fit is reported and stays without them, so that
/// its effect on the logic stack is not lost to the checks that follow. A call with parameters becomes several.
pub fn select(program: &ast::Program, diagnostics: &mut Vec<Diagnostic>) -> Vec<Selected> {
    let mut selected = Vec::with_capacity(program.statements.len());
    let mut open_loops = 0u16;
    for (index, statement) in program.statements.iter().enumerate() {
        match statement {
            Statement::Instruction(instruction) if instruction.mnemonic == "CALL" => {
                calls::expand(program, instruction, index as u32, &mut selected, diagnostics);
            }
            Statement::Instruction(instruction) => {
                select_one(program, instruction, index as u32, open_loops, &mut selected, diagnostics);
                match instruction.mnemonic {
                    "FOR" => open_loops += 1,
                    "NEXT" => open_loops = open_loops.saturating_sub(1),
                    _ => {}
                }
            }
            Statement::Unit(_) => open_loops = 0,
            Statement::Network(_) => {}
        }
    }
    selected
}

/// The instruction with this mnemonic that takes the operands, if there is one.
pub(crate) fn pick(
    mnemonic: &str,
    relation: Option<Relation>,
    operands: &[ast::Operand],
    statement: u32,
) -> Option<Selected> {
    let candidates = BY_MNEMONIC.get(mnemonic)?;
    candidates.iter().filter(|instruction| instruction.has_relation() == relation.is_some()).find_map(|instruction| {
        instruction.forms.iter().find_map(|form| {
            let (arguments, written) = fit_all(instruction, form.kinds, operands)?;
            let (op, kinds) = (instruction.op, form.kinds);
            Some(Selected { op, relation, arguments, kinds, written, statement, parameter: None })
        })
    })
}

/// An instruction that does not stand in the text, in its first form.
pub(crate) fn hidden(op: Op, arguments: &[Argument], statement: u32, parameter: Option<u8>) -> Selected {
    let mut all = [Argument::None; ARGUMENTS_MAX];
    all[..arguments.len()].copy_from_slice(arguments);
    let form = op.instruction().forms.first();
    let kinds = form.map_or(&[][..], |form| form.kinds);
    Selected { op, relation: None, arguments: all, kinds, written: 0, statement, parameter }
}

fn select_one(
    program: &ast::Program,
    source: &ast::Instruction,
    statement: u32,
    open_loops: u16,
    code: &mut Vec<Selected>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let picked = pick(source.mnemonic, source.relation, &source.operands, statement).map(|selected| vec![selected]);
    if let Some(picked) = picked.or_else(|| pointers::expand(source, statement, open_loops)) {
        picked.last().into_iter().for_each(|selected| check_values(program, source, selected, diagnostics));
        return code.extend(picked);
    }
    let fitting = |instruction: &&&'static Instruction| instruction.has_relation() == source.relation.is_some();
    let Some(named) = BY_MNEMONIC.get(source.mnemonic) else { return };
    let candidates: Vec<_> = named.iter().filter(fitting).copied().collect();
    if source.operands.iter().all(|operand| operand.value != Value::Invalid) {
        diagnostics.push(hardware::misfit(source).unwrap_or_else(|| misfit(source, &candidates)));
    }
    let Some(likely) = candidates.first() else { return };
    let Some(kinds) = likely.forms.first().map(|form| form.kinds) else { return };
    let arguments = fit_beginning(likely, kinds, &source.operands);
    let (op, relation) = (likely.op, source.relation);
    code.push(Selected { op, relation, arguments, kinds, written: 0, statement, parameter: None });
}

/// Checks what the kinds leave open: writing to inputs, and timer numbers.
fn check_values(
    program: &ast::Program,
    source: &ast::Instruction,
    selected: &Selected,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for ((argument, written), operand) in selected.arguments().zip(&source.operands) {
        if let (Argument::Bit(address) | Argument::Memory(address), true) = (argument, written) {
            diagnostics.extend(read_only(address, operand.span));
        }
    }
    if let (Some(kind), Argument::Timer(number)) = (TimerKind::started_by(selected.op), selected.arguments[0])
        && !kind.fits(number)
        && let Some(operand) = source.operands.first()
    {
        diagnostics.push(wrong_family(source.mnemonic, number, kind, operand.span));
    }
    diagnostics.extend(limits::check(program, source, selected));
    for (argument, operand) in selected.arguments.iter().zip(&source.operands) {
        if let Argument::Bit(address) | Argument::Memory(address) = *argument {
            diagnostics.extend(torn(address, operand.span));
            diagnostics.extend(hardware::counter(address, operand.span));
        }
    }
    diagnostics.extend(hardware::refusal(source, selected));
}

/// Special memory lies in two pieces on the board.
fn torn(address: Address, span: Span) -> Option<Diagnostic> {
    let (byte, len) = match address {
        Address::Word { area: Area::Sm, byte } => (byte, 2),
        Address::Double { area: Area::Sm, byte } => (byte, 4),
        _ => return None,
    };
    let border = Area::Sm.page_len();
    (byte < border && byte + len > border).then(|| {
        let message = format!("{address}: SMB{} and SMB{border} do not lie side by side on the Uno", border - 1);
        Diagnostic::new(Code::AddressRange, span, message)
            .help(format!("use one operand up to SMB{} and another from SMB{border} on", border - 1))
    })
}

pub(crate) fn read_only(address: Address, span: Span) -> Option<Diagnostic> {
    let message = match address {
        Address::Bit { area, byte, .. }
        | Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => {
            if byte >= area.first_writable() {
                return None;
            }
            match area {
                plc_isa::Area::I => format!("{address} is an input: a program cannot write it"),
                _ => format!("{address} is written by the system: a program can only read SMB0 to SMB29"),
            }
        }
        Address::Analog(_) => format!("{address} is an analog input: a program cannot write it"),
        Address::HighSpeedCounter(_) => format!("{address} counts by itself: a program cannot write it"),
        Address::Timer(_) | Address::Counter(_) | Address::Accumulator(_) | Address::AnalogOutput(_) => return None,
    };
    Some(Diagnostic::new(Code::ReadOnly, span, message).label("read only"))
}

fn wrong_family(mnemonic: &str, number: u8, kind: TimerKind, span: Span) -> Diagnostic {
    let resolution = timer_resolution(number);
    let fitting: Vec<u8> =
        (0..=255).filter(|&other| kind.fits(other) && timer_resolution(other) == resolution).collect();
    let family = match timer_family(number) {
        plc_isa::TimerFamily::Tonr => "a TONR number",
        plc_isa::TimerFamily::TonTof => "a TON or TOF number",
    };
    let mut diagnostic =
        Diagnostic::new(Code::TimerFamily, span, format!("T{number} is {family}: {mnemonic} needs another one"))
            .help(format!("with {}, {mnemonic} can use {}", resolution_words(resolution), ranges(&fitting)));
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
