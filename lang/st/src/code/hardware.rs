//! Timers and counters of the controller that take the place of instances of TON, TOF and CTU:
//! which instances can be one, and its number. It writes no AWL.

use std::collections::{BTreeSet, HashMap, HashSet};

use diagnostics::Span;

use super::timers::Owner;
use crate::around::Around;
use crate::check::{each_assignment, each_expression};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    BinaryOperator, BlockCall, Expression, ExpressionKind, Place, Program, Root, RoutineArgument,
    Statement, StatementKind, Step, Type, UnitKind, Value, each_statement,
};
use crate::names::safe_name;

/// A timer or counter of the controller.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Device {
    /// TON, TOF or CTU.
    pub(super) mnemonic: &'static str,
    /// `T37`, `C0`.
    pub(super) address: String,
    /// The preset in steps of the timer, or the counter's.
    pub(super) preset: i64,
}

/// Devices by the full names of the instances whose place they take.
pub(super) type Devices = HashMap<String, Device>;

/// A declared instance: what declares it, and its number there.
pub(super) type Key = (Owner, usize);

/// The variables of TON, TOF and CTU, by their numbers in blocks.st.
const IN_OR_CU: usize = 0;
const PT_OR_R: usize = 1;
const Q: usize = 2;
const PV: usize = 2;
const CV: usize = 4;
const Q_OF_CTU: usize = 3;

/// What the program does with a declared instance.
#[derive(Debug, Default)]
pub(super) struct Usage<'p> {
    pub(super) calls: Vec<Site<'p>>,
    is_read: HashSet<usize>,
    pub(super) is_written: bool,
}

/// A call of an instance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site<'p> {
    pub(super) call: &'p BlockCall,
    /// The unit with the call.
    unit: usize,
    /// Whether it is executed whenever the unit is, and once.
    is_plain: bool,
}

/// Chooses devices, and tells of timers that need not be exact but are.
pub(super) fn devices(program: &Program, around: &Around) -> (Devices, Vec<(usize, Diagnostic)>) {
    let mut choice = Choice {
        program,
        has_awl: around.has_main,
        usages: usages(program),
        free: Free::beside(program),
        devices: Devices::new(),
        refused: HashMap::new(),
    };
    for (at, variable) in program.globals.iter().enumerate() {
        let instance = Instance { name: safe_name(&variable.name), is_once: true, is_single: true };
        choice.instance((Owner::Global, at), instance, variable.is_retained);
    }
    for (number, unit) in program.units.iter().enumerate() {
        if unit.kind != UnitKind::Program {
            continue;
        }
        for (at, variable) in unit.variables.iter().enumerate() {
            let name = format!("{}.{}", unit.name, variable.name);
            let instance = Instance { name, is_once: true, is_single: true };
            choice.instance((Owner::Unit(number), at), instance, variable.is_retained);
        }
    }
    let notes = choice.notes();
    (choice.devices, notes)
}

struct Choice<'p> {
    program: &'p Program,
    has_awl: bool,
    usages: HashMap<Key, Usage<'p>>,
    free: Free,
    devices: Devices,
    /// Why an instance that need not be exact is.
    refused: HashMap<Key, String>,
}

/// An instance, and what is known of the block that it is in.
struct Instance {
    /// Its full name.
    name: String,
    /// Whether what declares it is executed exactly once in each scan.
    is_once: bool,
    /// Whether the text of what declares it is written out once.
    is_single: bool,
}

