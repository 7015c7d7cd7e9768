//! Charts edited as the page does it: edits in, the text of the file out.

use std::collections::BTreeMap;

use ide_core::Session;
use ide_core::protocol::chart::Chart;
use ide_core::protocol::chart_edit::{Allowed, Copied, Edited};
use ide_core::protocol::{Event, File, ProjectWish, Request, TargetWish, TextWish, Wish};
use serde_json::{Value, json};

const FILE: &str = "line.sfc";

/// A page without pixels that shows a chart.
#[derive(Default)]
struct Page {
    session: Session,
    now_ms: u64,
    id: u32,
}

impl Page {
    fn empty() -> Page {
        let mut page = Page::default();
        let files = vec![File { name: FILE.to_owned(), text: String::new() }];
        page.wish(Wish::Project(ProjectWish::Open { files, main: None }));
        page
    }

    fn wish(&mut self, wish: Wish) -> Vec<Event> {
        self.id += 1;
        let events = self.session.request(Request { id: self.id, wish }, self.now_ms);
        let is_refused = |event: &Event| matches!(event, Event::Refused { .. });
        assert!(!events.iter().any(is_refused), "{events:?}");
        events
    }

    fn answer<T: serde::de::DeserializeOwned>(&mut self, wish: Value) -> T {
        let wish: TextWish = serde_json::from_value(wish).expect("a wish");
        let events = self.wish(Wish::Text(wish));
        let found = events.into_iter().find_map(|event| match event {
            Event::Answer { answer, .. } => Some(answer),
            _ => None,
        });
        serde_json::from_value(found.expect("an answer")).expect("the answer's form")
    }

    fn edited(&mut self, edits: &Value) -> Edited {
        self.answer(json!({ "do": "editChart", "file": FILE, "edits": edits }))
    }

    /// The text that comes back is the text of the file then.
    fn edit(&mut self, edits: &Value) -> Vec<String> {
        let edited = self.edited(edits);
        assert_eq!(edited.refusal, None, "{edits}");
        self.text(&edited.text.expect("a text"));
        edited.select
    }

    fn refused(&mut self, edits: &Value) -> String {
        let edited = self.edited(edits);
        assert_eq!(edited.text, None);
        edited.refusal.expect("a refusal")
    }

    fn text(&mut self, text: &str) {
        let (file, text) = (FILE.to_owned(), text.to_owned());
        self.wish(Wish::Project(ProjectWish::Edit { file, text }));
    }

    fn chart(&mut self) -> Option<Chart> {
        self.answer(json!({ "do": "chart", "file": FILE }))
    }

    /// The middles of the steps, in the coordinates of the text.
    fn middles(&mut self) -> Vec<(i32, i32)> {
        let chart = self.chart().expect("a chart");
        let (left, top) = chart.sheets[0].origin;
        let middle = |[x, y, width, height]: [i32; 4]| (x + width / 2 - left, y + height / 2 - top);
        chart.sheets[0].steps.iter().map(|step| middle(step.frame)).collect()
    }

    fn allowed(&mut self, steps: &[&str], transitions: &[u32]) -> BTreeMap<String, Option<String>> {
        let selection = json!({ "steps": steps, "transitions": transitions });
        let wish = json!({ "do": "chartEdits", "file": FILE, "sheet": 0, "selection": selection });
        let all: Vec<Allowed> = self.answer(wish);
        all.into_iter().map(|one| (one.kind, one.refusal)).collect()
    }
}

fn first() -> Value {
    json!({ "kind": "addStep", "sheet": 0, "at": null, "initial": true })
}

fn after(step: &str) -> Value {
    json!({ "kind": "addStepAfter", "sheet": 0, "step": step })
}

