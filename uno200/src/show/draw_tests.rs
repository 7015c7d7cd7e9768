//! What is on the screen, without a PLC: the news are made up.

use client::show::Key;
use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier};

use super::picture::{buffer, svg};
use super::theme::Theme;
use awl_asm::source::Source;
use client::program::Program;
use client::reference::Reference;
use client::service::{Executed, Forced, Identity};
use client::show::state::{News, State};

const TEXT: &str = "\
//# symbol Start I0.0 the green button
NETWORK 1 // Run
LD     Start      // pressed
LPS
A      T37
=      Q0.0
LPP
MOVW   VW0, VW2
LDW>   VW2, 5
JMP    1
LD     I0.1
=      Q0.1
LBL    1
";

/// A running PLC with this program.
fn identity(state: &State) -> Identity {
    Identity {
        is_running: true,
        has_program: true,
        has_status: true,
        counts_per_ms: 2000,
        last: 1_500,
        longest: 3_000,
        scans: 4711,
        room: 252,
        image_crc: state.model.image.0,
        image_len: state.model.image.1,
        ..Identity::default()
    }
}

/// The view of a PLC that has answered.
fn state() -> State {
    let program = Program::assembled(Source::new("lamp.awl", TEXT).unwrap(), Vec::new()).unwrap();
    let mut state = State::new(program, "COM3".to_owned());
    state.hear(News::Identity(Box::new(identity(&state))));
    let stacks = [
        (3, Some(1)),
        (4, Some(3)),
        (5, Some(2)),
        (6, Some(2)),
        (7, Some(1)),
        (8, Some(1)),
        (9, Some(3)),
    ];
    let stacks = stacks.into_iter().chain([(10, Some(1)), (11, None), (12, None), (13, Some(1))]);
    let executed = stacks.map(|(line, stack): (usize, Option<u16>)| {
        let instruction = state.model.rows[line - 1].instruction().unwrap();
        let value = if line == 8 || line == 9 { 7 } else { u32::from(line == 3) };
        let executed = Executed { is_executed: stack.is_some(), stack: stack.unwrap_or(0), value };
        (instruction.offset.unwrap(), executed)
    });
    let executed = executed.collect();
    state.hear(News::Status(executed));
    let vw0 = (Reference([0x89, 0, 0]), 7);
    let t37 = (Reference([0x50, 0, 37]), 0);
    let points = [(Reference([0x01, 0, 0]), 0), (Reference([0x11, 0, 0]), 0)];
    state.hear(News::Values([vw0, t37].into_iter().chain(points).collect()));
    state
}

fn lines(buffer: &Buffer) -> Vec<String> {
    let cells = |y: u16| (0..buffer.area.width).map(move |x| buffer[(x, y)].symbol());
    (0..buffer.area.height).map(|y| cells(y).collect::<String>().trim_end().to_owned()).collect()
}

fn screen(state: &mut State) -> Vec<String> {
    lines(&buffer(state, 80, 18, Theme::new(true)))
}

#[test]
fn a_whole_screen() {
    let expected = "
 lamp   RUN   scan 4711: 0.75 ms, longest 1.50 ms                          COM3
  1      //# symbol Start I0.0 the green button
  2      NETWORK 1 // Run
  3 ●    LD     Start      // pressed  1
  4 ●1   LPS
  5 ○1   A      T37                    0
  6 ○1   =      Q0.0                   0
  7 ●    LPP
  8 ●    MOVW   VW0, VW2               7  7
  9 ●    LDW>   VW2, 5                 7
 10 ●    JMP    1
 11 ·    LD     I0.1                   0
 12 ·    =      Q0.1                   0
 13 ●    LBL    1
 14

 Start  I0.0  = 1  the green button
 n p network  f force  u unforce  s set  t STOP  / search  x hex  ? help  q quit";
    assert_eq!(screen(&mut state()).join("\n"), expected.trim_start_matches('\n'));
}

