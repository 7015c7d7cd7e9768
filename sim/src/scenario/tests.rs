//! Reading scenarios: what is understood, and the exact place of every error.

use awl_asm::Address;
use awl_asm::ast::Value;
use plc_vm::TimeOfDay;

use super::condition::Comparison;
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
    Scenario::parse(
        "t.scn",
        text,
        Context { symbols: &symbols, plant: None, has_operand: &mut has_operand },
    )
}

/// Errors as `line:column message`.
fn errors(text: &str) -> Vec<String> {
    let problems = parse(text).unwrap_err();
    let place = |at: usize| {
        let before = &text[..at];
        (
            before.matches('\n').count() + 1,
            at - before.rfind('\n').map_or(0, |newline| newline + 1) + 1,
        )
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

/// The only comparison of an expectation.
fn only(scenario: &Scenario, index: usize) -> &Comparison {
    let [all] = &scenario.expectations[index].condition.0[..] else { panic!("alternatives") };
    let [comparison] = &all[..] else { panic!("several") };
    comparison
}

#[test]
fn reads_the_whole_format() {
    let scenario = parse(
        "# header\nscan 2ms # two\n\nat 0ms I0.1 = 1, Ain0 = 207\n\
            at 500ms expect Q0.1 = 0, MW3 = 200..210\r\n\
         at 1.5s start = 1, \"a, b = c # d\" = 0 # quoted\nAT 1s EXPECT T37 = 1,T37.cv=-5..16#10\n\
         run 5s",
    )
    .unwrap();
    assert_eq!(
        (scenario.scan_ms, scenario.run_ms, scenario.last_ms()),
        (Some(2), Some(5000), 1500)
    );
    let settings: Vec<_> = scenario
        .settings
        .iter()
        .map(|set| (set.at_ms, set.operand.to_string(), set.value))
        .collect();
    let expected = [(0, "I0.1", 1), (0, "Ain0", 207), (1500, "I0.0", 1), (1500, "I0.1", 0)];
    assert_eq!(settings, expected.map(|(at, name, value)| (at, name.to_string(), value)));
    let expectations: Vec<_> =
        scenario.expectations.iter().map(|e| (e.line, e.at_ms, e.condition.to_string())).collect();
    let expected = [
        (5, 500, "Q0.1 = 0"),
        (5, 500, "MW3 = 200..210"),
        (7, 1000, "T37 = 1"),
        (7, 1000, "T37.cv = -5..16"),
    ];
    assert_eq!(expectations, expected.map(|(line, at, text)| (line, at, text.to_string())));
}

#[test]
fn numbers_in_three_bases_and_comments_behind_them() {
    let scenario =
        parse("at 0s MW0 = 16#FFFF, MB2 = 2#1010_0101, MW4 = -7#.\nat 0s MW6 = 65535 # c").unwrap();
    let values: Vec<_> = scenario.settings.iter().map(|setting| setting.value).collect();
    assert_eq!(values, [-1, 165, -7, -1]);
}

#[test]
fn double_words_and_reals() {
    let text = "at 0s VD0 = 16#FFFFFFFF, AC0 = -70000, VD4 = 1.5, VD8:real = 3, AC1 = 1e3, VD12 = \
        -2.5e-1\n\
                at 1s expect VD4 = 1.4..1.6, HC0 = 5, VD8:real = 2..4, VD12 = -0.25";
    let scenario = parse(text).unwrap();
    let settings: Vec<_> = scenario
        .settings
        .iter()
        .map(|set| (set.operand.to_string(), set.operand.text(set.value)))
        .collect();
    let expected = [
        ("VD0", "-1"),
        ("AC0", "-70000"),
        ("VD4:real", "1.5"),
        ("VD8:real", "3.0"),
        ("AC1:real", "1000.0"),
        ("VD12:real", "-0.25"),
    ];
    assert_eq!(settings, expected.map(|(name, value)| (name.to_string(), value.to_string())));
    let met = |index: usize, real: f32| only(&scenario, index).holds(real.to_bits() as i32);
    assert!(met(0, 1.4) && met(0, 1.6) && !met(0, 1.39) && !met(0, f32::NAN) && !met(0, -1.5));
    assert!(met(3, -0.25) && !met(3, 0.25));
    assert!(only(&scenario, 1).holds(5));
    let expected = [
        "1:13 4294967296 is out of range: VD0 has 32 bits, -2147483648 to 2147483647 or a bit \
            pattern up to 16#FFFFFFFF",
        "2:13 1e39 is out of range: reals reach to 3.402823e38",
        "3:20 -1.5..-2.5 holds no value: -1.5 is more than -2.5",
        "4:13 1.5 is no value: write 207, 16#CF or 2#1100_1111; 1.5 or 2e-3 for a real",
        "5:7 VW0:real: only double words and accumulators hold a real",
    ];
    let text = "at 0s VD0 = 4294967296\nat 0s VD0 = 1e39\nat 0s expect VD0 = -1.5..-2.5\n\
        at 0s VW0 = 1.5\n\
                at 0s VW0:real = 1";
    assert_eq!(errors(text), expected);
}

#[test]
fn strings_are_length_and_characters() {
    let scenario =
        parse("at 0s VB9 = \"a,=#\\xFF\\n\"\nat 1s expect VB9 = \"\", VB20 = \"ü\"").unwrap();
    let settings: Vec<_> = scenario
        .settings
        .iter()
        .map(|setting| (setting.operand.to_string(), setting.value))
        .collect();
    let expected = [
        ("VB9", 6),
        ("VB10", 97),
        ("VB11", 44),
        ("VB12", 61),
        ("VB13", 35),
        ("VB14", 255),
        ("VB15", 10),
    ];
    assert_eq!(settings, expected.map(|(name, value)| (name.to_string(), value)));
    let expected = [("VB9", 0), ("VB20", 1), ("VB21", 252)];
    let expectations: Vec<_> =
        (0..3).map(|index| only(&scenario, index)).map(|e| (&*e.name, *e.values.start())).collect();
    assert_eq!(expectations, expected);
    let expected = [
        "1:13 a string is in bytes, and VW0 is none",
        "2:13 \"a does not end with a quote",
        "3:13 \\q begins with no character of a byte",
    ];
    assert_eq!(errors("at 0s VW0 = \"a\"\nat 0s VB0 = \"a\nat 0s VB0 = \"\\q\""), expected[..]);
}

#[test]
fn a_text_that_was_sent_is_one_item_of_a_list() {
    let scenario = parse(
        "at 1s expect sent \"X\", MW2=1, VB0 = \"Y\"\n\
            at 2s expect MW4 = 2, sent \"a, \\x22b\\\\\" # c\n",
    )
    .unwrap();
    let sent: Vec<_> =
        scenario.sent.iter().map(|sent| (sent.line, sent.at_ms, &*sent.bytes)).collect();
    assert_eq!(sent, [(1, 1000, &b"X"[..]), (2, 2000, b"a, \"b\\")]);
    let expectations: Vec<_> =
        (0..4).map(|index| only(&scenario, index)).map(|e| (&*e.name, *e.values.start())).collect();
    assert_eq!(expectations, [("MW2", 1), ("VB0", 1), ("VB1", 89), ("MW4", 2)]);
    let follows = "nothing may follow the quote that ends the text; one in the text is \\x22";
    let expected = [
        format!("1:19 {follows}"),
        "2:18 a text in quotes is missing".to_string(),
        format!("3:15 {follows}"),
        format!("4:13 {follows}"),
        "5:19 \"X, MW2 = 1 does not end with a quote".to_string(),
    ];
    let text = "at 1s expect sent \"X\" \"Y\"\nat 1s expect sent, MW2 = 1\n\
        at 1s receive \"X\", VB0 = \"Y\"\n\
                at 1s VB0 = \"X\" + \"Y\"\nat 1s expect sent \"X, MW2 = 1";
    assert_eq!(errors(text), expected);
}

#[test]
fn pulses_and_the_clock() {
    let text = "at 100ms pulse start 1000Hz for 2s # a symbol\nat 1s PULSE I0.2 0.5kHz 500 times\n\
                at 0s pulse I0.0, I0.1 12.5Hz for 1s\n\
                at 0s pulse I0.0,\"a, b = c # d\" 1Hz 1 times reverse\n\
                at 3s clock 2026-11-21 15:00:00";
    let scenario = parse(text).unwrap();
    let pulse = |at_ms, input, second, millihertz, count| {
        Action::Pulse(Pulse { at_ms, input, second, millihertz, count })
    };
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
                at 0s pulse I0.0 1Hz for 2\nat 0s pulse I0.0 10Hz for 50ms\n\
                at 0s pulse I0.0, I0.0 1Hz for 2s\n\
                at 0s pulse I0.0 1Hz for 2s reverse\nat 0s pulse I0.0 300kHz for 1s\n\
                at 0s pulse I0.0, I0.1, I0.2 1Hz for 1s\nat 0s clock 2026-02-29 00:00:00\n\
                at 0s plse I0.0 1Hz for 1s";
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
    let text = "scna 1ms\n  at 5 I0.0 = 1\nat 1s I0.9 = 1\nat 1s expect MW3 = 70000, Q0.0 == 1\n\
        run 1s extra\nrun 2s\n";
    let expected = [
        "1:1 unknown statement scna",
        "2:6 5: a time needs its unit: 5ms or 5s",
        "3:7 I0.9: a byte has bits 0 to 7",
        "4:20 70000 is out of range: MW3 is a word, -32768 to 32767 or a bit pattern up to 16#FFFF",
        "4:32 == is no sign of a comparison",
        "5:8 nothing may follow the time in this statement",
        "6:1 there is a run statement above already",
    ];
    assert_eq!(errors(text), expected);
}

#[test]
fn words_of_other_languages_are_answered() {
    let text = "at 0s I0.0 := 1\nat 0s set I0.0 = 1\n1s I0.0 = 1\nat 1s expect C1 > 10\n";
    let expected = [
        "1:12 := sets no value: a value is set by = alone",
        "2:7 a value is set without a word",
        "3:1 unknown statement 1s",
        "4:19 10 is out of range: C1 is a bit, 0 or 1; the current value is C1.cv",
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
        "5:13 -32769 is out of range: MW0 is a word, -32768 to 32767 or a bit pattern up to \
            16#FFFF",
        "6:12 -1 is out of range: T37 is a bit, 0 or 1; the current value is T37.cv",
        "7:20 99999999999999999999 is out of range: MB0 is a byte, 0 to 255",
    ];
    let text = "at 0s I0.0 = 2\nat 0s QB0 = 300\nat 0s Ain0 = 1024\nat 0s AIW0 = 32001\n\
        at 0s MW0 = -32769\n\
                at 0s T37 =-1\nat 0s expect MB0 = 99999999999999999999";
    assert_eq!(errors(text), expected);
}

#[test]
fn malformed_values_and_lists() {
    let text = "at 0s I0.0 =\nat 0s I0.0\nat 0s I0.0 = 1,\nat 0s\nat 0s expect\nat 0s MW0 = 1..2\n\
                at 0s expect MW0 = 5..4\nat 0s MW0 = 8#7\nat 0s MW0 = 1_000\nat 0s = 1\nscan 0ms\n\
                scan";
    let messages = errors(text);
    let places: Vec<_> =
        messages.iter().map(|message| message.split(' ').next().unwrap()).collect();
    let expected = [
        "1:13", "2:7", "3:16", "4:6", "5:13", "6:13", "7:20", "8:13", "9:13", "10:7", "11:6",
        "12:1",
    ];
    assert_eq!(places, expected, "{messages:#?}");
    assert!(messages[6].contains("5 is more than 4"), "{}", messages[6]);
}

#[test]
fn suggestions_for_misspelt_words() {
    let first = |text: &str| parse(text).unwrap_err().list[0].clone();
    let meant = |text: &str| first(text).suggestion.unwrap_or_default();
    assert_eq!(meant("rnu 1s"), "run");
    assert_eq!(meant("at 0s expct Q0.0 = 1"), "expect");
    assert_eq!(meant("at 0s Strat = 1"), "Start");
    assert_eq!(meant("plant tnak"), "tank");
    assert_eq!(
        first("measure 1s").help.as_deref(),
        Some(
            "the statements are scan, at, run, plant, every, always, never, until, program and goal"
        )
    );
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
    let problems =
        Scenario::parse("t.scn", "at 0s AIW0 = 5, I0.1 = 1, IB0 = 0", context).unwrap_err();
    let messages: Vec<_> = problems.list.iter().map(|problem| &*problem.message).collect();
    assert_eq!(messages, ["AIW0 is driven by the plant tank", "IB0 is driven by the plant tank"]);
}

fn conditions(text: &str) -> Vec<String> {
    let scenario = parse(text).unwrap_or_else(|problems| panic!("{problems}"));
    scenario.expectations.iter().map(|expectation| expectation.condition.to_string()).collect()
}

#[test]
fn comparisons_of_every_kind() {
    let text = "at 0s expect MW0 > 1, MW0<2, MW0 >=-3, MW0 <= 16#10, MW0 <> 5..7, VD0 > 1.5";
    let expected = ["MW0 > 1", "MW0 < 2", "MW0 >= -3", "MW0 <= 16", "MW0 <> 5..7", "VD0 > 1.5"];
    assert_eq!(conditions(text), expected);
    let scenario = parse(text).unwrap();
    let true_of = |index, values: &[i32]| -> Vec<i32> {
        let comparison = only(&scenario, index);
        values.iter().copied().filter(|&value| comparison.holds(value)).collect()
    };
    assert_eq!(true_of(0, &[0, 1, 2]), [2]);
    assert_eq!(true_of(1, &[1, 2, 3]), [1]);
    assert_eq!(true_of(2, &[-4, -3, -2]), [-3, -2]);
    assert_eq!(true_of(3, &[15, 16, 17]), [15, 16]);
    assert_eq!(true_of(4, &[4, 5, 6, 7, 8]), [4, 8]);
    // As reals: the bits of -2.0 would be the larger integer.
    let [less, same, more] = [-2.0_f32, 1.5, 2.0].map(|real| real.to_bits() as i32);
    assert_eq!(true_of(5, &[less, same, more]), [more]);
}

#[test]
fn words_for_the_values_of_bits() {
    let scenario = parse("at 0s I0.0 = TRUE, I0.1 = off, I0.2 = On, I0.3 = False").unwrap();
    let values: Vec<_> = scenario.settings.iter().map(|setting| setting.value).collect();
    assert_eq!(values, [1, 0, 1, 0]);
    assert_eq!(conditions("at 0s expect Q0.0 = ON"), ["Q0.0 = 1"]);
    let expected = [
        "1:13 TRUE is for bits, and MW0 is none",
        "2:14 TRU is no value of a bit: write 0 or 1, TRUE or FALSE, ON or OFF",
    ];
    assert_eq!(errors("at 0s MW0 = TRUE\nat 0s I0.0 = TRU"), expected);
}

#[test]
fn and_and_or_join_comparisons() {
    let text = "at 0s expect Q0.0 = 1 and MW0 > 3 or \"a, b = c # d\" = 0, Q0.1 = 1 AND Q0.2 = 1";
    let expected = ["Q0.0 = 1 and MW0 > 3 or \"a, b = c # d\" = 0", "Q0.1 = 1", "Q0.2 = 1"];
    assert_eq!(conditions(text), expected, "what has no alternative is told one by one");
    let expected = ["VB0 = 1 and VB1 = 65 or Q0.0 = 1"];
    assert_eq!(conditions("at 0s expect VB0 = \"A\" or Q0.0 = 1"), expected);
}

#[test]
fn a_name_may_have_such_words_and_signs_in_it() {
    let names = ["rise and fall", "a > b", "way to go", "within"];
    let symbols = names.map(|name| Symbol {
        name: name.to_string(),
        value: Value::Address(Address::parse("M0.0").unwrap()),
        comment: String::new(),
    });
    let text = "at 0s rise and fall = 1, a > b = 1, way to go = 1\nat 1s within = 1\n\
        at 1s expect rise and fall = 1, a > b = 0 and way to go >= 1\nnever a > b = 1 to 5s";
    let context = Context { symbols: &symbols, plant: None, has_operand: &mut |_| Ok(()) };
    let scenario = Scenario::parse("t.scn", text, context).unwrap();
    assert_eq!((scenario.settings.len(), scenario.expectations.len()), (4, 3));
    assert_eq!(scenario.rules[0].condition.to_string(), "a > b = 1");
}

#[test]
fn malformed_conditions() {
    let text = "at 0s expect MW0 > 1..2\nat 0s expect MW0 > 40000\nat 0s MW0 > 5\n\
        at 0s expect VB0 <> \"a\"\nat 0s expect Q0.0 = 1 and\nat 0s expect MW0 = 1 = 2\n\
        at 0s within 1s Q0.0 = 1\nat 0s within 1s expect sent \"a\"\nat 0s expect Q0.0 and Q0.1";
    let expected = [
        "1:20 1..2 is a range, and > takes one value",
        "2:20 > 40000 is out of range: MW0 is -32768 to 32767",
        "3:7 a value is set by =",
        "4:21 a text is compared by = and not by <>",
        "5:26 write operand = value, several joined by and, or",
        "6:14 write operand = value, several separated by commas",
        "7:17 expect is missing",
        "8:24 what is sent is looked at by at 2s expect sent \"text\" alone",
        "9:14 write operand = value, several joined by and, or",
    ];
    assert_eq!(errors(text), expected);
}

#[test]
fn relative_times_count_from_the_at_before() {
    let text = "at +5ms I0.0 = 1\nat 1min I0.0 = 0\nat +1min30s expect Q0.0 = 1\n\
        at +0ms within 2s expect Q0.1 = 1\nalways Q0.0 = 0 from 1h\nat +1s expect Q0.0 = 0";
    let scenario = parse(text).unwrap();
    let set: Vec<_> = scenario.settings.iter().map(|setting| setting.at_ms).collect();
    let expected: Vec<_> = scenario.expectations.iter().map(|e| (e.at_ms, e.within_ms)).collect();
    assert_eq!(set, [5, 60_000]);
    assert_eq!(expected, [(150_000, 0), (150_000, 2000), (151_000, 0)]);
    assert_eq!(
        errors("run +1s\nat 24000h I0.0 = 1\nat +1ms I0.0 = 0\nat + I0.0 = 1"),
        [
            "1:5 +1s is no time: write 500ms, 2s, 1.5s, 2min or 1h30min",
            "3:4 this is later than 1000 days (86400000s)",
            "4:5 a time is missing, such as 500ms or 2s"
        ]
    );
}

#[test]
fn rules_and_their_times() {
    let text = "never Q0.0 = 1 and Q0.1 = 1 from 1s to 5s\nalways Q0.0 = 0 or I0.0 = 1\n\
        ALWAYS Q0.2 = 0 TO 2s\nnever Q0.2 = 1 from 3s";
    let rules = parse(text).unwrap().rules;
    let rules: Vec<_> = rules
        .iter()
        .map(|rule| (rule.wanted, rule.condition.to_string(), rule.from_ms, rule.to_ms))
        .collect();
    let expected = [
        (false, "Q0.0 = 1 and Q0.1 = 1", 1000, Some(5000)),
        (true, "Q0.0 = 0 or I0.0 = 1", 0, None),
        (true, "Q0.2 = 0", 0, Some(2000)),
        (false, "Q0.2 = 1", 3000, None),
    ];
    assert_eq!(
        rules,
        expected.map(|(wanted, text, from, to)| (wanted, text.to_string(), from, to))
    );
    let text = "never Q0.0 = 1 from 2s to 2s\nnever Q0.0 = 1 from 1s for 2s\nalways\n\
        never Q0.0 = 1, Q0.1 = 1\nnever Q0.0 = 1 from 1\nnever Q0.0 = 1 to 1s 2s";
    let expected = [
        "1:27 no scan is between these times",
        "2:24 nothing may follow here but to and a time",
        "3:7 write operand = value, several joined by and, or",
        "4:7 write operand = value, several joined by and, or",
        "5:21 1: a time needs its unit: 1ms or 1s",
        "6:22 nothing may follow the time in this statement",
    ];
    assert_eq!(errors(text), expected);
}

#[test]
fn values_that_are_set_again_and_again() {
    let scenario = parse("every 2s I0.0 = 1, MW0 = 7 from 500ms to 5s\nevery 1s I0.1 = 1").unwrap();
    let repeat = |period_ms, to_ms| Some(Repeat { period_ms, to_ms });
    let settings: Vec<_> =
        scenario.settings.iter().map(|setting| (setting.at_ms, setting.repeat)).collect();
    let first = (500, repeat(2000, Some(5000)));
    assert_eq!(settings, [first, first, (0, repeat(1000, None))]);
    assert_eq!(scenario.last_ms(), 4500);
    let expected = [
        "1:7 a period is 1ms or longer",
        "2:10 every repeats values that are set",
        "3:10 every repeats values that are set",
        "4:9 nothing is set here: write operand = value",
    ];
    let text = "every 0s I0.0 = 1\nevery 2s expect Q0.0 = 1\nevery 2s from 1s I0.0 = 1\nevery 2s";
    let found = errors(text);
    assert_eq!(found.len(), 4, "{found:#?}");
    assert_eq!(found[..3], expected[..3]);
}

#[test]
fn until_is_in_place_of_run() {
    let scenario = parse("until Q0.0 = 1 or MW0 > 5 or 10s\nat 10s expect Q0.0 = 1").unwrap();
    let until = scenario.until.unwrap();
    assert_eq!(
        (until.condition.to_string(), until.limit_ms, until.line),
        ("Q0.0 = 1 or MW0 > 5".to_string(), 10_000, 1)
    );
    let missing = "1:7 a time is missing at which the run ends";
    for text in ["until Q0.0 = 1", "until Q0.0 = 1 or Q0.1 = 1", "until 10s"] {
        assert_eq!(errors(text), [missing], "{text}");
    }
    assert_eq!(
        errors("until Q0.0 = 1 or 1s\nrun 1s"),
        ["2:1 there is an until statement above already"]
    );
    assert_eq!(
        errors("run 1s\nuntil Q0.0 = 1 or 10s\nat 2s expect Q0.0 = 1")[0],
        "2:1 there is a run statement above already"
    );
}

#[test]
fn what_the_run_never_checks_is_an_error() {
    let late = "this would never be checked";
    for text in [
        "run 1s\nat 900ms within 101ms expect Q0.0 = 1",
        "run 1s\nnever Q0.0 = 1 from 1s",
        "run 1s\nnever Q0.0 = 1 to 2s",
        "until Q0.0 = 1 or 1s\nat 2s expect Q0.1 = 1",
    ] {
        let found = errors(text);
        assert!(found.len() == 1 && found[0].ends_with(late), "{text}: {found:?}");
    }
    assert!(parse("run 1s\nat 900ms within 100ms expect Q0.0 = 1\nnever Q0.1 = 1 to 1s").is_ok());
}

#[test]
fn the_program_is_found_before_the_scenario_is_read() {
    let text = "# program not.awl\nat nonsense\nPROGRAM \"my motor.awl\" # comment\n";
    assert_eq!(program_of(text), ["my motor.awl"]);
    assert_eq!(program_of("at 0s I0.0 = 1"), [""; 0]);
    assert_eq!(program_of("program main.awl, \"a, b.awl\""), ["main.awl", "a, b.awl"]);
    assert_eq!(parse("program ../a//b.awl").unwrap().program, ["../a//b.awl"]);
    assert_eq!(
        errors("program a.awl,"),
        ["1:9 a file is missing: write program main.awl, sbr0.awl"]
    );
    assert_eq!(errors("program"), ["1:8 a file is missing: write program motor.awl"]);
}

#[test]
fn the_example_of_the_manual_is_a_scenario() {
    let manual = include_str!("../../../docs/simulator.md");
    let example = manual.split("```\n").find(|block| block.starts_with("scan 1ms")).unwrap();
    let scenario = parse(example).unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!((scenario.expectations.len(), scenario.rules.len()), (5, 1));
}

#[test]
fn no_text_makes_it_panic() {
    let parts = [
        "at", "expect", "scan", "run", "plant", "tank", "station1", "pieces", " ", " ", " ", "\n",
        "\r\n", "\t", "=", ",", "..", "#", "16#", "2#", "\"", "-", "0", "7", "70000", "1s", "5ms",
        "1.5s", "I0.0", "MW3", "T37", ".cv", "Ain0", "pulse", "1000Hz", "for", "times", "reverse",
        "clock", "VD4", ":real", "1e5", "ü", "日本", "\u{a0}", "\u{0}", "🦀", "every", "always",
        "never", "until", "within", "from", "to", "and", "or", "<", ">", "+", "1min", "TRUE",
        "program",
    ];
    let mut random = fastrand::Rng::with_seed(1);
    let mut failed = 0;
    for _ in 0..20_000 {
        let text: String =
            (0..random.usize(0..30)).map(|_| parts[random.usize(0..parts.len())]).collect();
        if let Err(problems) = parse(&text) {
            failed += 1;
            assert!(problems.render(true).contains("t.scn:"), "{text:?}");
        }
    }
    assert!((10_000..20_000).contains(&failed), "{failed}");
}

#[test]
fn an_event_is_a_bit() {
    let scenario = parse("at 5ms event Start, M0.3\nat 6ms event = 1").unwrap_err();
    assert_eq!(scenario.list.len(), 1, "with a sign behind it, it is a symbol");
    let scenario = parse("at 5ms event Start, M0.3").unwrap();
    let settings = scenario.settings.iter();
    let settings: Vec<_> =
        settings.map(|set| (set.operand.to_string(), set.value, set.for_scan)).collect();
    assert_eq!(settings, [("I0.0".to_string(), 1, true), ("M0.3".to_string(), 1, true)]);
    assert_eq!(errors("at 5ms event MW3"), ["1:14 MW3: an event is a bit"]);
    assert_eq!(errors("at 5ms event"), ["1:13 an operand is missing"]);
}
