//! Reading scenarios: what is understood, and the exact place of every error.

use awl_asm::Address;
use awl_asm::ast::Value;
use plc_vm::TimeOfDay;

use super::*;
use crate::pulse::Pulse;

fn symbols() -> [Symbol; 2] {
    [("Start", "I0.0"), ("a, b = c # d", "I0.1")].map(|(name, address)| Symbol {
        name: name.to_string(),
        value: Value::Address(Address::parse(address).unwrap()),
        comment: String::new(),
    })
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
fn double_words_and_reals() {
    let text = "at 0s VD0 = 16#FFFFFFFF, AC0 = -70000, VD4 = 1.5, VD8:real = 3, AC1 = 1e3, VD12 = -2.5e-1\n\
                at 1s expect VD4 = 1.4..1.6, HC0 = 5, VD8:real = 2..4, VD12 = -0.25";
    let scenario = parse(text).unwrap();
    let settings: Vec<_> =
        scenario.settings.iter().map(|set| (set.operand.to_string(), set.operand.text(set.value))).collect();
    let expected = [
        ("VD0", "-1"),
        ("AC0", "-70000"),
        ("VD4:real", "1.5"),
        ("VD8:real", "3.0"),
        ("AC1:real", "1000.0"),
        ("VD12:real", "-0.25"),
    ];
    assert_eq!(settings, expected.map(|(name, value)| (name.to_string(), value.to_string())));
    let met = |index: usize, real: f32| scenario.expectations[index].is_met_by(real.to_bits() as i32);
    assert!(met(0, 1.4) && met(0, 1.6) && !met(0, 1.39) && !met(0, f32::NAN) && !met(0, -1.5));
    assert!(met(3, -0.25) && !met(3, 0.25));
    assert!(scenario.expectations[1].is_met_by(5));
    let expected = [
        "1:13 4294967296 is out of range: VD0 has 32 bits, -2147483648 to 2147483647 or a bit pattern up to 16#FFFFFFFF",
        "2:13 1e39 is out of range: reals reach to 3.402823e38",
        "3:20 -1.5..-2.5 holds no value: -1.5 is more than -2.5",
        "4:13 1.5 is no value: write 207, 16#CF or 2#1100_1111; 1.5 or 2e-3 for a real",
        "5:7 VW0:real: only double words and accumulators hold a real",
    ];
    let text = "at 0s VD0 = 4294967296\nat 0s VD0 = 1e39\nat 0s expect VD0 = -1.5..-2.5\nat 0s VW0 = 1.5\n\
                at 0s VW0:real = 1";
    assert_eq!(errors(text), expected);
}

#[test]
fn strings_are_length_and_characters() {
    let scenario = parse("at 0s VB9 = \"a,=#\\xFF\\n\"\nat 1s expect VB9 = \"\", VB20 = \"ü\"").unwrap();
    let settings: Vec<_> =
        scenario.settings.iter().map(|setting| (setting.operand.to_string(), setting.value)).collect();
    let expected = [("VB9", 6), ("VB10", 97), ("VB11", 44), ("VB12", 61), ("VB13", 35), ("VB14", 255), ("VB15", 10)];
    assert_eq!(settings, expected.map(|(name, value)| (name.to_string(), value)));
    let expected = [("VB9", 0), ("VB20", 1), ("VB21", 252)];
    let expectations = scenario.expectations.iter();
    let expectations: Vec<_> = expectations.map(|e| (&*e.name, *e.values.start(), *e.values.end())).collect();
    assert_eq!(expectations, expected.map(|(name, value)| (name, value, value)));
    let expected = [
        "1:13 a string stands in bytes, and VW0 is none",
        "2:13 \"a does not end with a quote",
        "3:13 \\q begins with no character of a byte",
    ];
    assert_eq!(errors("at 0s VW0 = \"a\"\nat 0s VB0 = \"a\nat 0s VB0 = \"\\q\""), expected[..]);
}

#[test]
fn a_text_that_was_sent_is_one_item_of_a_list() {
    let scenario =
        parse("at 1s expect sent \"X\", MW2=1, VB0 = \"Y\"\nat 2s expect MW4 = 2, sent \"a, \\x22b\\\\\" # c\n")
            .unwrap();
    let sent: Vec<_> = scenario.sent.iter().map(|sent| (sent.line, sent.at_ms, &*sent.bytes)).collect();
    assert_eq!(sent, [(1, 1000, &b"X"[..]), (2, 2000, b"a, \"b\\")]);
    let expectations: Vec<_> = scenario.expectations.iter().map(|e| (&*e.name, *e.values.start())).collect();
    assert_eq!(expectations, [("MW2", 1), ("VB0", 1), ("VB1", 89), ("MW4", 2)]);
    let follows = "nothing may follow the quote that ends the text; one in the text is \\x22";
    let expected = [
        format!("1:19 {follows}"),
        "2:18 a text in quotes is missing".to_string(),
        format!("3:15 {follows}"),
        format!("4:13 {follows}"),
        "5:19 \"X, MW2 = 1 does not end with a quote".to_string(),
    ];
    let text = "at 1s expect sent \"X\" \"Y\"\nat 1s expect sent, MW2 = 1\nat 1s receive \"X\", VB0 = \"Y\"\n\
                at 1s VB0 = \"X\" + \"Y\"\nat 1s expect sent \"X, MW2 = 1";
    assert_eq!(errors(text), expected);
}

#[test]
fn pulses_and_the_clock() {
    let text = "at 100ms pulse start 1000Hz for 2s # a symbol\nat 1s PULSE I0.2 0.5kHz 500 times\n\
                at 0s pulse I0.0, I0.1 12.5Hz for 1s\nat 0s pulse I0.0,\"a, b = c # d\" 1Hz 1 times reverse\n\
                at 3s clock 2026-11-21 15:00:00";
    let scenario = parse(text).unwrap();
    let pulse =
        |at_ms, input, second, millihertz, count| Action::Pulse(Pulse { at_ms, input, second, millihertz, count });
    let expected = [
        pulse(100, 0, None, 1_000_000, 2000),
        pulse(1000, 2, None, 500_000, 500),
        pulse(0, 0, Some(1), 12_500, 12),
        pulse(0, 1, Some(0), 1_000, 1),
        Action::SetClock { at_ms: 3000, time: TimeOfDay::new([26, 11, 21], [15, 0, 0]).unwrap() },
    ];
    assert_eq!(scenario.actions, expected);
    assert_eq!(scenario.last_ms(), 3000);
}

#[test]
fn malformed_pulses_and_clocks() {
    let text = "at 0s pulse I0.0 for 2s\nat 0s pulse Q0.0 1Hz for 2s\nat 0s pulse I0.0 1Hz\n\
                at 0s pulse I0.0 1Hz for 2\nat 0s pulse I0.0 10Hz for 50ms\nat 0s pulse I0.0, I0.0 1Hz for 2s\n\
                at 0s pulse I0.0 1Hz for 2s reverse\nat 0s pulse I0.0 300kHz for 1s\n\
                at 0s pulse I0.0, I0.1, I0.2 1Hz for 1s\nat 0s clock 2026-02-29 00:00:00\nat 0s plse I0.0 1Hz for 1s";
    let expected = [
        "1:13 a frequency such as 1000Hz is missing",
        "2:13 Q0.0 is none of the inputs I0.0 to I0.7, which pulses can come at",
        "3:21 how long the pulses last is missing",
        "4:26 2: a time needs its unit: 2ms or 2s",
        "5:27 no whole pulse fits into this time",
        "6:19 an encoder has two different inputs",
        "7:29 only pulses at two inputs have a direction",
        "8:18 300kHz: a frequency is 0.001Hz to 200kHz",
        "9:13 pulses come at one input or at two",
        "10:13 this is no date of 2000 to 2099 with a time",
        "11:7 unknown word plse",
    ];
    assert_eq!(errors(text), expected);
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
        "Ain0", "pulse", "1000Hz", "for", "times", "reverse", "clock", "VD4", ":real", "1e5", "ü", "日本", "\u{a0}",
        "\u{0}", "🦀",
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
