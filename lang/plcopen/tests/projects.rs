//! Projects: what becomes of them, and what is said about those that are wrong.

use diagnostics::Source;
use fastrand::Rng;
use plcopen::{Imported, is_project, read};

const PLANT: &str = include_str!("projects/plant.xml");

fn source(text: &str) -> Source {
    Source::new("plant.xml", text).expect("a short text")
}

fn imported(text: &str) -> Imported {
    read(&source(text))
}

/// What is said, each with the line and the text at its place.
fn said(text: &str) -> Vec<String> {
    let source = source(text);
    let all = read(&source).diagnostics.into_iter().map(|one| {
        let line = source.position(one.span.start as usize).0;
        format!("{} {line} `{}` {}", one.code.text(), one.span.text(text), one.message)
    });
    all.collect()
}

/// A project with this body of a program, and what is in the program before it.
fn program(before: &str, body: &str) -> String {
    format!(
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\"><types><pous>\n\
         <pou name=\"Lamp\" pouType=\"program\">{before}<body>{body}</body></pou>\n\
         </pous></types></project>"
    )
}

/// A chart of two steps, with the condition of the way back.
fn chart(condition: &str, more: &str) -> String {
    let into = |id: &str| {
        format!("<connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn>")
    };
    program(
        "",
        &format!(
            "<SFC>\n<step localId=\"1\" name=\"Off\" initialStep=\"true\"/>\n\
         <transition localId=\"2\">{}<condition><inline name=\"\"><ST>a</ST></inline>\
         </condition></transition>\n\
         <step localId=\"3\" name=\"On\">{}</step>\n\
         <transition localId=\"4\">{}<condition>{condition}</condition></transition>\n\
         <jumpStep localId=\"5\" targetName=\"Off\">{}</jumpStep>\n{more}</SFC>",
            into("1"),
            into("2"),
            into("3"),
            into("4"),
        ),
    )
}

/// The condition of the way back in a chart.
fn condition(condition: &str, more: &str) -> String {
    let found = imported(&chart(condition, more));
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    let last = found.charts[0].transitions.values().last().expect("a transition");
    last.condition.text.clone()
}

#[test]
fn a_project_becomes_a_text() {
    let found = imported(PLANT);
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    assert_eq!(found.text.text(), include_str!("projects/plant.sfc"));
    let text = found.text.text();
    let reading = chart::text::read(&Source::new("plant.sfc", text).expect("a short text"));
    assert!(reading.diagnostics.is_empty(), "{:?}", reading.diagnostics);
    // What is in the text is where it was read in the file.
    for word in ["Level > 5", "Twice := Value", "FillB", "T#2s", "ARRAY"] {
        let start = text.find(word).expect(word);
        let place = found.text.place(diagnostics::Span::new(start, start + word.len()));
        let there = place.text(PLANT);
        let is_there = there == word || word == "ARRAY" && there == "array";
        assert!(is_there || there.contains("FillB"), "{word}: {there}");
    }
}

#[test]
fn namespaces_of_all_versions_and_none_are_read() {
    for other in ["tc6_0200", "tc6.xsd", "tc6_0101"] {
        assert!(imported(&PLANT.replace("tc6_0201", other)).diagnostics.is_empty(), "{other}");
    }
    let bare = PLANT.replace(" xmlns=\"http://www.plcopen.org/xml/tc6_0201\"", "");
    assert!(imported(&bare).diagnostics.is_empty());
    let prefixed = "<ppx:pou xmlns:ppx=\"http://www.plcopen.org/xml/tc6_0201\" name=\"F\" \
                    pouType=\"functionBlock\"><ppx:body><ppx:ST/></ppx:body></ppx:pou>";
    assert_eq!(imported(prefixed).text.text(), "FUNCTION_BLOCK F\n\nEND_FUNCTION_BLOCK\n");
}

#[test]
fn files_are_told_apart_by_what_is_in_them() {
    assert!(is_project(&source(PLANT)));
    assert!(is_project(&source("<TcPlcObject/>")));
    assert!(!is_project(&source("<project><grafcet name=\"G\"/></project>")));
    assert!(!is_project(&source("<project")));
}

