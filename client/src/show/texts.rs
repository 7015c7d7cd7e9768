//! The rows of texts that became AWL, such as Structured Text: for each line what its statement
//! came to in AWL, by the lines `//# source` there. The languages of the texts are not known here.

use std::collections::BTreeMap;
use std::ops::Range;

use awl_asm::Address;
use awl_asm::ast::Statement;
use awl_asm::selected::{Argument, Selected};
use awl_asm::source::{At, Source};
use plc_isa::{Area, Op, PowerFlow, Rung};

use super::model::{Content, Instruction, Row, Says, instruction, offset, row, rung_levels, shown};
use super::operands::{Watched, operands};
use crate::program::Program;
use crate::reference::Reference;

/// Where a statement begins: the number of its file, line and column. Lines of AWL have no column.
type Place = (usize, usize, Option<usize>);
/// The rows, and which of them are those of which file.
type Rows = (Vec<Row>, Vec<(String, Range<usize>)>);

/// The rows of the texts that a program was made of.
pub(super) fn rows(program: &Program, texts: &[Source]) -> Rows {
    let (mut rows, mut files) = (Vec::new(), Vec::new());
    for text in texts {
        let first = rows.len();
        rows.extend(text.lines().zip(1..).map(|(line, number)| Row { number, ..row(line) }));
        files.push((text.name.clone(), first..rows.len()));
    }
    for statement in &program.assembly.program.statements {
        let (span, content) = match statement {
            Statement::Network(network) => (network.span, Content::Network),
            Statement::Unit(unit) => (unit.span, Content::Unit),
            Statement::Instruction(_) => continue,
        };
        let Some((file, line, column)) = place(program, texts, span.start) else { continue };
        // Networks that were made have no line of their own.
        let is_written = content == Content::Unit || column.is_none();
        let row = lines_of(&mut rows, &files, file, line..line + 1).first_mut();
        if let Some(row) = row.filter(|_| is_written) {
            row.content = content;
        }
    }
    let levels = rung_levels(program);
    let statements = statements(program, texts);
    for (&(file, line, column), code) in &statements {
        let next = statements.range((file, line + 1, None)..).next();
        let next = next.filter(|((of, ..), _)| *of == file).map(|((_, line, _), _)| *line);
        let lines = lines_of(&mut rows, &files, file, line..next.unwrap_or(usize::MAX));
        match (column, lines.first_mut()) {
            (None, Some(row)) => {
                row.content = Content::Instruction(instruction(program, code.clone(), &levels));
            }
            _ => show(program, code.clone(), lines),
        }
    }
    (rows, files)
}

/// The rows of lines of a file, which are counted from 1; of those that there are.
fn lines_of<'r>(
    rows: &'r mut [Row],
    files: &[(String, Range<usize>)],
    file: usize,
    lines: Range<usize>,
) -> &'r mut [Row] {
    let Some((_, of_file)) = files.get(file) else { return &mut [] };
    let end = of_file.end.min(of_file.start.saturating_add(lines.end - 1));
    rows.get_mut(of_file.start + lines.start - 1..end).unwrap_or_default()
}

/// Where what is at an offset of the AWL text comes from.
fn place(program: &Program, texts: &[Source], at: u32) -> Option<Place> {
    let origin = program.source.origin(at as usize)?;
    let file = texts.iter().position(|text| text.name == origin.file)?;
    match origin.at {
        At::Line { line, column } => Some((file, line, column)),
        At::Element(_) => None,
    }
}

/// What each statement has come to: the instructions from its place on, up to those of another
/// one. What is written out several times, as the block of several instances, is there once. One
/// that goes on with the bit that was just written has the coil before it.
fn statements(program: &Program, texts: &[Source]) -> BTreeMap<Place, Range<usize>> {
    let mut statements: BTreeMap<Place, Range<usize>> = BTreeMap::new();
    for (index, selected) in program.assembly.code.iter().enumerate() {
        let start = program.assembly.span_of(selected).start;
        let Some(place) = place(program, texts, start) else { continue };
        let code = statements.entry(place).or_insert(index..index);
        if code.end == index {
            code.end = index + 1;
        }
    }
    for (at, coil) in after_coils(program) {
        if let Some(place) = place(program, texts, at) {
            statements.entry(place).or_insert(coil..coil + 1);
        }
    }
    statements
}

