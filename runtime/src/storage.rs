//! Flash that is read and written in pieces: what retained values and programs have in common.

use embedded_storage::nor_flash::NorFlash;

/// Bytes that are read or written at once; what a board can write at once divides it.
pub const PIECE: usize = 256;
/// What erased flash reads as.
pub const ERASED: u8 = 0xFF;

/// Bytes that can be read and written at once.
pub const fn unit<S: NorFlash>() -> usize {
    if S::WRITE_SIZE > S::READ_SIZE { S::WRITE_SIZE } else { S::READ_SIZE }
}

/// Reads bytes in order, each with its offset; whether they could be read.
pub fn read<S: NorFlash>(
    storage: &mut S,
    at: u32,
    len: usize,
    mut take: impl FnMut(usize, u8),
) -> bool {
    let mut piece = [0; PIECE];
    let mut done = 0;
    while done < len {
        let count = (len - done).min(PIECE);
        let Some(part) = piece.get_mut(..count.next_multiple_of(unit::<S>())) else { return false };
        if storage.read(at + done as u32, part).is_err() {
            return false;
        }
        (done..done + count).zip(part).for_each(|(offset, byte)| take(offset, *byte));
        done += count;
    }
    true
}

/// Whether all of it reads as erased.
pub fn is_erased<S: NorFlash>(storage: &mut S, at: u32, len: u32) -> bool {
    let mut is_erased = true;
    read(storage, at, len as usize, |_, byte| is_erased &= byte == ERASED) && is_erased
}
