//! Characters on the board's serial line from a scenario: each at its cycle of the board's own
//! clock. What the board sends is told apart here: a program in freeport mode, or the firmware.

use std::collections::VecDeque;

use simavr::Avr;

use super::board::MS;

/// The bit of UCSR0B that only a program in freeport mode has set.
const FREEPORT: u8 = 1 << 6;

/// Characters that will come in.
#[derive(Debug, Default)]
pub struct BoardCharacters {
    /// When, in milliseconds, and what.
    incoming: VecDeque<(u64, u8)>,
}

impl BoardCharacters {
    /// Characters come in from this time on, one a millisecond.
    pub(super) fn receive(&mut self, at_ms: u64, characters: &[u8]) {
        self.incoming.extend((at_ms..).zip(characters.iter().copied()));
    }

    /// The cycle of the next one, with that of time 0.
    pub(super) fn next_cycle(&self, origin: Option<u64>) -> Option<u64> {
        let &(at_ms, _) = self.incoming.front()?;
        Some(origin? + at_ms * MS)
    }

    /// Gives the board those that are due.
    pub(super) fn pass(&mut self, origin: Option<u64>, avr: &mut Avr) {
        while self.next_cycle(origin).is_some_and(|cycle| cycle <= avr.cycles()) {
            let Some((_, character)) = self.incoming.pop_front() else { return };
            avr.uart_send(&[character]);
        }
    }

    /// What XMT has sent since the last call.
    pub(super) fn take_sent(avr: &mut Avr) -> Vec<u8> {
        let sent =
            avr.uart_take_with_control().into_iter().filter(|[_, control]| control & FREEPORT != 0);
        sent.map(|[character, _]| character).collect()
    }
}