impl<'p> Choice<'p> {
    fn instance(&mut self, key: Key, instance: Instance, is_retained: bool) {
        let Some(Type::Block(block, name)) = self.type_of(key).cloned() else { return };
        let Some(unit) = self.program.units.get(block) else { return };
        let site = self.only_site(key);
        let is_once = instance.is_once && site.is_some_and(|site| site.is_plain);
        let is_single = instance.is_single && site.is_some();
        if unit.file.is_none() {
            let chosen = match name.as_str() {
                "CTU" if is_single && !is_retained && !self.has_awl => {
                    self.counter(key).map(|preset| (preset, self.free.counter()))
                }
                "TON" | "TOF" if self.is_coarse(key) => {
                    let chosen = self.timer(key, is_once, is_retained);
                    chosen.map_err(|why| self.refused.insert(key, why)).ok()
                }
                _ => None,
            };
            if let Some((preset, Some(address))) = chosen {
                let mnemonic = match name.as_str() {
                    "CTU" => "CTU",
                    "TON" => "TON",
                    _ => "TOF",
                };
                self.devices.insert(instance.name, Device { mnemonic, address, preset });
            }
            return;
        }
        for (at, variable) in unit.variables.iter().enumerate() {
            let name = format!("{}.{}", instance.name, variable.name);
            let inner = Instance { name, is_once, is_single };
            let is_retained = is_retained || variable.is_retained;
            self.instance((Owner::Unit(block), at), inner, is_retained);
        }
    }

    fn type_of(&self, (owner, at): Key) -> Option<&'p Type> {
        let variables = match owner {
            Owner::Global => &self.program.globals,
            Owner::Unit(number) => &self.program.units.get(number)?.variables,
        };
        variables.get(at).map(|variable| &variable.of_type)
    }

    fn is_coarse(&self, (owner, at): Key) -> bool {
        let mut all = self.program.coarse.iter();
        all.any(|one| one.variable == at && owner == one.unit.map_or(Owner::Global, Owner::Unit))
    }

    /// The only call of an instance, by what declares it; of a global one by a program.
    fn only_site(&self, key: Key) -> Option<Site<'p>> {
        let [site] = self.usages.get(&key)?.calls.as_slice() else { return None };
        let is_own = match key.0 {
            Owner::Unit(number) => number == site.unit,
            Owner::Global => {
                let unit = self.program.units.get(site.unit);
                unit.is_some_and(|unit| unit.kind == UnitKind::Program)
            }
        };
        is_own.then_some(*site)
    }

    /// A counter does what CTU does if it begins with a reset: then it does not matter that the
    /// controller sees no edge in the first scan.
    fn counter(&self, key: Key) -> Option<i64> {
        let usage = self.usages.get(&key)?;
        let is_hidden = usage.is_read.iter().all(|at| [Q_OF_CTU, CV].contains(at));
        let inputs = &self.only_site(key)?.call.inputs;
        let input = |wanted| inputs.iter().find(|(at, _)| *at == wanted).map(|(_, value)| value);
        let (reset, preset) = (input(PT_OR_R)?, constant(input(PV)?)?);
        let begins_anew = is_on_in_first_scan(self.program, self.only_site(key)?.unit, reset);
        let fits = (1..=i64::from(i16::MAX)).contains(&preset);
        input(IN_OR_CU)?;
        (is_hidden && !usage.is_written && begins_anew && fits).then_some(preset)
    }

    /// The preset in steps and the timer; else why there is none.
    fn timer(
        &mut self,
        key: Key,
        is_once: bool,
        is_retained: bool,
    ) -> Result<(i64, Option<String>), String> {
        let Some(usage) = self.usages.get(&key).filter(|usage| !usage.calls.is_empty()) else {
            return Err("it is never called".to_owned());
        };
        if self.has_awl {
            return Err("AWL calls the program, and may do so more than once in a scan".to_owned());
        }
        if is_retained {
            return Err("no timer of the controller is retained".to_owned());
        }
        let Some(site) = self.only_site(key).filter(|_| is_once) else {
            return Err("it is not called exactly once in every scan".to_owned());
        };
        if usage.is_written || usage.is_read.iter().any(|&at| at != Q) {
            return Err("the program uses more of it than Q".to_owned());
        }
        let inputs = &site.call.inputs;
        let input = |wanted| inputs.iter().find(|(at, _)| *at == wanted).map(|(_, value)| value);
        let Some(preset) = input(PT_OR_R).and_then(constant) else {
            return Err("PT is not a constant in its call".to_owned());
        };
        if input(IN_OR_CU).is_none() {
            return Err("IN is not given in its call".to_owned());
        }
        self.free.timer(preset).map(|(steps, address)| (steps, Some(address)))
    }

    /// A warning for each declaration whose timers count milliseconds.
    fn notes(&self) -> Vec<(usize, Diagnostic)> {
        let note = |one: &crate::model::Coarse| {
            let owner = one.unit.map_or(Owner::Global, Owner::Unit);
            let why = self.refused.get(&(owner, one.variable))?;
            Some((one.file, self.note(owner, one.variable, one.span, why)))
        };
        self.program.coarse.iter().filter_map(note).collect()
    }

    fn note(&self, owner: Owner, at: usize, span: Span, why: &str) -> Diagnostic {
        let variable = match owner {
            Owner::Global => self.program.globals.get(at),
            Owner::Unit(number) => {
                self.program.units.get(number).and_then(|unit| unit.variables.get(at))
            }
        };
        let name = variable.map_or("", |variable| variable.name.as_str());
        let message = format!("{name}: counts milliseconds all the same: {why}");
        let found = Diagnostic::new(Code::Coarse, span, message);
        found.help("without `{coarse}` it does so without a warning")
    }
}

