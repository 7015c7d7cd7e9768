//! The pages of the codes: the wrong example of a page gets its code alone, the right one no
//! diagnostic at all.

use diagnostics::Source;
use plcopen::{Code, read};

/// The file in the block after a line.
fn example<'p>(page: &'p str, line: &str) -> &'p str {
    let (_, behind) = page.split_once(&format!("\n{line}\n\n```xml\n")).expect("an example");
    behind.split_once("```").expect("its end").0
}

fn codes(text: &str) -> Vec<&'static str> {
    let source = Source::new("lamp.xml", text).expect("a short text");
    read(&source).diagnostics.iter().map(|one| one.code.text()).collect()
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        let (page, text) = (code.page(), code.text());
        assert!(page.starts_with(&format!("# {text}: ")), "{text}");
        assert_eq!(codes(example(page, "Wrong:")), [text], "the wrong example of {text}");
        assert!(codes(example(page, "Right:")).is_empty(), "the right example of {text}");
    }
}
