//! Instruction lists of projects: the statements that become of them, and what is said about those
//! that are not read.

use diagnostics::Source;
use plcopen::{Imported, read};

/// A project with an instruction list, which begins in line 2.
fn program(list: &str) -> String {
    format!(
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><pous>\
         <pou name=\"Lamp\" pouType=\"program\"><body><IL><p><![CDATA[\n{list}\n]]></p></IL></body>\
         </pou></pous></types></project>"
    )
}

fn imported(text: &str) -> Imported {
    read(&Source::new("lamp.xml", text).expect("a short text"))
}

/// The statements of an instruction list.
fn statements(list: &str) -> String {
    let found = imported(&program(list));
    assert!(found.diagnostics.is_empty(), "{list}: {:?}", found.diagnostics);
    let text = found.text.text().strip_prefix("PROGRAM Lamp\n");
    text.and_then(|text| text.strip_suffix("END_PROGRAM\n")).expect("a program").to_owned()
}

/// What is said about an instruction list, with the line in it and the text at its place.
fn said(list: &str) -> Vec<String> {
    let text = program(list);
    let source = Source::new("lamp.xml", &text).expect("a short text");
    let all = read(&source).diagnostics.into_iter().map(|one| {
        let line = source.position(one.span.start as usize).0 - 1;
        format!("{} {line} `{}` {}", one.code.text(), one.span.text(&text), one.message)
    });
    all.collect()
}

#[test]
fn values_are_computed_and_stored() {
    for (list, text) in [
        ("LD a\nST q", "q := a;\n"),
        ("ldn a\nandn b\nST q\nSTN p", "q := NOT a AND NOT b;\np := NOT q;\n"),
        ("LD %IX0.0\n& b\nOR c\nXORN d\nST q", "q := ((%IX0.0 AND b) OR c) XOR NOT d;\n"),
        ("LD a\nOR b\nNOT\nST q", "q := NOT (a OR b);\n"),
        ("LD -1\nADD n\nADD m[i + 1]\nMUL 2\nST n", "n := (-1 + n + m[i + 1]) * 2;\n"),
        ("LD n\nSUB 3\nMOD 4\nDIV 1.5E-3\nST n", "n := ((n - 3) MOD 4) / 1.5E-3;\n"),
        ("LD t\nGE T#2s\nST q", "q := t >= T#2s;\n"),
        ("LD a\nAND( b\nOR c\n)\nST q", "q := a AND (b OR c);\n"),
        ("LD a\nORN(\nLD b\nAND( c\nOR d )\n)\nST q", "q := a OR NOT (b AND (c OR d));\n"),
        ("LD n\nINT_TO_REAL\nLimit 1.0, x\nST y", "y := Limit(INT_TO_REAL(n), 1.0, x);\n"),
        ("Limit(\n  MN := 1,\n  IN := n\n)\nADD 1\nST n", "n := Limit(MN := 1, IN := n) + 1;\n"),
        ("LD 1\nST n\nST m", "n := 1;\nm := n;\n"),
        ("(* Two\nlines *) LD a // b\nST q (* end *)", "// Two\n// lines\n// b\n// end\nq := a;\n"),
        ("", ""),
    ] {
        assert_eq!(statements(list), text, "{list}");
    }
}

#[test]
fn what_changes_a_value_asks_for_it_once() {
    let text = "IF NOT q THEN\n    q := TRUE;\n    p := FALSE;\nEND_IF;\nn := 1;\n";
    assert_eq!(statements("LDN q\nS q\nR p\nLD 1\nST n"), text);
    // It is stored after what it was computed from has changed.
    let text = "IF NOT q THEN\n    q := TRUE;\n    p := TRUE;\nELSE\n    p := FALSE;\nEND_IF;\n";
    assert_eq!(statements("LDN q\nS q\nST p"), text);
}

#[test]
fn function_blocks_are_called() {
    let list = "CAL Pause(\n  IN := a,\n  PT := T#1s\n)\nLD Pause.Q\nCALC Count (CU := b)\n\
                CALCN Other\nLD 1\nST n";
    let text = "Pause(IN := a, PT := T#1s);\nIF Pause.Q THEN\n    Count(CU := b);\nELSE\n    \
                Other();\nEND_IF;\nn := 1;\n";
    assert_eq!(statements(list), text);
}

