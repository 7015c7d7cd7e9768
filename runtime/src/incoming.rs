//! Characters that an interrupt takes from the line, until the scan looks for them.

use core::convert::Infallible;
use core::sync::atomic::{AtomicU8, AtomicUsize, Ordering};

use embedded_io::{ErrorType, Read, ReadReady};

/// A ring of one place more than it has room for, in a static of the board: one side fills it, an
/// interrupt, and the other, the scan, reads it. What comes when there is no room is lost.
pub struct Incoming<const LEN: usize> {
    places: [AtomicU8; LEN],
    /// Where the next one goes, and where the next one is read.
    filled: AtomicUsize,
    read: AtomicUsize,
}

impl<const LEN: usize> Incoming<LEN> {
    /// None yet.
    pub const fn new() -> Self {
        Incoming {
            places: [const { AtomicU8::new(0) }; LEN],
            filled: AtomicUsize::new(0),
            read: AtomicUsize::new(0),
        }
    }

    /// One has come. For the interrupt alone.
    pub fn push(&self, character: u8) {
        let place = self.filled.load(Ordering::Relaxed);
        let next = (place + 1) % LEN;
        // Without room the newest is lost, not one of a frame that is complete.
        if next != self.read.load(Ordering::Acquire) {
            self.places[place].store(character, Ordering::Relaxed);
            self.filled.store(next, Ordering::Release);
        }
    }

    fn is_empty(&self) -> bool {
        self.read.load(Ordering::Relaxed) == self.filled.load(Ordering::Acquire)
    }

    fn pop(&self) -> Option<u8> {
        if self.is_empty() {
            return None;
        }
        let place = self.read.load(Ordering::Relaxed);
        let character = self.places[place].load(Ordering::Relaxed);
        self.read.store((place + 1) % LEN, Ordering::Release);
        Some(character)
    }
}

impl<const LEN: usize> Default for Incoming<LEN> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const LEN: usize> ErrorType for &Incoming<LEN> {
    type Error = Infallible;
}

impl<const LEN: usize> ReadReady for &Incoming<LEN> {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.is_empty())
    }
}

impl<const LEN: usize> Read for &Incoming<LEN> {
    /// Does not wait: none is 0.
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        let mut count = 0;
        for (place, character) in bytes.iter_mut().zip(core::iter::from_fn(|| self.pop())) {
            (*place, count) = (character, count + 1);
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_come_in_order_and_the_newest_are_lost() {
        static WAITING: Incoming<5> = Incoming::new();
        let mut reader = &WAITING;
        assert_eq!((reader.read_ready(), reader.read(&mut [0; 2])), (Ok(false), Ok(0)));
        (1..=6).for_each(|character| WAITING.push(character));
        let mut bytes = [0; 3];
        assert_eq!((reader.read_ready(), reader.read(&mut bytes)), (Ok(true), Ok(3)));
        assert_eq!(bytes, [1, 2, 3]);
        // What was not asked for is still there.
        WAITING.push(7);
        assert_eq!(reader.read(&mut bytes), Ok(2));
        assert_eq!(bytes, [4, 7, 3]);
        assert_eq!(reader.read_ready(), Ok(false));
    }
}
