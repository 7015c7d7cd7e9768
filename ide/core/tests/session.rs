//! A session as the page uses it: requests in, events out, with time passed in.

mod charts;
mod measured;
mod recorded;

use std::collections::BTreeMap;

use ide_core::protocol::ladder::Ladder;
use ide_core::protocol::{
    ApartWish, Event, File, FrequencyResponse, Line, LookWish, Path, Problem, ProjectWish,
    Recording, Request, Status, TargetWish, TestResult, TextWish, Value, Wish,
};
use recorded::Recorded;

const STATION: &str = include_str!("../../../examples/station1.awl");
const SCENARIO: &str = include_str!("../../../examples/station1.scn");
const PLANT: &str =
    "station1 pieces=normal,small,normal,large,small,normal noise=3 seed=7 button=auto";

/// A page without pixels.
#[derive(Default)]
struct Page {
    session: Recorded,
    now_ms: u64,
    id: u32,
    events: Vec<Event>,
}

impl Page {
    fn with(name: &str, text: &str) -> Page {
        let mut page = Page::default();
        let files = vec![File { name: name.to_owned(), text: text.to_owned() }];
        page.wish(Wish::Project(ProjectWish::Open { files, main: None }));
        page
    }

    fn wish(&mut self, wish: Wish) -> Vec<Event> {
        self.id += 1;
        let events = self.session.request(Request { id: self.id, wish }, self.now_ms);
        self.events.extend(events.clone());
        events
    }

    fn target(&mut self, wish: TargetWish) {
        let events = self.wish(Wish::Target(wish));
        assert!(!events.iter().any(|event| matches!(event, Event::Refused { .. })), "{events:?}");
    }

    fn answer<T: serde::de::DeserializeOwned>(&mut self, wish: Wish) -> T {
        let id = self.id + 1;
        let events = self.wish(wish);
        let found = events.iter().find_map(|event| match event {
            Event::Answer { id: of, answer } if *of == id => Some(answer.clone()),
            _ => None,
        });
        let found = found.unwrap_or_else(|| panic!("no answer in {events:?}"));
        serde_json::from_value(found).unwrap()
    }

    fn refusal(&mut self, wish: Wish) -> String {
        let events = self.wish(wish);
        let found = events.iter().find_map(|event| match event {
            Event::Refused { message, .. } => Some(message.clone()),
            _ => None,
        });
        found.unwrap_or_else(|| panic!("not refused: {events:?}"))
    }

    /// Time passes, 10 ms at a time.
    fn pass(&mut self, ms: u64) {
        for _ in 0..ms / 10 {
            self.now_ms += 10;
            let events = self.session.tick(self.now_ms, 1000);
            self.events.extend(events);
        }
    }

    /// The last event that this finds something in.
    fn last<T>(&self, find: impl Fn(&Event) -> Option<T>) -> Option<T> {
        self.events.iter().rev().find_map(find)
    }

    fn status(&self) -> Status {
        let status = |event: &Event| match event {
            Event::Status { status } => Some(status.clone()),
            _ => None,
        };
        self.last(status).unwrap()
    }

    /// The lines with live values.
    fn live(&self) -> BTreeMap<u32, Line> {
        let lines = |event: &Event| match event {
            Event::Live { lines, .. } => {
                Some(lines.iter().map(|line| (line.line, line.clone())).collect())
            }
            _ => None,
        };
        self.last(lines).unwrap()
    }

    fn watched(&self) -> Vec<Value> {
        let values = |event: &Event| match event {
            Event::Watched { values } => Some(values.clone()),
            _ => None,
        };
        self.last(values).unwrap()
    }

    fn problems(&self) -> Vec<Problem> {
        let problems = |event: &Event| match event {
            Event::Problems { problems } => Some(problems.clone()),
            _ => None,
        };
        self.last(problems).unwrap()
    }
}

fn view(file: &str, from: u32, to: u32) -> Wish {
    Wish::Look(LookWish::View { file: file.to_owned(), from, to })
}

fn look(operands: &[&str]) -> Wish {
    let operands = operands.iter().map(|name| (*name).to_owned()).collect();
    Wish::Look(LookWish::Watch { operands })
}

