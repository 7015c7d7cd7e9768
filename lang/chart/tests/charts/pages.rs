//! The pages of the codes of charts: the wrong example of a page gets its code alone, the right one
//! no diagnostic at all.

#[path = "../../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use crate::compiled::compile;
use chart::Code;

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        let (page, text) = (code.page(), code.text());
        // Charts in XML have a test of their own.
        if page.contains("```xml") {
            assert!(page.starts_with(&format!("# {text}: ")), "{text}");
            continue;
        }
        page_examples::check(text, page, "sfc", |chart| compile(chart).codes());
    }
}