/// The constant that an argument is.
fn constant(value: &Expression) -> Option<i64> {
    match value.kind {
        ExpressionKind::Constant(Value::Int(value)) => Some(value),
        _ => None,
    }
}

/// Whether a condition is TRUE in the first scan because SM0.1 is.
fn is_on_in_first_scan(program: &Program, unit: usize, condition: &Expression) -> bool {
    match &condition.kind {
        ExpressionKind::Constant(Value::Bool(value)) => *value,
        ExpressionKind::Read(place) => {
            let variable = match &place.root {
                Root::Address(address) => return address == "SM0.1",
                Root::Global(at) => program.globals.get(*at),
                Root::Local(at) => program.units.get(unit).and_then(|unit| unit.variables.get(*at)),
            };
            variable.is_some_and(|variable| variable.at.as_deref() == Some("SM0.1"))
        }
        ExpressionKind::Binary(BinaryOperator::Or, left, right) => {
            [left, right].iter().any(|side| is_on_in_first_scan(program, unit, side))
        }
        _ => false,
    }
}

/// Numbers that nothing uses yet.
struct Free {
    of_100_ms: Vec<u8>,
    of_10_ms: Vec<u8>,
    counters: Vec<u8>,
}

impl Free {
    /// Numbers that the program does not name.
    fn beside(program: &Program) -> Free {
        let named = named_addresses(program);
        let free = |letter: char, numbers: &mut dyn Iterator<Item = u8>| {
            let mut list: Vec<u8> =
                numbers.filter(|number| !named.contains(&format!("{letter}{number}"))).collect();
            list.reverse();
            list
        };
        Free {
            of_100_ms: free('T', &mut (37..=63).chain(101..=255)),
            of_10_ms: free('T', &mut (33..=36).chain(97..=100)),
            counters: free('C', &mut (0..=255)),
        }
    }

    fn counter(&mut self) -> Option<String> {
        self.counters.pop().map(|number| format!("C{number}"))
    }

    /// The coarsest timer that has the preset, and the preset in its steps.
    fn timer(&mut self, preset: i64) -> Result<(i64, String), String> {
        const STEPS_MAX: i64 = i16::MAX as i64;
        let families = [(100, &mut self.of_100_ms), (10, &mut self.of_10_ms)];
        let mut why = "PT is no multiple of 10 ms".to_owned();
        for (step, numbers) in families {
            if preset % step != 0 {
                continue;
            }
            if !(0..=STEPS_MAX).contains(&(preset / step)) {
                why = "PT is negative or too long for a timer of the controller".to_owned();
                continue;
            }
            match numbers.pop() {
                Some(number) => return Ok((preset / step, format!("T{number}"))),
                None => why = format!("all timers of {step} ms that could be it are taken"),
            }
        }
        Err(why)
    }
}

