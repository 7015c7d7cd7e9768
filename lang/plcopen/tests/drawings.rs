//! Drawings in projects, LD and FBD: the statements that become of them, and what is said about
//! those that are not read.

use std::fmt::Write as _;

use diagnostics::Source;
use plcopen::{Imported, read};

/// A project with a drawing, whose elements begin in line 2.
fn imported(elements: &str) -> Imported {
    let text = format!(
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><pous>\
         <pou name=\"Lamp\" pouType=\"program\"><body><FBD>\n{elements}</FBD></body>\
         </pou></pous></types></project>"
    );
    read(&Source::new("lamp.xml", text).expect("a short text"))
}

/// The statements of a drawing.
fn statements(elements: &str) -> String {
    let found = imported(elements);
    assert!(found.diagnostics.is_empty(), "{elements}: {:?}", found.diagnostics);
    let text = found.text.text().strip_prefix("PROGRAM Lamp\n");
    text.and_then(|text| text.strip_suffix("END_PROGRAM\n")).expect("a program").to_owned()
}

/// What is said about a drawing.
fn said(elements: &str) -> Vec<String> {
    imported(elements).diagnostics.into_iter().map(|one| one.message).collect()
}

/// A point that a line comes to from an element, `7`, or from one of its outputs, `7.Q`.
fn point(from: &str) -> String {
    let (id, output) = from.split_once('.').unwrap_or((from, ""));
    format!(
        "<connectionPointIn><connection refLocalId=\"{id}\" formalParameter=\"{output}\"/>\
         </connectionPointIn>"
    )
}

fn variable(id: usize, text: &str) -> String {
    format!("<inVariable localId=\"{id}\"><expression>{text}</expression></inVariable>\n")
}

/// A variable that gets what is at a point.
fn result(id: usize, from: &str) -> String {
    let into = point(from);
    format!("<outVariable localId=\"{id}\">{into}<expression>q</expression></outVariable>\n")
}

/// A block with the points that its inputs get something from. `kind` is its type, with more
/// attributes after a space.
fn block(id: usize, kind: &str, inputs: &[(&str, &str)], outputs: &str) -> String {
    let (kind, more) = kind.split_once(' ').unwrap_or((kind, ""));
    let mut text = format!("<block localId=\"{id}\" typeName=\"{kind}\" {more}><inputVariables>");
    for (name, from) in inputs {
        let (name, more) = name.split_once(' ').unwrap_or((name, ""));
        let into = point(from);
        write!(text, "<variable formalParameter=\"{name}\" {more}>{into}</variable>")
            .expect("a text");
    }
    format!("{text}</inputVariables><outputVariables>{outputs}</outputVariables></block>\n")
}

#[test]
fn functions_that_enable_each_other_end() {
    let moved = |id: usize, enable: &str, from: &str| {
        block(id, "MOVE", &[("EN", enable), ("IN", from)], "")
    };
    // ENO depends on EN alone.
    let one =
        result(1, "2.ENO") + &moved(2, "3.ENO", "2") + &moved(3, "4", "4") + &variable(4, "a");
    assert_eq!(statements(&one), "q := a;\n");
    let circle = "block 2: what it asks for depends on itself";
    for (to, enable) in [("2.ENO", "2.ENO"), ("2", "2.ENO"), ("2.ENO", "2"), ("2.ENO", "3.ENO")] {
        let drawing = result(1, to) + &moved(2, enable, "4") + &moved(3, "2.ENO", "4");
        assert_eq!(said(&(drawing + &variable(4, "a"))), [circle], "{to} {enable}");
    }
    let chain = |count: usize| -> String {
        let mut text = result(1, "2.ENO") + &variable(2 + count, "a");
        for id in 2..2 + count {
            let after = format!("{}{}", id + 1, if id + 1 < 2 + count { ".ENO" } else { "" });
            text += &block(id, "AND", &[("EN", &after), ("IN1", &after), ("IN2", &after)], "");
        }
        text
    };
    assert_eq!(statements(&chain(40)), "q := a;\n");
    let told = said(&chain(10_000));
    assert!(told.len() == 1 && told[0].contains("too large to be read"), "{told:?}");
    // Each of two inputs asks for both of the block before.
    let mut both = result(1, "2") + &variable(42, "a");
    for id in 2..42 {
        let (after, end) = (id + 1, if id < 41 { ".ENO" } else { "" });
        both += &block(
            id,
            "AND",
            &[("EN", &format!("{after}{end}")), ("IN1", &format!("{after}{end}"))],
            "",
        );
    }
    assert_eq!(said(&both), ["block 2: this part of a drawn condition is not read"]);
}

