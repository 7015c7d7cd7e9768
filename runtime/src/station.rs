//! What the controller is to the answers on its line.

use plc_isa::ProgramMemory;
use plc_link::{Command, Link, ScanTimes, Station};
use plc_vm::{Memory, Mode, Plc};

use crate::board::Board;
use crate::controller::Controller;

impl<B: Board> Station for Controller<B> {
    type Program = B::Image;

    const COUNTS_PER_MS: u16 = 1000;

    fn parts(&mut self) -> (&mut Memory, &mut Link) {
        (&mut self.memory, &mut self.link)
    }

    fn plc(&self) -> &Plc<B::Image> {
        &self.plc
    }

    fn times(&self) -> &ScanTimes {
        &self.times
    }

    fn slot_len(&self) -> u16 {
        B::PROFILE.slot_len
    }

    fn slot_byte(&self, offset: u16) -> u8 {
        self.slot.as_ref().map_or(0xFF, |image| image.byte(offset))
    }

    fn fault_before_reset(&self) -> [u8; 4] {
        self.fault_before_reset.to_le_bytes()
    }

    fn free_stack(&self) -> u16 {
        self.board.free_stack()
    }

    fn product(&self) -> &'static str {
        B::PRODUCT
    }

    fn has_scans_left(&self) -> bool {
        self.scans_left > 0
    }

    fn control(&mut self, command: Command) {
        match command {
            Command::Stop => self.stop(),
            Command::ClearFault => self.clear_fault(),
            // In RUN there is nothing to begin.
            Command::Run if self.plc.mode() == Mode::Run => self.scans_left = 0,
            // They begin when the answer has been sent.
            Command::Run | Command::Scans(_) => self.command = Some(command),
        }
    }
}
