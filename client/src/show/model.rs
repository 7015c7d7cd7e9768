//! The program as the view shows it: a row for each line of its text, with what is asked from the
//! PLC for it. Which values there are at present is not known here. What the lines of a text have
//! that became AWL is in `texts`.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use awl_asm::ast::{Span, Statement};
use awl_asm::selected::Selected;
use plc_isa::{Op, decode, verify};

use super::operands::{Watched, operands};
use super::texts;
use crate::program::Program;
use crate::service::Executed;

/// Columns between tab stops.
const TAB: usize = 8;

/// A line of the source.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its number in its file, from 1.
    pub number: usize,
    /// The line, tabs as blanks.
    pub text: String,
    /// In which character a comment begins.
    pub comment_at: Option<usize>,
    /// What is in it.
    pub content: Content,
}

/// What a line is.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Nothing that is executed.
    Text,
    /// The beginning of a network.
    Network,
    /// The header of a program unit.
    Unit,
    /// An instruction, or several.
    Instruction(Instruction),
}

/// The instruction of a line, the last one where it has several.
#[derive(Debug, Clone, PartialEq)]
pub struct Instruction {
    /// Its offset in the image; `None` in a unit that is never called and therefore left out.
    pub offset: Option<u16>,
    /// How many levels of the logic stack belong to the rung after it, 1 to 9.
    pub levels: u8,
    /// The operands with a value, in the order of the text.
    pub operands: Vec<Watched>,
    /// Which of them is looked at first: what the line is there for.
    pub result: usize,
    /// Which of them have their values taken right after an instruction, and the offset of that;
    /// the others have theirs at the end of the scan.
    pub taken: Vec<(u16, usize)>,
    /// What the power flow after the instruction says of the line.
    pub says: Says,
}

/// What the power flow after an instruction says of its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Says {
    /// Itself: of a condition, that it is true.
    Flow,
    /// Nothing: the line is executed with it and without.
    Executed,
    /// That the line is executed, which it is not without.
    Powered,
    /// That the condition is false, and what hangs on it is jumped over.
    Jumped,
}

/// A program.
#[derive(Debug, Clone)]
pub struct Model {
    /// Its name.
    pub name: String,
    /// The lines of its files, one after the other.
    pub rows: Vec<Row>,
    /// Its files, and which rows are theirs.
    pub files: Vec<(String, Range<usize>)>,
    /// Checksum and length of its image.
    pub image: (u32, u16),
    /// The same of the image in machine code, where there can be one.
    pub native: Option<(u32, u16)>,
}

/// The power flow after an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// It was not executed in this scan.
    NotExecuted,
    /// The top of the logic stack is 0.
    Off,
    /// The top of the logic stack is 1.
    On,
}

impl Flow {
    /// What an answer says.
    pub fn of(executed: &Executed) -> Flow {
        match (executed.is_executed, executed.stack & 1) {
            (false, _) => Flow::NotExecuted,
            (true, 0) => Flow::Off,
            (true, _) => Flow::On,
        }
    }
}

impl Instruction {
    /// What has become of the line, after what its instruction did.
    pub fn flow(&self, executed: &Executed) -> Flow {
        match (self.says, Flow::of(executed)) {
            (Says::Executed, Flow::Off) | (Says::Jumped, Flow::Off) => Flow::On,
            (Says::Powered, Flow::Off) => Flow::NotExecuted,
            (Says::Jumped, Flow::On) => Flow::Off,
            (_, flow) => flow,
        }
    }
}

impl Row {
    /// Its instruction.
    pub fn instruction(&self) -> Option<&Instruction> {
        match &self.content {
            Content::Instruction(instruction) => Some(instruction),
            _ => None,
        }
    }
}

impl Model {
    /// The rows of a program.
    pub fn new(program: &Program) -> Model {
        let (rows, files) = match program.texts.as_slice() {
            [] => (rows(program), files(program)),
            texts => texts::rows(program, texts),
        };
        let native = program.native_image().map(|image| identity(&image));
        let (name, image) = (name(program), identity(&program.image));
        Model { name, rows, files, image, native }
    }

    /// The rows of a file; `None` where it is none of the program's.
    pub fn rows_of(&self, file: &str) -> Option<Range<usize>> {
        let (_, rows) = self.files.iter().find(|(name, _)| name == file)?;
        Some(rows.clone())
    }

    /// What each row's instruction has done to the power flow, from the answers by offset.
    pub fn power_flow(&self, answers: &HashMap<u16, Executed>) -> Vec<Option<Flow>> {
        let flow = |row: &Row| {
            let instruction = row.instruction()?;
            answers.get(&instruction.offset?).map(|executed| instruction.flow(executed))
        };
        self.rows.iter().map(flow).collect()
    }
}

