//! The order in which the elements of a diagram are executed, wherever they are in the text; loops
//! and what else breaks its rules, at their places.

use diagnostics::Source;
use fastrand::Rng;
use st::tree::Unit;

/// What is said about a diagram of these statements, and the statements in their order.
fn arranged(statements: &[String]) -> (Vec<String>, Vec<String>) {
    arranged_with("", statements)
}

/// The same with declarations, in the first line.
fn arranged_with(declared: &str, statements: &[String]) -> (Vec<String>, Vec<String>) {
    let text = format!("PROGRAM Main {declared}\n{}\nEND_PROGRAM\n", statements.join("\n"));
    let source = Source::new("d.fbd", text.as_str()).expect("a short text");
    let (mut file, found) = st::parser::parse(&source);
    assert!(found.is_empty(), "{text}\n{found:?}");
    let said = diagram::arrange(&source, &mut file).into_iter().map(|one| {
        let (line, _) = source.position(one.span.start as usize);
        format!("{} {} `{}` {}", one.code.text(), line - 1, one.span.text(&text), one.message)
    });
    let said = said.collect();
    (said, in_order(&text, &file.units[0]))
}

fn in_order(text: &str, unit: &Unit) -> Vec<String> {
    unit.body.iter().map(|one| one.span.text(text).to_owned()).collect()
}

fn of(statements: &[&str]) -> (Vec<String>, Vec<String>) {
    arranged(&statements.iter().map(|one| (*one).to_owned()).collect::<Vec<_>>())
}

#[test]
fn links_decide_and_the_text_where_they_leave_a_choice() {
    let (said, order) = of(&["c := b;", "x := 1;", "b := a;", "a := %IW0;", "y := 2;"]);
    assert_eq!(said, [""; 0]);
    assert_eq!(order, ["x := 1", "a := %IW0", "b := a", "c := b", "y := 2"]);
    // A block's outputs, what goes out of it, a part of a variable, letter case.
    let (said, order) = of(&[
        "z := LOOP.u + out;",
        "q[i] := rec.B;",
        "i := rec.A;",
        "Rec.A := 1;",
        "rec.b := 2;",
        "Loop(SP := q[0], U => Out);",
    ]);
    assert_eq!(said, [""; 0]);
    let wanted = ["Rec.A := 1", "i := rec.A", "rec.b := 2", "q[i] := rec.B"];
    assert_eq!(order[..2], ["Rec.A := 1", "rec.b := 2"]);
    assert!(wanted.iter().all(|one| order.contains(&(*one).to_owned())), "{order:?}");
    assert_eq!(order[4..], ["Loop(SP := q[0], U => Out)", "z := LOOP.u + out"]);
}

#[test]
fn a_feedback_is_read_before_it_is_written() {
    let (said, order) = of(&["b := a;", "a := {feedback} b + 1;"]);
    assert_eq!(said, [""; 0]);
    assert_eq!(order, ["a := {feedback} b + 1", "b := a"]);
    // Its own value, too.
    let (said, order) = of(&["n := { FEEDBACK } n + 1;"]);
    assert_eq!((said, order.len()), (vec![], 1));
    // In brackets, too.
    let (said, order) = of(&["b := a;", "a := -(({feedback} b)) + 1;"]);
    assert!(said.is_empty(), "{said:?}");
    assert_eq!(order, ["a := -(({feedback} b)) + 1", "b := a"]);
    // Also where no loop would be.
    let (said, order) = of(&["a := 5;", "b := {feedback} a;"]);
    assert_eq!(said, [""; 0]);
    assert_eq!(order, ["b := {feedback} a", "a := 5"]);
}

#[test]
fn loops_are_named_once_each_at_the_link_that_leads_back() {
    let (said, order) = of(&["a := c;", "b := a;", "c := b;", "d := e;", "e := d;", "f := a + e;"]);
    assert_eq!(said, ["E0503 1 `c` a loop: b -> c -> a -> b", "E0503 4 `e` a loop: e -> d -> e"]);
    assert_eq!(order.len(), 6);
    let (said, _) = of(&["n := n + 1;"]);
    assert_eq!(said, ["E0503 1 `n` a loop: n -> n"]);
    // One output as it is, the other one as it was.
    let (said, _) = of(&["A(IN := 1);", "x := A.Q + {feedback} A.ET;"]);
    assert_eq!(said, ["E0503 2 `A.ET` a loop: x -> A -> x"]);
}

