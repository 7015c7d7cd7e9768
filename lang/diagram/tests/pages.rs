//! The pages of the codes of diagrams: the wrong example of a page gets its code alone, the right
//! one no diagnostic at all.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use diagnostics::Source;
use diagram::Code;

fn codes(text: &str) -> Vec<&'static str> {
    let source = Source::new("page.fbd", text).expect("a short text");
    let (mut file, found) = st::parser::parse(&source);
    assert!(found.is_empty(), "{found:?}");
    diagram::arrange(&source, &mut file).iter().map(|one| one.code.text()).collect()
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    // That a period is too short is known when the program is assembled.
    for code in Code::ALL.iter().filter(|&&code| code != Code::ShortPeriod) {
        page_examples::check(code.text(), code.page(), "fbd", codes);
    }
}
