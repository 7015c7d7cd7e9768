//! The pages of the codes: the wrong example of a page gets its code alone, the right one no
//! diagnostic at all.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use diagnostics::Source;
use plcopen::{Code, read, write};

fn codes(text: &str) -> Vec<&'static str> {
    let source = Source::new("lamp.xml", text).expect("a short text");
    read(&source).diagnostics.iter().map(|one| one.code.text()).collect()
}

/// What has no place in a project is a text.
fn codes_of_text(text: &str) -> Vec<&'static str> {
    let source = Source::new("lamp.sfc", text).expect("a short text");
    write(&source).diagnostics.iter().map(|one| one.code.text()).collect()
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        match code {
            Code::NoPlace => page_examples::check(code.text(), code.page(), "sfc", codes_of_text),
            _ => page_examples::check(code.text(), code.page(), "xml", codes),
        }
    }
}
