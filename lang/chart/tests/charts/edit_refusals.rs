//! What edits mean, one by one, as text; and every reason why one is refused.

use std::collections::BTreeSet;

use chart::edit::{Edit, Editing, Element, Refusal, Wanted};
use chart::model::{ActionId, Position, Qualifier, StepId, TransitionId};
use chart::text::read;
use diagnostics::Source;

use crate::edits::check;

const STATION: &str = "\
PROGRAM Station
VAR
    Start AT %I0.0, Full AT %I0.1 : BOOL;
    Count : INT;
END_VAR
INITIAL_STEP Wait:
END_STEP

STEP Fill:
    Valve;
    Add(P1);
    Stir;
END_STEP

STEP Heat:
END_STEP

STEP Done:
END_STEP

TRANSITION FROM Wait TO (Fill, Heat)
    := Start;
END_TRANSITION

TRANSITION Go (PRIORITY := 1) FROM (Fill, Heat) TO Done
    := Full OR Fill.T >= T#10s;
END_TRANSITION

TRANSITION FROM Done TO Wait
    := NOT Start;
END_TRANSITION

ACTION Add:
    Count := Count + 1;
END_ACTION

ACTION Stir:
    INITIAL_STEP Left:
    END_STEP

    STEP Right:
    END_STEP

    TRANSITION FROM Left TO Right
        := Fill.T > T#5s AND Free;
    END_TRANSITION
END_ACTION
END_PROGRAM
";

const GRAFCET: &str = "\
{grafcet}
INITIAL_STEP A: {force G (B)}
    Lamp;
END_STEP

STEP C:
END_STEP

TRANSITION FROM A TO C
    := go;
END_TRANSITION

ACTION G:
    INITIAL_STEP B:
    END_STEP

    STEP D:
    END_STEP

    TRANSITION FROM B TO D
        := C.X;
    END_TRANSITION
END_ACTION
";

/// A text that is being edited, one of its charts.
struct Chart {
    editing: Editing,
    sheet: usize,
}

impl Chart {
    fn of(text: &str, sheet: usize) -> Chart {
        let reading = read(&Source::new("Main.sfc", text).expect("a short text"));
        assert!(reading.diagnostics.is_empty(), "{:?}", reading.diagnostics);
        let editing = Editing::of(reading.document, "Main").expect("a chart");
        Chart { editing, sheet }
    }

    fn chart(&self) -> &chart::model::Chart {
        self.editing.charts().nth(self.sheet).expect("a chart").1
    }

    fn step(&self, name: &str) -> StepId {
        self.chart().step_named(name).unwrap_or_default()
    }

    fn steps(&self, names: &str) -> BTreeSet<StepId> {
        names.split_whitespace().map(|name| self.step(name)).collect()
    }

    fn transition(&self, number: usize) -> TransitionId {
        self.chart().transitions.keys().nth(number).copied().unwrap_or_default()
    }

    /// What a transition is: its steps and its condition.
    fn transitions(&self) -> Vec<String> {
        let chart = self.chart();
        let name = |id: &StepId| chart.steps[id].name.as_str();
        let side = |ids: &BTreeSet<StepId>| ids.iter().map(name).collect::<Vec<_>>().join("+");
        let all = chart.transitions.values();
        all.map(|one| format!("{}>{} {}", side(&one.from), side(&one.to), one.condition.text))
            .collect()
    }

    fn apply(&mut self, edit: &Edit) -> Result<Vec<Element>, Refusal> {
        let path = self.editing.charts().nth(self.sheet).expect("a chart").0.clone();
        let done = self.editing.apply(&path, edit).map(|done| done.select);
        check(&self.editing);
        done
    }

    fn with(mut self, edit: impl Fn(&Chart) -> Edit) -> Chart {
        let edit = edit(&self);
        self.apply(&edit).unwrap_or_else(|refusal| panic!("{edit:?}: {refusal}"));
        self
    }

    fn refused(mut self, edit: impl Fn(&Chart) -> Edit) -> String {
        let edit = edit(&self);
        let before = self.editing.document().clone();
        let refusal = self.apply(&edit).expect_err("refused");
        assert_eq!(self.editing.document(), &before);
        refusal.to_string()
    }
}

