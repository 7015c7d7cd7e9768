//! A session with a PLC outside: bytes go out as events and come in, on the virtual Uno with its
//! chip's time. What is in the chip's place is in `board`.

mod board;

use board::Board;
use ide_core::Session;
use ide_core::protocol::{
    Event, File, LookWish, ProjectWish, Request, Status, TargetKind, TargetWish, Value, Wish,
};

const STATION: &str = include_str!("../../../examples/station1.awl");
const PLANT: &str = "station1 pieces=normal,small,normal noise=3 seed=7 button=auto";
/// A page with a board at its line.
#[derive(Default)]
struct Page {
    session: Session,
    board: Option<Board>,
    now_ms: u64,
    events: Vec<Event>,
    unit: u8,
    resets: usize,
}

impl Page {
    fn with(name: &str, text: &str) -> Page {
        let mut page = Page { unit: 1, ..Page::default() };
        let files = vec![File { name: name.to_owned(), text: text.to_owned() }];
        page.wish(Wish::Project(ProjectWish::Open { files, main: None }));
        page.target(TargetWish::Target { kind: TargetKind::VirtualUno });
        page
    }

    fn wish(&mut self, wish: Wish) -> Vec<Event> {
        let events = self.session.request(Request { id: 1, wish }, self.now_ms);
        self.take(events.clone());
        events
    }

    fn target(&mut self, wish: TargetWish) {
        let events = self.wish(Wish::Target(wish));
        assert!(!events.iter().any(|event| matches!(event, Event::Refused { .. })), "{events:?}");
    }

    fn refusal(&mut self, wish: TargetWish) -> String {
        let events = self.wish(Wish::Target(wish));
        let found = events.iter().find_map(|event| match event {
            Event::Refused { message, .. } => Some(message.clone()),
            _ => None,
        });
        found.unwrap_or_else(|| panic!("not refused: {events:?}"))
    }

    fn look(&mut self, operands: &[&str]) {
        let operands = operands.iter().map(|name| (*name).to_owned()).collect();
        self.wish(Wish::Look(LookWish::Watch { operands }));
    }

    fn take(&mut self, events: Vec<Event>) {
        for event in events {
            match &event {
                Event::PowerOn { flash } => self.board = Some(Board::with(flash, self.unit)),
                Event::PowerOff => self.board = None,
                Event::ResetBoard => self.resets += 1,
                Event::Send { bytes } => {
                    if let Some(board) = &mut self.board {
                        board.receive(bytes);
                    }
                }
                _ => {}
            }
            self.events.push(event);
        }
    }

    /// Time of the wall passes; the chip manages so much of it in 10 ms.
    fn pass_slowly(&mut self, ms: u64, able_ms: u32) {
        for _ in 0..ms / 10 {
            self.now_ms += 10;
            let events = self.session.tick(self.now_ms, 1000);
            self.take(events);
            for _ in 0..self.session.chip_due_ms().min(able_ms) {
                let Some(board) = &mut self.board else { break };
                let data = board.pass();
                let sent = std::mem::take(&mut board.sent);
                board.drive(self.session.chip_passed(&data));
                if !sent.is_empty() {
                    let events = self.session.receive(&sent, self.now_ms);
                    self.take(events);
                }
                let bytes = self.session.chip_bytes();
                if !bytes.is_empty() {
                    self.take(vec![Event::Send { bytes }]);
                }
            }
        }
    }

    fn pass(&mut self, ms: u64) {
        self.pass_slowly(ms, u32::MAX);
    }

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

    fn watched(&self) -> Vec<String> {
        let texts = |values: &Vec<Value>| values.iter().map(|value| value.text.clone()).collect();
        let values = |event: &Event| match event {
            Event::Watched { values } => Some(texts(values)),
            _ => None,
        };
        self.last(values).unwrap()
    }
}

#[test]
fn run_brings_firmware_and_program_to_the_chip_and_the_plant_runs_with_it() {
    let mut page = Page::with("station1.awl", STATION);
    page.target(TargetWish::Plant { spec: Some(PLANT.to_owned()) });
    page.wish(Wish::Look(LookWish::View { file: "station1.awl".to_owned(), from: 1, to: 60 }));
    page.target(TargetWish::Run);
    page.pass(40_000);
    let status = page.status();
    assert_eq!((status.mode.as_str(), status.agreement.as_str()), ("RUN", "same"));
    assert_eq!((status.target, status.pace), (TargetKind::VirtualUno, None));
    assert!(status.time_ms >= 39_900, "{} ms", status.time_ms);
    let plant = |event: &Event| match event {
        Event::Plant { state, .. } => Some(state.clone()),
        _ => None,
    };
    let state = page.last(plant).unwrap();
    let value = |name: &str| state.iter().find(|(key, _)| key == name).unwrap().1;
    assert_eq!((value("good"), value("rejected")), (2.0, 1.0));
    let flows = page.last(|event| match event {
        Event::Live { lines, .. } => Some(lines.iter().filter(|line| line.flow.is_some()).count()),
        _ => None,
    });
    assert!(flows.unwrap() > 10);
}

