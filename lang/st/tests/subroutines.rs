//! Which function blocks become subroutines.

use diagnostics::Source;
use st::{Around, compile};

/// A block with variables and a body, and so many instances of it that are called.
fn program(variables: &str, body: &str, instances: usize) -> String {
    let names: Vec<String> = (0..instances).map(|number| format!("b{number}")).collect();
    let calls: String = names.iter().map(|name| format!("{name}(p := %I0.0);\n")).collect();
    format!(
        "FUNCTION_BLOCK Part\nVAR_INPUT p : BOOL; END_VAR\n{variables}\n{body}\n\
         END_FUNCTION_BLOCK\nPROGRAM Main\nVAR {} : Part; END_VAR\n{calls}END_PROGRAM\n",
        names.join(", ")
    )
}

fn is_subroutine(text: &str, around: &Around) -> bool {
    let source = Source::new("t.st", text).expect("a short text");
    let compiled = compile(&[source], around);
    assert!(compiled.diagnostics.is_empty(), "{text}: {:?}", compiled.diagnostics);
    let awl = compiled.awl.expect("no errors");
    assert_eq!(awl.contains("SUBROUTINE_BLOCK Part:SBR"), awl.contains("CALL   Part, "), "{awl}");
    awl.contains("SUBROUTINE_BLOCK Part:SBR")
}

#[test]
fn blocks_are_subroutines_where_that_is_shorter() {
    let alone = Around::default();
    let counts = "VAR n : INT; END_VAR";
    let count = "IF p THEN n := n + 1; END_IF\n";
    // What a call takes is more than a short body.
    assert!(!is_subroutine(&program(counts, count, 2), &alone));
    assert!(is_subroutine(&program(counts, &count.repeat(20), 2), &alone));
    assert!(!is_subroutine(&program(counts, &count.repeat(20), 1), &alone));
    // Instances and arrays in it, and variables at addresses, cannot go in and out.
    for variables in [
        "VAR n : INT; t : TON; END_VAR",
        "VAR n : INT; l : ARRAY[1..3] OF INT; END_VAR",
        "VAR_INPUT l : ARRAY[1..3] OF INT; END_VAR VAR n : INT; END_VAR",
        "VAR_OUTPUT s : STRUCT x : INT; END_STRUCT; END_VAR VAR n : INT; END_VAR",
        "VAR CONSTANT l : ARRAY[1..3] OF INT := [1, 2, 3]; END_VAR VAR n : INT; END_VAR",
    ] {
        assert!(!is_subroutine(&program(variables, &count.repeat(20), 2), &alone));
    }
    // There is more than local memory can hold.
    let many: Vec<String> = (0..17).map(|number| format!("r{number}")).collect();
    let large = format!("VAR {} : REAL; q : BOOL; n : INT; END_VAR", many.join(", "));
    assert!(!is_subroutine(&program(&large, &(count.repeat(20) + "q := TRUE;\n"), 2), &alone));
    // Nobody knows what AWL beside it makes of the program.
    let around = Around { has_main: true, ..Around::default() };
    assert!(!is_subroutine(&program(counts, &count.repeat(20), 2), &around));
}

/// Functions that call each other, as many as there are levels.
#[test]
fn a_block_that_would_be_the_ninth_level_is_written_out() {
    let with_functions = |levels: usize| {
        let mut text = String::from(
            "FUNCTION f1 : INT\nVAR_INPUT x : INT; END_VAR\nf1 := x + 1;\nEND_FUNCTION\n",
        );
        for level in 2..=levels {
            let below = level - 1;
            text += &format!(
                "FUNCTION f{level} : INT\nVAR_INPUT x : INT; END_VAR\n\
                 f{level} := f{below}(x) + 1;\nEND_FUNCTION\n"
            );
        }
        let body = format!("n := f{levels}(n);\n").repeat(20);
        is_subroutine(&(text + &program("VAR n : INT; END_VAR", &body, 2)), &Around::default())
    };
    assert!(with_functions(7));
    assert!(!with_functions(8));
}