/// The rows of AWL.
fn rows(program: &Program) -> Vec<Row> {
    let Program { source, assembly, .. } = program;
    let mut rows: Vec<Row> = source.lines().map(row).collect();
    for (row, line) in rows.iter_mut().zip(1..) {
        row.number = source.line_in_file(line).1;
    }
    for statement in &assembly.program.statements {
        let (span, content) = match statement {
            Statement::Network(network) => (network.span, Content::Network),
            Statement::Unit(unit) => (unit.span, Content::Unit),
            Statement::Instruction(_) => continue,
        };
        if let Some(row) = rows.get_mut(source.position(span.start as usize).0 - 1) {
            row.content = content;
        }
    }
    let levels = rung_levels(program);
    for (line, code) in by_line(program) {
        if let Some(row) = rows.get_mut(line - 1) {
            row.content = Content::Instruction(instruction(program, code, &levels));
        }
    }
    rows
}

/// The files of AWL, and which rows are theirs.
fn files(program: &Program) -> Vec<(String, Range<usize>)> {
    let source = &program.source;
    let first = |(_, span): (&str, Span)| source.position(span.start as usize).0 - 1;
    let firsts: Vec<usize> = source.files().map(first).collect();
    let ends = firsts.iter().skip(1).copied().chain([source.line_count()]);
    let names = source.files().map(|(name, _)| name.to_owned());
    names.zip(firsts.iter().zip(ends)).map(|(name, (&from, to))| (name, from..to)).collect()
}

/// The name that the image carries.
fn name(program: &Program) -> String {
    let carried = verify(program.image.clone())
        .map(|program| program.plan().name().map(char::from).collect());
    carried.unwrap_or_else(|_| program.source.stem().to_owned())
}

/// Checksum and length of an image, as the PLC tells them.
fn identity(image: &[u8]) -> (u32, u16) {
    let crc = image.last_chunk::<4>().map_or(0, |bytes| u32::from_le_bytes(*bytes));
    (crc, image.len() as u16)
}

/// A line without instructions.
pub(super) fn row(line: &str) -> Row {
    let mut text = String::new();
    let mut column = 0;
    for character in line.chars() {
        let blanks = if character == '\t' { TAB - column % TAB } else { 0 };
        match blanks {
            0 if character.is_control() => text.push(' '),
            0 => text.push(character),
            _ => text.extend(std::iter::repeat_n(' ', blanks)),
        }
        column += blanks.max(1);
    }
    let comment_at = comment_at(&text);
    Row { number: 0, text, comment_at, content: Content::Text }
}

/// The character in which a `//` outside of quotes is.
fn comment_at(text: &str) -> Option<usize> {
    let characters: Vec<char> = text.chars().collect();
    let mut is_quoted = false;
    characters.iter().enumerate().find_map(|(at, &character)| {
        is_quoted ^= character == '"';
        (!is_quoted && character == '/' && characters.get(at + 1) == Some(&'/')).then_some(at)
    })
}

/// The instructions of each line that has some: a range of the code, since a call can become
/// several.
fn by_line(program: &Program) -> BTreeMap<usize, Range<usize>> {
    let mut lines: BTreeMap<usize, Range<usize>> = BTreeMap::new();
    for (index, selected) in program.assembly.code.iter().enumerate() {
        let line = program.source.position(program.assembly.span_of(selected).start as usize).0;
        lines.entry(line).or_insert(index..index).end = index + 1;
    }
    lines
}

/// What a line of AWL has whose code this is.
pub(super) fn instruction(program: &Program, code: Range<usize>, levels: &[u8]) -> Instruction {
    let assembly = &program.assembly;
    let selected = assembly.code.get(code.clone()).unwrap_or(&[]);
    let shown = shown(program, code.clone());
    let is_call = assembly.code.get(shown).is_some_and(|selected| selected.op == Op::Call);
    // The levels after a call are those of the routine.
    let levels = if is_call { 1 } else { levels.get(shown).copied().unwrap_or(1) };
    let unit = assembly.units.of(code.start);
    let (operands, result) = operands(&program.source, assembly, unit, selected);
    let offset = offset(program, shown);
    let taken = offset.filter(|_| !operands.is_empty()).map(|offset| (offset, result));
    let taken = taken.into_iter().collect();
    Instruction { offset, levels, operands, result, taken, says: Says::Flow }
}

/// Which instruction of some tells what they have done: the last one. A call with parameters goes
/// on after its copies; whether it is made, its beginning tells.
pub(super) fn shown(program: &Program, code: Range<usize>) -> usize {
    let selected = program.assembly.code.get(code.clone()).unwrap_or(&[]);
    let last_statement = selected.last().map(|selected| selected.statement);
    let of_last = || selected.iter().filter(|selected| Some(selected.statement) == last_statement);
    let begin = of_last().position(|selected| selected.op == Op::CallBegin);
    begin.map_or(code.end.saturating_sub(1), |place| code.end - of_last().count() + place)
}

/// The offset at whose instruction the power flow of a line is to be seen. In a segment of a
/// sequence that is the hidden one which combines it with the segment's bit.
pub(super) fn offset(program: &Program, index: usize) -> Option<u16> {
    let line = program.assembly.lines.get(index).filter(|line| line.len > 0)?;
    let image = &program.image;
    let own = u16::try_from(line.at + u32::from(line.hidden_len)).ok()?;
    let next = own + decode(image, own).ok()?.len;
    let is_in_line = u32::from(next) < line.at + u32::from(line.len);
    let is_powered =
        is_in_line && decode(image, next).is_ok_and(|decoded| decoded.op == Op::ScrAnd);
    Some(if is_powered { next } else { own })
}

