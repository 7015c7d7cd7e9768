//! The pages of the codes of Structured Text: the wrong example of a page gets its code alone, the
//! right one no diagnostic at all.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use diagnostics::Source;
use st::{Around, Code, compile};

fn codes(program: &str) -> Vec<&'static str> {
    let source = Source::new("page.st", program).expect("a short text");
    let compiled = compile(&[source], &Around::default());
    compiled.diagnostics.iter().map(|(_, one)| one.code.text()).collect()
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        page_examples::check(code.text(), code.page(), "st", codes);
    }
}
