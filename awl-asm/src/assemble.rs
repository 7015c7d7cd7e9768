//! The assembler from text to image: runs the passes in order and keeps what listing and map need.

use std::collections::HashSet;

use crate::ast::{Program, Span, Symbol};
use crate::check::{Depths, Usage, control, placement, sequence, span_of, stack, usage};
use crate::data_block::{DataLine, join};
use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::encode::{Checked, Encoding, Line, encode};
use crate::hardware;
use crate::mnemonic_set;
use crate::parser::parse;
use crate::plan::{Demand, demand};
use crate::select::{Selected, select};
use crate::source::Source;
use crate::special;
use crate::units::Units;

/// Everything known about an assembled program.
#[derive(Debug)]
pub struct Assembly {
    /// The image; `None` when there are errors.
    pub image: Option<Vec<u8>>,
    /// Errors and warnings, by their place in the source.
    pub diagnostics: Vec<Diagnostic>,
    /// The parsed program.
    pub program: Program,
    /// Its instructions.
    pub code: Vec<Selected>,
    /// Its units.
    pub units: Units,
    /// Their bytes, parallel to `code`; empty when there are errors.
    pub lines: Vec<Line>,
    /// The depth of the logic stack after each, parallel to `code`.
    pub depths: Depths,
    /// The cross-reference.
    pub usage: Usage,
    /// The memory plan.
    pub demand: Demand,
}

impl Assembly {
    /// Whether there are errors.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|diagnostic| diagnostic.severity() == Severity::Error)
    }

    /// Where an instruction of the program stands in the source.
    pub fn span_of(&self, selected: &Selected) -> Span {
        span_of(&self.program, selected)
    }

    /// The line in the source of the instruction at an offset of the image, the hidden ones around it included.
    pub fn line_at(&self, source: &Source, offset: u16) -> Option<usize> {
        let index = self.lines.iter().position(|line| line.holds(offset))?;
        self.code.get(index).map(|selected| self.line_of(source, selected))
    }

    fn line_of(&self, source: &Source, selected: &Selected) -> usize {
        source.position(self.span_of(selected).start as usize).0
    }

    /// Tells `file:line` of the instruction at an offset of the image, for longer than there is the assembly.
    pub fn places(&self, source: &Source) -> impl Fn(u16) -> Option<String> + use<> {
        let numbers = self.code.iter().map(|selected| self.line_of(source, selected));
        let lines: Vec<(Line, usize)> = self.lines.iter().copied().zip(numbers).collect();
        let name = source.name.clone();
        move |offset| {
            let (_, number) = lines.iter().find(|(line, _)| line.holds(offset))?;
            Some(format!("{name}:{number}"))
        }
    }
}

/// Assembles a program. `symbols` come from symbol files; the source may declare more.
pub fn assemble(source: &Source, symbols: Vec<Symbol>) -> Assembly {
    assemble_with_data(source, symbols, &[])
}

/// The same with a data block that is a file of its own, as [`data_block::parse`](crate::data_block::parse) reads it.
pub fn assemble_with_data(source: &Source, symbols: Vec<Symbol>, data: &[DataLine]) -> Assembly {
    let (mut program, mut diagnostics) = parse(source, symbols);
    join(&mut program.data, data, &mut diagnostics);
    mnemonic_set::check(&source.text, &program, &mut diagnostics);
    let code = select(&program, &mut diagnostics);
    diagnostics.extend(hardware::shared_timer(&program, &code));
    diagnostics.extend(hardware::shared_pins(&program, &code));
    diagnostics.extend(special::without_effect(&program, &code));
    let units = Units::new(&program, &code, &mut diagnostics);
    let control = control(&program, &code, &units, &mut diagnostics);
    placement(&program, &code, &units, &mut diagnostics);
    sequence(&program, &code, &units, &control, &mut diagnostics);
    let depths = stack(&program, &code, &mut diagnostics);
    let usage = usage(&program, &code, &mut diagnostics);
    let demand = demand(&program, &code, &units, &mut diagnostics);
    drop_follow_ups(&mut diagnostics);
    let has_errors = diagnostics.iter().any(|diagnostic| diagnostic.severity() == Severity::Error);
    let encoding = match has_errors {
        true => Encoding::default(),
        false => {
            let checked = Checked { program: &program, code: &code, units: &units, control: &control, demand: &demand };
            encode(checked, source.stem(), &mut diagnostics)
        }
    };
    diagnostics.sort_by_key(|diagnostic| diagnostic.span);
    let image = (!encoding.image.is_empty()).then_some(encoding.image);
    Assembly { image, diagnostics, program, code, units, lines: encoding.lines, depths, usage, demand }
}

/// A word that was no instruction is taken for the one it resembles, for the sake of the lines that follow. What is
/// then wrong with that guess itself is no news.
fn drop_follow_ups(diagnostics: &mut Vec<Diagnostic>) {
    let is_guess = |diagnostic: &&Diagnostic| matches!(diagnostic.code, Code::UnknownMnemonic | Code::NotSupported);
    let guesses: HashSet<Span> = diagnostics.iter().filter(is_guess).map(|diagnostic| diagnostic.span).collect();
    diagnostics.retain(|diagnostic| is_guess(&diagnostic) || !guesses.contains(&diagnostic.span));
    // Whether a value or a routine is used cannot be told while instructions are missing.
    if diagnostics.iter().any(|diagnostic| diagnostic.severity() == Severity::Error) {
        diagnostics.retain(|diagnostic| !matches!(diagnostic.code, Code::UnusedValue | Code::NeverCalled));
    }
}