/// For each instruction how many levels its rung has after it: what a rung before it left is not
/// counted.
pub(super) fn rung_levels(program: &Program) -> Vec<u8> {
    let assembly = &program.assembly;
    let mut below = 0;
    let mut before: Option<&Selected> = None;
    let mut levels = Vec::with_capacity(assembly.code.len());
    for (selected, &depth) in assembly.code.iter().zip(&assembly.depths) {
        let stack = selected.op.instruction().stack;
        let is_load = stack.needs == 0 && stack.adds > 0;
        if is_load && before.is_none_or(|before| !only_combines(before.op)) {
            below = depth.saturating_sub(1);
        }
        // A new network begins with less.
        below = below.min(depth.saturating_sub(1));
        levels.push((depth - below).max(1));
        before = Some(selected);
    }
    levels
}

/// Whether an instruction only combines values of the logic stack: a load after it belongs to the
/// same rung.
fn only_combines(op: Op) -> bool {
    op.instruction().rung.is_contact()
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;

    fn program(text: &str) -> Program {
        Program::assembled(Source::new("t.awl", text).unwrap(), Vec::new()).unwrap()
    }

    fn model(text: &str) -> Model {
        Model::new(&program(text))
    }

    /// The instructions at the offsets of the rows.
    fn ops(text: &str) -> Vec<Op> {
        let program = program(text);
        let offsets = offsets(&Model::new(&program));
        offsets.into_iter().flatten().map(|at| decode(&program.image, at).unwrap().op).collect()
    }

    fn offsets(model: &Model) -> Vec<Option<u16>> {
        model
            .rows
            .iter()
            .map(|row| row.instruction().and_then(|instruction| instruction.offset))
            .collect()
    }

    fn levels(model: &Model) -> Vec<u8> {
        model.rows.iter().filter_map(|row| Some(row.instruction()?.levels)).collect()
    }

    #[test]
    fn rows_are_the_lines() {
        let model = model("// first\nNETWORK 1 // title\nLD I0.0\t// start\n= Q0.0\n");
        let texts: Vec<&str> = model.rows.iter().map(|row| row.text.as_str()).collect();
        assert_eq!(texts, ["// first", "NETWORK 1 // title", "LD I0.0 // start", "= Q0.0", ""]);
        assert_eq!(model.rows[2].comment_at, Some(8));
        assert_eq!(model.rows[1].content, Content::Network);
        let offsets = offsets(&model);
        assert_eq!((offsets[0], offsets[1], offsets[4]), (None, None, None));
        assert!(offsets[2].unwrap() < offsets[3].unwrap());
    }

    #[test]
    fn hidden_instructions_are_skipped() {
        // T32 counts milliseconds: a refresh is before the contact that reads it.
        assert_eq!(
            ops("LD T32\n= Q0.0\nLD I0.0\nTON T32, 5\n"),
            [Op::Ld, Op::Assign, Op::Ld, Op::Ton]
        );
    }

    #[test]
    fn in_a_segment_the_segment_bit_counts() {
        let ops = ops("LSCR S0.0\nLD SM0.0\n= Q0.0\nSCRE\n");
        assert_eq!(ops, [Op::Lscr, Op::ScrAnd, Op::Assign, Op::Scre]);
    }

    #[test]
    fn a_call_with_parameters_is_one_line_and_a_unit_that_nobody_calls_has_no_offset() {
        let text = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD I0.0\nCALL SBR0, VW0\n\
            END_ORGANIZATION_BLOCK\n\
                    SUBROUTINE_BLOCK S:SBR0\nVAR_INPUT\nx:INT;\nEND_VAR\nBEGIN\nLD SM0.0\n\
                    MOVW #x, VW2\n\
                    END_SUBROUTINE_BLOCK\nSUBROUTINE_BLOCK T:SBR1\nBEGIN\nLD SM0.0\n= M0.0\n\
                    END_SUBROUTINE_BLOCK\n";
        let model = model(text);
        let row = |line: usize| model.rows[line - 1].instruction().unwrap();
        assert_eq!(decode(&program(text).image, row(4).offset.unwrap()).unwrap().op, Op::CallBegin);
        assert_eq!(row(4).operands.len(), 1);
        assert_eq!(row(12).operands.len(), 2, "local memory and V");
        assert_eq!(row(17).offset, None);
        assert_eq!(model.rows[5].content, Content::Unit);
    }

    #[test]
    fn levels_are_those_of_the_rung() {
        let text = "LD I0.0\nLPS\nA I0.1\n= Q0.0\nLPP\n= Q0.1\nLD I0.2\nLD I0.3\nOLD\n= Q0.2\n";
        assert_eq!(levels(&model(text)), [1, 2, 2, 2, 1, 1, 1, 2, 1, 1]);
    }
}