/// The lines `//# source` that have a coil before them and nothing in between: where each is, and
/// the number of the coil.
fn after_coils(program: &Program) -> Vec<(u32, usize)> {
    let Program { source, assembly, .. } = program;
    let mut coils = BTreeMap::new();
    for (index, selected) in assembly.code.iter().enumerate() {
        let (line, _) = source.position(assembly.span_of(selected).start as usize);
        coils.insert(line, (selected.op == Op::Assign).then_some(index));
    }
    let mut found = Vec::new();
    let mut before = None;
    for (line, text) in source.lines().enumerate().map(|(index, text)| (index + 1, text)) {
        match (coils.get(&line), before) {
            (Some(coil), _) => before = *coil,
            (None, Some(coil)) if text.starts_with("//# source ") => {
                found.push((source.line_span(line).start, coil));
            }
            (None, _) if text.starts_with("//") => {}
            _ => before = None,
        }
    }
    found
}

/// Shows a statement in its lines: what has become of it in each, and values where their names are.
fn show(program: &Program, code: Range<usize>, lines: &mut [Row]) {
    let Some((decisive, says)) = decisive(program, code.clone()) else { return };
    let Some(decisive) = offset(program, decisive) else { return };
    let head = lines.first().map(code_of).unwrap_or_default();
    let is = |word: &str| find(&head, word).is_some();
    let says = match says {
        // Which of its cases it is, the statements in them say.
        _ if is("CASE") => Says::Executed,
        Says::Executed if is("IF") || is("ELSIF") => Says::Flow,
        says => says,
    };
    let parts: Vec<Part> = code.filter_map(|index| Part::of(program, index)).collect();
    let mut watched: Vec<&Watched> = Vec::new();
    for one in parts.iter().flat_map(|part| &part.operands) {
        if watched.iter().all(|other| other.operand.reference != one.operand.reference) {
            watched.push(one);
        }
    }
    let mut free: Vec<&Part> = parts.iter().collect();
    for (number, row) in lines.iter_mut().enumerate() {
        let text = code_of(row);
        let mut here: Vec<(usize, &Watched)> = Vec::new();
        watched.retain(|one| match place_in(&text, &one.operand.name) {
            Some(at) => {
                here.push((at, one));
                false
            }
            None => true,
        });
        here.sort_by_key(|(at, _)| *at);
        if number == 0 || !here.is_empty() {
            let operands: Vec<Watched> = here.into_iter().map(|(_, one)| one.clone()).collect();
            add(row, decisive, says, operands, &mut free);
        }
        if text.contains(';') {
            break;
        }
    }
}

/// Adds what a statement has in a line to what others have there.
fn add(row: &mut Row, decisive: u16, says: Says, operands: Vec<Watched>, free: &mut Vec<&Part>) {
    if row.instruction().is_none() {
        row.content = Content::Instruction(Instruction {
            offset: Some(decisive),
            levels: 1,
            operands: Vec::new(),
            result: 0,
            taken: Vec::new(),
            says,
        });
    }
    let Content::Instruction(instruction) = &mut row.content else { return };
    for watched in operands {
        let index = instruction.operands.len();
        let reference = watched.operand.reference;
        if instruction.operands.iter().any(|other| other.operand.reference == reference) {
            continue;
        }
        if watched.is_local {
            // What is written, after it was written for the last time; else wherever there is room.
            let written = free.iter().rposition(|part| part.result() == Some(reference));
            if let Some(at) = written.or((!free.is_empty()).then_some(0)) {
                instruction.taken.push((free.remove(at).offset, index));
            }
        }
        instruction.operands.push(watched);
    }
}

/// An instruction of a statement.
struct Part {
    offset: u16,
    operands: Vec<Watched>,
    result: usize,
}

impl Part {
    fn of(program: &Program, index: usize) -> Option<Part> {
        let Program { source, assembly, .. } = program;
        let selected = assembly.code.get(index..=index)?;
        let (operands, result) = operands(source, assembly, assembly.units.of(index), selected);
        Some(Part { offset: offset(program, index)?, operands, result })
    }

    fn result(&self) -> Option<Reference> {
        self.operands.get(self.result).map(|watched| watched.operand.reference)
    }
}

