//! The charts of the IDE, asked as the page asks.

use ide_charts::Charts;
use serde_json::{Value, json};

const STATION: &str = include_str!("../../../examples/grafcet/station1.sfc");

/// What asks, with the text as an editor would have it.
struct Page {
    charts: Charts,
    text: String,
}

impl Page {
    fn with(text: &str) -> Page {
        Page { charts: Charts::default(), text: text.to_owned() }
    }

    fn ask(&mut self, mut question: Value) -> Result<Value, String> {
        let more = [("id", json!(7)), ("name", json!("Plant")), ("text", json!(self.text))];
        for (key, value) in more {
            question[key] = value;
        }
        let reply = self.charts.request_json(&question.to_string());
        let reply: Value = serde_json::from_str(&reply).unwrap();
        assert_eq!(reply["id"], 7);
        match reply["refused"].as_str() {
            Some(message) => Err(message.to_owned()),
            None => Ok(reply["answer"].clone()),
        }
    }

    fn draw(&mut self) -> Value {
        self.ask(json!({ "do": "draw" })).unwrap()
    }

    /// Carries edits of a chart out; gives what is to be selected.
    fn edit(&mut self, chart: usize, edits: Value) -> Result<Vec<String>, String> {
        let answer = self.ask(json!({ "do": "edit", "chart": chart, "edits": edits }))?;
        self.text = answer["text"].as_str().unwrap().to_owned();
        // The text is all there is: read anew it gives the same drawing, but for identities.
        let mut anew = Page::with(&self.text);
        assert_eq!(without_ids(anew.draw()), without_ids(answer["charts"].clone()));
        Ok(serde_json::from_value(answer["select"].clone()).unwrap())
    }
}

fn without_ids(mut charts: Value) -> Value {
    for sheet in charts["sheets"].as_array_mut().unwrap() {
        let elements = ["steps", "transitions"].map(|kind| sheet[kind].take());
        for mut element in elements.into_iter().flat_map(|all| all.as_array().unwrap().clone()) {
            for key in ["id", "from", "to"] {
                if let Some(fields) = element.as_object_mut() {
                    fields.remove(key);
                }
            }
            sheet["elements"] = json!([sheet["elements"].take(), element]);
        }
    }
    charts
}

#[test]
fn a_file_is_drawn_with_what_can_be_edited() {
    let mut page = Page::with(STATION);
    let charts = page.draw();
    assert_eq!((&charts["obstacle"], &charts["mistake"]), (&Value::Null, &Value::Null));
    let names: Vec<&Value> =
        charts["sheets"].as_array().unwrap().iter().map(|sheet| &sheet["name"]).collect();
    assert_eq!(names[..2], ["Station", "Station.Measuring"]);
    let sheet = &charts["sheets"][0];
    assert_eq!(sheet["isGrafcet"], true);
    assert_eq!(
        (&sheet["steps"][3]["name"], &sheet["steps"][3]["look"]),
        (&json!("Gauge"), &json!("macro"))
    );
    let lines: Vec<&str> = STATION.lines().collect();
    for sheet in charts["sheets"].as_array().unwrap() {
        for step in sheet["steps"].as_array().unwrap() {
            let line = lines[step["line"].as_u64().unwrap() as usize - 1];
            let name = step["fullName"].as_str().unwrap();
            assert!(line.contains(&format!("STEP {name} ")), "{name} in {line}");
        }
    }
}

#[test]
fn a_chart_is_drawn_from_nothing() {
    let mut page = Page::with("");
    let empty = page.draw();
    assert_eq!(empty["sheets"][0]["name"], "Plant");
    assert_eq!(empty["sheets"][0]["steps"], json!([]));
    let first = page.edit(0, json!([{ "addStep": { "at": null, "isInitial": true } }])).unwrap();
    assert_eq!(first.len(), 1);
    let second = page.edit(0, json!([{ "addAfter": { "of": first[0] } }])).unwrap();
    let rename = json!([{ "rename": { "step": first[0], "name": "Wait" } },
        { "insertAction": { "step": first[0], "index": 0,
            "action": { "qualifier": "L", "time": "T#2s", "action": "Lamp" } } }]);
    page.edit(0, rename).unwrap();
    let back = json!([{ "connect": { "from": [second[0]], "to": [first[0]] } }]);
    let back = page.edit(0, back).unwrap();
    let condition = json!([{ "setCondition": { "transition": back[0], "text": "Stop" } }]);
    page.edit(0, condition).unwrap();
    let sheet = page.draw()["sheets"][0].clone();
    let wait = &sheet["steps"][0];
    assert_eq!((&wait["fullName"], &wait["isInitial"]), (&json!("Wait"), &json!(true)));
    let written = json!({ "qualifier": "L", "time": "T#2s", "action": "Lamp" });
    assert_eq!(wait["actions"][0]["written"], written);
    assert_eq!(sheet["transitions"].as_array().unwrap().len(), 2);
    assert!(page.text.contains(":= Stop;"), "{}", page.text);
}

