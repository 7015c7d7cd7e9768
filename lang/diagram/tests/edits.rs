//! Changes of diagrams: what becomes of the text, what is refused, and that random changes leave
//! what they should.

use std::collections::BTreeSet;

use diagnostics::Source;
use diagram::drawing::{Sheet, draw};
use diagram::edit::{Edit, Edited, copy, edit};
use diagram::interfaces::Interfaces;
use fastrand::Rng;
use picture::Point;

const LOOP: &str = "\
// A loop.
PROGRAM Main
VAR
    Setpoint : REAL; // in V
    Loop : PID := (KP := 4.0, TS := T#50ms); // the controller
    Capacitor : LAG := (T1 := T#1s);
END_VAR
{at 360 40} Loop(SP := Setpoint, PV := {feedback} Capacitor.Y);
{at 640 40} Capacitor(X := Loop.U); // what is controlled
END_PROGRAM
";

fn changed(text: &str, one: &Edit) -> Result<Edited, String> {
    let source = Source::new("d.fbd", text).expect("a short text");
    edit(&source, 0, one, &Interfaces::default()).map_err(|refusal| refusal.to_string())
}

fn text_after(text: &str, one: &Edit) -> String {
    changed(text, one).expect("the change is possible").text
}

fn give(element: &str, input: &str, value: &str) -> Edit {
    let [element, input, value] = [element, input, value].map(str::to_owned);
    Edit::Give { element, input, value }
}

fn set(element: &str, parameter: &str, value: &str) -> Edit {
    let [element, parameter, value] = [element, parameter, value].map(str::to_owned);
    Edit::Set { element, parameter, value }
}

fn call(block: &str) -> Edit {
    Edit::Call { block: block.to_owned(), at: Point::new(100, 200) }
}

fn write(statement: &str) -> Edit {
    Edit::Write { statement: statement.to_owned(), at: Point::new(0, 0) }
}

fn remove(elements: &[&str]) -> Edit {
    Edit::Remove { elements: elements.iter().map(|one| (*one).to_owned()).collect() }
}

fn move_by(element: &str, x: i32, y: i32) -> Edit {
    Edit::Move { elements: vec![element.to_owned()], by: Point::new(x, y) }
}

/// The lines of a text that are not in another one, and those that are there alone.
fn differences<'t>(before: &'t str, after: &'t str) -> (Vec<&'t str>, Vec<&'t str>) {
    let only = |one: &'t str, other: &str| {
        let known: Vec<&str> = other.lines().collect();
        one.lines().filter(|line| !known.contains(line)).map(str::trim).collect()
    };
    (only(before, after), only(after, before))
}

fn sheet(text: &str) -> Sheet {
    let source = Source::new("d.fbd", text).expect("a short text");
    let read = diagram::read(&source);
    assert!(read.of_st.is_empty(), "{text}\n{:?}", read.of_st);
    draw(&source, &read.file, &Interfaces::default()).expect("a small diagram").sheets.remove(0)
}

#[test]
fn a_move_changes_a_place() {
    let after = text_after(LOOP, &move_by("LOOP", 20, -40));
    let new = "{at 380 0} Loop(SP := Setpoint, PV := {feedback} Capacitor.Y);";
    assert_eq!(differences(LOOP, &after).1, [new]);
    assert_eq!(text_after(&after, &move_by("LOOP", -20, 40)), LOOP);
}

#[test]
fn the_first_move_writes_all_places_down() {
    let bare = LOOP.replace("{at 360 40} ", "").replace("{at 640 40} ", "");
    let before = sheet(&bare);
    let after = sheet(&text_after(&bare, &move_by("LOOP", 0, 100)));
    let distance = |sheet: &Sheet| {
        let [a, b] = [&sheet.elements[0], &sheet.elements[1]].map(|one| one.frame);
        (b.x - a.x, b.y - a.y)
    };
    let (x, y) = distance(&before);
    assert_eq!((distance(&after), after.is_placed), ((x, y - 100), true));
}

