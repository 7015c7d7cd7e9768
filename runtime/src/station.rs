//! What the controller is to the answers on its line.

use plc_isa::{ImageError, ImageFault, ProgramMemory, verify};
use plc_link::{Command, Exception, Link, ScanTimes, Station};
use plc_vm::{Fault, Memory, Mode, Plc};

use crate::board::Board;
use crate::controller::Controller;
use crate::download::{Failed, bring_into_force};

impl<B: Board> Station for Controller<B> {
    type Program = B::Image;

    const COUNTS_PER_MS: u16 = 1000;
    const TAKES_DOWNLOADS: bool = B::PROFILE.takes_downloads;

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

    fn begin_download(&mut self, len: u16) -> Result<(), Exception> {
        self.board.feed_watchdog();
        let programs = self.board.programs().ok_or(Exception::Function)?;
        Ok(self.download.begin(programs, len)?)
    }

    fn take_block(&mut self, offset: u16, address: u16, len: u8) -> Result<u16, Exception> {
        let received = self.download.received().ok_or(Exception::Busy)?;
        if offset < received && offset + u16::from(len) == received {
            return Ok(received);
        }
        if offset != received || u16::from(len) > self.download.missing() {
            return Err(Exception::Address);
        }
        self.board.feed_watchdog();
        let programs = self.board.programs().ok_or(Exception::Function)?;
        for at in address..address + u16::from(len) {
            self.download.take(programs, self.memory.byte(at))?;
        }
        Ok(received + u16::from(len))
    }

    fn end_download(&mut self) -> Result<[u8; 4], Exception> {
        let programs = self.board.programs().ok_or(Exception::Function)?;
        let slot = self.download.end(programs).ok_or(Exception::Busy)?;
        self.board.feed_watchdog();
        let checked = match self.board.image(slot) {
            Some(image) => verify(image).map(drop),
            None => Err(ImageError { fault: ImageFault::Magic, at: 0 }),
        };
        if let Err(error) = checked {
            return Ok(Fault::BadImage(error).to_bytes());
        }
        let programs = self.board.programs().ok_or(Exception::Function)?;
        bring_into_force(programs)?;
        self.has_new_program = true;
        Ok(Fault::NONE)
    }
}

impl From<Failed> for Exception {
    fn from(Failed: Failed) -> Exception {
        Exception::Busy
    }
}
