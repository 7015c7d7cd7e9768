//! Blocks of IEC 61499, asked about as the page asks.

use ide_drawings::Drawings;
use serde_json::{Value, json};

const TANK: &str = include_str!("../../../examples/fbt/tank.fbt");

fn after(text: &str, lines: &[&str]) -> Result<Value, String> {
    let question =
        json!({ "id": 1, "do": "events", "name": "tank.fbt", "text": text, "lines": lines });
    let reply = Drawings::default().request_json(&question.to_string());
    let reply: Value = serde_json::from_str(&reply).unwrap();
    match reply["refused"].as_str() {
        Some(message) => Err(message.to_owned()),
        None => Ok(reply["answer"].clone()),
    }
}

#[test]
fn events_of_a_block() {
    let begin = after(TANK, &[]).unwrap();
    let names: Vec<_> = (0..2).map(|at| begin["states"][at]["name"].clone()).collect();
    assert_eq!(names, ["START", "E12"]);
    assert_eq!(begin["eventInputs"][0]["with"], json!(["Nivel", "Nivel_actual"]));
    assert_eq!((&begin["state"], &begin["cleared"]), (&json!(0), &json!([])));
    let sent = after(TANK, &["Nivel = 10.0, Nivel_actual = 5.0", "event Control"]).unwrap();
    // It has been through E12 and is at rest again.
    assert_eq!(
        (&sent["state"], &sent["cleared"], &sent["sent"]),
        (&json!(0), &json!([0, 1]), &json!([0]))
    );
    assert_eq!(sent["outputs"][0]["value"], "90.0");
    assert_eq!(sent["inputs"][1]["value"], "5.0");
    let told = "Control: START -> E12 -> START\n  Bomba Potencia = 90.0";
    assert_eq!(sent["told"][1], json!({ "text": told, "isWrong": false }));
}

#[test]
fn what_is_wrong_about_events() {
    let cases = [
        ("event Contro", "Contro: no event of the block; `Control` is one"),
        ("Nivel = high", "`high` is no value"),
        ("Potencia = 1.0", "no input of the block"),
        ("expect Potencia = 1.0", "Potencia is 0.0, not 1.0"),
    ];
    for (line, words) in cases {
        let answer = after(TANK, &["Nivel = 1.0", line, "event Control"]).unwrap();
        let told = &answer["told"][1];
        assert_eq!(told["isWrong"], true, "{told}");
        assert!(told["text"].as_str().unwrap().contains(words), "{told}");
        assert_eq!(answer["told"][2]["isWrong"], false, "the others are done");
    }
    let wrong = TANK.replace("Condition=\"Control\"", "Condition=\"Contro\"");
    let mistake = &after(&wrong, &[]).unwrap()["mistake"];
    assert_eq!(mistake["line"], 36, "{mistake}");
    let wrong = TANK.replace("Potencia := Pot_min;", "Potencia := ;");
    assert_eq!(after(&wrong, &[]).unwrap()["mistake"]["line"], 40);
    assert!(after("", &[]).unwrap()["mistake"]["message"].is_string());
    let refused = after(TANK, &vec!["event Control"; 10_001]).unwrap_err();
    assert!(refused.contains("begin anew"), "{refused}");
}
