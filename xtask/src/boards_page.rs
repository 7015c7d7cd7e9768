//! docs/boards.md: which board for what, with the limits of each, from the profiles.

use std::fmt::Write as _;

use plc_isa::{HOST, Profile, UNO};

/// The page.
pub const FILE: &str = "docs/boards.md";

/// What a row of the table says of a board.
type Row = (&'static str, fn(&Profile) -> String);

const ROWS: [Row; 12] = [
    ("in a program", |board| format!("`//# board {}`", board.name)),
    ("program", |board| format!("{} bytes", board.slot_len)),
    ("data: V, timers, counters, edges", |board| format!("{} bytes", board.arena_len())),
    ("retained", |board| format!("{} bytes", board.retained_max())),
    ("labels", |board| board.labels_max().to_string()),
    ("digital inputs", |board| points("I0.", board.input_pins)),
    ("digital outputs", |board| points("Q0.", board.output_pins)),
    ("analog inputs", |board| match board.analog_pins {
        [] => "none".to_owned(),
        pins => format!("{}: {}, {} bits", pins.len(), range(pins), board.analog_bits),
    }),
    ("analog outputs", |board| match board.analog_outputs {
        0 => "none".to_owned(),
        outputs => format!("{outputs}, as PWM"),
    }),
    ("interrupt events, high-speed counters, pulse outputs", |board| {
        yes(board.has_events).to_owned()
    }),
    ("machine code (`--native`)", |board| yes(board.native_interface != 0).to_owned()),
    ("written by", |board| {
        let way = match (&board.drive, board.avrdude_part) {
            (Some(_), _) => {
                "a .uf2 file on its drive: `-o F.uf2`, `awl-asm --flash DRIVE`; with the firmware on it, over its line: `uno200 flash`"
            }
            (None, Some(_)) => "`awl-asm --flash PORT`, `uno200 flash`, the page",
            (None, None) => "tools of its maker; in QEMU by its command line",
        };
        way.to_owned()
    }),
];

fn yes(is_so: bool) -> &'static str {
    if is_so { "yes" } else { "no" }
}

fn points(name: &str, pins: &[&str]) -> String {
    format!("{}: {name}0 to {name}{} at {}", pins.len(), pins.len() - 1, range(pins))
}

fn range(pins: &[&str]) -> String {
    match pins {
        [first, .., last] => format!("{first} to {last}"),
        _ => pins.concat(),
    }
}

/// The whole page.
pub fn text() -> String {
    let mut text = format!(
        "# Boards\n\n\
         Generated from the profiles of the boards by `cargo xtask docs`; do not edit.\n\n\
         A program is the same for all boards; an image is for one. Which one, the program says \
         (`//# board {uno}`) or\n\
         whoever builds it (`--board {uno}`). Without either it is for {title}, and for the host \
         (`awl-sim`) where that is too\n\
         small: a warning says what does not fit, and which board would do. An image for another \
         board is refused by the\n\
         board itself.\n\n",
        uno = UNO.name,
        title = UNO.title,
    );
    let names: Vec<&str> = Profile::BOARDS.map(|board| board.title).to_vec();
    let _ = writeln!(text, "| | {} |", names.join(" | "));
    let _ = writeln!(text, "|---{}|", "|---".repeat(names.len()));
    for (what, say) in ROWS {
        let cells = Profile::BOARDS.map(say);
        let _ = writeln!(text, "| {what} | {} |", cells.join(" | "));
    }
    let _ = write!(
        text,
        "\nThe host has the memory of the largest S7-200 ({} bytes of data, {} of program) and the \
         points of {}.\n\
         [porting.md](porting.md) says how another board becomes one.\n\n\
         Points of the Uno are of 5 V, those of the others of 3.3 V: \
         [wiring.md](wiring.md) says how 24 V, relays and analog\n\
         signals come to them, [flashing.md](flashing.md) how a program comes onto Uno and Pico, \
         and\n\
         [firmware-pico/README.md](../firmware-pico/README.md) what was tried on the Pico. \
         `awl-sim --on pico` runs its\n\
         firmware in an emulator ([simulator.md](simulator.md#on-an-emulated-pico)).\n\n\
         The Uno is the board for lessons and small machines: 5 V, the IDE's way onto it, \
         interrupts, counters and pulses. The\n\
         Pico is for programs that outgrow it, and for pins of 3.3 V; it has none of these three \
         yet. The micro:bit, tried in QEMU alone, is the example of how a board is added\n\
         ([firmware-microbit/README.md](../firmware-microbit/README.md)).\n",
        HOST.arena_len(),
        HOST.slot_len,
        UNO.title,
    );
    text
}
