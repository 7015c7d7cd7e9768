//! The pages of the codes of function blocks: the wrong example of a page gets its code alone, the
//! right one no diagnostic at all.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use diagnostics::Source;
use fb::{Code, xml};

fn codes(text: &str) -> Vec<&'static str> {
    let source = Source::new("page.fbt", text).expect("a short text");
    xml::read(&source).diagnostics.iter().map(|one| one.code.text()).collect()
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        page_examples::check(code.text(), code.page(), "xml", codes);
    }
}
