//! The names that the parser finds in a text: where they are, and what they stand for.

use awl_asm::ast::{Named, Program, Statement, Symbol};
use awl_asm::parser::parse;
use awl_asm::source::Source;
use awl_asm::symbols::load_placed;

/// Every name as it is in the text, with what it stands for; `!` where it is declared.
fn names(text: &str, symbols: Vec<Symbol>) -> Vec<String> {
    let source = Source::new("t.awl", text).unwrap();
    let (program, _) = parse(&source, symbols);
    let shown = program.names.iter().map(|name| {
        let mark = if name.declares { "!" } else { "" };
        format!("{mark}{} {}", name.span.text(text), words(&program, name.of))
    });
    shown.collect()
}

fn words(program: &Program, of: Named) -> String {
    match of {
        Named::Symbol(index) => format!("symbol {}", program.symbols[index as usize].name),
        Named::Unit(id) => id.to_string(),
        Named::Local(statement, index) => match &program.statements[statement as usize] {
            Statement::Unit(unit) => {
                format!("{} of {}", unit.variables[index as usize].name, unit.id)
            }
            _ => panic!("a variable is in a unit"),
        },
    }
}

#[test]
fn symbols_of_the_text() {
    let text = "//# symbol Start I0.0 x\n//# var Table ARRAY[0..1] OF INT\nLD \"start\"\n\
        MOVW TABLE[1], MW0\nMOVD &Table, AC1\nMOVW *AC1, MW2\nLD Unknown\n";
    let expected = [
        "!Start symbol Start",
        "!Table symbol Table",
        "\"start\" symbol Start",
        "TABLE[1] symbol Table[1]",
        "Table symbol Table",
    ];
    assert_eq!(names(text, Vec::new()), expected);
}

#[test]
fn routines_and_local_variables() {
    let text = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.0\nCALL Fill, 5\nCALL SBR0, 7\n\
        END_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK Fill:SBR0\nVAR_INPUT\nLevel : INT;\nEND_VAR\n\
        BEGIN\nLD SM0.0\nMOVW #Level, MW0\nMOVW level, MW2\nEND_SUBROUTINE_BLOCK\n";
    let expected = [
        "!MAIN OB1",
        "Fill SBR0",
        "SBR0 SBR0",
        "!Fill SBR0",
        "!Level Level of SBR0",
        "Level Level of SBR0",
        "level Level of SBR0",
    ];
    assert_eq!(names(text, Vec::new()), expected);
}

#[test]
fn symbols_of_a_table() {
    let text = "Symbol,Address\nStart,I0.0\n\"a,b\",MW0\nStart,I0.0\n";
    let (symbols, places, diagnostics) = load_placed(&Source::new("t.csv", text).unwrap());
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let shown: Vec<(&str, Named)> =
        places.iter().map(|name| (name.span.text(text), name.of)).collect();
    let start = Named::Symbol(0);
    assert_eq!(shown, [("Start", start), ("\"a,b\"", Named::Symbol(1)), ("Start", start)]);
    assert_eq!(names("LD Start\nDATA_BLOCK\n", symbols), ["Start symbol Start"]);
}