/// Timers and counters that the text and its settings name, upper case.
fn named_addresses(program: &Program) -> BTreeSet<String> {
    let mut named = BTreeSet::new();
    let locals = program.units.iter().flat_map(|unit| &unit.variables);
    named.extend(program.globals.iter().chain(locals).filter_map(|one| one.at.clone()));
    let mut from_place = |place: &Place| {
        if let Root::Address(address) = &place.root {
            named.insert(address.clone());
        }
    };
    for unit in &program.units {
        each_expression(&unit.body, &mut |one| {
            if let ExpressionKind::Read(place) = &one.kind {
                from_place(place);
            }
        });
        each_assignment(&unit.body, &mut |place, _| from_place(place));
    }
    for setting in &program.settings {
        let words = setting.split(|c: char| !c.is_alphanumeric());
        named.extend(words.map(str::to_ascii_uppercase));
    }
    named
}

/// What the program does with each declared instance.
pub(super) fn usages(program: &Program) -> HashMap<Key, Usage<'_>> {
    let mut usages: HashMap<Key, Usage> = HashMap::new();
    for (number, unit) in program.units.iter().enumerate() {
        let mut has_return = false;
        each_statement(&unit.body, &mut |statement| {
            has_return |= matches!(statement.kind, StatementKind::Return);
        });
        each_statement(&unit.body, &mut |statement| match &statement.kind {
            StatementKind::Call(call) => {
                let Some((key, _)) = member(program, number, &call.instance) else { return };
                let is_plain = !has_return && is_directly_in(&unit.body, statement);
                let site = Site { call, unit: number, is_plain };
                usages.entry(key).or_default().calls.push(site);
            }
            StatementKind::Routine(_, arguments) => {
                for argument in arguments {
                    if let RoutineArgument::Place(place) = argument
                        && let Some((key, _)) = member(program, number, place)
                    {
                        usages.entry(key).or_default().is_written = true;
                    }
                }
            }
            _ => {}
        });
        each_expression(&unit.body, &mut |one| {
            if let ExpressionKind::Read(place) = &one.kind
                && let Some((key, Some(at))) = member(program, number, place)
            {
                usages.entry(key).or_default().is_read.insert(at);
            }
        });
        each_assignment(&unit.body, &mut |place, _| {
            if let Some((key, _)) = member(program, number, place) {
                usages.entry(key).or_default().is_written = true;
            }
        });
        // Outputs that a call takes are read.
        let own: Vec<(Key, usize)> = taken_outputs(program, number);
        for (key, at) in own {
            usages.entry(key).or_default().is_read.insert(at);
        }
    }
    usages
}

fn taken_outputs(program: &Program, number: usize) -> Vec<(Key, usize)> {
    let mut found = Vec::new();
    let Some(unit) = program.units.get(number) else { return found };
    each_statement(&unit.body, &mut |statement| {
        if let StatementKind::Call(call) = &statement.kind
            && let Some((key, _)) = member(program, number, &call.instance)
        {
            found.extend(call.outputs.iter().map(|(at, _)| (key, *at)));
        }
    });
    found
}

fn is_directly_in(body: &[Statement], statement: &Statement) -> bool {
    body.iter().any(|one| std::ptr::eq(one, statement))
}

/// The innermost instance in a place, and which variable of it.
fn member(program: &Program, unit: usize, place: &Place) -> Option<(Key, Option<usize>)> {
    let (mut key, mut kind) = match place.root {
        Root::Address(_) => return None,
        Root::Global(at) => ((Owner::Global, at), &program.globals.get(at)?.of_type),
        Root::Local(at) => {
            ((Owner::Unit(unit), at), &program.units.get(unit)?.variables.get(at)?.of_type)
        }
    };
    let mut found = None;
    for step in &place.steps {
        kind = match (step, kind) {
            (Step::Member(at), Type::Block(number, _)) => {
                found = Some((key, Some(*at)));
                key = (Owner::Unit(*number), *at);
                &program.units.get(*number)?.variables.get(*at)?.of_type
            }
            (Step::Member(at), Type::Struct(structure)) => &structure.members.get(*at)?.of_type,
            (Step::Element(_), Type::Array(array)) => &array.of,
            _ => return found,
        };
    }
    match kind {
        Type::Block(..) => Some((key, None)),
        _ => found,
    }
}
