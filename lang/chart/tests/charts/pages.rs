//! The pages of the codes of charts: the wrong example of a page gets its code alone, the right one
//! no diagnostic at all.

use crate::compiled::compile;
use chart::Code;

/// The chart in the block after a line.
fn example<'p>(page: &'p str, line: &str) -> &'p str {
    let (_, behind) = page.split_once(&format!("\n{line}\n\n```sfc\n")).expect("an example");
    behind.split_once("```").expect("its end").0
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        let (page, text) = (code.page(), code.text());
        assert!(page.starts_with(&format!("# {text}: ")), "{text}");
        // Charts in XML have a test of their own.
        if page.contains("```xml") {
            continue;
        }
        let wrong = compile(example(page, "Wrong:")).codes();
        assert_eq!(wrong, [text], "the wrong example of {text}");
        let right = compile(example(page, "Right:")).codes();
        assert!(right.is_empty(), "the right example of {text} gets {right:?}");
    }
}