fn station() -> Chart {
    Chart::of(STATION, 0)
}

fn wanted(action: &str, qualifier: Qualifier, time: Option<&str>) -> Wanted {
    Wanted { qualifier, time: time.map(str::to_owned), action: action.to_owned() }
}

fn after(chart: Chart, name: &str) -> Vec<String> {
    chart.with(|chart| Edit::AddAfter(Element::Step(chart.step(name)))).transitions()
}

#[test]
fn a_step_after_another_one() {
    // One transition leaves it alone: the new step is behind that.
    let all = after(station(), "Done");
    let wanted = ["Wait>Fill+Heat Start", "Fill+Heat>Done Full OR Fill.T >= T#10s"];
    assert_eq!(all[..2], wanted);
    assert_eq!(all[2..], ["Done>S5 NOT Start", "S5>Wait TRUE"]);
    // It leaves with others: the branch is longer then.
    let all = after(station(), "Fill");
    assert_eq!(all[1], "Heat+S5>Done Full OR Fill.T >= T#10s");
    assert_eq!(all[3], "Fill>S5 TRUE");
    // Nothing leaves it.
    assert_eq!(after(Chart::of(STATION, 1), "Right")[1], "Right>S3 TRUE");
    // Alternatives leave the new one.
    let fork = "INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP
        TRANSITION FROM A TO B := x; END_TRANSITION TRANSITION FROM A TO C := y; END_TRANSITION";
    assert_eq!(after(Chart::of(fork, 0), "A"), ["S4>B x", "S4>C y", "A>S4 TRUE"]);
}

#[test]
fn a_step_before_another_one_or_a_transition() {
    let before = |of: fn(&Chart) -> Element| station().with(|one| Edit::AddBefore(of(one)));
    let all = before(|one| Element::Step(one.step("Fill"))).transitions();
    assert_eq!((all[0].as_str(), all[3].as_str()), ("Wait>Heat+S5 Start", "S5>Fill TRUE"));
    let all = before(|one| Element::Transition(one.transition(1))).transitions();
    assert_eq!(
        (all[1].as_str(), all[3].as_str()),
        ("S5>Done Full OR Fill.T >= T#10s", "Fill+Heat>S5 TRUE")
    );
    let chart = station().with(|one| Edit::AddAfter(Element::Transition(one.transition(0))));
    assert_eq!(chart.transitions()[0], "Wait>S5 Start");
    assert_eq!(chart.transitions()[3], "S5>Fill+Heat TRUE");
}

#[test]
fn branches() {
    let branch = |name: &str, is_parallel| {
        let of = |one: &Chart| Element::Step(one.step(name));
        station().with(|one| Edit::AddBranch { of: of(one), is_parallel }).transitions()
    };
    assert_eq!(branch("Wait", true)[0], "Wait>Fill+Heat+S5 Start");
    assert_eq!(branch("Done", true)[2], "Done>Wait+S5 NOT Start");
    assert_eq!(branch("Done", false)[3], "Done>S5 TRUE");
    let of = |one: &Chart| Element::Transition(one.transition(1));
    let chart = station().with(|one| Edit::AddBranch { of: of(one), is_parallel: false });
    assert_eq!(chart.transitions()[3], "Fill+Heat>S5 TRUE");
}

fn erase(names: &'static str, numbers: &'static [usize]) -> impl Fn(&Chart) -> Edit {
    move |chart| Edit::Erase {
        steps: chart.steps(names),
        transitions: numbers.iter().map(|number| chart.transition(*number)).collect(),
    }
}

