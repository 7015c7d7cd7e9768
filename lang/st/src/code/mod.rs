//! From a checked program to AWL that a person can read.

mod arithmetic;
mod blocks;
mod calls;
mod candidates;
mod compare;
mod control;
mod convert;
mod edges;
mod global_reads;
mod hardware;
mod logic;
mod memory;
mod places;
mod simple;
mod statements;
mod texts;
mod timers;
mod values;
mod writer;

use std::collections::{BTreeSet, HashSet};

use diagnostics::{Source, Span};

use crate::around::Around;
use crate::diagnostic::Diagnostic;
use crate::model::{Element, ExpressionKind, Program, SectionKind, UnitKind};
use edges::Edges;
use hardware::Devices;
use timers::Short;
use writer::Writer;

/// How the variables of a unit are called.
#[derive(Debug, Clone)]
enum Names {
    /// After the unit or instance: `Main.Delay`.
    Static(String),
    /// In local memory: `#Speed`.
    Local,
}

/// The unit or instance that is being written.
#[derive(Debug, Clone)]
struct Frame {
    unit: usize,
    names: Names,
    /// Whether it is a timer that counts in a word.
    is_short: bool,
    /// Its preset, if that is no variable.
    preset: Option<i64>,
    /// The file of its statements; `None`: they have no places of their own.
    file: Option<usize>,
    /// Where RETURN goes, once it is needed.
    end: Option<u16>,
    /// Labels that EXIT and CONTINUE go to.
    loops: Vec<(u16, u16)>,
}

struct Generator<'a> {
    program: &'a Program,
    sources: &'a [Source],
    short: Short,
    /// Instances of R_TRIG and F_TRIG without a memory beside CLK.
    edges: Edges,
    /// Instances that are timers and counters of the controller.
    devices: Devices,
    /// Blocks that are subroutines.
    as_routines: BTreeSet<usize>,
    /// Names that stand for addresses.
    located: HashSet<String>,
    /// What functions read, by the number of the unit.
    global_reads: Vec<global_reads::GlobalReads>,
    writer: Writer,
    frame: Frame,
    /// Whether there is AWL beside, whose names are not known.
    has_awl: bool,
    /// Room of the temporary texts, and which of them are of subroutines before.
    texts: Vec<u8>,
    texts_before: usize,
    /// Inside of what a timer does at the start of the scan, in a word.
    is_tick: bool,
}

/// Writes a checked program. Beside it what its author should know of timers, with the number of
/// the file.
pub(crate) fn generate(
    program: &Program,
    sources: &[Source],
    around: &Around,
) -> (String, Vec<(usize, Diagnostic)>) {
    let (devices, notes) = hardware::devices(program, around);
    let write = |as_routines: &BTreeSet<usize>| {
        written(program, sources, around, devices.clone(), as_routines.clone())
    };
    let mut chosen = BTreeSet::new();
    let mut awl = write(&chosen);
    // Beside AWL the text cannot be assembled alone, so nobody knows how long it becomes.
    let candidates = if around.has_main { Vec::new() } else { candidates::candidates(program) };
    let mut size = if candidates.is_empty() { None } else { bytes_of(&awl) };
    for number in candidates {
        chosen.insert(number);
        let other = write(&chosen);
        match (bytes_of(&other), size) {
            (Some(fewer), Some(most)) if fewer < most => (awl, size) = (other, Some(fewer)),
            _ => drop(chosen.remove(&number)),
        }
    }
    (awl, notes)
}

/// Bytes of the image of a program that has no errors.
fn bytes_of(awl: &str) -> Option<usize> {
    let source = Source::new("program.awl", awl).ok()?;
    awl_asm::assemble::assemble(&source, Vec::new()).image.map(|image| image.len())
}

