//! Reading scenarios: what is understood, and the exact place of every error.

use super::*;

fn symbols() -> Symbols {
    let mut symbols = Symbols::new();
    symbols.add("Start", awl_asm::Address::parse("I0.0").unwrap(), "");
    symbols.add("a, b = c # d", awl_asm::Address::parse("I0.1").unwrap(), "");
    symbols
}

fn parse(text: &str) -> Result<Scenario, Problems> {
    let symbols = symbols();
    let mut has_operand = |operand: Operand| match operand.to_string().as_str() {
        "VW1000" => Err(MachineError("the program has no memory for VW1000".to_string())),
        _ => Ok(()),
    };
    Scenario::parse("t.scn", text, Context { symbols: &symbols, plant: None, has_operand: &mut has_operand })
}

/// Errors as `line:column message`.
fn errors(text: &str) -> Vec<String> {
    let problems = parse(text).unwrap_err();
    let place = |at: usize| {
        let before = &text[..at];
        (before.matches('\n').count() + 1, at - before.rfind('\n').map_or(0, |newline| newline + 1) + 1)
    };
    problems
        .list
        .iter()
        .map(|problem| {
            let (line, column) = place(problem.span.start);
            format!("{line}:{column} {}", problem.message)
        })
        .collect()
}

#[test]
fn reads_the_whole_format() {
    let scenario = parse(
        "# header\nscan 2ms # two\n\nat 0ms I0.1 = 1, Ain0 = 207\nat 500ms expect Q0.1 = 0, MW3 = 200..210\r\n\
         at 1.5s start = 1, \"a, b = c # d\" = 0 # quoted\nAT 1s EXPECT T37 = 1,T37.cv=-5..16#10\nrun 5s",
    )
    .unwrap();
    assert_eq!((scenario.scan_ms, scenario.run_ms, scenario.last_ms()), (Some(2), Some(5000), 1500));
    let settings: Vec<_> =
        scenario.settings.iter().map(|set| (set.at_ms, set.operand.to_string(), set.value)).collect();
    let expected = [(0, "I0.1", 1), (0, "Ain0", 207), (1500, "I0.0", 1), (1500, "I0.1", 0)];
    assert_eq!(settings, expected.map(|(at, name, value)| (at, name.to_string(), value)));
    let expectations: Vec<_> =
        scenario.expectations.iter().map(|e| (e.line, e.at_ms, &*e.name, e.values.clone())).collect();
    let expected =
        [(5, 500, "Q0.1", 0..=0), (5, 500, "MW3", 200..=210), (7, 1000, "T37", 1..=1), (7, 1000, "T37.cv", -5..=16)];
    assert_eq!(expectations, expected);
}

#[test]
fn numbers_in_three_bases_and_comments_behind_them() {
    let scenario = parse("at 0s MW0 = 16#FFFF, MB2 = 2#1010_0101, MW4 = -7#.\nat 0s MW6 = 65535 # c").unwrap();
    let values: Vec<_> = scenario.settings.iter().map(|setting| setting.value).collect();
    assert_eq!(values, [-1, 165, -7, -1]);
}

#[test]
fn all_errors_in_one_run_with_their_places() {
    let text = "scna 1ms\n  at 5 I0.0 = 1\nat 1s I0.9 = 1\nat 1s expect MW3 = 70000, Q0.0 == 1\nrun 1s extra\nrun 2s\n";
    let expected = [
        "1:1 unknown statement scna",
        "2:6 5: a time needs its unit: 5ms or 5s",
        "3:7 I0.9: a byte has bits 0 to 7",
        "4:20 70000 is out of range: MW3 is a word, -32768 to 32767 or a bit pattern up to 16#FFFF",
        "4:27 write operand = value, several separated by commas",
        "5:8 nothing may follow the time in this statement",
        "6:1 there is a run statement above already",
    ];
    assert_eq!(errors(text), expected);
}