#[test]
fn jumps_forward_become_alternatives() {
    let counter = "LD Reset\nJMPC ToZero\nLD Out\nADD 1\nJMP Store\n\nToZero:\nLD Start\n\nStore: \
                   ST Out\nST Shown";
    let text = "IF Reset THEN\n    Out := Start;\n    Shown := Out;\nELSE\n    \
                Out := Out + 1;\n    Shown := Out;\nEND_IF;\n";
    assert_eq!(statements(counter), text);

    let skipped = "LD a\nJMPCN End\nLD 1\nST n\nEnd:\nLD b\nST q";
    assert_eq!(statements(skipped), "IF a THEN\n    n := 1;\nEND_IF;\nq := b;\n");
    assert_eq!(
        statements(&skipped.replace("CN", "C")),
        "IF NOT a THEN\n    n := 1;\nEND_IF;\nq := b;\n"
    );
    // What is in the accumulator after a jump is what decided it.
    let again = "LD a\nJMPC End\nLD 1\nST n\nLD b\nEnd:\nST q";
    assert_eq!(
        statements(again),
        "IF a THEN\n    q := TRUE;\nELSE\n    n := 1;\n    q := b;\nEND_IF;\n"
    );
    let over = "LD a\nJMPC X\nLD b\nJMPC Y\nLD 1\nST n\nX: LD 2\nST n\nY: LD 3\nST n";
    let text = "IF a THEN\n    n := 2;\nELSE\n    IF NOT b THEN\n        n := 1;\n        \
                n := 2;\n    END_IF;\nEND_IF;\nn := 3;\n";
    assert_eq!(statements(over), text);
    // The second jump is decided where the first one is.
    let known = "LD a\nJMPC X\nLD b\nX:\nJMPCN Y\nLD 1\nST n\nY: LD 2\nST m";
    let text = "IF a THEN\n    n := 1;\nELSE\n    IF b THEN\n        n := 1;\n    \
                END_IF;\nEND_IF;\nm := 2;\n";
    assert_eq!(statements(known), text);
    assert_eq!(
        statements("LD a\nS q\nRETC\nLD 1\nST n"),
        "IF a THEN\n    q := TRUE;\n    RETURN;\nEND_IF;\nn := 1;\n"
    );
    // What is after the last RET is never executed.
    let back = "LD a\nRETC\nST q\nLD b\nRETCN\nRET\nLD c\nST p";
    let text = "IF a THEN\n    RETURN;\nEND_IF;\nq := FALSE;\nIF NOT b THEN\n    RETURN;\nEND_IF;\n\
                RETURN;\n";
    assert_eq!(statements(back), text);
}

#[test]
fn actions_and_conditions_are_read() {
    let text = include_str!("projects/plant.xml");
    let action = |list: &str| {
        let body =
            format!("<action name=\"Listed\"><body><IL>{list}</IL></body></action></actions>");
        imported(&text.replacen("</actions>", &body, 1))
    };
    let found = action("LD Level\nST Level");
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    assert!(found.text.text().contains("ACTION Listed:\n    Level := Level;\n"));

    let chart = |list: &str| {
        let to = |id: usize| {
            format!("<connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn>")
        };
        let (one, two) = (to(1), to(2));
        format!(
            "<pou xmlns=\"http://www.plcopen.org/xml/tc6_0201\" name=\"Lamp\" pouType=\"program\">\
             <transitions><transition name=\"Go\"><body><IL>{list}</IL></body></transition>\
             </transitions><body><SFC><step localId=\"1\" name=\"Off\" initialStep=\"true\"/>\
             <transition localId=\"2\">{one}<condition><reference name=\"Go\"/></condition>\
             </transition><jumpStep localId=\"3\" targetName=\"Off\">{two}</jumpStep></SFC></body>\
             </pou>"
        )
    };
    for list in ["LD n\nGT 5\nAND b", "LD n\nGT 5\nAND b\nST go"] {
        let found = imported(&chart(list));
        assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
        let transition = found.charts[0].transitions.values().next().expect("a transition");
        assert_eq!(transition.condition.text, "(n > 5) AND b");
    }
    let told = imported(&chart("LD a\nST b\nLD c")).diagnostics;
    assert!(told[0].message.contains("condition Go is written in IL"), "{told:?}");
    let told = imported(&chart("LD a\nFROM b c")).diagnostics;
    assert!(told[0].message.contains("`b c` is no operand"), "{told:?}");
}

