//! What an address is, in words: area, size, pin, and what the system has there.

use awl_asm::Address;
use plc_isa::{AnalogInput, Area, Profile, TimerFamily, UNO, timer_family, timer_resolution};

/// What the system keeps in bits of special memory (docs/s7-200.md 3.1).
const BITS: &[(u16, u8, &str)] = &[
    (0, 0, "always 1"),
    (0, 1, "1 in the first scan"),
    (0, 2, "1 for a scan if retained data were lost"),
    (0, 3, "1 for a scan if RUN came with the power"),
    (0, 4, "a clock of 60 s: 30 s off, 30 s on"),
    (0, 5, "a clock of 1 s: 0.5 s off, 0.5 s on"),
    (0, 6, "changes with every scan"),
    (0, 7, "1 if the mode switch is at RUN"),
    (1, 0, "the last result was 0"),
    (1, 1, "the last result was too large or illegal, or the last bit shifted out"),
    (1, 2, "the last result was negative"),
    (1, 3, "there was a division by zero"),
    (1, 4, "a table is full"),
    (1, 5, "a table is empty"),
    (1, 6, "a value was no BCD"),
    (1, 7, "a character was no hexadecimal digit"),
    (3, 0, "freeport: parity error of the last character"),
    (4, 3, "a run-time error"),
    (4, 4, "interrupts are enabled"),
    (4, 5, "the transmitter is idle"),
    (4, 7, "something is forced"),
];

/// What it keeps in bytes (docs/s7-200.md 3.2): first, last, what.
const BYTES: &[(u16, u16, &str)] = &[
    (2, 2, "freeport: the last character"),
    (22, 23, "the last scan in ms"),
    (24, 25, "the shortest scan in ms"),
    (26, 27, "the longest scan in ms"),
    (30, 30, "freeport: parity, bits, rate, mode"),
    (34, 34, "period of timed interrupt 0, 1 to 255 ms"),
    (35, 35, "period of timed interrupt 1, 1 to 255 ms"),
    (36, 65, "high-speed counters: status, control, current value, preset"),
    (66, 85, "pulse outputs"),
    (86, 94, "message receive"),
    (136, 165, "high-speed counters: status, control, current value, preset"),
];

/// The bits of special memory that programs name most, for lists.
pub(crate) fn bits() -> impl Iterator<Item = Address> {
    BITS.iter().map(|&(byte, bit, _)| Address::Bit { area: Area::Sm, byte, bit })
}

/// What an address is.
pub(crate) fn words(address: Address) -> String {
    match address {
        Address::Bit { area, byte, bit } => bit_words(area, byte, bit),
        Address::Byte { area, byte } => in_area("byte", area, byte, 1),
        Address::Word { area, byte } => in_area("word", area, byte, 2),
        Address::Double { area, byte } => in_area("double word", area, byte, 4),
        Address::Timer(number) => {
            let family = match timer_family(number) {
                TimerFamily::Tonr => "TONR",
                TimerFamily::TonTof => "TON and TOF",
            };
            format!("a timer of {family}, {} ms; the bit, or the current value", {
                timer_resolution(number).ms()
            })
        }
        Address::Counter(_) => "a counter; the bit, or the current value".to_owned(),
        Address::Accumulator(_) => "an accumulator of 32 bits".to_owned(),
        Address::HighSpeedCounter(_) => "a high-speed counter's current value".to_owned(),
        Address::Analog(AnalogInput::Scaled(channel)) => {
            format!("an analog input, 0 to 32000{}", pin(UNO.analog_pins, channel))
        }
        Address::Analog(AnalogInput::Raw(channel)) => {
            let most = (1 << UNO.analog_bits) - 1;
            format!("an analog input as counts, 0 to {most}{}", pin(UNO.analog_pins, channel))
        }
        Address::AnalogOutput(_) => "an analog output, which can only be written".to_owned(),
    }
}

fn bit_words(area: Area, byte: u16, bit: u8) -> String {
    let what = format!("a bit of {}", area_words(area));
    let point = |pins: &[&str]| match byte {
        0 => format!("{what}{}", pin(pins, bit)),
        _ => format!("{what}{}", pin(&[], bit)),
    };
    match area {
        Area::I => point(UNO.input_pins),
        Area::Q => point(UNO.output_pins),
        Area::Sm => {
            let known = BITS.iter().find(|row| (row.0, row.1) == (byte, bit));
            known.map_or(what, |(_, _, words)| (*words).to_owned())
        }
        _ => what,
    }
}

/// Which pin of the Uno a point has, in words that follow others.
fn pin(pins: &[&str], point: u8) -> String {
    let title = UNO.title;
    match pins.get(usize::from(point)) {
        Some(pin) => format!(", pin {pin} of {title}"),
        None => format!(", without a pin on {title}"),
    }
}

fn in_area(size: &str, area: Area, byte: u16, len: u16) -> String {
    let what = format!("a {size} of {}", area_words(area));
    let last = byte.saturating_add(len - 1);
    if area == Area::Sm {
        let known = BYTES.iter().find(|(first, end, _)| *first <= byte && last <= *end);
        return known.map_or(what, |(_, _, words)| (*words).to_owned());
    }
    match len {
        1 => what,
        _ => format!("{what}: {0}B{byte} (high) to {0}B{last} (low)", area.name()),
    }
}

fn area_words(area: Area) -> &'static str {
    match area {
        Area::I => "the inputs",
        Area::Q => "the outputs",
        Area::M => "the marks",
        Area::Sm => "special memory",
        Area::S => "sequence control",
        Area::V => "variable memory",
        Area::T => "the timers",
        Area::C => "the counters",
        Area::L => "local memory",
    }
}

/// The inputs and outputs of a board.
pub(crate) fn points(board: &Profile) -> Vec<Address> {
    let bits = |area, count| (0..count).map(move |bit| Address::Bit { area, byte: 0, bit });
    let analog = (0..board.analog_inputs())
        .flat_map(|at| [AnalogInput::Scaled(at), AnalogInput::Raw(at)].map(Address::Analog));
    bits(Area::I, board.digital_inputs())
        .chain(bits(Area::Q, board.digital_outputs()))
        .chain(analog)
        .collect()
}