#[test]
fn conditions_are_texts_names_and_drawings() {
    let inline = |text: &str| format!("<inline name=\"\"><ST><p>{text}</p></ST></inline>");
    assert_eq!(condition(&inline("a &lt; 5"), ""), "a < 5");
    assert_eq!(condition(&inline(":= a AND b;"), ""), "a AND b");
    assert_eq!(condition("<reference name=\"Full\"/>", ""), "Full");
    let line = "<connectionPointIn><connection refLocalId=\"9\"/></connectionPointIn>";
    let variable = |id: u32, name: &str| {
        format!(
            "<inVariable localId=\"{id}\" negated=\"{}\"><expression>{name}</expression></inVariable>",
            id == 8
        )
    };
    assert_eq!(condition(line, &variable(9, "Full")), "Full");
    let input = |id: u32| {
        format!(
            "<variable formalParameter=\"\"><connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn></variable>"
        )
    };
    let block = format!(
        "<block localId=\"9\" typeName=\"GE\"><inputVariables>{}{}</inputVariables></block>{}{}",
        input(7),
        input(8),
        variable(7, "x"),
        variable(8, "y"),
    );
    assert_eq!(condition(line, &block), "x >= NOT (y)");
}

#[test]
fn a_macro_step_is_replaced_by_what_is_in_it() {
    let inner = "<macroStep localId=\"7\" name=\"Wash\"><connectionPointIn>\
        <connection refLocalId=\"2\"/></connectionPointIn><body><SFC>\
        <step localId=\"1\" name=\"Soak\"/><transition localId=\"2\">\
        <connectionPointIn><connection refLocalId=\"1\"/></connectionPointIn><condition>\
        <reference name=\"b\"/></condition></transition><step localId=\"3\" name=\"Off\">\
        <connectionPointIn><connection refLocalId=\"2\"/></connectionPointIn></step></SFC></body>\
        </macroStep>";
    let text = chart("<reference name=\"c\"/>", inner)
        .replace(
            "<step localId=\"3\" name=\"On\"><connectionPointIn><connection refLocalId=\"2\"/>\
             </connectionPointIn></step>",
            "",
        )
        .replace("refLocalId=\"3\"", "refLocalId=\"7\"");
    let found = imported(&text);
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    let chart = &found.charts[0];
    let mut ways: Vec<String> =
        chart.transitions.values().map(|one| chart.transition_title(one)).collect();
    ways.sort();
    assert_eq!(ways, ["Off_to_Soak", "Soak_to_Wash_Off", "Wash_Off_to_Off"]);
}

#[test]
fn wrong_projects_are_told_with_their_places() {
    let on = |wrong: &str| said(&chart("<reference name=\"b\"/>", wrong));
    let none = Vec::<String>::new();
    assert_eq!(on(""), none);
    assert_eq!(
        on("<step localId=\"3\" name=\"Other\"/>"),
        ["E0705 8 `3` localId 3 is there twice"]
    );
    assert_eq!(
        on("<step localId=\"8\" name=\"ON\"/>"),
        ["E0705 8 `ON` ON: a step of this name is there already"]
    );
    assert_eq!(
        on("<step localId=\"8\" name=\"Two\" initialStep=\"true\"/>"),
        ["E0706 8 `Two` Two: a second initial step of Lamp"]
    );
    let to = |id: u32, kind: &str| {
        format!(
            "<{kind} localId=\"8\" name=\"N\"><connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn></{kind}>"
        )
    };
    assert_eq!(on(&to(77, "step")), ["E0704 8 `77` step N: there is no element 77"]);
    assert_eq!(on(&to(3, "step")), ["E0706 8 `3` step N comes after step On"]);
    assert_eq!(on(&to(3, "actionBlock")), none);
    assert_eq!(on(&to(2, "actionBlock")), ["E0706 8 `2` actionBlock N belongs to no step"]);
    // Lines in a circle end.
    let circle = "<selectionConvergence localId=\"8\"><connectionPointIn>\
        <connection refLocalId=\"8\"/></connectionPointIn></selectionConvergence>\
        <step localId=\"9\" name=\"N\"><connectionPointIn>\
        <connection refLocalId=\"8\"/></connectionPointIn></step>";
    assert_eq!(on(circle), none);
    let added = "<addData><data name=\"vendor\" handleUnknown=\"discard\"><x/></data></addData>";
    let text = program(added, "<ST/>").replace("</pous>", &format!("{added}</pous>"));
    assert_eq!(said(&text), ["W0700 3 `data` vendor: what a vendor has added is left out"]);
}

