//! AWL texts beside generated AWL: their subroutines, and all as one text.

use awl_asm::ast::{Section, Type as AwlType, UnitKind};
use awl_asm::parser::parse;
use awl_asm::source::Source;
use st::model::Type;
use st::{Around, Routine, RoutineParameter};

/// What the AWL texts of a program offer to Structured Text.
pub(crate) fn around(awl: &[Source]) -> Around {
    let mut around = Around { has_main: !awl.is_empty(), ..Around::default() };
    for source in awl {
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

/// All texts as one. Lines of AWL say where they come from.
pub(crate) fn text(awl: &[Source], generated: &str) -> String {
    if awl.is_empty() {
        return generated.to_owned();
    }
    let mut text = String::new();
    // Declarations of the generated part come first: they are visible everywhere in any case.
    for source in awl {
        let has_blocks = source.text.lines().any(|line| {
            let word = line.trim_start().to_ascii_uppercase();
            word.starts_with("ORGANIZATION_BLOCK") || word.starts_with("SUBROUTINE_BLOCK")
        });
        if !has_blocks {
            text += "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n";
        }
        for (number, line) in (1..).zip(source.text.lines()) {
            if !line.trim().is_empty() && !line.trim_start().starts_with("//") {
                text += &format!("//# source {}:{number}\n", source.name);
            }
            text += line;
            text.push('\n');
        }
        text += "//# source\n";
        if !has_blocks {
            text += "END_ORGANIZATION_BLOCK\n";
        }
    }
    text + generated
}
