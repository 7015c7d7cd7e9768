//! Where the program is, on boards whose processor reads it like any other memory.

use core::fmt;
use core::marker::PhantomData;

use plc_isa::{Profile, ProgramMemory};

use crate::board::Board;
use crate::storage::ERASED;

/// That many bytes are looked at for whether anything was ever written.
const HEAD_LEN: usize = 4;

/// The program slot of a board. Its bytes do not change while it is used.
pub struct Slot<B> {
    bytes: &'static [u8],
    board: PhantomData<fn() -> B>,
}

impl<B> Slot<B> {
    /// What is there, valid or not; `None` where nothing was ever written.
    pub fn of(bytes: &'static [u8]) -> Option<Slot<B>> {
        let is_written = bytes.iter().take(HEAD_LEN).any(|&byte| byte != ERASED);
        is_written.then_some(Slot { bytes, board: PhantomData })
    }
}

impl<B> Clone for Slot<B> {
    fn clone(&self) -> Self {
        Slot { ..*self }
    }
}

impl<B> fmt::Debug for Slot<B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Slot of {} bytes", self.bytes.len())
    }
}

impl<B: Board> ProgramMemory for Slot<B> {
    const PROFILE: Option<&'static Profile> = Some(B::PROFILE);

    fn len(&self) -> u16 {
        u16::try_from(self.bytes.len()).unwrap_or(u16::MAX)
    }

    #[inline(always)]
    fn byte(&self, offset: u16) -> u8 {
        self.bytes.get(usize::from(offset)).copied().unwrap_or(ERASED)
    }
}