/// A block of a drawn condition, with its inputs from these elements.
fn drawn_block(id: usize, kind: &str, from: &[usize]) -> String {
    let inputs = from.iter().map(|from| {
        format!(
            "<variable formalParameter=\"IN\"><connectionPointIn>\
             <connection refLocalId=\"{from}\"/></connectionPointIn></variable>"
        )
    });
    let inputs: String = inputs.collect();
    format!(
        "<block localId=\"{id}\" typeName=\"{kind}\"><inputVariables>{inputs}</inputVariables></block>\n"
    )
}

const FROM_10: &str = "<connectionPointIn><connection refLocalId=\"10\"/></connectionPointIn>";

#[test]
fn a_condition_with_feedback_is_told_once_at_its_place() {
    let variable = "<inVariable localId=\"20\"><expression>x</expression></inVariable>\n";
    // 10 asks for 11 three times, which asks for 12, which asks for 10 again.
    let circle = drawn_block(10, "AND", &[20, 11, 11, 11])
        + &drawn_block(11, "OR", &[12, 12, 20])
        + &drawn_block(12, "NOT", &[10]);
    let told = said(&chart(FROM_10, &(circle + variable)));
    assert_eq!(told, ["E0702 8 `block` block 10: what it asks for depends on itself"]);
    // What is broken is told where it is, and nothing else.
    let broken = drawn_block(10, "AND", &[20, 11, 11]) + &drawn_block(11, "NOT", &[77]) + variable;
    let told = said(&chart(FROM_10, &broken));
    assert_eq!(told, ["E0704 9 `77` block 11: there is no element 77"]);
    let unread = drawn_block(10, "AND", &[20, 11, 11]) + &drawn_block(11, "SEL", &[]) + variable;
    let told = said(&chart(FROM_10, &unread));
    assert_eq!(told, ["E0702 9 `block` block 11: this part of a drawn condition is not read"]);
}

#[test]
fn functions_and_connectors_of_a_drawn_condition_are_read() {
    let more = drawn_block(10, "AND", &[11, 13])
        + &drawn_block(11, "SEL", &[20, 21, 12])
        + &drawn_block(12, "MOVE", &[3])
        + "<continuation localId=\"13\" name=\"Far\"/>\n<connector localId=\"14\" name=\"far\">\
           <connectionPointIn><connection refLocalId=\"21\"/></connectionPointIn></connector>\n"
        + "<inVariable localId=\"20\"><expression>x</expression></inVariable>\n"
        + "<inVariable localId=\"21\"><expression>y</expression></inVariable>\n";
    assert_eq!(condition(FROM_10, &more), "SEL(x, y, On.X) AND y");
}

#[test]
fn function_blocks_of_a_drawn_condition_are_called_while_the_step_is_active() {
    let block = |id: usize, kind: &str, inputs: &[(&str, usize, &str)]| {
        let inputs = inputs.iter().map(|(name, from, output)| {
            format!(
                "<variable formalParameter=\"{name}\"><connectionPointIn><connection \
                 refLocalId=\"{from}\" formalParameter=\"{output}\"/></connectionPointIn>\
                 </variable>"
            )
        });
        let inputs: String = inputs.collect();
        format!(
            "<block localId=\"{id}\" typeName=\"{kind}\" instanceName=\"{kind}{id}\">\
             <inputVariables>{inputs}</inputVariables><outputVariables>\
             <variable formalParameter=\"Q\"/></outputVariables></block>\n"
        )
    };
    // The timer is reset by what it sets: function blocks keep that from scan to scan.
    let more = block(10, "TON", &[("IN", 11, "Q1"), ("PT", 20, "")])
        + &block(11, "SR", &[("S1", 12, ""), ("R", 10, "Q")])
        + &drawn_block(12, "NOT", &[21])
        + "<inVariable localId=\"20\"><expression>T#2s</expression></inVariable>\n"
        + "<inVariable localId=\"21\"><expression>x</expression></inVariable>\n";
    let found = imported(&chart(FROM_10, &more));
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    let text = found.text.text();
    assert!(text.contains("STEP On:\n    On_blocks;\n"), "{text}");
    assert!(text.contains(":= TON10.Q;"), "{text}");
    let calls = "    SR11(S1 := NOT (x), R := TON10.Q);\n    TON10(IN := SR11.Q1, PT := T#2s);\n";
    assert!(text.contains(calls), "{text}");
    let shared = more.replace(
        "<inputVariables>",
        "<inOutVariables><variable formalParameter=\"V\">\
        <connectionPointIn/></variable></inOutVariables><inputVariables>",
    );
    assert!(said(&chart(FROM_10, &shared))[0].contains("is not read"));
}

