//! What a machine is to the answers: its memory, controller and times. Implemented by the firmware
//! and by the simulator.

use plc_isa::{ProgramMemory, UNO};
use plc_vm::{Memory, Plc};

use crate::link::Link;
use crate::request::Exception;

/// Who answers: vendor, product code and revision. A simulator may call itself by another product.
pub const TEXTS: [&str; 3] = ["uno200", "Arduino Uno", env!("CARGO_PKG_VERSION")];

/// Lengths of the scans since RUN, inputs to outputs, in counts of [`Station::COUNTS_PER_MS`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ScanTimes {
    /// The shortest.
    pub shortest: u32,
    /// The last.
    pub last: u32,
    /// The longest; 0: there is none yet.
    pub longest: u32,
    /// Scans executed since RUN. Wraps.
    pub scans: u32,
}

impl ScanTimes {
    /// Before the first scan.
    pub const NONE: ScanTimes = ScanTimes { shortest: 0, last: 0, longest: 0, scans: 0 };

    /// A scan has executed the program.
    pub fn count(&mut self) {
        self.scans = self.scans.wrapping_add(1);
    }

    /// Enters the length of a scan, in counts.
    pub fn enter(&mut self, length: u32) {
        if self.longest == 0 || length < self.shortest {
            self.shortest = length;
        }
        if length > self.longest {
            self.longest = length;
        }
        self.last = length;
    }
}

/// What [`Station::control`] is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// RUN to STOP.
    Stop,
    /// STOP to RUN, with a first scan. In RUN: nothing.
    Run,
    /// Forget the fault that led to STOP.
    ClearFault,
    /// So many scans, at least 1, from STOP: goes on where the program was, then STOP again.
    Scans(u16),
}

/// A machine with a line.
pub trait Station {
    /// Where the program's bytes are.
    type Program: ProgramMemory;

    /// Counts of [`times`](Self::times) in a millisecond.
    const COUNTS_PER_MS: u16;

    /// Whether programs come over the line.
    const TAKES_DOWNLOADS: bool = false;

    /// The data memory, with the frame in it, and what the machine holds for the answers.
    fn parts(&mut self) -> (&mut Memory, &mut Link);

    /// The data memory.
    fn memory(&mut self) -> &mut Memory {
        self.parts().0
    }

    /// What the machine holds for the answers.
    fn link(&mut self) -> &mut Link {
        self.parts().1
    }

    /// The controller.
    fn plc(&self) -> &Plc<Self::Program>;

    /// The scans since RUN.
    fn times(&self) -> &ScanTimes;

    /// Bytes of the program slot: as many as the program's profile has.
    fn slot_len(&self) -> u16 {
        self.plc().program().map_or(UNO.slot_len, |program| program.plan().profile().slot_len)
    }

    /// The byte of the program slot at an offset below its [length](Self::slot_len), whether there
    /// is a valid program or not; 0xFF where nothing was written.
    fn slot_byte(&self, offset: u16) -> u8;

    /// The fault before the last reset, as [`plc_vm::Fault::to_bytes`] gives it.
    fn fault_before_reset(&self) -> [u8; 4] {
        [0; 4]
    }

    /// Bytes of stack that were never used; 0xFFFF: not known.
    fn free_stack(&self) -> u16 {
        0xFFFF
    }

    /// What the machine is: the product code of function 43.
    fn product(&self) -> &'static str {
        TEXTS[1]
    }

    /// Whether single scans go on that [`Command::Scans`] asked for.
    fn has_scans_left(&self) -> bool;

    /// Carries a command out. It can be: RUN and single scans come only with a program, single
    /// scans in STOP only. STOP is obeyed at once. RUN and single scans begin after the answer has
    /// been sent, because they may load the program anew, which clears the frame; what became of
    /// them the client asks. Whoever goes from RUN to STOP, for whatever reason, calls
    /// [`Forces::clear`](crate::Forces::clear).
    fn control(&mut self, command: Command);

    /// A program of so many bytes, at most those of the slot, comes. The one that is in force stays
    /// so; of what has come before nothing is left.
    ///
    /// # Errors
    /// [`Exception::Busy`] where it cannot be kept, in this as in what follows.
    fn begin_download(&mut self, len: u16) -> Result<(), Exception> {
        let _ = len;
        Err(Exception::Function)
    }

    /// The next bytes of it, `len` of them from a data address on; or the last ones again, whose
    /// answer was lost. Gives how many have come.
    ///
    /// # Errors
    /// [`Exception::Address`] for bytes that are not the next.
    fn take_block(&mut self, offset: u16, address: u16, len: u8) -> Result<u16, Exception> {
        let _ = (offset, address, len);
        Err(Exception::Function)
    }

    /// All of it has come. It is checked: gives the fault that loading it would have, as
    /// [`plc_vm::Fault::to_bytes`] gives it, and all stays as it was; without a fault it is the
    /// program of the next power-up, and in force when the answer has been sent, in RUN where the
    /// other one was.
    ///
    /// # Errors
    /// [`Exception::Busy`] if it has not come, or cannot be brought into force.
    fn end_download(&mut self) -> Result<[u8; 4], Exception> {
        Err(Exception::Function)
    }

    /// Asked between the parts of an answer that can be made in parts: whether there is time for
    /// another one in this scan. After `false` the machine comes back at the end of the next scan.
    fn has_time(&mut self) -> bool {
        true
    }
}