#[test]
fn what_is_not_read_is_told_at_its_line() {
    for (list, message) in [
        ("L:\nLD a\nJMPC L", "E0702 3 `JMPC L` L: a jump backward is not read"),
        ("LD a\nJMPC L", "E0702 2 `JMPC L` there is no label `L`"),
        ("L:\nL:\nLD a\nST b", "E0705 2 `L` label L is there twice"),
        ("LD a\n=> b", "E0702 2 `=> b` `=>` is no operator that is read"),
        ("LD a\nCU Count", "E0702 2 `CU Count` CU: an input of a function block as an operator"),
        ("ADD 1\nST n", "E0702 1 `ADD 1` ADD: what is in the accumulator is not defined"),
        ("CAL T\nST n", "E0702 2 `ST n` ST: what is in the accumulator is not defined"),
        ("LD a + b\nST n", "E0702 1 `LD a + b` `a + b` is no operand that is read"),
        ("LD a+b\nST n", "E0702 1 `LD a+b` `a+b` is no operand that is read"),
        ("LD\nST n", "E0702 1 `LD` LD has no operand"),
        ("LD a\nAND( b\nST n\n)\nST n", "E0702 3 `ST n` ST is inside of a bracket"),
        ("LD a\n)\nST n", "E0702 2 `)` no bracket is open here"),
        ("LD a\nAND( b", "E0702 2 `AND( b` a bracket is not closed before the end or a label"),
        ("LD a\nTurn", "E0702 2 `Turn` nothing asks for the result of this call"),
        ("Pause(IN := a)\nLD b\nST q", "E0702 1 `Pause(IN := a)` nothing asks for the result"),
        ("LD a\n(* b\nST q", "E0702 2 `(* b` "),
        ("CAL\nLD a", "E0702 1 `CAL` `` is no call that is read"),
    ] {
        let told = said(list);
        assert!(told.len() == 1 && told[0].starts_with(message), "{list}: {told:?}");
    }
}

#[test]
fn large_lists_end() {
    let long: String = (0..3_000).map(|_| "ADD n\nMUL 2\n").collect();
    assert!(said(&format!("LD n\n{long}ST n"))[0].contains("too long"));
    // Each jump leads over the label of the one before.
    let over: String = (0..60).map(|n| format!("L{n}: LD a\nJMPC L{}\nADD n\n", n + 2)).collect();
    assert!(!said(&format!("{over}L60: ST n\nL61: ST n")).is_empty());
    let told = said(&"LD a\n".repeat(20_001));
    assert!(told.len() == 1 && told[0].contains("too large"), "{told:?}");
    let told = said(&format!("LD a\nST {}", "b".repeat(10_001)));
    assert!(told.len() == 1 && told[0].contains("too large"), "{told:?}");
    // A comment that is written again and again.
    let comment = format!("(* {} *)\n", "word ".repeat(20_000));
    let told = said(&format!("{over}L60: {comment}ST n\nL61: ST n"));
    assert!(!told.is_empty());
    let many: String = (0..2_000).map(|n| format!("LD a\nJMPC L{n}\nST n\nL{n}: ST q\n")).collect();
    assert!(said(&many).is_empty());
}

#[test]
fn any_list_is_read_or_refused() {
    let mut random = fastrand::Rng::with_seed(11);
    let list =
        "LD a\nJMPC Store\nAND( b\nOR c\n)\nCAL Pause(\n IN := a\n)\nLD d\nStore:\nST q (* é *)\n";
    let snippets = ["(", ")", "(*", "*)", "//", "'", ":", "é", "\n", "[", "JMP Store\n", "L:\n"];
    let (mut good, mut bad) = (0, 0);
    for _ in 0..2_000 {
        let mut text: Vec<char> = list.chars().collect();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(..text.len());
            let end = (at + random.usize(..4)).min(text.len());
            let snippet = snippets[random.usize(..snippets.len())];
            match random.bool() {
                true => drop(text.splice(at..at, snippet.chars())),
                false => drop(text.drain(at..end)),
            }
        }
        let found = imported(&program(&text.into_iter().collect::<String>()));
        assert!(found.text.text().is_empty() != found.diagnostics.is_empty());
        *(if found.diagnostics.is_empty() { &mut good } else { &mut bad }) += 1;
    }
    assert!(good > 100 && bad > 100, "{good} good, {bad} bad");
}