#[test]
fn conditions_with_a_drawing_of_their_own_are_read() {
    let rung = |variable: &str, more: &str| {
        format!(
            "<transitions><transition name=\"Full\"><body><LD><leftPowerRail localId=\"1\"/>\
             <contact localId=\"2\"><connectionPointIn><connection refLocalId=\"1\"/>\
             </connectionPointIn><variable>x</variable></contact>\
             <coil localId=\"3\" {more}><connectionPointIn><connection refLocalId=\"2\"/>\
             </connectionPointIn><variable>{variable}</variable></coil></LD></body></transition>\
             </transitions>"
        )
    };
    let with = |transitions: &str| {
        chart("<reference name=\"Full\"/>", "").replacen(
            "<body>",
            &format!("{transitions}<body>"),
            1,
        )
    };
    for (more, text) in [("", ":= x;"), ("negated=\"true\"", ":= NOT (x);")] {
        let found = imported(&with(&rung("full", more)));
        assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
        assert!(found.text.text().contains(text), "{}", found.text.text());
    }
    let diagram = rung("Full", "").replace("LD>", "FBD>").replace("coil", "outVariable");
    let diagram = diagram.replace("<variable>Full</variable>", "<expression>Full</expression>");
    assert!(imported(&with(&diagram)).diagnostics.is_empty());
    for other in [rung("y", ""), rung("Full", "storage=\"set\"")] {
        assert_eq!(
            said(&with(&other)),
            ["E0702 2 `LD` condition Full is written in LD, which is not read"]
        );
    }
}

/// A rung: contacts one after the other, then a coil.
fn rung(id: usize, contacts: &[&str], coil: &str) -> String {
    let mut text = format!("<leftPowerRail localId=\"{id}\"/>\n");
    let from = |id: usize| {
        format!("<connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn>")
    };
    for (at, contact) in contacts.iter().enumerate() {
        let into = from(id + at);
        let here = id + at + 1;
        text += &format!(
            "<contact localId=\"{here}\">{into}<variable>{contact}</variable></contact>\n"
        );
    }
    let last = id + contacts.len();
    let here = last + 1;
    let (name, more) = coil.split_once(' ').unwrap_or((coil, ""));
    text += &format!(
        "<coil localId=\"{here}\" {more}><position x=\"90\" y=\"{id}\"/>{}\
         <variable>{name}</variable></coil>\n",
        from(last)
    );
    text
}

