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