#[test]
fn erasing_leaves_what_can_be_without_it() {
    let chart = station().with(erase("Heat", &[]));
    assert_eq!(chart.transitions()[0], "Wait>Fill Start");
    assert_eq!(chart.transitions()[1], "Fill>Done Full OR Fill.T >= T#10s");
    // What would be there twice, or lead from a step to itself, goes.
    let text = "INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP
        TRANSITION FROM (A, B) TO C := x; END_TRANSITION
        TRANSITION FROM A TO C := y; END_TRANSITION
        TRANSITION FROM (B, C) TO C := z; END_TRANSITION";
    assert_eq!(Chart::of(text, 0).with(erase("B", &[])).transitions(), ["A>C y"]);
    // A variable is an action as long as a block has it.
    let chart = Chart::of("INITIAL_STEP A: END_STEP STEP B: Lamp; END_STEP", 0);
    assert!(chart.with(erase("B", &[])).chart().actions.is_empty());
    // All of it can go, and a new chart begins.
    let chart = Chart::of("INITIAL_STEP A: END_STEP STEP B: END_STEP", 0).with(erase("A B", &[]));
    assert_eq!(chart.editing.text(), "");
    let chart = chart.with(|_| Edit::AddStep { at: None, is_initial: false });
    assert_eq!(chart.editing.text(), "INITIAL_STEP S1:\nEND_STEP\n");
    let chart = station().with(|one| Edit::EraseAction {
        action: one.chart().action_named("Stir").expect("an action"),
    });
    assert_eq!(chart.editing.charts().count(), 1);
}

#[test]
fn who_names_a_step_follows_its_new_name() {
    let rename = |from: &'static str, to: &'static str| {
        move |one: &Chart| Edit::Rename { step: one.step(from), name: to.to_owned() }
    };
    let text = station().with(rename("fill", "Filling")).editing.text();
    assert!(!text.contains("Fill.") && !text.contains("Fill,"), "{text}");
    assert!(text.contains(":= Full OR Filling.T >= T#10s;"), "{text}");
    assert!(text.contains(":= Filling.T > T#5s AND Free;"), "{text}");
    let text = Chart::of(GRAFCET, 1).with(rename("B", "First")).editing.text();
    assert!(text.contains("{force G (First)}"), "{text}");
    let text = Chart::of(GRAFCET, 0).with(rename("C", "c2")).editing.text();
    assert!(text.contains(":= c2.X;"), "{text}");
    let text = station().with(rename("Fill", "FILL")).editing.text();
    assert!(text.contains("STEP FILL:") && text.contains("FILL.T"), "{text}");
}

#[test]
fn copies_have_free_names() {
    let chart = station();
    let path = chart.editing.charts().next().expect("a chart").0.clone();
    let text = chart.editing.copy(&path, &chart.steps("Fill Heat Done")).expect("a copy");
    assert!(text.starts_with("STEP Fill:") && text.contains("ACTION Add:"), "{text}");
    let chart = chart.with(|_| Edit::Paste { text: text.clone(), at: None });
    assert_eq!(chart.transitions()[3], "Fill2+Heat2>Done2 Full OR Fill2.T >= T#10s");
    let names: Vec<_> = chart.chart().transitions.values().map(|one| one.name.clone()).collect();
    assert_eq!(names[3].as_deref(), Some("Go2"));
    assert_eq!(chart.chart().actions.len(), 3);
    // Code of actions comes along to another chart.
    let at = Some(Position { x: 40, y: 80 });
    let other = Chart::of("", 0).with(|_| Edit::Paste { text: text.clone(), at });
    assert_eq!(other.chart().initial_steps().collect::<Vec<_>>(), [other.step("Fill")]);
    assert_eq!(other.editing.charts().count(), 2);
    let place = other.chart().steps[&other.step("Done")].at;
    assert_eq!(place, Some(Position { x: 40, y: 280 }));
}

#[test]
fn new_steps_of_a_chart_with_places_have_one() {
    let text = "INITIAL_STEP A {at 0 0}: END_STEP STEP B {at 0 100}: END_STEP
        TRANSITION FROM A TO B := x; END_TRANSITION";
    let place = |edit: fn(&Chart) -> Edit| {
        let chart = Chart::of(text, 0).with(edit);
        chart.chart().steps[&chart.step("S3")].at.map(|at| (at.x, at.y))
    };
    let add = |_: &Chart| Edit::AddStep { at: None, is_initial: false };
    assert_eq!(place(add), Some((0, 200)));
    assert_eq!(place(|one| Edit::AddAfter(Element::Step(one.step("A")))), Some((0, 50)));
    assert_eq!(place(|one| Edit::AddBefore(Element::Step(one.step("A")))), Some((0, -100)));
    let branch =
        |one: &Chart| Edit::AddBranch { of: Element::Step(one.step("A")), is_parallel: true };
    assert_eq!(place(branch), Some((160, 100)));
    let swap = |one: &Chart| Edit::Place {
        steps: [
            (one.step("A"), Position { x: 0, y: 100 }),
            (one.step("B"), Position { x: 0, y: 0 }),
        ]
        .into(),
        transitions: [].into(),
    };
    let text = Chart::of(text, 0).with(swap).with(|_| Edit::Layout).editing.text();
    assert!(!text.contains("{at"), "{text}");
}