#[test]
fn the_station_sorts_six_pieces_while_it_is_looked_at() {
    let mut page = Page::with("station1.awl", STATION);
    assert_eq!(page.problems(), []);
    page.target(TargetWish::Plant { spec: Some(PLANT.to_owned()) });
    page.wish(look(&["Push", "Height"]));
    page.wish(view("station1.awl", 1, 60));
    page.target(TargetWish::Run);
    page.target(TargetWish::Speed { factor: 10.0 });
    page.pass(6_400);
    let status = page.status();
    assert_eq!((status.mode.as_str(), status.agreement.as_str()), ("RUN", "same"));
    assert!(status.time_ms >= 63_000, "{} ms", status.time_ms);
    let state = |event: &Event| match event {
        Event::Plant { state, .. } => Some(state.clone()),
        _ => None,
    };
    let state = page.last(state).unwrap();
    let value = |name: &str| state.iter().find(|(key, _)| key == name).unwrap().1;
    assert_eq!((value("good"), value("rejected"), value("collisions")), (3.0, 3.0, 0.0));
    let flows: Vec<String> = page
        .last(|event| match event {
            Event::Live { lines, .. } => {
                Some(lines.iter().filter_map(|line| line.flow.clone()).collect())
            }
            _ => None,
        })
        .unwrap();
    assert!(flows.len() > 10, "{flows:?}");
    assert!(flows.iter().any(|flow| flow == "on") && flows.iter().any(|flow| flow == "off"));
    assert!(page.watched().iter().all(|value| value.number.is_some()));
}

#[test]
fn a_mistake_is_told_with_what_mends_it() {
    let mut page = Page::with("lamp.awl", "LD I0.0\n= Q0.9\n");
    let problems = page.problems();
    let problem = &problems[0];
    assert!(problem.is_error && problem.line == 2 && (problem.from, problem.to) == (10, 14));
    assert_eq!(page.refusal(Wish::Target(TargetWish::Run)), "lamp.awl has an error");
    let text = "LD I0.0\n= Q0.1\n".to_owned();
    page.wish(Wish::Project(ProjectWish::Edit { file: "lamp.awl".to_owned(), text }));
    assert_eq!(page.problems(), []);
    page.target(TargetWish::Run);
}

#[test]
fn inputs_are_set_and_forced_and_the_program_answers() {
    let mut page = Page::with("lamp.awl", "LD I0.0\n= Q0.1\n");
    page.wish(look(&["Q0.1", "I0.0", "MX"]));
    page.target(TargetWish::Run);
    page.pass(300);
    let texts = |page: &Page| -> Vec<String> {
        page.watched().into_iter().map(|value| value.text).collect()
    };
    assert_eq!(texts(&page), ["0", "0", ""]);
    assert!(page.watched()[2].problem.is_some(), "no such operand");
    page.target(TargetWish::Drive { operand: "I0.0".to_owned(), value: 1 });
    page.pass(300);
    assert_eq!(texts(&page), ["1", "1", ""]);
    let force =
        |value: &str| TargetWish::Force { operand: "I0.0".to_owned(), value: value.to_owned() };
    page.target(force("0"));
    page.pass(300);
    assert_eq!(texts(&page), ["0", "0", ""]);
    assert!(page.watched()[1].forced);
    assert!(page.refusal(Wish::Target(force("5"))).contains('5'));
    page.target(TargetWish::Unforce { operand: None });
    page.pass(300);
    assert_eq!(texts(&page), ["1", "1", ""]);
    page.target(TargetWish::Stop);
    page.pass(300);
    assert_eq!(page.status().mode, "STOP");
    let outputs = |event: &Event| match event {
        Event::Pins { outputs, .. } => Some(*outputs),
        _ => None,
    };
    assert_eq!(page.last(outputs), Some(0), "outputs are off in STOP");
}

#[test]
fn a_pause_stands_still_and_single_scans_go_on() {
    let mut page = Page::with("count.awl", "LD SM0.0\nINCW MW0\n");
    page.wish(look(&["MW0"]));
    page.target(TargetWish::Run);
    page.pass(500);
    page.target(TargetWish::Pause { on: true });
    page.pass(100);
    let time_ms = page.status().time_ms;
    page.pass(1000);
    assert_eq!((page.status().mode.as_str(), page.status().time_ms), ("PAUSE", time_ms));
    page.target(TargetWish::SingleScan);
    page.pass(100);
    let first: f64 = page.watched()[0].number.unwrap();
    page.target(TargetWish::SingleScan);
    page.pass(100);
    assert_eq!(page.watched()[0].number, Some(first + 1.0));
    assert_eq!(page.status().time_ms, time_ms + 2);
    page.target(TargetWish::Pause { on: false });
    page.pass(300);
    assert_eq!(page.status().mode, "RUN");
    assert!(page.status().time_ms >= time_ms + 290);
}

