//! What people write who know other languages, and what they are told that they meant.

use super::*;

/// The first problem as `line:column message | help or suggestion`.
fn told(text: &str) -> String {
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    let problems = Scenario::parse("t.scn", text, context).unwrap_err();
    let problem = problems.list[0].diagnostic();
    let before = &text[..problem.span.start as usize];
    let line = before.matches('\n').count() + 1;
    let column = before.len() - before.rfind('\n').map_or(0, |newline| newline + 1) + 1;
    let meant = problem.suggestion.map(|meant| format!("did you mean {meant}?"));
    let help = meant.or(problem.help.into_iter().next()).unwrap_or_default();
    format!("{line}:{column} {} | {help}", problem.message)
}

fn check(cases: &[(&str, &str)]) {
    for (text, expected) in cases {
        assert_eq!(told(text), *expected, "{text}");
    }
}

#[test]
fn signs_of_other_languages() {
    check(&[
        ("at 4s expect Q0.0 == 1", "1:19 == is no sign of a comparison | did you mean =?"),
        ("at 4s expect MW0 != 1", "1:18 != is no sign of a comparison | did you mean <>?"),
        ("at 4s expect MW0=>1", "1:17 => is no sign of a comparison | did you mean >=?"),
        ("at 4s expect MW0 =< 1", "1:18 =< is no sign of a comparison | did you mean <=?"),
        ("at 4s expect MW0 := 1", "1:18 := is no sign of a comparison | did you mean =?"),
        ("never Q0.0 == 1 and Q0.1 = 1", "1:12 == is no sign of a comparison | did you mean =?"),
        ("until Q0.0 == 1 or 5s", "1:12 == is no sign of a comparison | did you mean =?"),
        ("at 1s I0.0 == 1", "1:12 == sets no value: a value is set by = alone | did you mean =?"),
        ("at 1s I0.0:=1", "1:11 := sets no value: a value is set by = alone | did you mean =?"),
        (
            "plant tank\nat 1s plant Jam == 1",
            "2:17 == sets no value: a value is set by = alone | did you mean =?",
        ),
        (
            "plant tank\nat 1s expect plant level == 1",
            "2:26 == is no sign of a comparison | did you mean =?",
        ),
    ]);
    let symbols = ["Alarm!", "Alarm"].map(|name| Symbol {
        name: name.to_string(),
        value: awl_asm::ast::Value::Address(awl_asm::Address::parse("M0.0").unwrap()),
        comment: String::new(),
    });
    let context = Context { symbols: &symbols, plant: None, has_operand: &mut |_| Ok(()) };
    let scenario = Scenario::parse("t.scn", "at 1s expect Alarm!=1, Alarm <> 1", context).unwrap();
    assert_eq!(scenario.expectations.len(), 2, "a name may end with such a sign");
}

#[test]
fn ranges_of_other_languages() {
    check(&[
        ("at 2s expect T37.cv = 9-11", "1:23 9-11 is no value and no range | did you mean 9..11?"),
        (
            "at 2s expect MW0 = -5 to 5",
            "1:20 -5 to 5 is no value and no range | did you mean -5..5?",
        ),
        (
            "at 2s expect VD0 = 1.5 - 2.5",
            "1:20 1.5 - 2.5 is no value and no range | did you mean 1.5..2.5?",
        ),
        (
            "plant tank\nat 2s expect plant level = 3-5",
            "2:28 3-5 is no whole number and no range | did you mean 3..5?",
        ),
        (
            "at 2s MW0 = 9-11",
            "1:13 9-11 is no value: write 207, 16#CF or 2#1100_1111; 1.5 or 2e-3 for a real | \
             only expect takes a range",
        ),
    ]);
}