/// An output of a block.
const OUTPUT: &str = "<variable formalParameter=\"Q\"/>";

/// A function block.
fn timer(id: usize, inputs: &[(&str, &str)]) -> String {
    block(id, &format!("TON instanceName=\"T{id}\""), inputs, OUTPUT)
}

#[test]
fn function_blocks_are_called_after_those_that_they_ask_for() {
    let both = |first: &str, second: &str| {
        block(2, "OR", &[("IN1", first), ("IN2", second)], "")
            + &timer(7, &[("IN", "8.Q")])
            + &timer(8, &[])
    };
    for drawing in [both("7.Q", "8.Q"), both("8.Q", "7.Q")] {
        let text = statements(&(result(1, "2") + &drawing));
        assert!(text.starts_with("T8();\nT7(IN := T8.Q);\nq := "), "{text}");
    }
    // Through what both ask for, from a block that comes first in the file.
    let shared = |first: &str, second: &str| {
        let inputs = [("IN", first), ("PT", second)];
        timer(6, &inputs)
            + &block(9, "NOT", &[("IN", "8.Q")], "")
            + &timer(7, &[("IN", "9")])
            + &timer(8, &[])
    };
    let before = "T8();\nT7(IN := NOT (T8.Q));\n";
    for (first, second, last) in [
        ("9", "7.Q", "T6(IN := NOT (T8.Q), PT := T7.Q);\n"),
        ("7.Q", "9", "T6(IN := T7.Q, PT := NOT (T8.Q));\n"),
    ] {
        assert_eq!(statements(&shared(first, second)), format!("{before}{last}"));
    }
    // Two that ask for each other keep what they have from scan to scan.
    let circle = timer(7, &[("IN", "8.Q")]) + &timer(8, &[("IN", "7.Q")]);
    assert_eq!(statements(&circle), "T8(IN := T7.Q);\nT7(IN := T8.Q);\n");
    // EN of a function before a block is no matter of what asks for the block.
    let moved = block(8, "MOVE", &[("EN", "9"), ("IN", "9")], "") + &variable(9, "a");
    let told = said(&(result(1, "7.Q") + &timer(7, &[("IN", "8")]) + &moved));
    assert_eq!(told, ["block 8: this part of a drawn condition is not read"]);
}

#[test]
fn many_function_blocks_in_a_row_are_called_in_order() {
    let count = 3_000;
    let mut drawing = String::new();
    for id in 1..count {
        drawing += &timer(id, &[("IN", &format!("{}.Q", id + 1))]);
    }
    let text = statements(&(drawing + &timer(count, &[])));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), count);
    assert_eq!((lines[0], lines[count - 1]), ("T3000();", "T1(IN := T2.Q);"));
}

