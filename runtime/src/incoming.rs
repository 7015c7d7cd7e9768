//! Characters that an interrupt takes from the line, until the scan looks for them.

use core::cell::RefCell;
use core::convert::Infallible;

use critical_section::Mutex;
use embedded_io::{ErrorType, Read, ReadReady};
use heapless::Deque;

/// Up to so many characters, in a static of the board. What comes when there is no room is lost.
pub struct Incoming<const LEN: usize>(Mutex<RefCell<Deque<u8, LEN>>>);

impl<const LEN: usize> Incoming<LEN> {
    /// None yet.
    pub const fn new() -> Self {
        Incoming(Mutex::new(RefCell::new(Deque::new())))
    }

    /// One has come. For the interrupt.
    pub fn push(&self, character: u8) {
        critical_section::with(|section| {
            // Without room the newest is lost, not one of a frame that is complete.
            let _ = self.0.borrow_ref_mut(section).push_back(character);
        });
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
        Ok(critical_section::with(|section| !self.0.borrow_ref(section).is_empty()))
    }
}

impl<const LEN: usize> Read for &Incoming<LEN> {
    /// Does not wait: none is 0.
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        let next = || critical_section::with(|section| self.0.borrow_ref_mut(section).pop_front());
        let mut count = 0;
        for (place, character) in bytes.iter_mut().zip(core::iter::from_fn(next)) {
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
        static WAITING: Incoming<4> = Incoming::new();
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
    }
}