/// The instruction that says what has become of a statement, and what its power flow says.
fn decisive(program: &Program, code: Range<usize>) -> Option<(usize, Says)> {
    let all = &program.assembly.code;
    let is_end = |index: &usize| !matches!(all[*index].op, Op::Lbl | Op::Next);
    let last = code.clone().rev().find(is_end)?;
    let decisive = shown(program, code.start..last + 1);
    let op = all.get(decisive)?.op;
    let conditions = all.get(code.start..decisive).unwrap_or(&[]);
    let says = match op.instruction().power_flow {
        _ if op == Op::Jmp && conditions.iter().any(is_condition) => Says::Jumped,
        // Its own rung, whatever comes of that; what hangs on another statement has none.
        PowerFlow::Needed if conditions.iter().any(is_loaded) => Says::Executed,
        PowerFlow::Needed => Says::Powered,
        PowerFlow::Always if op.instruction().rung.is_contact() => Says::Flow,
        PowerFlow::Always => Says::Executed,
    };
    Some((decisive, says))
}

/// Whether an instruction begins a rung with something that is not always so.
fn is_loaded(selected: &Selected) -> bool {
    selected.op.instruction().rung == Rung::Loads && is_condition(selected)
}

/// Whether an instruction makes power flow of something that is not always so.
fn is_condition(selected: &Selected) -> bool {
    const ALWAYS: Argument = Argument::Bit(Address::Bit { area: Area::Sm, byte: 0, bit: 0 });
    let is_always = selected.arguments().any(|(argument, _)| argument == ALWAYS);
    selected.op.instruction().rung.is_contact() && !is_always
}

/// The text of a row without its comment.
fn code_of(row: &Row) -> String {
    row.text.chars().take(row.comment_at.unwrap_or(usize::MAX)).collect()
}

/// Where a line has a variable that AWL calls like this: `Main.Table[3]` is `Table` there.
fn place_in(text: &str, name: &str) -> Option<usize> {
    let name = name.trim_start_matches('#');
    let bare = name.split('[').next().unwrap_or(name);
    let last = bare.rsplit('.').next().unwrap_or(bare);
    // `ON_` stands for a variable that is called `ON`.
    let words = [last, last.trim_end_matches('_')];
    // An address has nothing but a number there.
    let mut words =
        words.into_iter().filter(|word| !word.starts_with(|one: char| one.is_numeric()));
    find(text, bare).or_else(|| words.find_map(|word| find(text, word)))
}