#[test]
fn a_block_is_declared_and_called() {
    let Edited { text, new } = changed(LOOP, &call("rate_limit")).expect("a block");
    assert_eq!(new, ["Rate_limit1"]);
    let (gone, new) = differences(LOOP, &text);
    assert_eq!(gone, [""; 0]);
    assert_eq!(new[0], "Rate_limit1 : RATE_LIMIT;");
    assert!(new[1].starts_with("{at ") && new[1].ends_with("} Rate_limit1();"), "{new:?}");
    let drawn = sheet(&text);
    let corner = |at: usize| (drawn.elements[at].frame.x, drawn.elements[at].frame.y);
    let was = sheet(LOOP).elements[0].frame;
    // It is where it was put, seen from the others, as near as the grid allows.
    let (x, y) = (corner(2).0 - corner(0).0, corner(2).1 - corner(0).1);
    assert!((x - (100 - was.x)).abs() <= 10 && (y - (200 - was.y)).abs() <= 10, "{x} {y}");
    assert!((x - 360) % 20 == 0 && (y - 40) % 20 == 0, "{x} {y}");
    assert!(text_after(&text, &call("RATE_LIMIT")).contains("Rate_limit2 : RATE_LIMIT;"));
}

#[test]
fn the_first_element_of_a_diagram() {
    for text in [
        "PROGRAM Main\nEND_PROGRAM\n",
        "PROGRAM Main VAR END_VAR END_PROGRAM",
        "PROGRAM Main\nEND_PROGRAM;",
        "",
        "//# name loop",
    ] {
        let after = text_after(text, &call("PID"));
        let drawn = sheet(&after);
        assert_eq!(drawn.elements[0].full_name, "Pid1", "{after}");
        let after = text_after(&after, &write("%Q0.0 := Pid1.SAT;"));
        assert_eq!(sheet(&after).elements.len(), 2, "{after}");
    }
}

#[test]
fn inputs_get_values() {
    let cases = [
        (give("LOOP", "SP", "2.5"), "Loop(SP := 2.5, PV := {feedback} Capacitor.Y);"),
        (give("LOOP", "pv", "Setpoint"), "Loop(SP := Setpoint, PV := Setpoint);"),
        (give("LOOP", "PV", ""), "Loop(SP := Setpoint);"),
        (give("LOOP", "SP", ""), "Loop(PV := {feedback} Capacitor.Y);"),
        (
            give("LOOP", "EN", "TRUE"),
            "Loop(SP := Setpoint, PV := {feedback} Capacitor.Y, EN := TRUE);",
        ),
    ];
    for (one, wanted) in cases {
        let after = text_after(LOOP, &one);
        assert_eq!(differences(LOOP, &after).1, [format!("{{at 360 40}} {wanted}")], "{one:?}");
    }
    let empty = text_after(LOOP, &give("CAPACITOR", "X", ""));
    assert!(empty.contains("{at 640 40} Capacitor(); // what is controlled"), "{empty}");
    assert_eq!(text_after(&empty, &give("CAPACITOR", "X", "Loop.U")), LOOP);
}

#[test]
fn a_link_back_is_a_feedback() {
    let text = text_after(LOOP, &give("LOOP", "PV", ""));
    assert_eq!(
        text_after(&text, &give("LOOP", "PV", "Capacitor.Y")),
        LOOP,
        "the loop is opened where it was closed"
    );
    let of_itself = text_after(LOOP, &give("CAPACITOR", "X", "Capacitor.Y"));
    assert!(of_itself.contains("Capacitor(X := {feedback} Capacitor.Y)"), "{of_itself}");
}

#[test]
fn assignments_get_values() {
    let text = text_after(LOOP, &write("%Q0.0 := Loop.SAT"));
    let after = text_after(&text, &give("%Q0.0", "", "TRUE"));
    assert!(after.contains(" %Q0.0 := TRUE;"), "{after}");
    assert!(changed(&text, &give("%Q0.0", "", " ")).is_err());
}

#[test]
fn parameters_are_declared() {
    let cases = [
        (set("LOOP", "KP", "5.0"), "Loop : PID := (KP := 5.0, TS := T#50ms); // the controller"),
        (set("LOOP", "KP", ""), "Loop : PID := (TS := T#50ms); // the controller"),
        (set("LOOP", "TS", ""), "Loop : PID := (KP := 4.0); // the controller"),
        (
            set("LOOP", "KI", "1.0"),
            "Loop : PID := (KP := 4.0, TS := T#50ms, KI := 1.0); // the controller",
        ),
        (set("CAPACITOR", "T1", ""), "Capacitor : LAG;"),
    ];
    for (one, wanted) in cases {
        assert_eq!(differences(LOOP, &text_after(LOOP, &one)).1, [wanted], "{one:?}");
    }
    let bare = text_after(LOOP, &set("CAPACITOR", "T1", ""));
    assert_eq!(text_after(&bare, &set("CAPACITOR", "T1", "T#1s")), LOOP);
}