#[test]
fn a_statement_of_several_rungs_is_executed_whatever_they_come_to() {
    let text = "PROGRAM Main\nVAR\n    Delay : TON;\n    n : INT;\nEND_VAR\nCASE n OF\n\
        0: Delay(IN := TRUE, PT := T#8s);\n1: Delay(IN := FALSE);\nEND_CASE\n\
        IF %I0.0 THEN\n    n := 0;\nEND_IF\nEND_PROGRAM\n";
    let mut page = Page::with("a.st", text);
    assert_eq!(page.problems(), []);
    page.wish(view("a.st", 1, 40));
    page.target(TargetWish::Run);
    page.pass(300);
    let flow = |line: u32| page.live().get(&line).and_then(|one| one.flow.clone());
    let flows = [7, 8, 10, 11].map(|line| flow(line).unwrap_or_default());
    assert_eq!(flows, ["on", "skipped", "off", "skipped"]);
}

#[test]
fn simulations_and_tests_are_what_awl_sim_does() {
    let mut page = Page::with("station1.awl", STATION);
    let text = SCENARIO.to_owned();
    page.wish(Wish::Project(ProjectWish::Edit { file: "station1.scn".to_owned(), text }));
    assert_eq!(page.problems(), []);
    let wanted = ApartWish::Simulate {
        signals: vec!["Push".to_owned(), "Height".to_owned()],
        for_ms: 20_000,
        scan_ms: 1,
        plant: Some(PLANT.to_owned()),
    };
    let recording: Recording = page.answer(Wish::Apart(wanted));
    assert_eq!(recording.csv.lines().count(), 20_001);
    assert!(recording.csv.starts_with("time_ms,scan,Push,Height\n0,1,0,"));
    let (least, greatest, mean) = recording.figures[0];
    assert!(least == 0.0 && greatest == 1.0 && mean > 0.0 && mean < 0.5, "{mean}");
    assert_eq!(recording.columns[0].len(), recording.times.len());
    let test = || Wish::Apart(ApartWish::Test { file: "station1.scn".to_owned() });
    let result: TestResult = page.answer(test());
    assert!(result.passed && result.met > 0, "{result:?}");
    let wrong = "at 0ms I0.5 = 1\nat 1s expect Q0.0 = 5\n".to_owned();
    page.wish(Wish::Project(ProjectWish::Edit { file: "station1.scn".to_owned(), text: wrong }));
    let failed = page.refusal(test());
    assert!(failed.contains("station1.scn:2"), "{failed}");
}

#[test]
fn a_simulated_real_is_a_number() {
    let text =
        "PROGRAM Main\nVAR\n    Level : REAL;\nEND_VAR\nLevel := Level + 0.5;\nEND_PROGRAM\n";
    let mut page = Page::with("a.st", text);
    assert_eq!(page.problems(), []);
    let signals = vec!["Main.Level".to_owned()];
    let wanted = ApartWish::Simulate { signals, for_ms: 3, scan_ms: 1, plant: None };
    let recording: Recording = page.answer(Wish::Apart(wanted));
    assert_eq!(recording.csv, "time_ms,scan,Main.Level\n0,1,0.5\n1,2,1.0\n2,3,1.5\n");
}

