//! What the view does to a PLC, and what it shows of it.

use std::sync::mpsc::{Sender, channel};

use ratatui::crossterm::event::{KeyCode, KeyEvent};
use uno200::show::Action;
use uno200::show::poll::{Message, Poller};
use uno200::show::state::{Agreement, State};
use uno200::{Client, Program};

use crate::bench::{Bench, connect};
use crate::example;

/// A view with its PLC, without threads.
struct View {
    state: State,
    to_poller: Sender<Message>,
    poller: Poller,
}

impl View {
    fn new(program: Program, client: Client) -> View {
        let (to_poller, messages) = channel();
        let poller = Poller::new(client, messages);
        let mut view = View { state: State::new(program, "here".to_owned()), to_poller, poller };
        view.state.resize(20);
        view.go_on();
        view
    }

    fn go_on(&mut self) {
        for _ in 0..3 {
            self.to_poller.send(Message::Wishes(self.state.wishes())).unwrap();
            self.poller.round().unwrap().into_iter().for_each(|news| self.state.hear(news));
        }
    }

    fn keys(&mut self, keys: &str) {
        for key in keys.chars() {
            let code = if key == '\n' { KeyCode::Enter } else { KeyCode::Char(key) };
            if let Action::Order(order) = self.state.key(KeyEvent::from(code)) {
                self.to_poller.send(Message::Order(order)).unwrap();
            }
        }
        self.go_on();
    }

    /// Selects the first line with this text.
    fn select(&mut self, text: &str) {
        let row = self.state.model.rows.iter().position(|row| row.text.starts_with(text)).unwrap();
        self.state.select(row);
        self.go_on();
    }

    fn value(&self) -> Option<u32> {
        self.state.selected_operand().and_then(|(_, value)| value)
    }
}

fn program(text: &str) -> Program {
    Program::assembled(awl_asm::source::Source::new("test.awl", text).unwrap(), Vec::new()).unwrap()
}

const TEXT: &str = "LD I0.0\n= Q0.0\nLD SM0.0\nMOVW VW2, VW0\nTON T37, 100\n";

fn view(text: &str) -> View {
    let program = program(text);
    let (_, client) = connect(Bench::with_plant(&program.image, "station1"));
    View::new(program, client)
}

#[test]
fn forcing() {
    let mut view = view(TEXT);
    view.select("LD I0.0");
    assert_eq!((view.value(), view.state.forced.len()), (Some(0), 0));
    view.keys("f");
    assert_eq!((view.value(), view.state.forced.len()), (Some(1), 1));
    view.select("= Q0.0");
    assert_eq!(view.value(), Some(1), "the program sees the forced input");
    view.keys("f");
    assert_eq!((view.value(), view.state.forced.len()), (Some(1), 2));
    view.keys("u");
    assert_eq!(view.state.forced.len(), 1);
    view.keys("U");
    assert_eq!((view.value(), view.state.forced.len()), (Some(0), 0));
}

#[test]
fn setting_and_refusing() {
    let mut view = view(TEXT);
    view.select("MOVW");
    view.state.operand = 0;
    view.keys("s-7\n");
    assert_eq!(view.value(), Some(0xFFF9));
    view.state.operand = 1;
    assert_eq!(view.value(), Some(0xFFF9), "it was moved on");
    view.keys("s99999\n");
    assert!(view.state.message.as_ref().is_some_and(|(text, is_bad)| *is_bad && text.contains("-32768")));
    view.select("TON");
    view.keys("f");
    assert!(view.state.message.as_ref().is_some_and(|(text, is_bad)| *is_bad && text.contains("cannot be forced")));
}

#[test]
fn stop_needs_a_yes_and_scans_are_single() {
    let mut view = view(TEXT);
    let is_running = |view: &View| view.state.identity.as_ref().unwrap().is_running;
    view.keys("tn");
    assert!(is_running(&view));
    view.keys(" ");
    assert!(view.state.message.is_some(), "no single scans in RUN");
    view.keys("ty");
    assert!(!is_running(&view));
    let scans = view.state.identity.as_ref().unwrap().scans;
    view.keys(" ");
    assert_eq!((view.state.identity.as_ref().unwrap().scans, is_running(&view)), (scans + 1, false));
    view.keys("r");
    assert!(is_running(&view));
}

#[test]
fn of_another_program_nothing_is_shown() {
    let (_, client) = connect(Bench::with_plant(&program("LD I0.1\n= Q0.0\n").image, "station1"));
    let mut view = View::new(program(TEXT), client);
    assert_eq!(view.state.agreement(), Agreement::Other);
    assert!(view.state.executed.is_empty() && view.state.values.is_empty());
    assert_eq!(view.state.wishes(), Default::default());
    view.select("LD I0.0");
    view.keys("f");
    assert!(view.state.forced.is_empty());
}

#[test]
fn every_visible_line_of_an_example_gets_its_values() {
    for name in ["station1.awl", "pick_and_place.awl", "pid.awl", "encoder.awl"] {
        let program = example(name);
        let (_, client) = connect(Bench::with_random(&program.image, 1));
        let mut view = View::new(program, client);
        for top in (0..view.state.model.rows.len()).step_by(20) {
            view.state.go_to(top);
            view.go_on();
            assert_eq!(view.state.message, None, "{name} from line {top}");
            for row in &view.state.model.rows[view.state.visible()] {
                let Some(instruction) = row.instruction() else { continue };
                assert!(view.state.flow(instruction).is_some(), "{name}: {}", row.text);
                for (index, watched) in instruction.operands.iter().enumerate().filter(|(_, one)| !one.is_local) {
                    assert!(view.state.value(instruction, index).is_some(), "{name}: {} {watched:?}", row.text);
                }
            }
        }
    }
}