#[test]
fn elements_are_taken_out_with_what_is_theirs() {
    let after = text_after(LOOP, &remove(&["LOOP"]));
    let (gone, new) = differences(LOOP, &after);
    assert_eq!(gone.len(), 3, "{after}");
    assert_eq!(new, ["{at 640 40} Capacitor(); // what is controlled"]);
    assert!(after.contains("Setpoint : REAL"), "a variable stays");
    let none = text_after(LOOP, &remove(&["LOOP", "CAPACITOR"]));
    assert!(!none.contains("PID") && !none.contains("LAG"), "{none}");
    // An instance of several that are declared together, and one that somebody reads.
    let text =
        "PROGRAM Main VAR A, B : BLINK; X : BOOL; END_VAR\nA(); B();\nX := A.Q;\nEND_PROGRAM";
    let after = text_after(text, &remove(&["B"]));
    assert!(after.contains("VAR A : BLINK;") && after.contains("A(); \nX"), "{after}");
    let refusal = changed(text, &remove(&["A"])).expect_err("X needs it");
    assert_eq!(refusal, "X needs A.Q: change that first");
    text_after(text, &remove(&["A", "X"]));
    let after = text_after(text, &remove(&["A", "B", "X"]));
    assert!(!after.contains("BLINK") && after.contains("X : BOOL;"), "{after}");
    let text = "PROGRAM Main VAR A, B, C : BLINK; END_VAR\nA(); B(); C();\nEND_PROGRAM";
    assert!(text_after(text, &remove(&["A", "B"])).contains("VAR C : BLINK;"));
    assert!(text_after(text, &remove(&["B", "C"])).contains("VAR A : BLINK;"));
}

fn group(elements: &[&str], name: &str) -> Edit {
    let elements = elements.iter().map(|one| (*one).to_owned()).collect();
    Edit::Group { elements, name: name.to_owned() }
}

/// Of each group its name and its elements.
fn groups(text: &str) -> Vec<(String, Vec<usize>)> {
    sheet(text).groups.into_iter().map(|one| (one.name, one.elements)).collect()
}

#[test]
fn elements_are_in_groups() {
    let both = text_after(LOOP, &group(&["CAPACITOR", "LOOP"], " Control & plant "));
    let (_, new) = differences(LOOP, &both);
    let wanted = [
        "{group \"Control & plant\"} {at 360 40} Loop(SP := Setpoint, PV := {feedback} Capacitor.Y);",
        "{group \"Control & plant\"} {at 640 40} Capacitor(X := Loop.U); // what is controlled",
    ];
    assert_eq!(new, wanted);
    assert_eq!(groups(&both), [("Control & plant".to_owned(), vec![0, 1])]);
    // Another name for one of them, and for those that are left.
    let two = text_after(&both, &group(&["CAPACITOR"], "Plant"));
    let wanted = [("Control & plant".to_owned(), vec![0]), ("Plant".to_owned(), vec![1])];
    assert_eq!(groups(&two), wanted);
    let none = text_after(&two, &group(&["LOOP", "CAPACITOR"], ""));
    assert_eq!(none, LOOP);
    assert_eq!(text_after(LOOP, &group(&["LOOP"], "")), LOOP);
    // As a line of its own, and after the place.
    let own = LOOP.replace("{at 640 40}", "{group \"Plant\"}\n{at 640 40}");
    assert_eq!(text_after(&own, &group(&["CAPACITOR"], "")), LOOP);
    let after = LOOP.replace("{at 640 40}", "{at 640 40} { GROUP \"Plant\" }");
    assert_eq!(text_after(&after, &group(&["CAPACITOR"], "")), LOOP);
    for name in ["a \"b\"", "}", "{at 1 1}", "a\nb"] {
        let refusal = changed(LOOP, &group(&["LOOP"], name)).expect_err(name);
        assert!(refusal.contains("quotation marks"), "{refusal}");
    }
}

fn comment(element: &str, comment: &str) -> Edit {
    Edit::Comment { element: element.to_owned(), comment: comment.to_owned() }
}

