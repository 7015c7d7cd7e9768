//! Periods of clocks beside the time that a scan takes: a clock is asked once in each scan, so it
//! has no more periods than there are scans.

use awl_asm::assemble::Assembly;
use awl_asm::cost::{Stated, cost_with};
use awl_asm::longest_scan::us;
use diagnostics::Span;
use st::Compiled;
use st::model::{
    BlockCall, ExpressionKind, Root, StatementKind, Unit, Value, Variable, each_statement,
};

use crate::findings::{Diagnostic, from_diagram};

/// The block of the library that is a clock, and its period.
const CLOCK: &str = "EVERY";
const PERIOD: &str = "TS";
/// Shortest and longest period in milliseconds: the block takes them for what is beyond.
const PERIODS_MS: (i64, i64) = (1, 60_000);

/// A clock whose period is known before it runs.
struct Clock<'p> {
    name: &'p str,
    file: usize,
    /// What gives it its period.
    span: Span,
    period_ms: u64,
}

/// How long a scan takes, in microseconds.
struct Scan {
    /// From one start to the next, as the text sets it.
    set: u64,
    /// The longest, executed as it is to be; 0 for a program that is for no board.
    longest: u64,
    /// Whether none is longer.
    is_known: bool,
    /// The longest in machine code, where it is not to be executed so.
    translated: Option<u64>,
}

/// Warnings about clocks, with the numbers of their files, of a program that is assembled to this
/// bytecode, which is empty where there are errors. `is_native`: the program is to be
/// executed as machine code.
pub(crate) fn check(
    compiled: &Compiled,
    (image, assembly): (&[u8], &Assembly),
    is_native: bool,
) -> Vec<(usize, Diagnostic)> {
    let clocks = clocks(compiled);
    if clocks.is_empty() || image.is_empty() {
        return Vec::new();
    }
    let scan = Scan::of(image, assembly, is_native);
    clocks.iter().filter_map(|clock| Some((clock.file, scan.warning(clock)?))).collect()
}

/// The clocks that are called.
fn clocks(compiled: &Compiled) -> Vec<Clock<'_>> {
    let program = &compiled.program;
    let blocks = program.units.iter().enumerate();
    let mut blocks = blocks.filter(|(_, unit)| unit.file.is_none() && unit.name == CLOCK);
    let Some((number, block)) = blocks.next() else { return Vec::new() };
    let mut clocks = Vec::new();
    for unit in &program.units {
        let Some(file) = unit.file else { continue };
        each_statement(&unit.body, &mut |statement| {
            let StatementKind::Call(call) = &statement.kind else { return };
            if call.block == number {
                clocks.extend(clock(compiled, (unit, file), call, block));
            }
        });
    }
    clocks
}

/// What a call in a unit of a file says of its clock; nothing where its period can change.
fn clock<'p>(
    compiled: &'p Compiled,
    (unit, file): (&'p Unit, usize),
    call: &'p BlockCall,
    block: &'p Unit,
) -> Option<Clock<'p>> {
    // Instances in arrays and in others have the period of their block.
    let (variable, file): (&Variable, usize) = match call.instance.root {
        _ if !call.instance.steps.is_empty() => return None,
        Root::Local(at) => (unit.variables.get(at)?, file),
        Root::Global(at) => {
            let variable = compiled.program.globals.get(at)?;
            let is_it = |name: &&st::Name| name.declares && name.span == variable.span;
            (variable, compiled.names.iter().find(is_it)?.file)
        }
        Root::Address(_) => return None,
    };
    let period = block.variables.iter().position(|one| one.name == PERIOD)?;
    let given = call.inputs.iter().find(|(input, _)| *input == period);
    let (value, span) = match (given, &variable.initial) {
        (Some((_, given)), _) => match &given.kind {
            ExpressionKind::Constant(value) => (value, given.span),
            _ => return None,
        },
        (None, Value::List(values)) => (values.get(period)?, variable.span),
        (None, _) => (&block.variables.get(period)?.initial, variable.span),
    };
    let &Value::Int(ms) = value else { return None };
    let period_ms = ms.clamp(PERIODS_MS.0, PERIODS_MS.1) as u64;
    Some(Clock { name: &variable.name, file, span, period_ms })
}

impl Scan {
    fn of(image: &[u8], assembly: &Assembly, is_native: bool) -> Scan {
        let cost = cost_with(image, &Stated::of(assembly));
        let (longest, translated) = match cost {
            Some(cost) if is_native => (cost.translated, None),
            Some(cost) => (Some(cost.interpreted), cost.translated.filter(|one| one.is_known())),
            None => (None, None),
        };
        Scan {
            set: u64::from(assembly.program.settings.scan_ms) * 1000,
            longest: longest.as_ref().map_or(0, |one| us(one.scan)),
            is_known: longest.is_some_and(|one| one.is_known()),
            translated: translated.map(|one| us(one.scan)),
        }
    }

    /// That a scan is longer than the period of a clock.
    fn warning(&self, clock: &Clock<'_>) -> Option<Diagnostic> {
        let Clock { name, period_ms, .. } = *clock;
        let period = period_ms * 1000;
        let scan = self.set.max(self.longest);
        if scan <= period {
            return None;
        }
        let why = match (self.set > period, self.is_known) {
            (true, _) => format!("scans begin every {} (`//# scan`)", ms(self.set)),
            (false, true) => format!("a scan takes up to {} on the Uno", ms(self.longest)),
            (false, false) => format!("a scan can take {} and more on the Uno", ms(self.longest)),
        };
        let message = format!("{name} has a period of {period_ms} ms, but {why}");
        let least = scan.div_ceil(1000);
        let mut one = diagram::Diagnostic::new(diagram::Code::ShortPeriod, clock.span, message)
            .label("some periods are left out")
            .help(format!(
                "a period of {least} ms or more has its scan; `{name}.LOST` counts the others"
            ));
        if let Some(translated) = self.translated.filter(|&one| one.max(self.set) <= period) {
            one = one.help(format!(
                "translated to machine code (`--native`) a scan takes up to {}",
                ms(translated)
            ));
        }
        Some(from_diagram(one))
    }
}

/// Microseconds as milliseconds, rounded up to a hundredth.
fn ms(us: u64) -> String {
    let hundredths = us.div_ceil(10);
    let text = format!("{}.{:02}", hundredths / 100, hundredths % 100);
    format!("{} ms", text.trim_end_matches('0').trim_end_matches('.'))
}