#[test]
fn statements_without_their_time() {
    check(&[
        (
            "wait 3s\nexpect Q0.0 = 1",
            "1:1 there is no wait: each line says when it happens | \
             begin the next line with at +3s",
        ),
        (
            "after 3s expect Q0.0 = 1",
            "1:1 there is no after: each line says when it happens | write at +3s expect Q0.0 = 1",
        ),
        (
            "expect Q0.0 = 1",
            "1:1 expect is after `at TIME` | write at TIME expect Q0.0 = 1, such as at 2s",
        ),
        (
            "within 2s expect Q0.0 = 1",
            "1:1 within is after `at TIME` | \
             write at TIME within 2s expect Q0.0 = 1, such as at 2s",
        ),
        (
            "check Q0.0 = 1",
            "1:1 unknown statement check | write at TIME expect Q0.0 = 1, such as at 2s",
        ),
        ("I0.0 = 1", "1:1 a value is set after `at TIME` | write at TIME I0.0 = 1, such as at 2s"),
        (
            "set I0.0 = 1, I0.1 = 0",
            "1:1 a value is set after `at TIME` | write at TIME I0.0 = 1, I0.1 = 0, such as at 2s",
        ),
        (
            "3s expect Q0.0 = 1",
            "1:1 unknown statement 3s | a time is after at: at 3s expect Q0.0 = 1",
        ),
        ("at 3s check Q0.0 = 1", "1:7 unknown word check | did you mean expect?"),
    ]);
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    let text = "wait 3s\n\n# then\nexpect Q0.0 = 1\nexpect Q0.1 = 1";
    let problems = Scenario::parse("t.scn", text, context).unwrap_err();
    let helps: Vec<_> = problems.list.iter().filter_map(|one| one.help.as_deref()).collect();
    let expected = [
        "begin the next line with at +3s",
        "write at +3s expect Q0.0 = 1",
        "write at TIME expect Q0.1 = 1, such as at 2s",
    ];
    assert_eq!(helps, expected);
}

#[test]
fn times_behind_what_they_are_about() {
    check(&[
        (
            "at 1s expect Q0.0 = 1 within 3s",
            "1:23 the time within which it is expected is before expect | \
             write at 1s within 3s expect Q0.0 = 1",
        ),
        (
            "at +1s expect Q0.0 = 1, MW0 > 3 before 3s",
            "1:33 the time within which it is expected is before expect | \
             write at +1s within 3s expect Q0.0 = 1, MW0 > 3",
        ),
        (
            "at 1s expect Q0.0 = 1 for 3s",
            "1:23 expect looks once | write always Q0.0 = 1 from 1s to 4s",
        ),
        (
            "at 1s expect Q0.0 = 1 after 3s",
            "1:23 the time is before expect | write at 4s expect Q0.0 = 1",
        ),
        (
            "every 2s I0.0 = 1 for 1s",
            "1:19 a value stays until it is set again | add a line: every 2s I0.0 = 0 from 1s",
        ),
        (
            "every 2s I0.0 = OFF, MW0 = 5 for 500ms from 3s to 9s",
            "1:30 a value stays until it is set again | \
             add a line: every 2s I0.0 = 1, MW0 = VALUE from 3500ms",
        ),
        (
            "at 1s I0.0 = 1 for 2s",
            "1:16 a value stays until it is set again | add a line: at 3s I0.0 = 0",
        ),
        (
            "at 1s I0.0 = 1 until 5s",
            "1:16 a value stays until it is set again | add a line: at 5s I0.0 = 0",
        ),
    ]);
}

#[test]
fn examples_have_the_times_and_names_of_the_author() {
    check(&[
        ("at 7s set I0.0 = 1", "1:7 a value is set without a word | write at 7s I0.0 = 1"),
        ("every 3s force I0.2 = 1", "1:10 a value is set without a word | write every 3s I0.2 = 1"),
        ("at 7s event MW3", "1:13 MW3: an event is a bit | a value is set by =: at 7s MW3 = 5"),
        (
            "at 7s within 1s Q0.0 = 1",
            "1:17 expect is missing | write at 7s within 1s expect Q0.0 = 1",
        ),
    ]);
}