#[test]
fn elements_have_comments() {
    let said = |text: &str| -> Vec<String> {
        sheet(text).elements.into_iter().map(|one| one.comment).collect()
    };
    let after = text_after(LOOP, &comment("LOOP", " at each scan "));
    assert_eq!(said(&after), ["at each scan", "what is controlled"]);
    assert_eq!(text_after(&after, &comment("LOOP", "")), LOOP);
    let after = text_after(LOOP, &comment("CAPACITOR", "// {at 1 1} *)"));
    assert_eq!(said(&after), ["", "// {at 1 1} *)"]);
    let none = text_after(&after, &comment("CAPACITOR", ""));
    assert!(none.contains("Capacitor(X := Loop.U);\n"), "{none}");
    assert_eq!(text_after(&none, &comment("CAPACITOR", "what is controlled")), LOOP);
    // What is after it in its line is not part of it.
    let text = "PROGRAM Main VAR A, B : BLINK; END_VAR\nA() ; B(); (* on *)\r\nEND_PROGRAM";
    let after = text_after(text, &comment("A", "first"));
    assert!(after.contains("A() ; // first\n B(); (* on *)\r\n"), "{after}");
    assert_eq!(said(&after), ["first", ""]);
    let after = text_after(&after, &comment("B", "second"));
    assert_eq!(said(&after), ["first", "second"]);
    let refusal = changed(LOOP, &comment("LOOP", "a\nb")).expect_err("two lines");
    assert_eq!(refusal, "a comment is in one line");
}

fn copied(text: &str, elements: &[&str]) -> String {
    let source = Source::new("d.fbd", text).expect("a short text");
    let elements: Vec<String> = elements.iter().map(|one| (*one).to_owned()).collect();
    copy(&source, 0, &elements, &Interfaces::default()).expect("they are there")
}

fn paste(text: &str) -> Edit {
    Edit::Paste { text: text.to_owned(), by: Point::new(40, 20) }
}

