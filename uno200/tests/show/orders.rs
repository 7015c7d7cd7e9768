//! What the view does to a PLC, and what it shows of it.

use std::sync::mpsc::{Sender, channel};

use client::Program;
use client::show::model::Flow;
use client::show::state::{Agreement, State};
use client::show::{Action, Key};
use uno200::Client;
use uno200::show::poll::{Message, Poller};

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
        for character in keys.chars() {
            let key = if character == '\n' { Key::Enter } else { Key::Char(character) };
            if let Action::Order(order) = self.state.key(key) {
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

/// What the view shows of a line: the mark, and whether there is a value.
fn shown(view: &View, text: &str) -> (Option<Flow>, Option<u32>) {
    let row = view.state.model.rows.iter().find(|row| row.text.starts_with(text)).unwrap();
    let instruction = row.instruction().unwrap();
    (view.state.flow(instruction), view.state.value(instruction, instruction.result))
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
    assert!(
        view.state
            .message
            .as_ref()
            .is_some_and(|(text, is_bad)| *is_bad && text.contains("-32768"))
    );
    view.select("TON");
    view.keys("f");
    assert!(
        view.state
            .message
            .as_ref()
            .is_some_and(|(text, is_bad)| *is_bad && text.contains("cannot be forced"))
    );
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
    assert_eq!(
        (view.state.identity.as_ref().unwrap().scans, is_running(&view)),
        (scans + 1, false)
    );
    view.keys("r");
    assert!(is_running(&view));
}

#[test]
fn a_single_scan_shows_what_it_did() {
    let text = "LD I0.0\n= Q0.0\nLDN I0.0\nJMP 1\nLD I0.0\nMOVB IB0, VB0\nLBL 1\n";
    let program = program(text);
    let (bench, client) = connect(Bench::with_random(&program.image, 7));
    let mut view = View::new(program, client);
    view.keys("ty");
    assert!(view.state.executed.is_empty(), "of RUN, not of the last scan");
    let (mut on, mut off) = (0, 0);
    for _ in 0..40 {
        view.keys(" ");
        assert!(view.state.scanned.is_some());
        assert_eq!(view.state.known_of_scan(), (7, 7));
        // The scans in STOP that the questions took have new inputs, and execute nothing.
        let (flow, value) = shown(&view, "LD I0.0");
        let is_on = value == Some(1);
        assert_eq!(flow, Some(if is_on { Flow::On } else { Flow::Off }));
        assert_eq!(shown(&view, "= Q0.0"), (flow, value));
        let moved = if is_on { Flow::On } else { Flow::NotExecuted };
        assert_eq!(shown(&view, "MOVB").0, Some(moved));
        view.select("MOVB");
        view.state.operand = 0;
        assert_eq!(view.value(), None, "what the inputs are now was not in the scan");
        on += usize::from(is_on);
        off += usize::from(!is_on);
        view.select("LD I0.0");
    }
    assert!(on > 5 && off > 5, "{on}, {off}");
    // Somebody else has a scan executed: what is shown would be of another one.
    bench.with(|bench| bench.single_scan());
    view.go_on();
    assert!(view.state.executed.is_empty() && view.state.scanned.is_none());
    view.keys(" ");
    view.keys("r");
    assert!(view.state.scanned.is_none() && !view.state.executed.is_empty(), "RUN");
}

#[test]
fn of_a_single_scan_one_window_is_known() {
    let text: String = (0..40).map(|bit| format!("LD I0.{}\n= M{}.0\n", bit % 6, bit)).collect();
    let text = text.replace("M32", "V0").replace("M33", "V1").replace("M34", "V2");
    let text = text.replace("M35", "V3").replace("M36", "V4").replace("M37", "V5");
    let text = text.replace("M38", "V6").replace("M39", "V7");
    let program = program(&text);
    let (bench, client) = connect(Bench::with_random(&program.image, 3));
    let mut view = View::new(program, client);
    view.state.resize(60);
    view.keys("ty");
    for line in [0, 30, 59] {
        view.state.select(line);
        let scans = bench.with(|bench| bench.scans);
        view.keys(" ");
        assert_eq!(bench.with(|bench| bench.scans), scans + 1, "one scan, not one a window");
        assert_eq!(view.state.known_of_scan(), (60, 24));
        let known = |line: usize| {
            let instruction = view.state.model.rows[line].instruction().unwrap();
            view.state.flow(instruction).is_some()
        };
        assert!(known(line), "line {line}, which is selected");
        assert_eq!((0..60).filter(|&line| known(line)).count(), 24);
        let rows: Vec<usize> = (0..60).filter(|&line| known(line)).collect();
        assert_eq!(rows[23] - rows[0], 23, "side by side");
    }
}

#[test]
fn what_ends_with_stop_is_told() {
    let mut view = view(TEXT);
    view.select("LD I0.0");
    view.keys("f");
    view.keys("ty");
    assert!(view.state.forced.is_empty());
    let message = view.state.message.clone().unwrap();
    assert_eq!(message, ("not forced any more: I0.0".to_owned(), true));
    // Forced in STOP, it holds from one single scan to the next.
    view.keys("f");
    for _ in 0..3 {
        view.keys(" ");
        let forced = view.state.forced.values().copied().next();
        assert!(forced.is_some());
        assert_eq!(shown(&view, "= Q0.0").1, forced);
    }
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
                for (index, watched) in
                    instruction.operands.iter().enumerate().filter(|(_, one)| !one.is_local)
                {
                    assert!(
                        view.state.value(instruction, index).is_some(),
                        "{name}: {} {watched:?}",
                        row.text
                    );
                }
            }
        }
    }
}
