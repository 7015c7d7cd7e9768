//! AWL texts beside generated AWL: their subroutines, and all as one text.

use awl_asm::ast::{Section, Type as AwlType, UnitKind};
use awl_asm::parser::parse;
use awl_asm::source::Source;
use diagnostics::Span;
use st::model::Type;
use st::{Around, Routine, RoutineParameter};

/// What the AWL texts of a program offer to Structured Text.
pub(crate) fn around(awl: &[(usize, Source)]) -> Around {
    let mut around = Around { has_main: !awl.is_empty(), ..Around::default() };
    for (_, source) in awl {
        // What is wrong in it the assembler tells later.
        let (program, _) = parse(source, Vec::new());
        for (_, unit) in program.units() {
            if unit.id.kind != UnitKind::Subroutine {
                continue;
            }
            around.first_routine = around.first_routine.max(u16::from(unit.id.number) + 1);
            let parameters: Option<Vec<RoutineParameter>> = unit
                .variables
                .iter()
                .filter(|one| one.section != Section::Temp)
                .map(|one| {
                    let is_written = one.section != Section::In;
                    let of_type = type_of(one.kind)?;
                    Some(RoutineParameter { name: one.name.clone(), of_type, is_written })
                })
                .collect();
            if let Some(parameters) = parameters {
                around.routines.push(Routine { name: unit.name.clone(), parameters });
            }
        }
    }
    around
}

fn type_of(kind: AwlType) -> Option<Type> {
    Some(match kind {
        AwlType::Bool => Type::Bool,
        AwlType::Byte | AwlType::Char => Type::Byte,
        AwlType::Word => Type::Word,
        AwlType::Int => Type::Int,
        AwlType::Dword => Type::Dword,
        AwlType::Dint => Type::Dint,
        AwlType::Real => Type::Real,
        AwlType::Text => return None,
    })
}

/// A stretch of a file that the text of all files has as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// The number of the file.
    pub file: usize,
    /// Where it is in it.
    pub span: Span,
    /// Where it begins in the text of all.
    pub at: u32,
}

/// All texts as one, and what of them is in it. Lines of AWL say where they come from.
pub(crate) fn text(awl: &[(usize, Source)], generated: &str) -> (String, Vec<Part>) {
    let mut parts = Vec::new();
    let mut text = String::new();
    // Declarations of the generated part come first: they are visible everywhere in any case.
    for (file, source) in awl {
        let has_blocks = source.text.lines().any(|line| {
            let word = line.trim_start().to_ascii_uppercase();
            word.starts_with("ORGANIZATION_BLOCK") || word.starts_with("SUBROUTINE_BLOCK")
        });
        if !has_blocks {
            text += "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n";
        }
        for number in 1..=source.line_count() {
            let span = source.line_span(number);
            let line = span.text(&source.text);
            if !line.trim().is_empty() && !line.trim_start().starts_with("//") {
                text += &format!("//# source {}:{number}\n", source.name);
            }
            parts.push(Part { file: *file, span, at: text.len() as u32 });
            text += line;
            text.push('\n');
        }
        text += "//# source\n";
        if !has_blocks {
            text += "END_ORGANIZATION_BLOCK\n";
        }
    }
    (text + generated, parts)
}