#[test]
fn the_frequency_response_of_a_lag_is_measured() {
    let text = "PROGRAM Main\nVAR\n    X : REAL;\n    L : LAG;\nEND_VAR\n\
        L(X := X, T1 := T#200ms, TS := T#10ms);\nEND_PROGRAM\n";
    let mut page = Page::with("a.st", text);
    assert_eq!(page.problems(), []);
    let path = Path {
        excite: "Main.X".to_owned(),
        from: None,
        to: "Main.L.Y".to_owned(),
        low: 0.1,
        high: 10.0,
        amplitude: 1.0,
        offset: 0.5,
    };
    let wish = |path: &Path| {
        Wish::Apart(ApartWish::Sweep { path: path.clone(), scan_ms: 10, plant: None })
    };
    let response: FrequencyResponse = page.answer(wish(&path));
    let bandwidth = response.figures.bandwidth.unwrap_or_default();
    assert!((bandwidth - 0.808).abs() < 0.002, "{bandwidth}");
    assert_eq!((response.frequencies.len(), response.csv.lines().count()), (25, 26));
    assert!(response.phases[0].is_some_and(|phase| (-8.0..-6.0).contains(&phase)));
    assert!(response.settled.iter().all(|settled| *settled));
    for (wrong, said) in [
        (Path { to: "Main.L.Z".to_owned(), ..path.clone() }, "Main.L.Z"),
        (Path { low: 0.0, ..path.clone() }, "above 0 Hz"),
        (Path { low: 20.0, ..path.clone() }, "below the highest"),
        (Path { low: 1e-9, ..path.clone() }, "scans"),
        (Path { high: 60.0, ..path.clone() }, "less than 50.00 Hz"),
        (Path { amplitude: 0.0, ..path.clone() }, "amplitude"),
        (Path { excite: "Main.L.Y".to_owned(), ..path.clone() }, "writes"),
    ] {
        let message = page.refusal(wish(&wrong));
        assert!(message.contains(said), "{said}: {message}");
    }
}

#[test]
fn what_is_not_right_is_answered() {
    let mut page = Page::default();
    let json = page.session.request_json("{\"id\": 7, \"do\": \"dance\"}", 0);
    assert!(json.contains("\"is\":\"refused\""), "{json}");
    let message = page.refusal(Wish::Target(TargetWish::Run));
    assert!(message.contains(".awl"), "{message}");
    assert!(page.refusal(Wish::Target(TargetWish::Stop)).contains("Run or Connect"));
    let spec = Some("station2".to_owned());
    assert!(page.refusal(Wish::Target(TargetWish::Plant { spec })).contains("station2"));
    let wish = TargetWish::Speed { factor: -1.0 };
    assert!(page.refusal(Wish::Target(wish)).contains("-1"));
}

#[test]
fn an_edit_that_changes_nothing_keeps_the_values_and_another_program_ends_them() {
    let mut page = Page::with("lamp.awl", "LD I0.0\n= Q0.1\n");
    page.target(TargetWish::Run);
    page.wish(view("lamp.awl", 1, 3));
    page.pass(300);
    let mut edit = |text: &str| {
        let file = "lamp.awl".to_owned();
        page.wish(Wish::Project(ProjectWish::Edit { file, text: text.to_owned() }));
        page.pass(300);
        page.status().agreement
    };
    assert_eq!(edit("// a lamp\nLD I0.0\n= Q0.1\n"), "same");
    assert_eq!(edit("LD I0.1\n= Q0.1\n"), "other");
    assert_eq!(edit("LD I0.1\n= Q0.\n"), "other", "of a program with errors nothing is known");
}

#[test]
fn the_network_at_the_cursor_is_a_ladder_with_power_flow() {
    let mut page = Page::with("station1.awl", STATION);
    let at = STATION.find("NETWORK 4").unwrap() as u32 + 20;
    let file = || "station1.awl".to_owned();
    let ladder = |page: &mut Page| -> Option<Ladder> {
        page.answer(Wish::Text(TextWish::Ladder { file: file(), at }))
    };
    let shown = ladder(&mut page).unwrap();
    assert_eq!((shown.number, shown.rungs.len()), (Some(4), 1));
    let [rung] = &shown.rungs[..] else { panic!() };
    let first = &rung.elements[0];
    assert_eq!((first.shape.as_str(), first.is_switch), ("contact", true));
    assert_eq!(
        (first.pins[0].text.as_str(), first.pins[0].other.as_deref()),
        ("HasPiece", Some("M0.0"))
    );
    assert!(rung.elements.iter().all(|one| (shown.lines.0..=shown.lines.1).contains(&one.line)));
    page.target(TargetWish::Plant { spec: Some(PLANT.to_owned()) });
    page.wish(view("station1.awl", shown.lines.0, shown.lines.1));
    page.target(TargetWish::Run);
    // What was told at any time, contact by contact.
    let mut seen = vec![Vec::new(); rung.elements.len()];
    for _ in 0..60 {
        page.pass(100);
        let power = page.last(|event| match event {
            Event::Power { rungs, .. } => Some(rungs.clone()),
            _ => None,
        });
        let power = &power.unwrap()[0];
        assert!(power.nets.first().is_some_and(|rail| rail.is_none_or(|rail| rail)), "the rail");
        for (seen, &now) in seen.iter_mut().zip(&power.elements) {
            seen.extend(now);
        }
    }
    assert!(seen[0].contains(&true) && seen[0].contains(&false), "a piece comes and goes");
    // After an edit the page asks anew; what is not AWL is no ladder.
    let text = STATION.replace("NETWORK 4", "NETWORK 44");
    page.wish(Wish::Project(ProjectWish::Edit { file: file(), text }));
    assert_eq!(ladder(&mut page).unwrap().number, Some(44));
    let none: Option<Ladder> =
        page.answer(Wish::Text(TextWish::Ladder { file: "none.awl".to_owned(), at: 0 }));
    assert_eq!(none, None);
}