/// The text with these blocks as subroutines, all others written out.
fn written(
    program: &Program,
    sources: &[Source],
    around: &Around,
    devices: Devices,
    as_routines: BTreeSet<usize>,
) -> String {
    let frame = Frame {
        unit: 0,
        names: Names::Local,
        is_short: false,
        preset: None,
        file: None,
        end: None,
        loops: Vec::new(),
    };
    let mut generator = Generator {
        program,
        sources,
        short: timers::short_timers(program),
        edges: edges::edges(program),
        devices,
        as_routines,
        located: located(program),
        global_reads: global_reads::of_units(program),
        writer: Writer::default(),
        frame,
        has_awl: around.has_main,
        texts: Vec::new(),
        texts_before: 0,
        is_tick: false,
    };
    let mut lines: Vec<String> = Vec::new();
    let mut routine = around.first_routine;
    if around.has_main {
        lines.extend(generator.programs_as_routines(&mut routine));
    } else {
        lines.extend(generator.main());
    }
    let called = called(program);
    for (number, unit) in program.units.iter().enumerate() {
        let is_needed = unit.file.is_some() || called.contains(&number);
        if unit.kind == UnitKind::Function && is_needed {
            lines.extend(generator.function(number, routine));
            routine += 1;
        }
    }
    for number in generator.as_routines.clone() {
        lines.extend(generator.block_routine(number, routine));
        routine += 1;
    }
    let mut all: Vec<String> = program.settings.clone();
    all.extend(generator.declarations());
    all.extend(lines);
    all.join("\n") + "\n"
}

/// The functions that are called by what is in the files, by blocks, and by those.
fn called(program: &Program) -> HashSet<usize> {
    let mut found = HashSet::new();
    let is_written =
        |unit: &&crate::model::Unit| unit.file.is_some() || unit.kind == UnitKind::Block;
    let mut open: Vec<&crate::model::Unit> = program.units.iter().filter(is_written).collect();
    while let Some(unit) = open.pop() {
        crate::check::each_expression(&unit.body, &mut |expression| {
            if let ExpressionKind::Call(number, _) = expression.kind
                && found.insert(number)
            {
                open.extend(program.units.get(number));
            }
        });
    }
    found
}

fn located(program: &Program) -> HashSet<String> {
    let globals = program.globals.iter().map(|one| (None, one));
    let programs = program.units.iter().filter(|unit| unit.kind == UnitKind::Program);
    let locals =
        programs.flat_map(|unit| unit.variables.iter().map(|one| (Some(unit.name.as_str()), one)));
    let all = globals.chain(locals).filter(|(_, one)| one.at.is_some());
    let name = |(unit, one): (Option<&str>, &crate::model::Variable)| match unit {
        Some(unit) => format!("{unit}.{}", one.name),
        None => crate::names::safe_name(&one.name),
    };
    all.map(name).collect()
}

