//! The assembler from text to image: runs the passes in order and keeps what listing and map need.

use std::collections::HashSet;

use plc_isa::{HOST, Profile, UNO};

use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::image::encode::{Checked, Encoding, Line, encode};
use crate::meaning::boards::lacking;
use crate::meaning::check::{
    Control, Depths, Usage, control, counting, intervals, labels, local_reads, mixed_coils,
    no_result, overlap, permission, placement, presets, same_answer, sequence, stack, steps, usage,
    whole_reals,
};
use crate::meaning::free_places;
use crate::meaning::hardware;
use crate::meaning::promises::{Promises, promises};
use crate::meaning::select::select;
use crate::meaning::selected::{Selected, span_of};
use crate::meaning::special;
use crate::meaning::units::Units;
use crate::plan::demand::{Demand, demand};
use crate::source::{At, Place, Source};
use crate::text::ast::{DataLine, Program, Span, Statement, Symbol};
use crate::text::boards::way;
use crate::text::data_block::join;
use crate::text::parser::{parse_for, parse_placed};
use crate::text::tree;
use crate::text::{german, mnemonic_set};

/// Everything known about an assembled program.
#[derive(Debug)]
pub struct Assembly {
    /// The image; `None` when there are errors.
    pub image: Option<Vec<u8>>,
    /// The bytes of a program without other errors than that it is too large for the slot, for the
    /// listing; empty otherwise.
    pub draft: Vec<u8>,
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
    /// What the text says of how often loops and events can be.
    pub promises: Promises,
    /// Why the program is not for the board that nobody named, in errors; empty if it is. Then the
    /// image is one for the host.
    pub misfit: Vec<Diagnostic>,
    /// What would become of it for that board.
    for_board: Option<Box<(Demand, Encoding)>>,
}

impl Assembly {
    /// The board that the image is for.
    pub fn profile(&self) -> &'static Profile {
        self.demand.profile
    }

    /// Whether there are errors.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.diagnostics)
    }

    /// For those who need an image for the Uno: that the program is not for it is an error.
    pub fn require_board(&mut self) {
        if let (Some(span), true) = (self.program.board_named, self.profile() != &UNO) {
            let message =
                format!("the program is for {}, not for {}", self.profile().title, UNO.title);
            self.diagnostics.push(Diagnostic::new(Code::Setting, span, message));
            self.image = None;
        }
        if let Some(for_board) = self.for_board.take() {
            let (demand, Encoding { draft, lines, .. }) = *for_board;
            (self.image, self.draft, self.lines, self.demand) = (None, draft, lines, demand);
            self.diagnostics.retain(|diagnostic| diagnostic.code != Code::NotForBoard);
            self.diagnostics.append(&mut self.misfit);
            self.diagnostics.sort_by_key(|diagnostic| diagnostic.span);
        }
    }

    /// Whether it has errors, and none but that it is too large for the board.
    pub fn is_too_large(&self) -> bool {
        let is_size = |code: Code| matches!(code, Code::ProgramTooLarge | Code::DataTooLarge);
        let mut errors = self.diagnostics.iter().filter(|one| one.severity() == Severity::Error);
        self.has_errors() && errors.all(|one| is_size(one.code))
    }

    /// Where an instruction of the program is in the source.
    pub fn span_of(&self, selected: &Selected) -> Span {
        span_of(&self.program, selected)
    }

    /// The line in the source of the instruction at an offset of the image, the hidden ones around
    /// it included.
    pub fn line_at(&self, source: &Source, offset: u16) -> Option<usize> {
        let index = self.lines.iter().position(|line| line.holds(offset))?;
        self.code.get(index).map(|selected| self.line_of(source, selected))
    }

    fn line_of(&self, source: &Source, selected: &Selected) -> usize {
        source.position(self.span_of(selected).start as usize).0
    }

    /// The place of the instruction at an offset of the image: where the text says that it comes
    /// from, otherwise its line.
    pub fn place_at(&self, source: &Source, offset: u16) -> Option<Place> {
        let index = self.lines.iter().position(|line| line.holds(offset))?;
        self.code.get(index).map(|selected| self.place_of(source, selected))
    }

    /// Where an instruction comes from: where the text says, otherwise its line.
    pub fn place_of(&self, source: &Source, selected: &Selected) -> Place {
        let start = self.span_of(selected).start as usize;
        source.origin(start).cloned().unwrap_or_else(|| {
            let (file, line) = source.line_in_file(source.position(start).0);
            Place { file: file.to_owned(), at: At::Line { line, column: None } }
        })
    }

    /// Tells the [place](Self::place_at) of the instruction at an offset of the image, for longer
    /// than there is the assembly.
    pub fn places(&self, source: &Source) -> impl Fn(u16) -> Option<String> + use<> {
        let places = self.code.iter().map(|selected| self.place_of(source, selected).to_string());
        let lines: Vec<(Line, String)> = self.lines.iter().copied().zip(places).collect();
        move |offset| {
            let (_, place) = lines.iter().find(|(line, _)| line.holds(offset))?;
            Some(place.clone())
        }
    }
}

