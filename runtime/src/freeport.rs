//! The line as the program's: characters go to it and from it as they are.

use embedded_io::{Read, ReadReady, Write, WriteReady};
use plc_isa::LineSettings;

use crate::board::Board;
use crate::controller::{Controller, Port};

/// Most characters that are taken in a scan.
const CHARACTERS_MAX: usize = 256;

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
        self.line.ignore();
        if self.asked_on == Port::First {
            self.request_len = 0;
        }
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
}