#[test]
fn what_is_said_at_inputs_and_outputs_is_kept_or_told() {
    let output = |name: &str, more: &str| format!("<variable formalParameter=\"{name}\" {more}/>");
    let negated = "negated=\"true\"";
    let kind = "SR instanceName=\"Keep\"";
    for (outputs, from, text) in [
        (output("Q", negated), "7.Q", "NOT (Keep.Q)"),
        (output("Q", negated), "7", "NOT (Keep.Q)"),
        (output("P", "") + &output("Q", negated), "7.q", "NOT (Keep.q)"),
        (output("P", negated) + &output("Q", "edge=\"none\""), "7.Q", "Keep.Q"),
        // Of an output that nothing asks for.
        (output("P", "edge=\"rising\"") + &output("Q", ""), "7.Q", "Keep.Q"),
    ] {
        let found = statements(&(result(1, from) + &block(7, kind, &[], &outputs)));
        assert_eq!(found, format!("Keep();\nq := {text};\n"));
    }
    let inputs = [("EN", "8"), ("IN", "9")];
    let operands = variable(8, "a") + &variable(9, "b");
    for (outputs, from, text) in [
        (output("ENO", "") + &output("OUT", negated), "7", "IF a THEN q := NOT (b); END_IF;"),
        (output("ENO", "") + &output("", negated), "7.OUT", "IF a THEN q := NOT (b); END_IF;"),
        (output("ENO", negated) + &output("OUT", ""), "7.ENO", "q := NOT (a);"),
        (output("ENO", negated) + &output("OUT", ""), "7.OUT", "IF a THEN q := b; END_IF;"),
    ] {
        let drawing = result(1, from) + &block(7, "MOVE", &inputs, &outputs) + &operands;
        assert_eq!(statements(&drawing), format!("{text}\n"));
    }
    let unread = ["block 7: this part of a drawn condition is not read"];
    for more in ["edge=\"rising\"", "edge=\"falling\"", "storage=\"set\""] {
        let input = format!("IN {more}");
        for kind in ["NOT", "TON instanceName=\"T\""] {
            let at_input = block(7, kind, &[(&input, "8")], OUTPUT);
            let at_output = block(7, kind, &[("IN", "8")], &output("Q", more));
            for block in [at_input, at_output] {
                assert_eq!(said(&(result(1, "7.Q") + &block + &operands)), unread, "{more}");
            }
        }
    }
}

#[test]
fn expressions_at_variables_stay_whole() {
    let both = block(7, "AND", &[("IN1", "8"), ("IN2", "9")], "");
    let with =
        |text: &str| statements(&(result(1, "7") + &both + &variable(8, text) + &variable(9, "c")));
    for text in ["a", "m[i + 1].n", "%IX0.0", "16#FF", "-1.5E-3", "T#-2s", "'a b'", "D#2026-01-02"]
    {
        assert_eq!(with(text), format!("q := {text} AND c;\n"));
    }
    for text in ["a OR b", "a+b", "NOT a", "f(a)", "(a) OR (b)", "t-T#2s", "T#3s-t", "T#3s-T#2s"] {
        assert_eq!(with(text), format!("q := ({text}) AND c;\n"));
    }
    let alone = result(1, "8") + &variable(8, "a OR b");
    assert_eq!(statements(&alone), "q := a OR b;\n");
    let negated = alone.replace("localId=\"8\"", "localId=\"8\" negated=\"true\"");
    assert_eq!(statements(&negated), "q := NOT (a OR b);\n");
    for (kind, text) in [
        ("NOT", "q := NOT (a OR b);\n"),
        ("TO_INT", "q := TO_INT(a OR b);\n"),
        ("TON instanceName=\"T\"", "T(IN := a OR b);\nq := T.Q;\n"),
    ] {
        let drawing = block(7, kind, &[("IN", "8")], OUTPUT) + &variable(8, "a OR b");
        assert_eq!(statements(&(result(1, "7") + &drawing)), text);
    }
    // What some tools write without a line.
    let written = both.replacen(
        &point("8"),
        "<connectionPointIn><expression>a OR b</expression></connectionPointIn>",
        1,
    );
    let text = statements(&(result(1, "7") + &written + &variable(9, "c")));
    assert_eq!(text, "q := (a OR b) AND c;\n");
    let contact = |id: usize, from: &str, text: &str| {
        let into = point(from);
        format!("<contact localId=\"{id}\">{into}<variable>{text}</variable></contact>\n")
    };
    let row = result(1, "3") + "<leftPowerRail localId=\"5\"/>\n";
    let row = row + &contact(4, "5", "n &gt; 2 OR a") + &contact(3, "4", "b");
    assert_eq!(statements(&row), "q := (n > 2 OR a) AND b;\n");
    // Nothing is no operand.
    let told = said(&(result(1, "7") + &both + &variable(8, "") + &variable(9, "c")));
    assert_eq!(told, ["block 7: this part of a drawn condition is not read"]);
}