#[test]
fn a_chart_begins_in_the_program_of_its_file() {
    let add = |_: &Chart| Edit::AddStep { at: None, is_initial: true };
    let text = "PROGRAM P\nVAR\n    a : BOOL;\nEND_VAR\nEND_PROGRAM\n";
    let text = Chart::of(text, 0).with(add).editing.text();
    assert_eq!(
        text,
        "PROGRAM P\nVAR\n    a : BOOL;\nEND_VAR\nINITIAL_STEP S1:\nEND_STEP\nEND_PROGRAM\n"
    );
    let reading = read(&Source::new("m.sfc", "PROGRAM P a := b; END_PROGRAM").expect("short"));
    let refusal = Editing::of(reading.document, "m").expect_err("refused").to_string();
    assert_eq!(refusal, "P has statements: a unit is these or a chart");
}

#[test]
fn blocks() {
    let action = |index, text: &'static str, qualifier| {
        move |one: &Chart| {
            let action = wanted(text, qualifier, None);
            Edit::SetAction { step: one.step("Fill"), index, action }
        }
    };
    let chart = station()
        .with(action(0, "Pump", Qualifier::S))
        .with(action(3, "%Q0.1", Qualifier::N))
        .with(|one| Edit::InsertAction {
            step: one.step("Fill"),
            index: 0,
            action: wanted("Lamp", Qualifier::L, Some("T#2s")),
        })
        .with(|one| Edit::MoveAction { step: one.step("Fill"), index: 0, to: 2 })
        .with(|one| Edit::RemoveAction { step: one.step("Fill"), index: 3 });
    let text = chart.editing.text();
    assert!(
        text.contains(":\n    Pump(S);\n    Add(P1);\n    Lamp(L, T#2s);\n    %Q0.1;\n"),
        "{text}"
    );
    let chart = chart.with(|one| Edit::ClearActions { step: one.step("Fill") });
    let names = chart.chart().actions.values().map(|one| one.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["Add", "Stir"]);
}

/// All that is refused, with what is said then.
#[test]
fn every_refusal_says_why() {
    let inner = || Chart::of(STATION, 1);
    let grafcet = || Chart::of(GRAFCET, 0);
    let no = StepId(999);
    let says = |chart: Chart, edit: &dyn Fn(&Chart) -> Edit, message: &str| {
        assert_eq!(chart.refused(edit), message);
    };
    let nobody = Element::Step(no);
    says(station(), &|_| Edit::AddAfter(nobody), "999: there is no step of this name");
    let transition = Element::Transition(TransitionId(999));
    says(station(), &|_| Edit::AddBefore(transition), "there is no such transition");
    says(station(), &erase("", &[]), "nothing is selected");
    let add = |at, is_initial| move |_: &Chart| Edit::AddStep { at, is_initial };
    let message = "Wait is the initial step already; an SFC has one";
    says(station(), &add(None, true), message);
    let far = Some(Position { x: 1_000_001, y: 0 });
    says(station(), &add(far, false), "a place is between -1000000 and 1000000");
    let message = "Wait is the initial step: another one must be made that first";
    says(station(), &erase("Wait", &[]), message);
    let message = "Stir: the chart of an action keeps a step";
    says(inner(), &erase("Left Right", &[]), message);
    let message = "Go asks for Fill: that must be changed first";
    says(station(), &erase("Fill", &[]), message);
    says(
        station(),
        &erase("Fill", &[1]),
        "Left_to_Right asks for Fill: that must be changed first",
    );
    says(Chart::of(GRAFCET, 0), &erase("C", &[]), "B_to_D asks for C: that must be changed first");
    let forced = Chart::of(&GRAFCET.replace("STEP D:", "INITIAL_STEP D:"), 1);
    says(forced, &erase("B", &[]), "A asks for B: that must be changed first");
    let initial = |name: &'static str, is_initial| {
        move |one: &Chart| Edit::SetInitial { step: one.step(name), is_initial }
    };
    let message = "Wait is the initial step of the chart: it needs one";
    says(station(), &initial("Wait", false), message);
    let branch = |name: &'static str| {
        move |one: &Chart| Edit::AddBranch { of: Element::Step(one.step(name)), is_parallel: true }
    };
    says(inner(), &branch("Right"), "Right: no transition leaves this step yet");
    let fork = "INITIAL_STEP A: END_STEP STEP B: END_STEP
        TRANSITION FROM A TO B := x; END_TRANSITION TRANSITION FROM A TO A := y; END_TRANSITION";
    let message = "A: several transitions leave this step; one is to be selected";
    says(Chart::of(fork, 0), &branch("A"), message);
    says(station(), &|_| Edit::Layout, "nothing has a place: the layout is automatic already");
    let erase_action = |_: &Chart| Edit::EraseAction { action: ActionId(999) };
    says(grafcet(), &erase_action, "999: there is no action of this name");
}

