//! A failure in words: what happened, what helps, and what the board holds now.

use std::fmt;

use plc_isa::UNO;

/// The chips that are taken for an Uno by mistake, by their signatures.
const CHIPS: &[([u8; 3], &str)] = &[
    ([0x1E, 0x93, 0x07], "ATmega8"),
    ([0x1E, 0x94, 0x06], "ATmega168"),
    ([0x1E, 0x95, 0x14], "ATmega328"),
    ([0x1E, 0x95, 0x16], "ATmega328PB"),
    ([0x1E, 0x95, 0x87], "ATmega32U4"),
    ([0x1E, 0x98, 0x01], "ATmega2560"),
];

/// What went wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cause {
    /// No bootloader answers.
    NoAnswer,
    /// It answered, and stopped.
    FellSilent,
    /// The chip is another one; its signature.
    OtherChip([u8; 3]),
    /// The firmware that must be there is not.
    OtherFirmware,
    /// The flash does not hold what was written, first at this byte.
    Mismatch(u16),
    /// The way to the board is gone: why.
    Lost(String),
}

/// What the board holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// What it held: nothing was written.
    Before,
    /// What it held, or nothing that runs: the first page was on its way.
    BeforeOrNothing,
    /// The firmware, and no program that it would run.
    NoProgram,
    /// No firmware that starts.
    NoFirmware,
    /// What was to be written, or nothing that runs: the last page was on its way.
    NewOrNothing,
    /// What was to be written.
    New,
}

/// A board that could not be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// What went wrong.
    pub cause: Cause,
    /// What the board holds now.
    pub holds: Holds,
}

impl Failure {
    /// What helps, a sentence each.
    pub fn help(&self) -> &'static [&'static str] {
        match self.cause {
            Cause::NoAnswer => &[
                "Is it the port of the Uno?",
                "Close what else uses the port, such as a serial monitor, and take the wires off \
                 D0 and D1.",
                "Press the reset button when it begins: not every board is reset by the computer.",
            ],
            Cause::FellSilent => {
                &["Is it still plugged in? Plug it in again and download once more."]
            }
            Cause::OtherChip(_) => {
                &["uno200 needs an Arduino Uno, or a board with an ATmega328P at 16 MHz."]
            }
            Cause::OtherFirmware => &["Download the firmware, too."],
            Cause::Mismatch(_) => &[
                "Try again, with another cable and without the wires at D0 and D1.",
                "The same address every time: the flash is worn out there.",
            ],
            Cause::Lost(_) => &["Plug the board in again, connect, and download once more."],
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::NoAnswer => f.write_str("no bootloader answers"),
            Cause::FellSilent => f.write_str("the board has stopped answering"),
            Cause::OtherChip(signature) => {
                f.write_str("the board has another chip than an Uno: ")?;
                match CHIPS.iter().find(|(known, _)| known == signature) {
                    Some((_, name)) => f.write_str(name),
                    None => {
                        let [one, two, three] = signature;
                        write!(f, "signature {one:02X} {two:02X} {three:02X}")
                    }
                }
            }
            Cause::OtherFirmware => {
                f.write_str("the board does not hold the uno200 firmware of this version")
            }
            Cause::Mismatch(at) => {
                let what = if *at < UNO.slot_start { "firmware" } else { "program" };
                write!(
                    f,
                    "the board holds something else than was written, first at {at:#06x} in the \
                     {what}"
                )
            }
            Cause::Lost(why) => write!(f, "the connection is lost: {why}"),
        }
    }
}

impl fmt::Display for Holds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Holds::Before => "Nothing was written: the board holds what it held before.",
            Holds::BeforeOrNothing => {
                "Writing had just begun: the board runs what it held before, or nothing, with all \
                 outputs off."
            }
            Holds::NoProgram => {
                "The program in the board is not complete. The firmware refuses it: nothing runs, \
                 and all outputs stay off until a program is downloaded."
            }
            Holds::NoFirmware => {
                "The firmware in the board is not complete. Nothing starts, and all outputs stay \
                 off until firmware and program are downloaded."
            }
            Holds::NewOrNothing => {
                "The last page was on its way: the board runs the new program, or nothing, with \
                 all outputs off."
            }
            Holds::New => {
                "All of the new program is in the board, which checks it before it runs it; only \
                 the last page was not read back."
            }
        })
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}. {} {}", self.cause, self.help().join(" "), self.holds)
    }
}

impl std::error::Error for Failure {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_says_what_happened_what_helps_and_what_the_board_holds() {
        let text = |cause, holds| Failure { cause, holds }.to_string();
        let chip = text(Cause::OtherChip([0x1E, 0x94, 0x06]), Holds::Before);
        assert!(chip.contains("ATmega168.") && chip.contains("Nothing was written"), "{chip}");
        let chip = text(Cause::OtherChip([1, 2, 0xAB]), Holds::Before);
        assert!(chip.contains("signature 01 02 AB"), "{chip}");
        let lost = text(Cause::Lost("the cable is out".into()), Holds::NoProgram);
        assert!(lost.starts_with("the connection is lost: the cable is out."), "{lost}");
        assert!(lost.contains("again") && lost.contains("outputs stay off"), "{lost}");
        let mismatch = text(Cause::Mismatch(0x6012), Holds::NoProgram);
        assert!(mismatch.contains("0x6012 in the program"), "{mismatch}");
        assert!(text(Cause::NoAnswer, Holds::Before).contains("reset button"));
    }
}