#[test]
fn names_with_an_address_are_that_address() {
    let declared = "VAR Lamp AT %Q0.0 : BOOL; Other AT %QX0.0 : BOOL; END_VAR";
    let of = |all: &[&str]| {
        arranged_with(declared, &all.iter().map(|one| (*one).to_owned()).collect::<Vec<_>>())
    };
    let (said, order) = of(&["Copy := %QX0.0;", "Lamp := Button;"]);
    assert_eq!(said, [""; 0]);
    assert_eq!(order, ["Lamp := Button", "Copy := %QX0.0"]);
    let (said, _) = of(&["Lamp := a;", "%Q0.0 := b;", "OTHER := c;"]);
    assert_eq!(
        said,
        [
            "E0502 2 `%Q0.0` %Q0.0: two elements give it a value",
            "E0502 3 `OTHER` OTHER: two elements give it a value",
        ]
    );
}

#[test]
fn inputs_of_a_block_are_given_in_its_call() {
    let (said, _) = of(&["fb.IN := x;", "Fb();", "y := Fb.Q;"]);
    let wanted = "E0502 1 `fb.IN` fb.IN: its block is called, and that is what gives it a value";
    assert_eq!(said, [wanted]);
}

#[test]
fn large_diagrams_the_other_way_round_are_ordered() {
    let count = 20_000;
    let one = |at: usize| format!("a{} := a{at};", at + 1);
    let statements: Vec<String> = (0..count).rev().map(one).collect();
    let (said, order) = arranged(&statements);
    assert_eq!((said.len(), order.len()), (0, count));
    assert_eq!((&order[0][..], &order[count - 1][..]), ("a1 := a0", "a20000 := a19999"));
}

#[test]
fn everything_is_told_at_its_place() {
    let (said, _) = of(&[
        "IF a THEN b := 1; END_IF",
        "L(IN := a);",
        "l(IN := c);",
        "%QW0 := 1;",
        "m := 2;",
        "M := {feedback} 3;",
        "%qw0 := 5;",
    ]);
    assert_eq!(
        said,
        [
            "E0500 1 `IF a THEN` a diagram has calls of blocks and assignments, and nothing else",
            "E0501 3 `l` l: this block is called twice",
            "E0502 6 `M` M: two elements give it a value",
            "E0505 6 `{feedback}` `{feedback}` is not before a name that is read",
            "E0502 7 `%qw0` %qw0: two elements give it a value",
        ]
    );
}

fn text((at, before, after): &(usize, Vec<usize>, Vec<usize>)) -> String {
    let now = before.iter().map(|one| format!(" + v{one}"));
    let was = after.iter().map(|one| format!(" + {{feedback}} v{one}"));
    format!("v{at} := 1{};", now.chain(was).collect::<String>())
}

#[test]
fn diagrams_in_any_order_of_their_text_are_executed_as_their_links_say() {
    for seed in 0..2_000 {
        let mut random = Rng::with_seed(seed);
        let count = random.usize(1..20);
        // Each reads some that are before it, and itself and some after it as they were.
        let mut elements: Vec<(usize, Vec<usize>, Vec<usize>)> = Vec::new();
        for at in 0..count {
            let before = (0..at).filter(|_| random.u8(..4) == 0).collect();
            let after = (at..count).filter(|_| random.u8(..12) == 0).collect();
            elements.push((at, before, after));
        }
        random.shuffle(&mut elements);
        let texts: Vec<String> = elements.iter().map(text).collect();
        let (said, order) = arranged(&texts);
        assert_eq!((said.len(), order.len()), (0, count), "seed {seed}: {texts:?}\n{said:?}");
        let place = |at: usize| {
            let begin = format!("v{at} :=");
            order.iter().position(|one| one.starts_with(&begin)).expect("it is there")
        };
        for (at, before, after) in &elements {
            let earlier = before.iter().all(|one| place(*one) < place(*at));
            let later = after.iter().all(|one| one == at || place(*at) < place(*one));
            assert!(earlier && later, "seed {seed}: v{at} in {order:?}");
        }
    }
}