#[test]
fn every_refusal_of_transitions_says_why() {
    let connect = |from: &'static str, to: &'static str| {
        move |one: &Chart| Edit::Connect { from: one.steps(from), to: one.steps(to) }
    };
    let message = "a transition has a step before it and one after it";
    assert_eq!(station().refused(connect("Fill", "")), message);
    let message = "there is a transition between these steps already: Done_to_Wait";
    assert_eq!(station().refused(connect("Done", "Wait")), message);
    let message = "0: there is no step of this name";
    assert_eq!(station().refused(connect("Done", "Nobody")), message);
    let set = |name: Option<&'static str>, priority| {
        move |one: &Chart| {
            let transition = one.transition(0);
            let before = one.chart().transitions[&transition].clone();
            let (from, to, name) = (before.from, before.to, name.map(str::to_owned));
            Edit::SetTransition { transition, name, priority, from, to }
        }
    };
    let with_two = || station().with(erase("", &[0])).with(connect("Wait", "Fill Heat"));
    let renamed = with_two().refused(set(Some("go now"), None));
    assert_eq!(
        renamed,
        "`go now` is no name: letters, digits and `_`, and a digit is not the first"
    );
    let second = |one: &Chart| match set(Some("GO"), None)(one) {
        Edit::SetTransition { name, priority, .. } => {
            let transition = one.transition(1);
            let before = one.chart().transitions[&transition].clone();
            Edit::SetTransition { transition, name, priority, from: before.from, to: before.to }
        }
        other => other,
    };
    assert_eq!(station().refused(set(Some("GO"), None)), "GO: a transition is called so already");
    station().with(second);
    let message = "priorities belong to SFC: all that can be crossed are";
    assert_eq!(Chart::of(GRAFCET, 0).refused(set(None, Some(1))), message);
    let condition = |text: &'static str| {
        move |one: &Chart| Edit::SetCondition {
            transition: one.transition(2),
            text: text.to_owned(),
        }
    };
    for (text, part) in [
        ("a AND", "the condition of Done_to_Wait: "),
        ("", "the condition of Done_to_Wait: "),
        ("a; b", "the condition of Done_to_Wait: "),
        ("a // why", "Done_to_Wait would be read as something else; comments are apart from it"),
        ("END_STEP", "Done_to_Wait could not be read again: "),
    ] {
        let message = station().refused(condition(text));
        assert!(message.starts_with(part), "{message}");
    }
}

