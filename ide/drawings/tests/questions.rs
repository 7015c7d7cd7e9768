//! The drawings of the IDE, asked as the page asks.

use ide_drawings::Drawings;
use serde_json::{Value, json};

const STATION: &str = include_str!("../../../examples/grafcet/station1.sfc");

/// What asks, with the text as an editor would have it.
struct Page {
    drawings: Drawings,
    text: String,
}

impl Page {
    fn with(text: &str) -> Page {
        Page { drawings: Drawings::default(), text: text.to_owned() }
    }

    fn ask(&mut self, mut question: Value) -> Result<Value, String> {
        let more = [("id", json!(7)), ("name", json!("Plant")), ("text", json!(self.text))];
        for (key, value) in more {
            question[key] = value;
        }
        let reply = self.drawings.request_json(&question.to_string());
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

const TANK: &str = "PROGRAM Tank
VAR Level : INT; Start AT %I0.0 : BOOL; END_VAR
INITIAL_STEP Wait: END_STEP
STEP Fill: END_STEP
STEP Drain: Stir; END_STEP
TRANSITION FROM Wait TO Fill := Start AND (Open OR NOT Hand) AND Level < 3; END_TRANSITION
TRANSITION FROM Fill TO Drain := Fill.T >= T#2s OR %IX0.1; END_TRANSITION
TRANSITION FROM Drain TO Wait := R_EDGE(Start) AND NOT (Open AND Hand); END_TRANSITION
ACTION Stir:
    INITIAL_STEP Left: END_STEP
    STEP Right: END_STEP
    TRANSITION FROM Left TO Right := Drain.X AND Speed[2] > 0; END_TRANSITION
    TRANSITION FROM Right TO Left := TRUE; END_TRANSITION
END_ACTION
END_PROGRAM
";

#[test]
fn the_variables_of_conditions_are_named_as_the_program_may_have_them() {
    let sheets = Page::with(TANK).draw()["sheets"].clone();
    let operands = |sheet: usize, at: usize| sheets[sheet]["transitions"][at]["operands"].clone();
    let level = json!({ "written": "Level", "kind": "number",
        "names": ["Tank.Level", "Level", "Tank.Stir.Level"] });
    assert_eq!(operands(0, 0).as_array().unwrap().len(), 4);
    assert_eq!(operands(0, 0)[3], level);
    let time = json!({ "written": "Fill.T", "kind": "time",
        "names": ["Tank.Fill.T", "Fill.T", "Tank.Stir.Fill.T"] });
    let input = json!({ "written": "%IX0.1", "kind": "truth", "names": ["I0.1"] });
    assert_eq!(operands(0, 1), json!([time, input]));
    let step = json!([
        "Tank.Stir.Drain.X",
        "Tank.Stir.Drain",
        "Tank.Drain.X",
        "Tank.Drain",
        "Drain.X",
        "Drain"
    ]);
    assert_eq!(operands(1, 0)[0]["names"], step);
    assert_eq!(operands(1, 0)[1]["names"], json!([]), "an element of an array has no name");
}

#[test]
fn conditions_are_judged_and_say_what_is_missing() {
    let mut page = Page::with(TANK);
    let ids: Vec<Value> = page.draw()["sheets"][0]["transitions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|transition| transition["id"].clone())
        .collect();
    let mut judge = |at: usize, values: Value| {
        let one = json!([{ "chart": 0, "transition": ids[at], "values": values }]);
        let answer = page.ask(json!({ "do": "judge", "transitions": one })).unwrap();
        (answer[0]["isTrue"].as_bool(), answer[0]["waitsFor"].as_str().unwrap().to_owned())
    };
    // Start, Open, Hand, Level.
    let all = "Start AND (Open OR NOT Hand) AND Level < 3";
    assert_eq!(judge(0, json!([0, 0, 1, 3])), (Some(false), all.to_owned()));
    assert_eq!(judge(0, json!([1, 0, 0, 3])), (Some(false), "Level < 3".to_owned()));
    assert_eq!(judge(0, json!([1, 1, 1, 2])), (Some(true), String::new()));
    // What decides need not be all that is known.
    assert_eq!(judge(0, json!([0, null, 0, 1])), (Some(false), "Start".to_owned()));
    assert_eq!(judge(0, json!([1, null, 1, 1])), (None, String::new()));
    let either = "Fill.T >= T#2s OR %IX0.1";
    assert_eq!(judge(1, json!([1999, 0])), (Some(false), either.to_owned()));
    assert_eq!(judge(1, json!([2000, 0])), (Some(true), String::new()));
    // An edge is no value; it may be all that is missing.
    let edge = "R_EDGE(Start) AND (NOT Open OR NOT Hand)";
    assert_eq!(judge(2, json!([1, 1, 1])), (Some(false), edge.to_owned()));
    assert_eq!(judge(2, json!([1, 0, 1])), (None, String::new()));
}

#[test]
fn the_chart_of_a_macro_step_can_be_folded() {
    let mut page = Page::with(STATION);
    let all = page.draw();
    assert_eq!(all["sheets"][0]["steps"][3]["expansion"], 1);
    assert_eq!(all["sheets"][1]["isFolded"], false);
    let folded = page.ask(json!({ "do": "draw", "folded": ["Station.Measuring"] })).unwrap();
    let count = |charts: &Value| charts["sheets"].as_array().unwrap().len();
    assert_eq!(count(&folded), count(&all), "the others keep their numbers");
    assert_eq!(folded["sheets"][1]["isFolded"], true);
    assert_eq!(folded["sheets"][1]["steps"], json!([]));
    assert_eq!(folded["sheets"][0], all["sheets"][0]);
    let area =
        |charts: &Value| charts["width"].as_i64().unwrap() * charts["height"].as_i64().unwrap();
    assert!(area(&folded) < area(&all), "its room is free");
}

#[test]
fn charts_of_sfcedit_become_programs_with_the_kinds_that_are_chosen() {
    let text = include_str!("../../../lang/chart/tests/sfcedit/ejemplo.xml");
    let mut page = Page::with(text);
    let mut convert = |variables: &str, target: &str| {
        page.ask(json!({ "do": "convert", "variables": variables, "target": target }))
    };
    let first = convert("", "uno200").unwrap();
    let kind = |answer: &Value, name: &str| {
        let all = answer["variables"].as_array().unwrap().clone();
        all.into_iter().find(|one| one["name"] == name).unwrap()["kind"].clone()
    };
    assert_eq!((kind(&first, "T0_1"), kind(&first, "A1")), (json!("input"), json!("output")));
    for (target, words, ending) in [
        ("twincat", "FUNCTION_BLOCK GEjemplo", "st"),
        ("pl7", "IF", "st"),
        ("plcopen", "<project", "xml"),
        ("uno200", "FUNCTION_BLOCK GEjemplo", "st"),
    ] {
        let answer = convert("T0_1,memory,BOOL\n", target).unwrap();
        assert!(answer["program"].as_str().unwrap().contains(words), "{target}");
        assert_eq!((&answer["ending"], kind(&answer, "T0_1")), (&json!(ending), json!("memory")));
        assert!(answer["equations"].as_str().unwrap().contains("X2.X3 + Init + Reset"));
    }
    let wrong = convert("T0_1,memori,BOOL\n", "uno200").unwrap();
    assert_eq!(wrong["program"], Value::Null);
    let problem = &wrong["problems"][0];
    assert_eq!((&problem["isOfTable"], &problem["line"]), (&json!(true), &json!(1)));
    assert!(convert("", "logo").unwrap_err().contains("logo"));
}

#[test]
fn sums_that_can_have_wrapped_around_are_not_judged() {
    let mut page = Page::with(
        "INITIAL_STEP A: END_STEP STEP B: END_STEP\n\
         TRANSITION FROM A TO B := Level + 30000 > 5; END_TRANSITION",
    );
    let id = page.draw()["sheets"][0]["transitions"][0]["id"].clone();
    let mut judge = |level: i32| {
        let one = json!([{ "chart": 0, "transition": id, "values": [level] }]);
        let answer = page.ask(json!({ "do": "judge", "transitions": one })).unwrap();
        answer[0]["isTrue"].as_bool()
    };
    assert_eq!((judge(2767), judge(2768), judge(-30_000)), (Some(true), None, Some(false)));
    assert_eq!(judge(-30_001), None);
}

#[test]
fn diagrams_are_drawn_with_what_their_project_has() {
    let text = "PROGRAM Main\nVAR A : OWN; Loop : PID := (KP := 2.0); END_VAR\n\
                A(IN := {feedback} Loop.U);\nLoop(SP := A.OUT);\nEND_PROGRAM\n";
    let own = "FUNCTION_BLOCK OWN VAR_INPUT IN, BIAS : REAL; END_VAR\n\
        VAR_OUTPUT OUT : REAL; END_VAR\n\
               OUT := IN + BIAS; END_FUNCTION_BLOCK\n";
    let mut page = Page::with(text);
    let ask = |page: &mut Page, others: Value| {
        page.ask(json!({ "do": "diagrams", "others": others })).unwrap()
    };
    let drawn = ask(&mut page, json!([own]));
    let sheet = &drawn["sheets"][0];
    assert_eq!((drawn["mistake"].clone(), sheet["name"].as_str()), (Value::Null, Some("Main")));
    let [a, pid] = &sheet["elements"].as_array().unwrap()[..] else { panic!("{sheet}") };
    assert_eq!(
        (a["id"].as_str(), a["block"].as_str(), a["line"].as_u64()),
        (Some("A"), Some("OWN"), Some(3))
    );
    assert_eq!(a["inputs"][1]["name"], "BIAS");
    assert_eq!(a["outputs"][0]["names"][0], "Main.A.OUT");
    let kp = pid["parameters"].as_array().unwrap().iter().find(|one| one["name"] == "KP").unwrap();
    assert_eq!((kp["value"].as_str(), kp["type"].as_str()), (Some("2.0"), Some("REAL")));
    let links = sheet["links"].as_array().unwrap();
    let ends: Vec<String> =
        links.iter().map(|one| format!("{}{}", one["from"], one["to"])).collect();
    assert_eq!(ends, ["[0,0][1,0]", "[1,0][0,0]"]);
    assert_eq!(links[1]["isFeedback"], true);

    // A change is one of the text, and is drawn with it; what is refused changes nothing.
    let edit = |page: &mut Page, edit: Value| {
        page.ask(json!({ "do": "editDiagram", "others": [own], "diagram": 0, "edit": edit }))
    };
    let call = json!({ "call": { "block": "OWN", "at": [40, 300] } });
    let edited = edit(&mut page, call).unwrap();
    assert_eq!(edited["new"], json!(["OWN1"]));
    assert!(edited["text"].as_str().unwrap().contains("Own1 : OWN;"));
    assert_eq!(edited["diagrams"]["sheets"][0]["elements"][2]["id"], "OWN1");
    let give = json!({ "give": { "element": "A", "input": "IN", "value": "(" } });
    assert!(edit(&mut page, give).is_err());
    let blocks = page.ask(json!({ "do": "blocks", "others": [own] })).unwrap();
    assert_eq!(
        (blocks[0]["name"].as_str(), blocks[0]["origin"].as_str()),
        (Some("OWN"), Some("project"))
    );
    assert!(blocks.as_array().unwrap().iter().any(|one| one["name"] == "PID"));

    // Without the text of its block, and with a mistake: what could be read is drawn.
    assert_eq!(ask(&mut page, json!([]))["sheets"][0]["elements"][0]["isUnknown"], true);
    page.text = text.replace("{feedback} ", "");
    let drawn = ask(&mut page, json!([own]));
    assert_eq!(drawn["mistake"]["line"], 3);
    assert_eq!(drawn["sheets"][0]["elements"].as_array().unwrap().len(), 2);
}
