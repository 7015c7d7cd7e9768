//! The line as the program's: characters go to it and from it as they are, as fast as SMB30 says.

use embedded_io::{Read, ReadReady, Write, WriteReady};
use plc_isa::{LineSettings, Parity, SM_START};

use crate::board::Board;
use crate::controller::Controller;

/// Settings of the port.
const SETTINGS: u16 = SM_START + 30;
/// By bits 2 to 4 of them (manual, SMB30), bits a second.
const RATES: [u32; 8] = [38_400, 19_200, 9_600, 4_800, 2_400, 1_200, 115_200, 57_600];
/// Most characters that are taken in a scan.
const CHARACTERS_MAX: usize = 256;

/// What the settings of the port say. Characters have 8 bits, whatever bit 5 says.
fn line_settings(settings: u8) -> LineSettings {
    let baud = RATES.get(usize::from(settings >> 2 & 7)).copied().unwrap_or(9_600);
    let rate = LineSettings::RATES.iter().position(|&rate| rate == baud).unwrap_or(0) as u8;
    let parity = match settings >> 6 {
        1 => Parity::Even,
        3 => Parity::Odd,
        _ => Parity::None,
    };
    LineSettings { rate, parity }
}

impl<B: Board> Controller<B> {
    /// How characters are sent on the line from now on; what was sent before leaves before that.
    pub(crate) fn set_line(&mut self, settings: LineSettings) {
        if self.line_settings != Some(settings) {
            self.line_settings = Some(settings);
            // A line that fails has nothing to lose.
            let _ = self.board.line().flush();
            self.board.set_line(settings);
        }
    }

    /// What comes in is the program's.
    pub(crate) fn receive_characters(&mut self) {
        self.is_freeport = true;
        self.set_line(line_settings(self.memory.byte(SETTINGS)));
        self.line.ignore();
        self.request_len = 0;
        let now_ms = self.clock.now_ms();
        let mut characters = [0; 16];
        for _ in 0..CHARACTERS_MAX / characters.len() {
            let line = self.board.line();
            if !line.read_ready().unwrap_or(true) {
                return;
            }
            let count = line.read(&mut characters).unwrap_or(0);
            for &character in characters.iter().take(count) {
                self.plc.receive(&mut self.memory, character, now_ms);
            }
        }
    }

    /// What the program sends goes out, as much as the line takes now.
    pub(crate) fn send_characters(&mut self) {
        let line = self.board.line();
        while line.write_ready().unwrap_or(true)
            && let Some(&character) = self.outgoing.front()
        {
            if line.write(&[character]).unwrap_or(1) == 0 {
                return;
            }
            self.outgoing.pop_front();
        }
    }

    /// The line is for requests again, as the program's settings say.
    pub(crate) fn end_freeport(&mut self) {
        self.is_freeport = false;
        self.outgoing.clear();
        self.set_line(LineSettings::of_byte(self.settings.line));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_the_manual() {
        for (settings, baud, parity) in [
            (0b0000_1001, 9_600, Parity::None),
            (0b0100_0001, 38_400, Parity::Even),
            (0b1101_1001, 115_200, Parity::Odd),
            (0b1000_0101, 19_200, Parity::None),
        ] {
            let LineSettings { rate, parity: found } = line_settings(settings);
            assert_eq!((LineSettings::RATES[usize::from(rate)], found), (baud, parity));
        }
    }
}