#[test]
fn in_stop_a_single_scan_is_shown_and_what_is_not_known_of_it() {
    let mut state = state();
    let stopped = Identity { is_running: false, has_scan_status: true, ..identity(&state) };
    state.hear(News::Identity(Box::new(stopped.clone())));
    let shown = screen(&mut state);
    assert!(shown[1].contains("STOP: what the last scan did is not known"), "{shown:?}");
    assert_eq!(shown[4], "  3      LD     Start      // pressed", "no guess");
    let offset = state.model.rows[2].instruction().unwrap().offset.unwrap();
    let executed = Executed { is_executed: true, stack: 1, value: 1 };
    let scans = 4712;
    state.hear(News::Scanned(Some((scans, vec![(offset, executed)]))));
    state.hear(News::Identity(Box::new(Identity { scans: scans.into(), ..stopped.clone() })));
    let shown = screen(&mut state);
    assert!(shown[1].contains("scan 4712: 1 of 11 lines fit into its window"), "{shown:?}");
    assert_eq!(shown[4], "  3 \u{25CF}    LD     Start      // pressed  1");
    assert_eq!(shown[5], "  4 ?    LPS");
    // The input of this line is what it is now, not what the scan saw.
    assert_eq!(shown[12], "  11 ?    LD     I0.1".replacen("  11", " 11", 1));
    state.hear(News::Identity(Box::new(Identity { scans: 4713, ..stopped })));
    assert!(screen(&mut state)[1].contains("not known"), "another scan was executed");
}

#[test]
fn hexadecimal_and_forced() {
    let mut state = state();
    state.hear(News::Forced(vec![
        Forced { reference: Reference([0x00, 0, 0]), value: 1 },
        Forced { reference: Reference([0x89, 0, 0]), value: 0xFFFF },
    ]));
    state.key(Key::Char('x'));
    let lines = screen(&mut state);
    assert!(lines[0].contains(" 2 forced "), "{}", lines[0]);
    assert!(lines[3].ends_with("1 F"), "{}", lines[3]);
    assert!(lines[8].ends_with("16#0007 F  16#0007"), "{}", lines[8]);
    assert!(lines[16].contains("forced to 1"), "{}", lines[16]);
}

#[test]
fn without_colours_everything_is_still_there() {
    let mut state = state();
    state.hear(News::Forced(vec![Forced { reference: Reference([0x00, 0, 0]), value: 1 }]));
    let (coloured, plain) = (
        buffer(&mut state, 80, 18, Theme::new(true)),
        buffer(&mut state, 80, 18, Theme::new(false)),
    );
    assert_eq!(lines(&coloured), lines(&plain));
    assert!(coloured.content().iter().any(|cell| cell.fg != Color::Reset));
    assert!(plain.content().iter().all(|cell| cell.fg == Color::Reset && cell.bg == Color::Reset));
    let forced = plain.content().iter().filter(|cell| cell.symbol() == "F").any(|cell| {
        cell.modifier.contains(Modifier::REVERSED) && cell.modifier.contains(Modifier::BOLD)
    });
    assert!(forced);
}

#[test]
fn of_another_program_no_values() {
    let mut state = state();
    state.hear(News::Identity(Box::new(Identity { image_crc: 0x1234_ABCD, ..identity(&state) })));
    let lines = screen(&mut state);
    assert!(lines[1].contains("another program: 1234ABCD"), "{}", lines[1]);
    assert_eq!(lines[4], "  3      LD     Start      // pressed");
    assert!(lines[16].ends_with("the green button") && !lines[16].contains('='), "{}", lines[16]);
    state.hear(News::Identity(Box::new(Identity {
        has_program: false,
        image_len: 0,
        ..identity(&state)
    })));
    assert!(screen(&mut state)[1].contains("no program"));
}

#[test]
fn the_line_of_keys_fits() {
    let mut state = state();
    state.hear(News::Identity(Box::new(Identity { is_running: false, ..identity(&state) })));
    for width in [60, 80, 100] {
        let lines = lines(&buffer(&mut state, width, 24, Theme::new(true)));
        let keys = lines.last().unwrap();
        assert!(keys.contains("r RUN  space scan") && keys.ends_with("? help  q quit"), "{keys}");
    }
}

