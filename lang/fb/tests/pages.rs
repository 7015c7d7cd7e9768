//! The pages of the codes of function blocks: the wrong example of a page gets its code alone, the
//! right one no diagnostic at all.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use diagnostics::Source;
use fb::{Code, Diagnostic, matlab, xml};

fn codes(diagnostics: &[Diagnostic]) -> Vec<&'static str> {
    diagnostics.iter().map(|one| one.code.text()).collect()
}

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text).expect("a short text")
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        match code {
            Code::BrokenMatlab => {
                page_examples::check(code.text(), code.page(), "matlab", |text| {
                    codes(&matlab::read(&source("page.m", text)).diagnostics)
                })
            }
            Code::NoMatlab | Code::MatlabDiffers => {
                page_examples::check(code.text(), code.page(), "xml", |text| {
                    let source = source("page.fbt", text);
                    let block = xml::read(&source).block.expect("a block");
                    codes(&matlab::write(&block, &source).diagnostics)
                });
            }
            _ => page_examples::check(code.text(), code.page(), "xml", |text| {
                codes(&xml::read(&source("page.fbt", text)).diagnostics)
            }),
        }
    }
}
