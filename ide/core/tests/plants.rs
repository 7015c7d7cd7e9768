//! Plants that files of the project describe, faults, and hidden scenarios.

use ide_core::Session;
use ide_core::protocol::plant::PlantInfo;
use ide_core::protocol::{
    ApartWish, Event, File, ProjectWish, Request, TargetKind, TargetWish, TestResult, TextWish,
    Wish,
};
use serde_json::Value;

const DOOR: &str = include_str!("../../../examples/garage_door.plant");

/// A session with a door that goes up as long as its button is pressed.
struct Page {
    session: Session,
    now_ms: u64,
    events: Vec<Event>,
}

impl Page {
    fn new(program: &str) -> Page {
        let file = |name: &str, text: &str| File { name: name.to_owned(), text: text.to_owned() };
        let files = vec![file("door.awl", program), file("door.plant", DOOR)];
        let mut page = Page { session: Session::new(), now_ms: 0, events: Vec::new() };
        page.ask(Wish::Project(ProjectWish::Open { files, main: None })).unwrap();
        page
    }

    /// The answer, null where there is none, or why not.
    fn ask(&mut self, wish: Wish) -> Result<Value, String> {
        let events = self.session.request(Request { id: 1, wish }, self.now_ms);
        let mut found = Ok(Value::Null);
        for event in &events {
            match event {
                Event::Answer { answer, .. } => found = Ok(answer.clone()),
                Event::Refused { message, .. } => found = Err(message.clone()),
                _ => {}
            }
        }
        self.events.extend(events);
        found
    }

    fn target(&mut self, wish: TargetWish) -> Result<Value, String> {
        self.ask(Wish::Target(wish))
    }

    fn handle(&mut self, name: &str, value: i64) -> Result<Value, String> {
        self.target(TargetWish::Handle { name: name.to_owned(), value })
    }

    fn pass(&mut self, ms: u64) {
        for _ in 0..ms / 10 {
            self.now_ms += 10;
            self.events.extend(self.session.tick(self.now_ms, 1000));
        }
    }

    /// The height of the door, and how its shapes are.
    fn door(&self) -> (f64, Vec<Vec<f64>>) {
        let found = self.events.iter().rev().find_map(|event| match event {
            Event::Plant { name, state, places, .. } => Some((name, state, places)),
            _ => None,
        });
        let (name, state, places) = found.unwrap();
        assert_eq!(name, "door.plant");
        let height = state.iter().find(|(name, _)| name == "Door").unwrap().1;
        (height, places.clone())
    }

    fn about(&mut self) -> Result<PlantInfo, String> {
        let wish = TextWish::AboutPlant { spec: "door.plant".to_owned() };
        self.ask(Wish::Text(wish)).map(|answer| serde_json::from_value(answer).unwrap())
    }
}

fn wired() -> Page {
    let mut page = Page::new("LD I0.0\n= Q0.0\n");
    page.target(TargetWish::Plant { spec: Some("door.plant".to_owned()) }).unwrap();
    page
}

#[test]
fn a_plant_file_is_drawn_and_moves_when_its_button_is_pressed() {
    let mut page = wired();
    let info = page.about().unwrap();
    assert_eq!(info.title, ["Garage door", "Garagentor", "Puerta de garaje"]);
    assert_eq!((info.digital, info.analog), (0b1111, 0));
    let kinds: Vec<&str> = info.controls.iter().map(|control| control.kind.as_str()).collect();
    assert_eq!(kinds, ["button", "switch", "fault", "fault", "fault", "fault"]);
    page.target(TargetWish::Run).unwrap();
    page.pass(1000);
    let (height, before) = page.door();
    assert_eq!((height, before.len()), (0.0, info.shapes.len()));
    page.handle("Call", 1).unwrap();
    page.pass(4000);
    let (height, after) = page.door();
    assert!((900.0..=1100.0).contains(&height), "{height}");
    assert_ne!(before, after);
    assert!(page.handle("Cal", 1).unwrap_err().contains("by the name Cal"));
}

#[test]
fn what_was_set_stays_when_the_program_begins_anew_and_ends_with_the_plant() {
    let mut page = wired();
    page.handle("Call", 1).unwrap();
    page.target(TargetWish::Run).unwrap();
    page.pass(2000);
    assert!(page.door().0 > 300.0, "it was pressed before");
    page.target(TargetWish::Reset).unwrap();
    page.pass(2000);
    assert!(page.door().0 > 300.0);
    page.target(TargetWish::Plant { spec: Some("door.plant".to_owned()) }).unwrap();
    page.pass(2000);
    assert_eq!(page.door().0, 0.0);
}

#[test]
fn a_plant_with_a_mistake_says_where_and_runs_nothing() {
    let mut page = wired();
    let text = DOOR.replace("part Strain", "prt Strain");
    page.ask(Wish::Project(ProjectWish::Edit { file: "door.plant".to_owned(), text })).unwrap();
    let problems = page.events.iter().rev().find_map(|event| match event {
        Event::Problems { problems } => Some(problems.clone()),
        _ => None,
    });
    let problems = problems.unwrap();
    assert_eq!((&*problems[0].code, problems[0].suggestion.as_deref()), ("E0600", Some("part")));
    let refused = page.about().unwrap_err();
    assert!(refused.starts_with("door.plant:9:1: unknown statement prt"), "{refused}");
    assert_eq!(page.target(TargetWish::Run).unwrap_err(), refused);
}

#[test]
fn the_virtual_uno_has_the_plant_too() {
    let mut page = wired();
    page.target(TargetWish::Target { kind: TargetKind::VirtualUno }).unwrap();
    page.target(TargetWish::Run).unwrap();
    // I0.0 is D2, and nothing is on it but the button.
    assert_eq!(page.session.chip_pins()[0] & 1, 0);
    page.handle("Call", 1).unwrap();
    let levels = page.session.chip_passed(&[0; 2304]);
    assert_eq!(levels[0] & 1, 1);
}

#[test]
fn hidden_scenarios_are_judged_with_their_own_plant() {
    let check = |page: &mut Page, text: &str| -> Result<TestResult, String> {
        let plants = vec![File { name: "../door.plant".to_owned(), text: DOOR.to_owned() }];
        let (name, text) = ("hidden.scn".to_owned(), text.to_owned());
        let answer = page.ask(Wish::Apart(ApartWish::Check { name, text, plants }));
        answer.map(|answer| serde_json::from_value(answer).unwrap())
    };
    let text = "goal \"It opens\" de \"Es geht auf\"\nplant ../door.plant\n\
        at 1s plant Call = 1\nat 1s within 10s expect plant Door = 2200\n";
    let good = check(&mut wired(), text).unwrap();
    assert!(good.passed);
    let goal = ["It opens", "Es geht auf", "It opens"].map(str::to_owned);
    assert_eq!(good.goal, Some(goal));
    let bad = check(&mut Page::new("LD I0.1\n= Q0.0\n"), text).unwrap();
    assert!(!bad.passed);
    assert_eq!(bad.failures[0].0, 4);
    assert!(check(&mut Page::new("LD I0.9\n"), text).unwrap_err().contains("I0.9"));
    let other = text.replace("../door", "none");
    assert!(check(&mut wired(), &other).unwrap_err().contains("there is no file none.plant"));
}