/// Assembles a program. `symbols` come from symbol files; the source may declare more.
pub fn assemble(source: &Source, symbols: Vec<Symbol>) -> Assembly {
    assemble_with_data(source, symbols, &[])
}

/// The same with a data block that is a file of its own, as
/// [`data_block::parse`](crate::text::data_block::parse) reads it.
pub fn assemble_with_data(source: &Source, symbols: Vec<Symbol>, data: &[DataLine]) -> Assembly {
    assemble_for(source, symbols, data, &UNO)
}

/// The same for a board; without sizes that bind unless the program names it (`//# board`): what is
/// too large for it is for the host.
pub fn assemble_for(
    source: &Source,
    symbols: Vec<Symbol>,
    data: &[DataLine],
    profile: &'static Profile,
) -> Assembly {
    let (program, mut diagnostics) = read(source, symbols, data, profile);
    mnemonic_set::check(&source.text, &program, &mut diagnostics);
    translated(source, understood(program, source.stem(), diagnostics))
}

/// The same with a board that is asked for beside the text, as if the text named it. That it names
/// another one is an error there.
pub fn assemble_with(
    source: &Source,
    symbols: Vec<Symbol>,
    data: &[DataLine],
    board: Option<&'static Profile>,
) -> Assembly {
    let Some(board) = board else { return assemble_with_data(source, symbols, data) };
    let (mut program, mut diagnostics) = read(source, symbols, data, board);
    mnemonic_set::check(&source.text, &program, &mut diagnostics);
    match program.board_named {
        Some(span) if program.profile != board => {
            let (named, wanted) = (program.profile.title, board.title);
            let message = format!("the program is for {named}, and is asked for {wanted}");
            let help = "without this line it is for the board that is asked for";
            diagnostics.push(Diagnostic::new(Code::Setting, span, message).help(help));
        }
        _ => program.board_named = program.board_named.or(Some(Span::default())),
    }
    translated(source, understood(program, source.stem(), diagnostics))
}

/// Messages show what is written in the mnemonics of the text.
fn translated(source: &Source, mut assembly: Assembly) -> Assembly {
    german::translate(&source.text, &assembly.program, &mut assembly.diagnostics);
    german::translate(&source.text, &assembly.program, &mut assembly.misfit);
    assembly
}

/// The syntax tree, with places for what the program declares: these are found in a first reading,
/// in which it has any.
pub(crate) fn read(
    source: &Source,
    symbols: Vec<Symbol>,
    data: &[DataLine],
    profile: &'static Profile,
) -> (Program, Vec<Diagnostic>) {
    let joined = |(mut program, mut diagnostics): (Program, Vec<Diagnostic>)| {
        join(&mut program.data, data, &mut diagnostics);
        (program, diagnostics)
    };
    let (program, diagnostics) = joined(parse_for(source, symbols.clone(), profile));
    if program.variables.is_empty() {
        return (program, diagnostics);
    }
    let code = select(&program, &mut Vec::new());
    let mut problems = Vec::new();
    let placed = free_places::find(&source.text, &program, &code, &mut problems);
    let (program, mut diagnostics) = joined(parse_placed(source, symbols, profile, &placed));
    diagnostics.extend(problems);
    (program, diagnostics)
}