#[test]
fn power_flow_in_a_ladder_is_that_of_the_program() {
    let text = "LD I0.0\nLDW> MW0, 10\nO I0.1\nALD\nNOT\n= Q0.0\n";
    let mut page = Page::with("lamp.awl", text);
    let wish = TextWish::Ladder { file: "lamp.awl".to_owned(), at: 0 };
    let ladder: Option<Ladder> = page.answer(Wish::Text(wish));
    assert_eq!(ladder.unwrap().rungs[0].elements.len(), 5);
    page.wish(view("lamp.awl", 1, 6));
    page.target(TargetWish::Run);
    let elements = |page: &Page| -> Vec<Option<bool>> {
        let power = page.last(|event| match event {
            Event::Power { rungs, .. } => Some(rungs.clone()),
            _ => None,
        });
        power.unwrap()[0].elements.clone()
    };
    page.pass(500);
    // I0.0, MW0 > 10, I0.1; what goes into NOT, and into the coil.
    assert_eq!(elements(&page), [false, false, false, false, true].map(Some));
    for input in ["I0.0", "I0.1"] {
        page.target(TargetWish::Drive { operand: input.to_owned(), value: 1 });
    }
    page.pass(500);
    assert_eq!(elements(&page), [true, false, true, true, false].map(Some));
    page.target(TargetWish::Drive { operand: "I0.1".to_owned(), value: 0 });
    page.target(TargetWish::Set { operand: "MW0".to_owned(), value: "11".to_owned() });
    page.pass(500);
    assert_eq!(elements(&page), [true, true, false, true, false].map(Some));
}

#[test]
fn structured_text_of_two_files() {
    let mut page = Page::default();
    let blocks = "FUNCTION Next : INT\nVAR_INPUT\n    x : INT;\nEND_VAR\nNext := x + 1;\n\
        END_FUNCTION\n";
    let main = "PROGRAM Main\nVAR\n    n : INT;\nEND_VAR\nn := Next(n);\n\nEND_PROGRAM\n";
    let scenario = "at 5ms expect Main.n = 5\nat 5ms expect Main.n = 4\nrun 10ms\n";
    let files = [("blocks.st", blocks), ("main.st", main), ("main.scn", scenario)]
        .map(|(name, text)| File { name: name.to_owned(), text: text.to_owned() });
    page.wish(Wish::Project(ProjectWish::Open { files: files.to_vec(), main: None }));
    assert_eq!(page.problems(), []);
    // What can be written has holes.
    let at = main.find("\n\nEND").unwrap() as u32 + 1;
    let file = "main.st".to_owned();
    let found: Vec<ide_core::protocol::Completion> =
        page.answer(Wish::Text(TextWish::Complete { file: file.clone(), at }));
    let one = found.iter().find(|one| one.label == "IF").unwrap();
    assert_eq!((one.insert.as_str(), &one.holes[..]), ("IF  THEN\n    \nEND_IF;", &[3, 13][..]));
    let edits: ide_core::protocol::Edits =
        page.answer(Wish::Text(TextWish::Format { file: file.clone() }));
    assert_eq!(edits.len(), 0, "it has its layout");
    // Both files run, and each has its values: those of a function right after its statements.
    page.wish(look(&["Main.n"]));
    page.wish(view("main.st", 1, 7));
    page.target(TargetWish::Run);
    page.pass(300);
    assert_eq!(page.status().mode, "RUN");
    assert!(page.watched()[0].number.is_some_and(|n| n > 100.0), "{:?}", page.watched());
    let live = page.live();
    assert_eq!(live.keys().copied().collect::<Vec<_>>(), [5]);
    let number = |line: &Line, name: &str| {
        let value = line.values.iter().find(|value| value.name == name);
        value.unwrap_or_else(|| panic!("{name} in {line:?}")).number.unwrap()
    };
    assert!(number(&live[&5], "Main.n") > 100.0, "{live:?}");
    page.wish(view("blocks.st", 1, 6));
    page.pass(300);
    let line = &page.live()[&5];
    assert_eq!(line.flow.as_deref(), Some("on"));
    assert_eq!(
        line.values.iter().map(|one| one.name.as_str()).collect::<Vec<_>>(),
        ["#Next", "#x"]
    );
    assert_eq!(number(line, "#Next"), number(line, "#x") + 1.0);
    page.wish(view("main.scn", 1, 6));
    page.pass(300);
    assert!(page.live().is_empty(), "it is no part of the program");
    let result: TestResult =
        page.answer(Wish::Apart(ApartWish::Test { file: "main.scn".to_owned() }));
    assert_eq!(result.failures.len(), 1, "{result:?}");
    // An error in one file keeps the program from running.
    let text = blocks.replace("x + 1", "y + 1");
    page.wish(Wish::Project(ProjectWish::Edit { file: "blocks.st".to_owned(), text }));
    assert_eq!(page.problems()[0].file, "blocks.st");
    assert_eq!(page.refusal(Wish::Target(TargetWish::Download)), "main.st has an error");
}