#[test]
fn diagrams_become_statements() {
    // The lower rung comes first in the file, and is executed last.
    let rungs = rung(50, &["b"], "q storage=\"set\"")
        + &rung(10, &["a", "b"], "p")
        + &rung(30, &[], "r negated=\"true\"");
    let found = imported(&program("", &format!("<LD>{rungs}</LD>")));
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    let lines = "p := (a AND b);\nr := NOT (TRUE);\nIF b THEN q := TRUE; END_IF;\n";
    assert!(
        found.text.text().contains(&lines.replace("(a AND b)", "a AND b")),
        "{}",
        found.text.text()
    );

    // A function block is called before what asks for it, once.
    let block = "<block localId=\"80\" typeName=\"TON\" instanceName=\"Pause\"><inputVariables>\
        <variable formalParameter=\"IN\"><connectionPointIn><connection refLocalId=\"81\"/>\
        </connectionPointIn></variable><variable formalParameter=\"PT\"><connectionPointIn>\
        <expression>T#2s</expression></connectionPointIn></variable></inputVariables>\
        <outputVariables><variable formalParameter=\"Q\"/></outputVariables></block>\n\
        <inVariable localId=\"81\"><expression>a</expression></inVariable>\n";
    let out = |id: usize, name: &str| {
        format!(
            "<outVariable localId=\"{id}\"><connectionPointIn><connection refLocalId=\"80\" \
             formalParameter=\"Q\"/></connectionPointIn><expression>{name}</expression>\
             </outVariable>\n"
        )
    };
    let diagram = format!("<FBD>{}{}{block}</FBD>", out(1, "p"), out(2, "q"));
    let lines = "Pause(IN := a, PT := T#2s);\np := Pause.Q;\nq := Pause.Q;\n";
    let found = imported(&program("", &diagram));
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    assert!(found.text.text().contains(lines), "{}", found.text.text());
    // The same as an action of a chart.
    let action =
        format!("<actions><action name=\"b\"><body>{diagram}</body></action></actions><body>");
    let text = chart("<reference name=\"b\"/>", "").replacen("<body>", &action, 1);
    let found = imported(&text);
    assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
    let indented = "ACTION b:\n    Pause(IN := a, PT := T#2s);\n";
    assert!(found.text.text().contains(indented), "{}", found.text.text());

    // A function that is enabled by what is before it, and gives that on.
    let moved = "<block localId=\"70\" typeName=\"MOVE\"><inputVariables>\
        <variable formalParameter=\"EN\"><connectionPointIn><connection refLocalId=\"71\"/>\
        </connectionPointIn></variable><variable formalParameter=\"IN\"><connectionPointIn>\
        <connection refLocalId=\"72\"/></connectionPointIn></variable></inputVariables></block>\n\
        <inVariable localId=\"71\"><expression>a</expression></inVariable>\n\
        <inVariable localId=\"72\"><expression>5</expression></inVariable>\n";
    let asks = |output: &str| out(1, "n").replace("\"80\"", "\"70\"").replace("\"Q\"", output);
    for (output, line) in [("\"OUT\"", "IF a THEN n := 5; END_IF;\n"), ("\"ENO\"", "n := a;\n")] {
        let found = imported(&program("", &format!("<LD>{}{moved}</LD>", asks(output))));
        assert!(found.diagnostics.is_empty(), "{:?}", found.diagnostics);
        assert!(found.text.text().contains(line), "{}", found.text.text());
    }
    let deep = rung(20, &[], "p").replace("refLocalId=\"20\"", "refLocalId=\"73\"")
        + &drawn_block(73, "NOT", &[70]);

    for (wrong, message) in [
        (deep + moved, "block 70: this part of a drawn condition is not read"),
        (rung(1, &[], "p edge=\"rising\""), "coil 2: this part of a diagram is not read"),
        ("<jump localId=\"1\" label=\"End\"/>".to_owned(), "jump 1: this part of a diagram"),
        (out(1, "p"), "outVariable 1: there is no element 80"),
        (
            "<coil localId=\"1\"><variable>p</variable></coil>".to_owned(),
            "coil 1: this part of a diagram is not read",
        ),
    ] {
        let told = said(&program("", &format!("<LD>{wrong}</LD>")));
        assert!(told.len() == 1 && told[0].contains(message), "{told:?}");
    }
}

#[test]
fn variables_with_a_line_from_a_step_are_actions() {
    let variable = |more: &str, into: &str| {
        format!(
            "<outVariable localId=\"9\" {more}>{into}<expression>Lamp</expression></outVariable>\n"
        )
    };
    let from = |id: usize| {
        format!("<connectionPointIn><connection refLocalId=\"{id}\"/></connectionPointIn>")
    };
    let found = imported(&chart("<reference name=\"b\"/>", &variable("", &from(3))));
    assert!(found.text.text().contains("STEP On:\n    Lamp;\n"), "{}", found.text.text());
    let left = said(&chart("<reference name=\"b\"/>", &variable("", "")));
    assert_eq!(left, ["W0700 8 `outVariable` outVariable 9: no line leads to it, it is left out"]);
    for wrong in [variable("negated=\"true\"", &from(3)), variable("", &from(2))] {
        let told = said(&chart("<reference name=\"b\"/>", &wrong));
        assert_eq!(told, ["E0702 8 `outVariable` outVariable 9: no action of a step"]);
    }
}

#[test]
fn a_transition_that_is_joined_with_nothing_is_left_out() {
    let loose = "<transition localId=\"9\"><connectionPointIn/><condition><reference name=\"c\"/>\
        </condition></transition>";
    let told = said(&chart("<reference name=\"b\"/>", loose));
    assert_eq!(
        told,
        ["W0700 8 `transition` transition 9: it is joined with nothing, and left out"]
    );
    let jump = "<jumpStep localId=\"10\" targetName=\"Off\"><connectionPointIn>\
        <connection refLocalId=\"9\"/></connectionPointIn></jumpStep>";
    let told = said(&chart("<reference name=\"b\"/>", &format!("{loose}{jump}")));
    assert_eq!(told, ["E0706 8 `transition` transition 9: no step is before it"]);
}

