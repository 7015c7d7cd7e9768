//! Every case in `tests/cases` on the host: all expectations must hold. All failures are listed.
//!
//! The board runs them beside the host in `lockstep.rs`.

use tests::case::{Case, host};

#[test]
fn all_cases_hold() {
    let cases = Case::all();
    assert!(!cases.is_empty(), "there are no cases");
    let mut failures = Vec::new();
    for case in cases {
        match case.prepare() {
            Ok(prepared) => failures.extend(prepared.failures(&mut host(&prepared.image))),
            Err(errors) => failures.push(errors),
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn every_case_says_what_it_is_about() {
    for case in Case::all() {
        let first = case.awl.lines().next().unwrap_or("");
        let is_sentence = first.starts_with("// ") && first.ends_with(['.', ':']);
        assert!(is_sentence, "{}: the first line is a comment with the rule", case.file);
    }
}

/// The runner itself: it must see what is wrong.
#[test]
fn a_wrong_case_fails() {
    let failures = |text: &str| match Case::new("x/y.awl".to_string(), text.to_string()).prepare() {
        Ok(prepared) => prepared.failures(&mut host(&prepared.image)),
        Err(errors) => vec![errors],
    };
    let endless = "LBL 1\nLD SM0.0\nJMP 1\n";
    assert_eq!(failures("LD I0.0\n= Q0.0\n//$ at 1ms expect Q0.0 = 0"), [""; 0]);
    assert_eq!(failures(&format!("{endless}//$ fault watchdog")), [""; 0]);
    let wrong = [
        (
            "LD I0.0\n= Q0.0\n//$ at 1ms expect Q0.0 = 1",
            "x/y.awl:3: at 1ms expected Q0.0 = 1, got 0",
        ),
        ("LD I0.0\n= Q0.0\n//$ at 1ms I0.0 = 1", "nothing is expected"),
        ("LD I0.0\n= Q0.9\n//$ at 1ms expect Q0.0 = 0", "E0005"),
        ("LD I0.0\n= Q0.0\n//$ at 1ms expcet Q0.0 = 0", "x/y.awl:3:12"),
        ("LD I0.0\n= Q0.0\n//$ at 1ms expect VB7 = 0", "VB7"),
        ("LD I0.0\n= Q0.0\n//$ fault watchdog", "expected fault watchdog"),
        (endless, "nothing is expected"),
        (&format!("{endless}//$ at 1ms expect Q0.0 = 0"), "fault: watchdog"),
    ];
    for (text, part) in wrong {
        let found = failures(text);
        assert!(found.len() == 1 && found[0].contains(part), "{text}\n{found:?}");
    }
}