#[test]
fn values_must_fit_their_operand() {
    let expected = [
        "1:14 2 is out of range: I0.0 is a bit, 0 or 1",
        "2:13 300 is out of range: QB0 is a byte, 0 to 255",
        "3:14 1024 is out of range: Ain0 takes 0 to 1023",
        "4:14 32001 is out of range: AIW0 takes 0 to 32000",
        "5:13 -32769 is out of range: MW0 is a word, -32768 to 32767 or a bit pattern up to 16#FFFF",
        "6:12 -1 is out of range: T37 is a bit, 0 or 1",
        "7:20 99999999999999999999 is out of range: MB0 is a byte, 0 to 255",
    ];
    let text = "at 0s I0.0 = 2\nat 0s QB0 = 300\nat 0s Ain0 = 1024\nat 0s AIW0 = 32001\nat 0s MW0 = -32769\n\
                at 0s T37 =-1\nat 0s expect MB0 = 99999999999999999999";
    assert_eq!(errors(text), expected);
}

#[test]
fn malformed_values_and_lists() {
    let text = "at 0s I0.0 =\nat 0s I0.0\nat 0s I0.0 = 1,\nat 0s\nat 0s expect\nat 0s MW0 = 1..2\n\
                at 0s expect MW0 = 5..4\nat 0s MW0 = 8#7\nat 0s MW0 = 1_000\nat 0s = 1\nscan 0ms\nscan";
    let messages = errors(text);
    let places: Vec<_> = messages.iter().map(|message| message.split(' ').next().unwrap()).collect();
    let expected = ["1:13", "2:7", "3:16", "4:6", "5:13", "6:13", "7:20", "8:13", "9:13", "10:7", "11:6", "12:1"];
    assert_eq!(places, expected, "{messages:#?}");
    assert!(messages[6].contains("5 is more than 4"), "{}", messages[6]);
}

#[test]
fn suggestions_for_misspelt_words() {
    let help = |text: &str| parse(text).unwrap_err().list[0].help.clone();
    assert_eq!(help("rnu 1s").as_deref(), Some("did you mean `run`?"));
    assert_eq!(help("at 0s expct Q0.0 = 1").as_deref(), Some("did you mean `expect`?"));
    assert_eq!(help("at 0s Strat = 1").as_deref(), Some("did you mean `Start`?"));
    assert_eq!(help("plant tnak").as_deref(), Some("did you mean `tank`?"));
    assert_eq!(help("measure 1s").as_deref(), Some("the statements are scan, at, run and plant"));
}

#[test]
fn expectation_behind_the_end_is_an_error() {
    assert!(parse("run 1s\nat 1s expect Q0.0 = 0").is_ok());
    let expected = ["2:18 expected at 1001ms, but the run ends at 1s: this would never be checked"];
    assert_eq!(errors("run 1s\nat 1001ms expect Q0.0 = 0"), expected);
}

#[test]
fn operand_without_memory_is_an_error_at_its_place() {
    assert_eq!(errors("at 0s expect VW1000 = 0"), ["1:14 the program has no memory for VW1000"]);
}

#[test]
fn plant_of_the_command_line_counts() {
    let symbols = symbols();
    let plant = crate::plant::parse_spec("tank").unwrap();
    let mut has_operand = |_| Ok(());
    let context = Context { symbols: &symbols, plant: Some(&plant), has_operand: &mut has_operand };
    let problems = Scenario::parse("t.scn", "at 0s AIW0 = 5, I0.1 = 1, IB0 = 0", context).unwrap_err();
    let messages: Vec<_> = problems.list.iter().map(|problem| &*problem.message).collect();
    assert_eq!(messages, ["AIW0 is driven by the plant tank", "IB0 is driven by the plant tank"]);
}

#[test]
fn no_text_makes_it_panic() {
    let parts = [
        "at", "expect", "scan", "run", "plant", "tank", "station1", "pieces", " ", " ", " ", "\n", "\r\n", "\t", "=",
        ",", "..", "#", "16#", "2#", "\"", "-", "0", "7", "70000", "1s", "5ms", "1.5s", "I0.0", "MW3", "T37", ".cv",
        "Ain0", "ü", "日本", "\u{a0}", "\u{0}", "🦀",
    ];
    let mut random = fastrand::Rng::with_seed(1);
    let mut failed = 0;
    for _ in 0..20_000 {
        let text: String = (0..random.usize(0..30)).map(|_| parts[random.usize(0..parts.len())]).collect();
        if let Err(problems) = parse(&text) {
            failed += 1;
            assert!(problems.render(true).contains("t.scn:"), "{text:?}");
        }
    }
    assert!((10_000..20_000).contains(&failed), "{failed}");
}