#[test]
fn all_edits_are_carried_out_or_none() {
    let mut page = Page::with("INITIAL_STEP A: END_STEP");
    let id = page.draw()["sheets"][0]["steps"][0]["id"].clone();
    let edits = json!([{ "addAfter": { "of": id } }, { "rename": { "step": id, "name": "STEP" } }]);
    assert_eq!(page.edit(0, edits).unwrap_err(), "STEP: a word of the language names nothing");
    assert_eq!(page.draw()["sheets"][0]["steps"].as_array().unwrap().len(), 1);
    let wrong = json!([{ "insertAction": { "step": id, "index": 0,
        "action": { "qualifier": "Q", "time": null, "action": "Lamp" } } }]);
    let message = page.edit(0, wrong).unwrap_err();
    assert!(message.starts_with("Q is no qualifier: there are N, S, R, L,"), "{message}");
    let no_step = json!([{ "rename": { "step": "t1", "name": "B" } }]);
    assert_eq!(page.edit(0, no_step).unwrap_err(), "t1 is no step");
    assert_eq!(page.edit(9, json!([])).unwrap_err(), "there is no such chart in the file");
    let message = page.edit(0, json!([{ "fly": {} }])).unwrap_err();
    assert!(message.contains("unknown variant `fly`"), "{message}");
}

#[test]
fn what_is_allowed_is_told_and_nothing_changes() {
    let mut page = Page::with("INITIAL_STEP A: END_STEP");
    let before = page.draw();
    let id = before["sheets"][0]["steps"][0]["id"].clone();
    let edits = json!([{ "addAfter": { "of": id } }, { "layout": {} },
        { "erase": { "elements": [id] } }]);
    let question = json!({ "do": "allowed", "chart": 0, "edits": edits });
    let answer = page.ask(question).unwrap();
    let reason = "nothing has a place: the layout is automatic already";
    assert_eq!((&answer[0], &answer[1]), (&Value::Null, &json!(reason)));
    assert_eq!(page.draw(), before);
}

#[test]
fn a_text_with_a_mistake_is_drawn_and_not_edited() {
    let mut page = Page::with(
        "INITIAL_STEP A: END_STEP\nSTEP B: END_STEP\nTRANSITION FROM A TO C := TRUE; END_TRANSITION\n",
    );
    let charts = page.draw();
    assert_eq!(charts["sheets"][0]["steps"].as_array().unwrap().len(), 2);
    assert_eq!(charts["mistake"]["line"], 3);
    let message = page.edit(0, json!([{ "layout": {} }])).unwrap_err();
    assert!(message.starts_with("the text is to be mended first, line 3: "), "{message}");
}

#[test]
fn steps_go_where_they_are_dragged_and_the_others_stay() {
    // The second step is written so close that the drawing moves it away.
    let mut page = Page::with(
        "INITIAL_STEP A {at 100 100}: END_STEP\nSTEP B {at 100 110}: END_STEP\n\
         STEP C {at 400 100}: END_STEP\nTRANSITION FROM A TO B := TRUE; END_TRANSITION\n",
    );
    let sheet = page.draw()["sheets"][0].clone();
    assert_eq!(sheet["isPlaced"], true);
    let middle = |sheet: &Value, at: usize| {
        let frame: [i32; 4] = serde_json::from_value(sheet["steps"][at]["frame"].clone()).unwrap();
        let origin: (i32, i32) = serde_json::from_value(sheet["origin"].clone()).unwrap();
        (frame[0] + frame[2] / 2 - origin.0, frame[1] + frame[3] / 2 - origin.1)
    };
    let before: Vec<_> = (0..3).map(|at| middle(&sheet, at)).collect();
    let (x, y) = before[2];
    let to = (x + 50, y + 200);
    let edit = json!([{ "place": { "elements": [[sheet["steps"][2]["id"], to]] } }]);
    page.edit(0, edit).unwrap();
    let sheet = page.draw()["sheets"][0].clone();
    let after: Vec<_> = (0..3).map(|at| middle(&sheet, at)).collect();
    assert_eq!(after, [before[0], before[1], to]);
}

#[test]
fn a_copy_can_be_pasted() {
    let mut page = Page::with("INITIAL_STEP A: Lamp; END_STEP");
    let id = page.draw()["sheets"][0]["steps"][0]["id"].clone();
    let copy = page.ask(json!({ "do": "copy", "chart": 0, "steps": [id] })).unwrap();
    page.edit(0, json!([{ "paste": { "text": copy, "at": null } }])).unwrap();
    let sheet = page.draw()["sheets"][0].clone();
    let names: Vec<&Value> =
        sheet["steps"].as_array().unwrap().iter().map(|step| &step["fullName"]).collect();
    assert_eq!(names, ["A", "A2"]);
    assert_eq!(sheet["steps"][1]["actions"][0]["name"], "Lamp");
}