#[test]
fn machine_code_has_values_and_no_power_flow() {
    let mut state = state();
    let (image_crc, image_len) = state.model.native.unwrap();
    state.hear(News::Identity(Box::new(Identity {
        is_native: true,
        image_crc,
        image_len,
        ..identity(&state)
    })));
    screen(&mut state);
    let wishes = state.wishes();
    assert!(wishes.status.is_empty() && wishes.watch.contains(&Reference([0x00, 0, 0])));
    state.hear(News::Values(vec![(Reference([0x00, 0, 0]), 1)]));
    let lines = screen(&mut state);
    assert!(lines[1].contains("machine code"), "{}", lines[1]);
    assert_eq!(lines[4], "  3      LD     Start      // pressed  1");
}

#[test]
fn a_firmware_without_status_has_values() {
    let mut state = state();
    state.hear(News::Identity(Box::new(Identity { has_status: false, ..identity(&state) })));
    assert!(screen(&mut state)[1].contains("no power flow"));
    let wishes = state.wishes();
    assert!(wishes.status.is_empty() && !wishes.watch.is_empty());
}

#[test]
fn a_lost_connection_is_said_and_old_values_go() {
    let mut state = state();
    state.hear(News::Lost("the PLC does not answer".to_owned()));
    let lines = screen(&mut state);
    assert!(lines[0].ends_with("no connection"), "{}", lines[0]);
    assert!(lines[1].contains("trying again: the PLC does not answer"), "{}", lines[1]);
    assert_eq!(lines[4], "  3      LD     Start      // pressed");
    state.hear(News::Identity(Box::new(identity(&state))));
    assert!(screen(&mut state)[0].ends_with("COM3"));
}

#[test]
fn a_fault_names_its_line() {
    let mut state = state();
    let offset = state.model.rows[9].instruction().unwrap().offset.unwrap();
    let fault = plc_vm::Fault::Watchdog { at: offset }.to_bytes();
    state.hear(News::Identity(Box::new(Identity { is_running: false, fault, ..identity(&state) })));
    let lines = screen(&mut state);
    assert!(lines[0].contains(" STOP "), "{}", lines[0]);
    assert!(lines[1].contains("watchdog") && lines[1].contains("lamp.awl:10"), "{}", lines[1]);
}

#[test]
fn no_screen_is_too_small() {
    let mut state = state();
    for (width, height) in (1..30).flat_map(|width| (1..8).map(move |height| (width, height))) {
        for help in [false, true] {
            state.has_help = help;
            buffer(&mut state, width, height, Theme::new(true));
        }
    }
    state.has_help = true;
    let lines = lines(&buffer(&mut state, 80, 24, Theme::new(true)));
    assert!(lines.iter().any(|line| line.contains("power flow after the line")), "{lines:?}");
}

#[test]
fn moving_and_searching() {
    let mut state = state();
    state.resize(4);
    let mut press = |key: Key| {
        state.key(key);
        (state.top + 1, state.selected + 1)
    };
    assert_eq!(press(Key::Home), (1, 1));
    assert_eq!(press(Key::Char('n')), (2, 2));
    assert_eq!(press(Key::PageDown), (2, 5));
    assert_eq!(press(Key::Down), (3, 6));
    assert_eq!(press(Key::End), (11, 14));
    assert_eq!(press(Key::Down), (11, 14));
    assert_eq!(press(Key::Char('p')), (2, 2));
    for key in "/vw2".chars().map(Key::Char).chain([Key::Enter]) {
        press(key);
    }
    assert_eq!(press(Key::Other), (5, 8));
    press(Key::Char('/'));
    assert_eq!(press(Key::Enter), (6, 9));
    press(Key::Char('/'));
    assert_eq!(press(Key::Enter), (6, 8), "round and round");
    for key in "/nothing".chars().map(Key::Char).chain([Key::Enter]) {
        press(key);
    }
    assert!(state.message.is_some());
}

#[test]
fn the_picture_has_the_letters_of_the_screen() {
    let mut state = state();
    let screen = buffer(&mut state, 80, 18, Theme::new(true));
    let picture = svg(&screen);
    assert_eq!(picture, svg(&screen));
    for part in
        ["LD\u{A0}\u{A0}\u{A0}\u{A0}\u{A0}Start", "●", "lamp", ">\nRUN\n<", "//\u{A0}pressed"]
    {
        assert!(picture.contains(part), "{part} is missing in {picture}");
    }
}