#[test]
fn beside_a_statement_stands_what_has_become_of_it() {
    let text = "PROGRAM Main\nVAR\n    Lamp AT %Q0.0 : BOOL;\n    n : INT;\nEND_VAR\n\
        IF %I0.0 THEN\n    Lamp := TRUE;\nELSIF %I0.1 THEN\n    Lamp := FALSE;\nELSE\n    \
        n := 7;\nEND_IF\nWHILE n > 3\n  AND %I0.2 DO\n    n := n - 1;\nEND_WHILE\nCASE n OF\n  \
        7: n := 8;\n  3: n := 9;\n  9: n := 7;\nEND_CASE\nEND_PROGRAM\n";
    let mut page = Page::with("lamp.st", text);
    assert_eq!(page.problems(), []);
    page.wish(view("lamp.st", 1, 40));
    page.target(TargetWish::Run);
    page.pass(300);
    let flow = |page: &Page, line: u32| page.live().get(&line).and_then(|one| one.flow.clone());
    let flows = |page: &Page, lines: &[u32]| -> Vec<String> {
        lines.iter().map(|&line| flow(page, line).unwrap_or_default()).collect()
    };
    let branches = [6, 7, 8, 9, 11];
    assert_eq!(flows(&page, &branches), ["off", "skipped", "off", "skipped", "on"]);
    assert_eq!(flows(&page, &[13, 14, 15]), ["off", "off", "skipped"], "a condition of two lines");
    assert_eq!(flows(&page, &[17, 18, 19, 20]), ["on", "on", "skipped", "skipped"]);
    let names = |page: &Page, line: u32| -> Vec<String> {
        page.live()[&line].values.iter().map(|value| value.name.clone()).collect()
    };
    assert_eq!(
        (names(&page, 7), names(&page, 13)),
        (vec!["Main.Lamp".into()], vec!["Main.n".into()])
    );
    assert_eq!(names(&page, 14), ["I0.2"]);
    let drive = |page: &mut Page, operand: &str| {
        page.target(TargetWish::Drive { operand: operand.to_owned(), value: 1 });
        page.pass(300);
    };
    drive(&mut page, "I0.1");
    assert_eq!(flows(&page, &branches), ["off", "skipped", "on", "on", "skipped"]);
    drive(&mut page, "I0.0");
    assert_eq!(flows(&page, &branches), ["on", "on", "off", "skipped", "skipped"]);
    let lamp = page.live()[&7].values[0].clone();
    assert_eq!((lamp.number, lamp.can_force), (Some(1.0), true));
    // Other lines than those of the program have none.
    page.wish(view("lamp.st", 9, 10));
    page.pass(300);
    assert_eq!(page.live().keys().copied().collect::<Vec<_>>(), [9]);
}