/// Where a text has a word, in any letter case.
fn find(text: &str, word: &str) -> Option<usize> {
    let (text, word) = (text.to_lowercase(), word.to_lowercase());
    let is_word = |character: char| character.is_alphanumeric() || character == '_';
    let mut found = text.match_indices(&word).filter(|(at, word)| {
        let before = text.get(..*at).and_then(|before| before.chars().next_back());
        let after = text.get(at + word.len()..).and_then(|after| after.chars().next());
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    });
    found.next().map(|(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::service::Executed;
    use crate::show::model::{Flow, Model};
    use plc_isa::decode;

    const TEXT: &str = "IF Go THEN // Halt\n  Halt := TRUE;\nEND_IF\nSum := One +\n  Other;\n\
        A(IN := Sum);\nWHILE Go DO\n";
    const AWL: &str = "//# symbol Go I0.0\n//# symbol Halt Q0.0\n//# var Main.One INT\n\
        //# var Main.Other INT\n//# var Sum INT\n//# var Main.A.Q BOOL\n\
        //# source t.st:1:1\nLD Go\n//# source t.st:2:3\nS Halt, 1\n\
        //# source t.st:4:1\nLD SM0.0\nMOVW Main.One, Sum\n+I Main.Other, Sum\n\
        //# source t.st:6:1\nLDW> Sum, 3\n= Main.A.Q\n\
        //# source t.st:7:1\nLD SM0.0\nLBL 0\nLDN Go\nJMP 1\n\
        //# source\nLD SM0.0\nJMP 0\n//# source t.st:7:1\nLBL 1\n";

    fn program() -> Program {
        let text = Source::new("t.st", TEXT).unwrap();
        let awl = Source::new("t.st", AWL).unwrap();
        Program::assembled(awl, Vec::new()).unwrap().made_of(vec![text])
    }

    fn names(row: &Row) -> Vec<&str> {
        let operands = row.instruction().map_or(&[][..], |one| &one.operands);
        operands.iter().map(|watched| watched.operand.name.as_str()).collect()
    }

    #[test]
    fn values_stand_beside_the_lines_that_name_them() {
        let model = Model::new(&program());
        let found: Vec<Vec<&str>> = model.rows.iter().map(names).collect();
        let expected: [&[&str]; 8] = [
            &["Go"],
            &["Halt"],
            &[],
            &["Sum", "Main.One"],
            &["Main.Other"],
            &["Sum"],
            &["Go"],
            &[],
        ];
        assert_eq!(found, expected, "what is inside of A is not on its line");
        assert_eq!(model.rows_of("t.st"), Some(0..8));
        assert_eq!(model.rows_of("t.awl"), None);
    }

    #[test]
    fn one_instruction_says_what_has_become_of_a_statement() {
        let program = program();
        let model = Model::new(&program);
        let seen = |stack: u16| -> Vec<(Op, Flow)> {
            let executed = Executed { is_executed: true, stack, value: 0 };
            let of_row = |row: &Row| {
                let instruction = row.instruction()?;
                let op = decode(&program.image, instruction.offset?).unwrap().op;
                Some((op, instruction.flow(&executed)))
            };
            model.rows.iter().filter_map(of_row).collect()
        };
        let ops = [Op::Ld, Op::Set, Op::AddInt, Op::AddInt, Op::Assign, Op::Jmp];
        let expected = |flows: [Flow; 6]| ops.into_iter().zip(flows).collect::<Vec<_>>();
        assert_eq!(
            seen(1),
            expected([Flow::On, Flow::On, Flow::On, Flow::On, Flow::On, Flow::Off])
        );
        let not = Flow::NotExecuted;
        assert_eq!(seen(0), expected([Flow::Off, not, not, not, Flow::On, Flow::On]));
    }

    #[test]
    fn a_condition_that_was_just_written_is_the_coil_before() {
        let awl = "//# source t.st:1:1\nLD I0.0\n= Q0.0\n//# source t.st:2:1\n// IF\n\
            //# source t.st:3:1\nS Q0.1, 1\n\nNETWORK 2\n//# source t.st:4:1\nLD I0.1\n= Q0.2\n";
        let program = Program::assembled(Source::new("t.st", awl).unwrap(), Vec::new()).unwrap();
        let text = "%Q0.0 := %I0.0;\nIF %Q0.0 THEN\n%Q0.1 := TRUE;\n%Q0.2 := %I0.1;\n";
        let program = program.made_of(vec![Source::new("t.st", text).unwrap()]);
        let model = Model::new(&program);
        assert_eq!(names(&model.rows[1]), ["Q0.0"]);
        let on = |row: usize, stack| {
            let executed = Executed { is_executed: true, stack, value: 0 };
            model.rows[row].instruction().unwrap().flow(&executed)
        };
        assert_eq!((on(0, 0), on(1, 0), on(1, 1)), (Flow::On, Flow::Off, Flow::On));
    }

    #[test]
    fn local_variables_are_looked_at_right_after_instructions_of_their_own() {
        let awl = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.0\nCALL Add, 1, 2, VW0\n\
            END_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK Add:SBR0\nVAR_INPUT\nA:INT;\nB:INT;\nEND_VAR\n\
            VAR_OUTPUT\nAdd:INT;\nEND_VAR\nBEGIN\n//# source t.st:1:1\nLD SM0.0\nMOVW #A, #Add\n\
            +I #B, #Add\n//# source\nEND_SUBROUTINE_BLOCK\n";
        let program = Program::assembled(Source::new("t.st", awl).unwrap(), Vec::new()).unwrap();
        let text = Source::new("t.st", "Add := A + B;\n").unwrap();
        let program = program.made_of(vec![text]);
        let model = Model::new(&program);
        let instruction = model.rows[0].instruction().unwrap();
        let op = |at: u16| decode(&program.image, at).unwrap().op;
        let taken: Vec<_> = instruction.taken.iter().map(|&(at, index)| (op(at), index)).collect();
        assert_eq!(names(&model.rows[0]), ["#Add", "#A", "#B"]);
        assert_eq!(taken, [(Op::AddInt, 0), (Op::Ld, 1), (Op::Movw, 2)]);
    }
}