#[test]
fn comments_are_those_of_the_nearest_step_however_far() {
    let at = |x: &str, y: &str| format!("<position x=\"{x}\" y=\"{y}\"/>");
    let comment = format!(
        "<comment localId=\"9\">{}<content>far away</content></comment>\n",
        at("-3e9", "-3e9")
    );
    let text = chart("<reference name=\"b\"/>", &comment)
        .replace(
            "initialStep=\"true\"/>",
            &format!("initialStep=\"true\">{}</step>", at("3e9", "3e9")),
        )
        .replace("name=\"On\">", &format!("name=\"On\">{}", at("3e9", "2e9")));
    let chart = &imported(&text).charts[0];
    let near = chart.steps.values().find(|step| step.comment == "far away");
    assert_eq!(near.map(|step| step.name.as_str()), Some("On"));
}

#[test]
fn lines_that_meet_again_and_again_end() {
    let variable = "<inVariable localId=\"50\"><expression>x</expression></inVariable>\n";
    let ladder = |count: usize| -> String {
        (10..10 + count).map(|id| drawn_block(id, "XOR", &[id + 1, id + 1])).collect()
    };
    let last = drawn_block(13, "OR", &[50, 50]);
    let text = chart(FROM_10, &format!("{}{last}{variable}", ladder(3)));
    assert_eq!(said(&text), [""; 0]);
    let told = said(&chart(FROM_10, &format!("{}{variable}", ladder(40))));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("too large to be read"), "{told:?}");
}

#[test]
fn large_and_deep_files_are_refused() {
    let codes = |text: &str| -> Vec<&str> {
        imported(text).diagnostics.iter().map(|one| one.code.text()).collect()
    };
    assert_eq!(codes(&" ".repeat(50_000_000)), ["E0700"]);
    let laughs = "<!DOCTYPE p [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">\
        <!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;\">\
        <!ENTITY d \"&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;\">\
        <!ENTITY e \"&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;\">\
        <!ENTITY f \"&e;&e;&e;&e;&e;&e;&e;&e;&e;&e;\">\
        ]><project>&f;</project>";
    assert!(!codes(laughs).is_empty());
    let nested = |open: &str, close: &str, inside: &str| {
        format!("{}{inside}{}", open.repeat(10_000), close.repeat(10_000))
    };
    // Whatever is read of it, it ends, and something is said.
    let array = nested("<array><baseType>", "</baseType></array>", "<INT/>");
    let types = format!(
        "<project><types><dataTypes><dataType name=\"T\"><baseType>{array}</baseType></dataType></dataTypes></types></project>"
    );
    assert!(!codes(&types).is_empty());
    let steps =
        nested("<macroStep localId=\"1\" name=\"M\"><body><SFC>", "</SFC></body></macroStep>", "");
    assert!(!codes(&program("", &format!("<SFC>{steps}</SFC>"))).is_empty());
}

#[test]
fn any_text_is_read_or_refused() {
    let mut random = Rng::with_seed(7);
    let snippets = [
        "<step ",
        "</SFC>",
        "localId=\"1\"",
        "&lt;",
        "]]>",
        "<!--",
        "\"",
        "<macroStep>",
        "é",
        "END_VAR",
    ];
    let (mut good, mut bad) = (0, 0);
    for _ in 0..1_500 {
        let mut text: Vec<char> = PLANT.chars().collect();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(..text.len());
            match random.u8(..4) {
                0 => {
                    let end = (at + random.usize(..60)).min(text.len());
                    text.drain(at..end);
                }
                1 => text[at] = random.char(' '..='~'),
                2 => {
                    let snippet = snippets[random.usize(..snippets.len())];
                    text.splice(at..at, snippet.chars());
                }
                _ => {
                    let digit = text.iter().enumerate().skip(at).find(|(_, c)| c.is_ascii_digit());
                    if let Some((at, _)) = digit {
                        text[at] = random.char('0'..='9');
                    }
                }
            }
        }
        let text: String = text.into_iter().collect();
        let found = imported(&text);
        match found.text.text().is_empty() {
            true => {
                assert!(!found.diagnostics.is_empty());
                bad += 1;
            }
            false => {
                let written = Source::new("p.sfc", found.text.text()).expect("a short text");
                for one in chart::text::read(&written).diagnostics {
                    assert!(found.text.place(one.span).end as usize <= text.len());
                }
                good += 1;
            }
        }
    }
    assert!(good > 100 && bad > 100, "{good} good, {bad} bad");
}