#[test]
fn a_chart_of_twenty_steps_is_built_by_edits_and_runs() {
    let mut page = Page::empty();
    assert_eq!(page.chart(), None);
    assert_eq!(page.edit(&json!([first()])), ["S1"]);
    for number in 1..18 {
        let select = page.edit(&json!([after(&format!("S{number}"))]));
        assert_eq!(select, [format!("S{}", number + 1)]);
    }
    let end = json!([
        { "kind": "addBranch", "sheet": 0, "step": "S3", "parallel": true },
        { "kind": "setTransition", "sheet": 0, "transition": 3, "name": "Join", "priority": null,
          "from": ["S4", "S19"], "to": ["S5"] },
        { "kind": "addBranch", "sheet": 0, "step": "S10", "parallel": false },
        { "kind": "connect", "sheet": 0, "from": ["S20"], "to": ["S13"] },
        { "kind": "setCondition", "sheet": 0, "transition": 9, "text": "NOT %M0.0" },
        { "kind": "setAction", "sheet": 0, "step": "S11", "index": 0, "qualifier": "S",
          "time": null, "action": "%M0.0" },
        { "kind": "setAction", "sheet": 0, "step": "S20", "index": 0, "qualifier": "R",
          "time": null, "action": "%M0.0" },
        { "kind": "connect", "sheet": 0, "from": ["S18"], "to": ["S1"] },
        { "kind": "setAction", "sheet": 0, "step": "S18", "index": 0, "qualifier": "N",
          "time": null, "action": "%Q0.0" },
        { "kind": "setCondition", "sheet": 0, "transition": 0, "text": "%I0.0" },
        { "kind": "rename", "sheet": 0, "step": "S1", "name": "Wait" },
    ]);
    assert_eq!(page.edit(&end), ["Wait"]);
    let chart = page.chart().expect("a chart");
    let sheet = &chart.sheets[0];
    assert_eq!((sheet.steps.len(), sheet.transitions.len()), (20, 20));
    assert_eq!((sheet.steps[0].full_name.as_str(), sheet.is_placed), ("Wait", false));
    let begin = &sheet.transitions[0];
    assert_eq!((begin.condition.as_str(), &begin.to[..]), ("%I0.0", &[1][..]));
    let instance = sheet.steps[17].actions[0].instance.clone().expect("an instance");
    assert_eq!((instance.action.as_str(), instance.qualifier.as_str()), ("%Q0.0", "N"));
    page.wish(Wish::Target(TargetWish::Run));
    let drive = TargetWish::Drive { operand: "I0.0".to_owned(), value: 1 };
    page.wish(Wish::Target(drive));
    let mut seen = [false; 20];
    for _ in 0..300 {
        page.now_ms += 60;
        for event in page.session.tick(page.now_ms, 1) {
            let Event::Situation { steps, .. } = event else { continue };
            for (seen, active) in seen.iter_mut().zip(&steps[0]) {
                *seen |= *active == Some(true);
            }
        }
    }
    // S10 is left in both ways, one after the other.
    assert_eq!(seen, [true; 20]);
}

#[test]
fn moving_a_step_keeps_the_others_where_they_are() {
    let mut page = Page::empty();
    page.edit(&json!([first(), after("S1"), after("S2")]));
    let before = page.middles();
    let mut at = (before[1].0 + 200, before[1].1);
    for _ in 0..3 {
        let steps = json!([{ "name": "S2", "at": at }]);
        let place = json!([{ "kind": "place", "sheet": 0, "steps": steps, "transitions": [] }]);
        assert_eq!(page.edit(&place), ["S2"]);
        assert_eq!(page.middles(), [before[0], at, before[2]]);
        assert!(page.chart().expect("a chart").sheets[0].is_placed);
        at.0 += 30;
    }
    page.edit(&json!([{ "kind": "layout", "sheet": 0 }]));
    assert_eq!(page.middles(), before);
    // A step that is put somewhere keeps the others, too.
    let at = (before[0].0 + 300, before[0].1);
    page.edit(&json!([{ "kind": "addStep", "sheet": 0, "at": at, "initial": false }]));
    assert_eq!(page.middles(), [before[0], before[1], before[2], at]);
}

#[test]
fn edits_are_refused_as_a_whole() {
    let mut page = Page::empty();
    page.edit(&json!([first(), after("S1")]));
    let erase = json!({ "kind": "erase", "sheet": 0, "steps": ["S1"], "transitions": [] });
    let message = "S1 is the initial step: another one must be made that first";
    assert_eq!(page.refused(&json!([after("S1"), erase])), message);
    assert_eq!(page.chart().expect("a chart").sheets[0].steps.len(), 2);
    let elsewhere = json!([{ "kind": "layout", "sheet": 1 }]);
    assert_eq!(page.refused(&elsewhere), "there is no such chart in the file");
    page.text("INITIAL_STEP A:\nEND_STEP\nTRANSITION FROM A TO B := x; END_TRANSITION\n");
    let message = "line 3: B: there is no step of this name: the text is to be mended first";
    assert_eq!(page.refused(&json!([first()])), message);
    assert_eq!(page.allowed(&[], &[])["addStep"].as_deref(), Some(message));
}

#[test]
fn what_is_allowed_is_told_before() {
    let mut page = Page::empty();
    assert_eq!(page.allowed(&[], &[])["addStep"], None);
    page.edit(&json!([first(), after("S1")]));
    let all = page.allowed(&["S1"], &[]);
    let refusal = |kind: &str| all[kind].as_deref();
    assert_eq!((refusal("addStepAfter"), refusal("rename")), (None, None));
    let message = "S1 is the initial step: another one must be made that first";
    assert_eq!(refusal("erase"), Some(message));
    assert_eq!(refusal("connect"), Some("two steps are to be selected"));
    assert_eq!(refusal("removeAction"), Some("S1: its block has 0 actions"));
    assert_eq!(all.len(), 23);
    let all = page.allowed(&["S2", "S1"], &[]);
    assert_eq!((&all["connect"], &all["copy"], &all["erase"]), (&None, &None, &None));
    let all = page.allowed(&[], &[0]);
    assert_eq!((&all["addParallelBranch"], &all["setCondition"]), (&None, &None));
    let selection = json!({ "steps": ["S2"], "transitions": [] });
    let wish = json!({ "do": "copyChart", "file": FILE, "sheet": 0, "selection": selection });
    let copied: Copied = page.answer(wish);
    assert_eq!(copied.text.as_deref(), Some("STEP S2:\nEND_STEP\n"));
}