#[test]
fn a_board_is_ordered_watched_and_forced_over_its_line() {
    let mut page = Page::with("lamp.awl", "LD I0.0\n= Q0.1\n");
    page.look(&["Q0.1", "I0.0"]);
    assert!(page.refusal(TargetWish::Stop).contains("Run or Connect"));
    page.target(TargetWish::Connect);
    page.pass(390);
    let has_asked = |page: &Page| page.last(|one| matches!(one, Event::Send { .. }).then_some(()));
    assert!(has_asked(&page).is_none(), "the firmware still boots");
    page.pass(300);
    assert_eq!(
        (page.status().mode.as_str(), page.watched()),
        ("RUN", vec!["0".into(), "0".into()])
    );
    page.target(TargetWish::Drive { operand: "I0.0".to_owned(), value: 1 });
    page.pass(300);
    assert_eq!(page.watched(), ["1", "1"]);
    let pins = |event: &Event| match event {
        Event::Pins { inputs, outputs, .. } => Some((*inputs, *outputs)),
        _ => None,
    };
    assert_eq!(page.last(pins), Some((1, 2)));
    page.target(TargetWish::Force { operand: "I0.0".to_owned(), value: "0".to_owned() });
    page.pass(300);
    assert_eq!(page.watched(), ["0", "0"]);
    assert!(page.refusal(TargetWish::SingleScan).contains("press Stop first"));
    page.target(TargetWish::Stop);
    page.pass(300);
    assert_eq!(page.status().mode, "STOP");
    page.target(TargetWish::SingleScan);
    page.pass(300);
    let scans = page.status().scans;
    page.target(TargetWish::SingleScan);
    page.pass(300);
    assert_eq!((page.status().mode.as_str(), page.status().scans), ("STOP", scans + 1));
    page.target(TargetWish::Reset);
    page.pass(700);
    assert_eq!((page.resets, page.status().mode.as_str()), (1, "STOP"), "here nothing is reset");
    page.target(TargetWish::Disconnect);
    page.pass(100);
    assert!(page.board.is_none() && page.status().mode == "OFFLINE");
}

#[test]
fn the_time_of_the_chip_is_the_time_on_its_line() {
    let mut page = Page::with("count.awl", "LD SM0.0\nINCW MW0\n");
    page.target(TargetWish::Run);
    page.pass_slowly(20_000, 1);
    let status = page.status();
    assert_eq!((status.mode.as_str(), status.pace), ("RUN", Some(0.1)), "slow, and not lost");
    assert!((1_990..=2_000).contains(&status.time_ms), "{} ms", status.time_ms);
    page.target(TargetWish::Pause { on: true });
    page.pass(100);
    let time_ms = page.status().time_ms;
    page.pass(1000);
    assert_eq!((page.status().mode.as_str(), page.status().time_ms), ("PAUSE", time_ms));
    page.target(TargetWish::Pause { on: false });
    page.pass(300);
    assert_eq!(page.status().mode, "RUN");
}

#[test]
fn a_board_that_does_not_answer_is_lost_and_found_again() {
    let mut page = Page::with("count.awl", "LD SM0.0\nINCW MW0\n");
    page.unit = 5;
    page.target(TargetWish::Run);
    page.pass(5_000);
    assert_eq!(page.status().mode, "LOST");
    assert!(page.status().lost.is_some());
    page.board.as_mut().unwrap().unit = 1;
    page.pass(3_000);
    assert_eq!((page.status().mode.as_str(), page.status().lost), ("RUN", None));
}

#[test]
fn the_oscilloscope_has_what_the_line_gives_and_no_more() {
    let mut page = Page::with("count.awl", "LD SM0.0\nINCW MW0\n");
    page.wish(Wish::Look(LookWish::Scope { signals: vec!["MW0".to_owned()], every_ms: 10 }));
    page.target(TargetWish::Run);
    page.pass(2_400);
    let samples = |page: &mut Page| {
        let mut all: Vec<(f64, f64, bool)> = Vec::new();
        for event in page.events.drain(..) {
            if let Event::Samples { times, columns, lost } = event {
                let is_first = |index: usize| index == 0 && lost;
                let rows = times.iter().zip(&columns[0]).enumerate();
                all.extend(rows.map(|(index, (&at, &value))| (at, value, is_first(index))));
            }
        }
        all
    };
    let found = samples(&mut page);
    assert!((180..=200).contains(&found.len()), "{}", found.len());
    // The answer to a question is there a millisecond after the scan at most.
    assert!(found.iter().all(|(at, value, lost)| (at - value).abs() <= 2.0 && !lost), "{found:?}");
    // For 200 ms nothing comes back: that is a gap.
    page.board.as_mut().unwrap().unit = 5;
    page.pass(200);
    page.board.as_mut().unwrap().unit = 1;
    page.pass(3_000);
    let found = samples(&mut page);
    assert_eq!(found.iter().filter(|sample| sample.2).count(), 1, "{found:?}");
    let unknown = LookWish::Scope { signals: vec!["nonsense".to_owned()], every_ms: 0 };
    let events = page.wish(Wish::Look(unknown));
    let told = events.iter().find_map(|event| match event {
        Event::Notice { message, bad: true } => Some(message),
        _ => None,
    });
    assert!(told.is_some_and(|message| message.contains("nonsense")), "{events:?}");
}

#[test]
fn what_the_uno_cannot_take_does_not_get_there() {
    let mut page = Page::with("wide.awl", "LD SM0.0\n= Q9.9\n");
    assert!(page.refusal(TargetWish::Run).contains("error"));
    let text = "LD SM0.0\nMOVB 1, VB9000\nMOVB 1, VB5000\nFILL 0, VW0, 200\nFILL 0, VW1000, 255\n\
                FILL 0, VW2000, 255\nFILL 0, VW3000, 255\nFILL 0, VW4000, 255\n";
    let file = "wide.awl".to_owned();
    page.wish(Wish::Project(ProjectWish::Edit { file, text: text.to_owned() }));
    let message = page.refusal(TargetWish::Run);
    assert!(message.contains("the Uno cannot take it"), "{message}");
    assert!(page.board.is_none());
}
