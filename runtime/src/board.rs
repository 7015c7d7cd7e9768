//! What the runtime asks of a board: time, points, a line, memory that keeps without power.

use embedded_io::{Read, ReadReady, Write, WriteReady};
use embedded_storage::nor_flash::NorFlash;
use plc_isa::{LineSettings, Profile, ProgramMemory};

use crate::engine::Engine;

/// A board. Points are given and taken as levels of their pins; what a program inverts, the runtime
/// inverts.
pub trait Board {
    /// What it has.
    const PROFILE: &'static Profile;
    /// How it calls itself on its line.
    const PRODUCT: &'static str;

    /// Where the program is read: a [`Slot`](crate::Slot), where the processor reads it like any
    /// memory. It takes images of the board's profile alone.
    type Image: ProgramMemory + Clone;
    /// What executes programs: [`Interpreted`](crate::Interpreted), if the board has nothing
    /// faster.
    type Engine: Engine<Self::Image>;
    /// Where requests come in and answers go out. Characters that come between two looks wait, at
    /// least as many as come in the longest scan. Reading and writing never wait: none is 0, and
    /// an error is a wrong character, which spoils its frame.
    type Line: Read + ReadReady + Write + WriteReady;
    /// Another line, for requests alone, in packets: USB. [`NoLine`](crate::NoLine) on boards that
    /// have one line.
    type SecondLine: Read + ReadReady + Write + WriteReady;
    /// Where retained values are kept: all of it, from its first byte on, at least
    /// [`SECTORS_MIN`](crate::SECTORS_MIN) sectors.
    type Storage: NorFlash;
    /// Where programs are that come over the line:
    /// [`NeverWritten`](crate::NeverWritten) on boards that get theirs in other ways only.
    type Programs: NorFlash;

    /// What executes programs. Once, before all else.
    fn engine(&mut self) -> Self::Engine;

    /// A clock of microseconds that wraps. Only differences are used; two looks at it are never as
    /// far apart as it wraps.
    fn now_us(&mut self) -> u32;

    /// The program in a slot, valid or not; `None` where nothing was ever written. Slot 0 is where
    /// other ways than the line write it; slot 1, which is asked for only where there are
    /// [`programs`](Self::programs), is in their second half.
    fn image(&mut self, slot: u8) -> Option<Self::Image>;

    /// The levels of the inputs, a bit for each pin that the profile has.
    fn inputs(&mut self) -> u8;

    /// Switches the pull-up resistors of inputs on, a bit each. The others have a pull-down, if the
    /// board has any: what is not connected is 0.
    fn set_pullups(&mut self, inputs: u8);

    /// Drives the pins of the outputs to these levels.
    fn drive_outputs(&mut self, levels: u8);

    /// Lets the pins of the outputs go: none is driven, none modulated. As after a reset.
    fn release_outputs(&mut self);

    /// The part of the time in thousandths that an output is high, in the place of its level;
    /// `None` ends that. Nothing on a board without analog outputs.
    fn modulate(&mut self, output: u8, duty: Option<u16>) {
        let _ = (output, duty);
    }

    /// An analog input as a part of full scale, 0 to 65535, however many bits the converter has: of
    /// 10 bits `bits << 6 | bits >> 4`. Nothing asks for it on a board without analog inputs.
    fn analog(&mut self, channel: u8) -> u16 {
        let _ = channel;
        0
    }

    /// The line.
    fn line(&mut self) -> &mut Self::Line;

    /// The second line, where there is one. It serves also while a program has the first one for
    /// itself.
    fn second_line(&mut self) -> Option<&mut Self::SecondLine> {
        None
    }

    /// How characters are sent on the line from now on. A line that has no rate does nothing; one
    /// that cannot do what is asked for is silent.
    fn set_line(&mut self, settings: LineSettings);

    /// The memory for retained values.
    fn storage(&mut self) -> &mut Self::Storage;

    /// The memory of both slots, if programs come over the line. Each has half of it: first the
    /// longest program, then a sector, which a program that was written in another way leaves
    /// erased in both of them.
    fn programs(&mut self) -> Option<&mut Self::Programs> {
        None
    }

    /// The program is alive: the hardware watchdog, which resets the board otherwise, waits again.
    /// It waits at least half a second, and after that as long as the storage needs to erase a
    /// sector.
    fn feed_watchdog(&mut self);

    /// Remembers a fault where a reset leaves it alone, and whether it holds the board in STOP
    /// after that.
    fn remember_fault(&mut self, fault: u32, holds: bool);

    /// The fault that was remembered, 0 if there is none, and whether it holds the board in STOP:
    /// it does so once.
    fn recall_fault(&mut self) -> (u32, bool);

    /// Whether the stack has left alone what is before it.
    fn is_stack_sound(&mut self) -> bool {
        true
    }

    /// Bytes of stack that were never used; 0xFFFF: not known.
    fn free_stack(&self) -> u16 {
        0xFFFF
    }

    /// Tells whoever looks at the board from outside, such as a test, how far the scan is.
    #[inline(always)]
    fn mark(&mut self, mark: Mark) {
        let _ = mark;
    }
}

/// How far the scan is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// It begins: inputs were not read yet.
    ScanStart = 1,
    /// Outputs were written.
    ScanEnd = 2,
}