impl Generator<'_> {
    /// The main program, with all PROGRAMs one after the other.
    fn main(&mut self) -> Vec<String> {
        self.begin_text();
        self.start_of_scan();
        for number in self.programs() {
            self.program_body(number);
        }
        if self.writer.is_empty() {
            self.writer.section("the program does nothing");
            self.writer.boxed("NOP", "0");
        }
        let writer = std::mem::take(&mut self.writer);
        let place = self.programs().first().and_then(|&number| self.place_of(number));
        writer::block(place, "ORGANIZATION_BLOCK MAIN:OB1", "END_ORGANIZATION_BLOCK", &[], writer)
    }

    /// What is written from now on is a text of its own, with temporary texts of its own: those of
    /// its callers are in use.
    fn begin_text(&mut self) {
        self.writer = Writer::default();
        self.texts_before = self.texts.len();
    }

    fn programs(&self) -> Vec<usize> {
        let units = self.program.units.iter().enumerate();
        units.filter(|(_, unit)| unit.kind == UnitKind::Program).map(|(at, _)| at).collect()
    }

    /// Each PROGRAM as a subroutine of its name, for a main program in AWL. The timers of all go on
    /// when the first one is called.
    fn programs_as_routines(&mut self, routine: &mut u16) -> Vec<String> {
        let mut lines = Vec::new();
        for (at, number) in self.programs().into_iter().enumerate() {
            self.begin_text();
            if at == 0 {
                self.start_of_scan();
            }
            self.program_body(number);
            if self.writer.is_empty() {
                self.writer.section("the program does nothing");
                self.writer.boxed("NOP", "0");
            }
            let name = self.program.units.get(number).map_or("", |unit| unit.name.as_str());
            let header = format!("SUBROUTINE_BLOCK {name}:SBR{routine}");
            let writer = std::mem::take(&mut self.writer);
            let place = self.place_of(number);
            lines.extend(writer::block(place, &header, "END_SUBROUTINE_BLOCK", &[], writer));
            *routine += 1;
        }
        lines
    }

    fn program_body(&mut self, number: usize) {
        let Some(unit) = self.program.units.get(number) else { return };
        self.frame = Frame {
            unit: number,
            names: Names::Static(unit.name.clone()),
            is_short: false,
            preset: None,
            file: unit.file,
            end: None,
            loops: Vec::new(),
        };
        self.reset_temporaries(unit);
        self.body(&unit.body);
        self.end_of_unit();
    }

    /// VAR_TEMP begins anew.
    fn reset_temporaries(&mut self, unit: &crate::model::Unit) {
        for (at, variable) in unit.variables.iter().enumerate() {
            if variable.section == SectionKind::Temp {
                self.initialise(at, variable);
            }
        }
    }

    /// The label that RETURN goes to.
    fn end_of_unit(&mut self) {
        if let Some(label) = self.frame.end.take() {
            self.writer.label(label);
        }
    }

    /// A function as a subroutine.
    fn function(&mut self, number: usize, routine: u16) -> Vec<String> {
        let Some(unit) = self.program.units.get(number) else { return Vec::new() };
        self.begin_text();
        self.frame = Frame {
            unit: number,
            names: Names::Local,
            is_short: false,
            preset: None,
            file: unit.file,
            end: None,
            loops: Vec::new(),
        };
        self.writer.section("initial values");
        for (at, variable) in unit.variables.iter().enumerate() {
            if variable.section != SectionKind::Input && !variable.is_constant {
                self.initialise(at, variable);
            }
        }
        self.body(&unit.body);
        self.end_of_unit();
        let mut sections = Vec::new();
        for (word, is_wanted) in [
            ("VAR_INPUT", SectionKind::Input),
            ("VAR_OUTPUT", SectionKind::Output),
            ("VAR", SectionKind::Var),
        ] {
            let list: Vec<String> = unit
                .variables
                .iter()
                .filter(|one| !one.is_constant)
                .filter(|one| {
                    one.section == is_wanted
                        || is_wanted == SectionKind::Var && one.section == SectionKind::Temp
                })
                .map(|one| {
                    let of_type = memory::local_type(&one.of_type);
                    format!("{}:{of_type};", crate::names::safe_name(&one.name))
                })
                .collect();
            if !list.is_empty() {
                sections.push(word.to_owned());
                sections.extend(list);
                sections.push("END_VAR".to_owned());
            }
        }
        let header = format!("SUBROUTINE_BLOCK {}:SBR{routine}", unit.name);
        let writer = std::mem::take(&mut self.writer);
        writer::block(self.place_of(number), &header, "END_SUBROUTINE_BLOCK", &sections, writer)
    }

    /// Where the name of a unit is, unless it is a standard block.
    fn place_of(&self, number: usize) -> Option<String> {
        let unit = self.program.units.get(number)?;
        let source = self.sources.get(unit.file?)?;
        Some(writer::place_in(source, unit.span))
    }

    /// What follows in the AWL text belongs to a statement, if that is of a file.
    fn begin(&mut self, span: Span) {
        if span == Span::default() {
            return;
        }
        if let Some(source) = self.frame.file.and_then(|file| self.sources.get(file)) {
            self.writer.statement(source, span);
        }
    }

    /// What follows in the network belongs to a statement, if that is of a file.
    fn go_on(&mut self, span: Span) {
        if span == Span::default() {
            return;
        }
        if let Some(source) = self.frame.file.and_then(|file| self.sources.get(file)) {
            self.writer.go_on_at(&writer::place_in(source, span));
        }
    }

    /// What follows in the AWL text belongs to an element of a drawing.
    fn begin_element(&mut self, element: &Element) {
        if let Some(source) = self.frame.file.and_then(|file| self.sources.get(file)) {
            self.writer.element(&source.name, element);
        }
    }
}