#[test]
fn elements_are_copied_and_pasted() {
    let text = copied(LOOP, &["CAPACITOR", "LOOP"]);
    let wanted = "\
VAR
    Loop : PID := (KP := 4.0, TS := T#50ms);
    Capacitor : LAG := (T1 := T#1s);
END_VAR
{at 360 40} Loop(SP := Setpoint, PV := {feedback} Capacitor.Y);
{at 640 40} Capacitor(X := Loop.U);
";
    assert_eq!(text, wanted);
    // Links among them lead to the new ones, those from others stay.
    let edited = changed(LOOP, &paste(&text)).expect("a part");
    assert_eq!(edited.new, ["Loop1", "Capacitor1"]);
    let added = [
        "Loop1 : PID := (KP := 4.0, TS := T#50ms);",
        "Capacitor1 : LAG := (T1 := T#1s);",
        "{at 400 60} Loop1(SP := Setpoint, PV := {feedback} Capacitor1.Y);",
        "{at 680 60} Capacitor1(X := Loop1.U);",
    ];
    assert_eq!(differences(LOOP, &edited.text), (vec![], added.to_vec()));
    // Once more, into another diagram, and one of several that are declared together.
    let twice = changed(&edited.text, &paste(&text)).expect("a part");
    assert_eq!(twice.new, ["Loop2", "Capacitor2"]);
    assert_eq!(changed("", &paste(&text)).expect("a part").new, ["Loop", "Capacitor"]);
    let text = "PROGRAM Main VAR X, Y : BLINK; END_VAR\nX(); Y();\n%Q0.0 := Y.Q;\nEND_PROGRAM";
    let part = copied(text, &["Y", "%Q0.0"]);
    assert_eq!(part, "VAR\n    Y : BLINK;\nEND_VAR\nY();\n%Q0.0 := Y.Q;\n");
    assert_eq!(changed(text, &paste(&part)).expect("a part").new, ["Y1", "%Q0.0"]);
}

#[test]
fn names_of_pins_are_not_renamed() {
    let text = "PROGRAM Main VAR X : LAG; Y : LAG; END_VAR\nX(X := 1.0); Y(X := X.Y);\nEND_PROGRAM";
    let after = text_after(text, &paste(&copied(text, &["X", "Y"])));
    assert!(after.contains("X1(X := 1.0);"), "{after}");
    assert!(after.contains("Y1(X := X1.Y);"), "{after}");
}

#[test]
fn what_is_no_part_of_a_diagram_is_not_pasted() {
    for text in ["", "hello", "IF TRUE THEN", "END_PROGRAM PROGRAM Other", "Loop(", "}{"] {
        let refusal = changed(LOOP, &paste(text)).expect_err(text);
        assert_eq!(refusal, "this is no part of a diagram", "{text}");
    }
}

#[test]
fn what_is_wrong_is_refused_and_nothing_changes() {
    let cases = [
        (give("LOOP", "SP", "1.0 +"), "value"),
        (give("LOOP", "SP", "1.0); Capacitor("), ""),
        (set("LOOP", "KP", "4.0 5.0"), ""),
        (set("NOBODY", "KP", "4.0"), "NOBODY is not in the diagram any more"),
        (call("NO_BLOCK"), "there is no block NO_BLOCK"),
        (write("IF TRUE THEN"), ""),
        (write("A := 1; B := 2"), "write one call or one assignment"),
        (write("RETURN"), "write one call or one assignment"),
        (write("// nothing"), ""),
        (write(""), ""),
        (give("%Q0.0", "", "TRUE"), "not in the diagram any more"),
    ];
    for (one, words) in cases {
        let refusal = changed(LOOP, &one).expect_err(&format!("{one:?}"));
        assert!(refusal.contains(words), "{one:?}: {refusal}");
    }
    let broken = LOOP.replace("(SP :=", "(SP =:");
    let refusal = changed(&broken, &call("PID")).expect_err("the text is broken");
    assert!(refusal.starts_with("line 8 has to be right first"), "{refusal}");
}

/// Links as `A.Y -> B.X`, feedbacks or not.
fn links(sheet: &Sheet) -> BTreeSet<String> {
    let named = sheet.links.iter().map(|link| {
        let (from, to) = (&sheet.elements[link.from.element], &sheet.elements[link.to.element]);
        let (output, input) = (&from.outputs[link.from.pin].name, &to.inputs[link.to.pin].name);
        format!("{}.{output} -> {}.{input}", from.id, to.id)
    });
    named.collect()
}

/// Random changes: the links are those that were made, whatever is done besides.
#[test]
fn random_changes() {
    const BLOCKS: [(&str, &[&str], &str); 3] =
        [("LAG", &["X"], "Y"), ("PID", &["SP", "PV"], "U"), ("SATURATION", &["X"], "Y")];
    for seed in 0..60 {
        let mut rng = Rng::with_seed(seed);
        let mut text = "PROGRAM Main\nEND_PROGRAM\n".to_owned();
        let mut there: Vec<(String, usize)> = Vec::new();
        let mut wanted: BTreeSet<(String, String, String)> = BTreeSet::new();
        for _ in 0..60 {
            let one = match rng.u8(0..10) {
                0..=2 => {
                    let kind = rng.usize(..BLOCKS.len());
                    let Edited { text: after, new } =
                        changed(&text, &call(BLOCKS[kind].0)).expect("a block");
                    there.push((new[0].to_uppercase(), kind));
                    text = after;
                    continue;
                }
                _ if there.is_empty() => continue,
                3..=6 => {
                    let (to, kind) = there[rng.usize(..there.len())].clone();
                    let input = BLOCKS[kind].1[rng.usize(..BLOCKS[kind].1.len())];
                    let (from, kind) = there[rng.usize(..there.len())].clone();
                    let output = BLOCKS[kind].2;
                    let is_link = rng.u8(0..4) > 0;
                    wanted.retain(|(_, element, pin)| (&element[..], &pin[..]) != (&to, input));
                    let value = if is_link { format!("{from}.{output}") } else { String::new() };
                    let edit = give(&to, input, &value);
                    if is_link {
                        wanted.insert((value, to, input.to_owned()));
                    }
                    edit
                }
                7 => {
                    let (gone, _) = there.swap_remove(rng.usize(..there.len()));
                    let of_it = format!("{gone}.");
                    wanted.retain(|(from, to, _)| !from.starts_with(&of_it) && *to != gone);
                    remove(&[&gone])
                }
                8 => {
                    let (element, _) = &there[rng.usize(..there.len())];
                    move_by(element, rng.i32(-50..50) * 10, rng.i32(-50..50) * 10)
                }
                _ => {
                    let pids: Vec<_> = there.iter().filter(|(_, kind)| *kind == 1).collect();
                    let Some((element, _)) = pids.first() else { continue };
                    let value = if rng.bool() { "2.5" } else { "" };
                    set(element, ["KP", "KI", "KD"][rng.usize(..3)], value)
                }
            };
            text = changed(&text, &one).unwrap_or_else(|why| panic!("{one:?}: {why}\n{text}")).text;
            let source = Source::new("d.fbd", &text[..]).expect("a short text");
            let read = diagram::read(&source);
            let loops = read.diagnostics.iter().filter(|one| one.code == diagram::Code::Loop);
            assert_eq!(loops.count(), 0, "each loop is opened\n{text}");
            if there.is_empty() {
                continue;
            }
            let expected = wanted.iter().map(|(from, to, pin)| format!("{from} -> {to}.{pin}"));
            assert_eq!(links(&sheet(&text)), expected.collect(), "{one:?}\n{text}");
        }
    }
}
