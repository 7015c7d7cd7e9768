//! What every page of a code is held to: its wrong example gets the code alone, its right one no
//! diagnostic at all. The tests of the crates that have pages call it.

/// The example after a line, which is in a language.
fn example<'p>(page: &'p str, line: &str, language: &str) -> &'p str {
    let begin = format!("\n{line}\n\n```{language}\n");
    let (_, behind) = page.split_once(&begin).expect("an example");
    behind.split_once("```").expect("its end").0
}

/// Checks the page of a code; `codes` are those that a text gets.
///
/// # Panics
/// If the page is not as it should be.
pub fn check(code: &str, page: &str, language: &str, codes: impl Fn(&str) -> Vec<&'static str>) {
    assert!(page.starts_with(&format!("# {code}: ")), "{code}");
    let wrong = codes(example(page, "Wrong:", language));
    assert_eq!(wrong, [code], "the wrong example of {code}");
    let right = codes(example(page, "Right:", language));
    assert!(right.is_empty(), "the right example of {code} gets {right:?}");
}
