//! The pages of the error codes: the wrong example of a page gets its code, the right one no
//! diagnostic at all.

use awl_asm::assemble::assemble;
use awl_asm::diagnostic::Code;
use awl_asm::source::Source;

/// Codes without a wrong example: it would be thousands of lines long, and `messages.rs` makes one.
const NOT_SHOWN: [Code; 1] = [Code::ProgramTooLarge];

/// The program in the block after a line.
fn example<'p>(page: &'p str, line: &str) -> Option<&'p str> {
    let (_, behind) = page.split_once(&format!("\n{line}\n\n```awl\n"))?;
    behind.split_once("```").map(|(program, _)| program)
}

/// The codes of a program's diagnostics.
fn codes(program: &str) -> Vec<&'static str> {
    let source = Source::new("page.awl", program).expect("a short text");
    assemble(&source, Vec::new())
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code.text())
        .collect()
}

/// What is wrong with the page of a code.
fn check(code: Code) -> Vec<String> {
    let (page, text) = (code.page(), code.text());
    let mut wrong = Vec::new();
    if !page.starts_with(&format!("# {text}: ")) {
        wrong.push(format!("{text}: the page begins with \"# {text}: \" and a title"));
    }
    match example(page, "Wrong:") {
        Some(program) if codes(program) != [text] => {
            wrong.push(format!("{text}: the wrong example gets {:?}", codes(program)));
        }
        None if !NOT_SHOWN.contains(&code) => {
            wrong.push(format!("{text}: there is no wrong example"))
        }
        _ => {}
    }
    match example(page, "Right:") {
        Some(program) if !codes(program).is_empty() => {
            wrong.push(format!("{text}: the right example gets {:?}", codes(program)));
        }
        None => wrong.push(format!("{text}: there is no right example")),
        _ => {}
    }
    wrong
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    let wrong: Vec<String> = Code::ALL.iter().flat_map(|&code| check(code)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