#[test]
fn every_refusal_of_blocks_says_why() {
    let set = |index, wanted: Wanted| {
        move |one: &Chart| Edit::SetAction { step: one.step("Fill"), index, action: wanted.clone() }
    };
    use Qualifier::{L, N, P1};
    for (index, action, message) in [
        (4, wanted("a", N, None), "Fill: its block has 3 actions"),
        (3, wanted("add", P1, None), "Add(P1): this is in the block already"),
        (3, wanted("a", L, None), "L: this qualifier needs a time, such as T#2s"),
        (
            3,
            wanted("a", N, Some("T#2s")),
            "N: this qualifier has no time; L, D, SD, DS and SL have one",
        ),
        (3, wanted("Heat", N, None), "Heat: a step or an action is called so already"),
    ] {
        assert_eq!(station().refused(set(index, action)), message);
    }
    let message = station().refused(set(0, wanted("a", L, Some("T#2s +"))));
    assert!(message.starts_with("the time: "), "{message}");
    let message = station().refused(set(0, wanted("a b", N, None)));
    assert!(message.starts_with("the action: "), "{message}");
    let message = station().refused(set(0, wanted("a + b", N, None)));
    assert!(message.starts_with("Fill could not be read again: "), "{message}");
    let in_grafcet = |name: &'static str, qualifier| {
        move |one: &Chart| {
            let action = wanted(name, qualifier, None);
            Edit::SetAction { step: one.step("A"), index: 1, action }
        }
    };
    let message = "Horn(P1): not in a GRAFCET; a variable has N, L, D, S or R in a GRAFCET";
    assert_eq!(Chart::of(GRAFCET, 0).refused(in_grafcet("Horn", P1)), message);
    let message = "G(N): not in a GRAFCET; charts as actions belong to SFC";
    assert_eq!(Chart::of(GRAFCET, 0).refused(in_grafcet("G", N)), message);
}

#[test]
fn every_refusal_of_places_and_copies_says_why() {
    let at = |x, y| Position { x, y };
    let text = "INITIAL_STEP A {at 0 0}: END_STEP STEP B {at 0 100}: END_STEP";
    let place = |x, y| {
        move |one: &Chart| Edit::Place {
            steps: [(one.step("A"), at(x, y))].into(),
            transitions: [].into(),
        }
    };
    assert_eq!(Chart::of(text, 0).refused(place(0, 100)), "B is at this place");
    let message = "a place is between -1000000 and 1000000";
    assert_eq!(Chart::of(text, 0).refused(place(0, i32::MIN)), message);
    let nothing = |_: &Chart| Edit::Place { steps: [].into(), transitions: [].into() };
    assert_eq!(station().refused(nothing), "nothing is selected");
    let paste =
        |text: &'static str| move |_: &Chart| Edit::Paste { text: text.to_owned(), at: None };
    let says = |text, message: &str| {
        let said = station().refused(paste(text));
        assert!(said.starts_with(message), "{said}");
    };
    let message = "this is no copy of steps: it is something else than steps and transitions";
    says("once upon a time", message);
    says("PROGRAM P INITIAL_STEP A: END_STEP END_PROGRAM", message);
    says("STEP A: END_STEP STEP A: END_STEP", "this is no copy of steps: A: ");
    says("{grafcet} STEP A: END_STEP", "the copy is of the other standard, SFC or GRAFCET");
    says("STEP A: Heat; END_STEP", "Heat: a step or an action is called so already");
    let chart = station();
    let path = chart.editing.charts().next().expect("a chart").0.clone();
    let refused = chart.editing.copy(&path, &BTreeSet::new()).expect_err("refused");
    assert_eq!(refused, Refusal::Nothing);
}

#[test]
fn every_refusal_of_names_says_why() {
    let rename = |name: &'static str| {
        move |one: &Chart| Edit::Rename { step: one.step("Fill"), name: name.to_owned() }
    };
    for (name, message) in [
        ("heat", "heat: a step or an action is called so already"),
        ("stir", "stir: a step or an action is called so already"),
        ("Count", "Count: a variable is called so already"),
        ("Free", "Free: Left_to_Right names something else so"),
        ("Left", "Left: Left_to_Right names something else so"),
        ("2x", "`2x` is no name: letters, digits and `_`, and a digit is not the first"),
        ("a b", "`a b` is no name: letters, digits and `_`, and a digit is not the first"),
        ("from", "from: a word of the language names nothing"),
        ("If", "If: a word of the language names nothing"),
    ] {
        assert_eq!(station().refused(rename(name)), message);
    }
}
