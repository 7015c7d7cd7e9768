//! Where an image is read from, and what a machine knows beside it: instruction table and modules.

use crate::crc::Crc32;
use crate::header::{DIRECTORY_AT, FORMAT_AT};
use crate::image::Header;
use crate::modules::MODULES;
use crate::profile::{Profile, UNO};
use crate::routines::{self, MODULE_KINDS_AT, Routine};
use crate::token_table::{TOKEN_TABLE, TOKEN_TABLE_LEN};

/// Where an image is read from: a slice on the host, flash on the board.
pub trait ProgramMemory {
    /// The firmware interface that machine code finds here; 0: none, machine code is refused.
    const NATIVE_INTERFACE: u8 = 0;
    /// The one profile whose images run here; `None`: those of all, as on the host.
    const PROFILE: Option<&'static Profile> = None;

    /// Bytes that can be read.
    fn len(&self) -> u16;
    /// The byte at an offset; 0xFF, an undefined token, past the end.
    fn byte(&self, offset: u16) -> u8;
    /// The little-endian word at an offset.
    #[inline(always)]
    fn word(&self, offset: u16) -> u16 {
        u16::from_le_bytes([self.byte(offset), self.byte(offset.wrapping_add(1))])
    }
    /// The two bytes at an offset of [`TOKEN_TABLE`](crate::TOKEN_TABLE), which the board keeps in
    /// flash like the program; 0 past the end.
    fn token_table(&self, offset: u16) -> [u8; 2] {
        static TABLE: [u8; TOKEN_TABLE_LEN] = TOKEN_TABLE;
        let byte = |at: usize| TABLE.get(at).copied().unwrap_or(0);
        [byte(usize::from(offset)), byte(usize::from(offset) + 1)]
    }
    /// Where [`kind`](Self::kind) finds the list of kinds that is at an offset of the token
    /// table.
    fn kinds_at(&self, offset: u16) -> u16 {
        offset
    }
    /// The number of a kind in a list of the token table or of a [`Routine`].
    fn kind(&self, at: u16) -> u8 {
        if at < MODULE_KINDS_AT {
            self.token_table(at)[0]
        } else {
            routines::kind_byte(at - MODULE_KINDS_AT)
        }
    }
    /// A routine of a module; `None` where there is none.
    fn routine(&self, module: u8, routine: u8) -> Option<Routine> {
        routines::routine(module, routine)
    }
    /// One past the last data address that the modules in the image leave to the program; `None`
    /// when one of them is not the module that this machine knows. The host executes their
    /// instructions itself and takes them all.
    fn modules_end(&self) -> Option<u16> {
        let is_used = |module: &u8| self.word(DIRECTORY_AT + 2 * u16::from(*module)) != 0;
        Some(self.profile().data_end_with((0..MODULES as u8).filter(is_used)))
    }
    /// The profile that the image is for; the Uno's where it does not say.
    #[inline(always)]
    fn profile(&self) -> &'static Profile {
        match Self::PROFILE {
            Some(profile) => profile,
            None => Profile::of_format(self.byte(FORMAT_AT)).unwrap_or(&UNO),
        }
    }
    /// Whether operands are stored wide.
    #[inline(always)]
    fn is_wide(&self) -> bool {
        self.profile().is_wide
    }
    /// Reads the fields of the header in place, whatever they say. The board copies them: they
    /// are in the image as they lie in its memory.
    fn read_header(&self, header: &mut Header) {
        header.read_fields(self);
    }
    /// The same place, of which the compiler is not to know where it is: on the board distances
    /// from a pointer make shorter code than addresses.
    #[inline(always)]
    fn anywhere<T>(place: &mut T) -> &mut T {
        place
    }
    /// Whether there is nothing to read.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Slices and vectors of the host.
impl<T: AsRef<[u8]>> ProgramMemory for T {
    #[inline(always)]
    fn len(&self) -> u16 {
        u16::try_from(self.as_ref().len()).unwrap_or(u16::MAX)
    }
    #[inline(always)]
    fn byte(&self, offset: u16) -> u8 {
        self.as_ref().get(usize::from(offset)).copied().unwrap_or(0xFF)
    }
}

impl Crc32 {
    /// Takes bytes of program memory in, from one offset to before another.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn bytes<P: ProgramMemory>(&mut self, memory: &P, from: u16, to: u16) {
        let mut offset = from;
        while offset != to {
            self.byte(memory.byte(offset));
            offset = offset.wrapping_add(1);
        }
    }
}

/// A program of which it is known whether its operands are stored wide: the compiler makes an
/// interpreter for each.
#[derive(Debug)]
pub struct OfWidth<'a, P, const IS_WIDE: bool>(pub &'a P);

impl<P: ProgramMemory, const IS_WIDE: bool> ProgramMemory for OfWidth<'_, P, IS_WIDE> {
    const NATIVE_INTERFACE: u8 = P::NATIVE_INTERFACE;
    const PROFILE: Option<&'static Profile> = P::PROFILE;

    #[inline(always)]
    fn len(&self) -> u16 {
        self.0.len()
    }
    #[inline(always)]
    fn byte(&self, offset: u16) -> u8 {
        self.0.byte(offset)
    }
    #[inline(always)]
    fn word(&self, offset: u16) -> u16 {
        self.0.word(offset)
    }
    #[inline(always)]
    fn token_table(&self, offset: u16) -> [u8; 2] {
        self.0.token_table(offset)
    }
    #[inline(always)]
    fn kinds_at(&self, offset: u16) -> u16 {
        self.0.kinds_at(offset)
    }
    #[inline(always)]
    fn kind(&self, at: u16) -> u8 {
        self.0.kind(at)
    }
    #[inline(always)]
    fn routine(&self, module: u8, routine: u8) -> Option<Routine> {
        self.0.routine(module, routine)
    }
    fn modules_end(&self) -> Option<u16> {
        self.0.modules_end()
    }
    fn read_header(&self, header: &mut Header) {
        self.0.read_header(header);
    }
    #[inline(always)]
    fn is_wide(&self) -> bool {
        IS_WIDE
    }
}