/// Assembles a program that another front end has read; `name` is the image's if the program has
/// none. The spans of the tree are places in that front end's text, as those of the diagnostics
/// are. A tree that no parser makes, such as one with an address that does not exist, is an error
/// of the program.
pub fn assemble_tree(mut program: Program, name: &str) -> Assembly {
    let diagnostics = tree::check(&mut program);
    understood(program, name, diagnostics)
}

/// What a program means, and its image.
fn understood(mut program: Program, name: &str, mut diagnostics: Vec<Diagnostic>) -> Assembly {
    let code = select(&program, &mut diagnostics);
    free_places::add_wishes(&mut program, &code, &mut diagnostics);
    diagnostics.extend(hardware::shared_timer(&program, &code));
    diagnostics.extend(hardware::shared_pins(&program, &code));
    diagnostics.extend(special::without_effect(&program, &code));
    let units = Units::new(&program, &code, &mut diagnostics);
    let control = control(&program, &code, &units, &mut diagnostics);
    let promises = promises(&program, &code, &units, &control, &mut diagnostics);
    placement(&program, &code, &units, &mut diagnostics);
    sequence(&program, &code, &units, &control, &mut diagnostics);
    let depths = stack(&program, &code, &mut diagnostics);
    let usage = usage(&program, &code, &mut diagnostics);
    mixed_coils(&program, &code, &usage, &mut diagnostics);
    overlap(&program, &code, &usage, &mut diagnostics);
    counting(&program, &code, &mut diagnostics);
    permission(&program, &code, &mut diagnostics);
    intervals(&program, &code, &mut diagnostics);
    steps(&program, &code, &mut diagnostics);
    presets(&program, &code, &mut diagnostics);
    no_result(&program, &code, &mut diagnostics);
    local_reads(&program, &code, &units, &mut diagnostics);
    whole_reals(&program, &code, &mut diagnostics);
    same_answer(&program, &code, &mut diagnostics);
    diagnostics.extend(empty(&program));
    let meaning = Meaning { program: &program, code: &code, units: &units, control: &control };
    let is_sound = !has_errors(&diagnostics);
    let mut built = meaning.build(name, program.profile, is_sound);
    let (mut misfit, mut board) = (Vec::new(), None);
    if is_sound && has_errors(&built.diagnostics) {
        let has_way = add_way(meaning, name, &mut built.diagnostics);
        if program.board_named.is_none() {
            let host = meaning.build(name, &HOST, true);
            if !has_errors(&host.diagnostics) {
                let for_board = std::mem::replace(&mut built, host);
                misfit = for_board.diagnostics;
                board = Some(Box::new((for_board.demand, for_board.encoding)));
                built.diagnostics.extend(warning(program.profile, &misfit));
            } else if !has_way {
                // What no machine has room for.
                built = host;
            }
        }
    }
    let Built { demand, encoding, diagnostics: others } = built;
    diagnostics.extend(others);
    drop_follow_ups(&mut diagnostics);
    diagnostics.retain(|diagnostic| !program.allowed.contains(&diagnostic.code));
    diagnostics.sort_by_key(|diagnostic| diagnostic.span);
    let image = (!encoding.image.is_empty()).then_some(encoding.image);
    let Encoding { draft, lines, .. } = encoding;
    Assembly {
        image,
        draft,
        diagnostics,
        program,
        code,
        units,
        lines,
        depths,
        usage,
        demand,
        promises,
        misfit,
        for_board: board,
    }
}

/// What the text means, whatever the board.
#[derive(Clone, Copy)]
struct Meaning<'a> {
    program: &'a Program,
    code: &'a [Selected],
    units: &'a Units,
    control: &'a Control,
}

/// What becomes of it for a board.
struct Built {
    demand: Demand,
    encoding: Encoding,
    diagnostics: Vec<Diagnostic>,
}

impl Meaning<'_> {
    /// Plans and, where there are no errors, encodes it.
    fn build(self, name: &str, profile: &'static Profile, is_sound: bool) -> Built {
        let Meaning { program, code, units, control } = self;
        let mut diagnostics = Vec::new();
        labels(program, code, units, control, profile, &mut diagnostics);
        lacking(program, code, profile, &mut diagnostics);
        let demand = demand(program, code, units, profile, &mut diagnostics);
        let encoding = if is_sound && !has_errors(&diagnostics) {
            let checked = Checked { program, code, units, control, demand: &demand };
            encode(checked, name, &mut diagnostics)
        } else {
            Encoding::default()
        };
        Built { demand, encoding, diagnostics }
    }
}

/// Says at the first of the errors which other board would do. Returns whether there is one.
fn add_way(meaning: Meaning<'_>, name: &str, errors: &mut [Diagnostic]) -> bool {
    let does = |board| !has_errors(&meaning.build(name, board, true).diagnostics);
    let way = way(meaning.program.profile, does);
    let has_way = way.is_some();
    if let Some(first) = errors.iter_mut().min_by_key(|error| error.span) {
        first.help.extend(way);
    }
    has_way
}

/// A program without any instruction is most likely not the file that was meant.
fn empty(program: &Program) -> Option<Diagnostic> {
    let is_instruction = |one: &Statement| matches!(one, Statement::Instruction(_));
    (!program.statements.iter().any(is_instruction)).then(|| {
        let message = "the program has no instructions: it does nothing";
        Diagnostic::new(Code::EmptyProgram, Span::default(), message)
            .help("a rung begins with a contact and ends with an output: `LD I0.0`, `= Q0.0`")
    })
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|diagnostic| diagnostic.severity() == Severity::Error)
}

/// Says that a program is too large for a board that it does not name: where the first of the
/// errors is.
fn warning(profile: &Profile, misfit: &[Diagnostic]) -> Option<Diagnostic> {
    let first = misfit.iter().min_by_key(|diagnostic| diagnostic.span)?;
    let message = format!("not for {}: {}", profile.title, first.message);
    let warning = Diagnostic::new(Code::NotForBoard, first.span, message);
    Some(Diagnostic { help: first.help.clone(), ..warning })
}

/// A word that was no instruction is taken for the one it resembles, for the sake of the lines that
/// follow. What is then wrong with that guess itself is no news.
fn drop_follow_ups(diagnostics: &mut Vec<Diagnostic>) {
    let is_guess = |diagnostic: &&Diagnostic| {
        matches!(diagnostic.code, Code::UnknownMnemonic | Code::NotSupported)
    };
    let guesses: HashSet<Span> =
        diagnostics.iter().filter(is_guess).map(|diagnostic| diagnostic.span).collect();
    diagnostics.retain(|diagnostic| is_guess(&diagnostic) || !guesses.contains(&diagnostic.span));
    // Whether a value or a routine is used, or whether there is anything at all, cannot be told
    // while instructions are missing.
    let is_uncertain = |code: Code| {
        matches!(
            code,
            Code::UnusedValue
                | Code::NeverCalled
                | Code::EmptyProgram
                | Code::NeverActive
                | Code::NoInterval
                | Code::NeverWritten
        )
    };
    if has_errors(diagnostics) {
        diagnostics.retain(|diagnostic| !is_uncertain(diagnostic.code));
    }
    // What is outside of the blocks counts to the one before it.
    if diagnostics.iter().any(|diagnostic| diagnostic.code == Code::Block) {
        diagnostics.retain(|diagnostic| diagnostic.code != Code::Recursion);
    }
}
