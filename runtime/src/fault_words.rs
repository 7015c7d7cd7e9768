//! A fault as the two words that a board keeps where a reset leaves them alone.

/// Beside a fault: that it is one and no accident of power-up, and that it holds the board in STOP.
const IS_FAULT: u32 = 0x5A17_0000;
const HOLDS: u32 = 1;

/// What is kept of a fault. `holds`: the board must not go to RUN by itself after the reset that
/// follows.
pub const fn fault_words(fault: u32, holds: bool) -> [u32; 2] {
    [fault, IS_FAULT | holds as u32]
}

/// The fault that was kept, 0 if there is none, and whether it holds the board in STOP.
pub const fn fault_of_words([fault, kind]: [u32; 2]) -> (u32, bool) {
    if kind & !HOLDS != IS_FAULT { (0, false) } else { (fault, kind & HOLDS != 0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_comes_back_and_what_is_in_memory_at_power_up_is_none() {
        for (fault, holds) in [(0, false), (7, true), (u32::MAX, false)] {
            assert_eq!(fault_of_words(fault_words(fault, holds)), (fault, holds));
        }
        for words in [[0, 0], [5, u32::MAX], [5, 1], [5, IS_FAULT | 2]] {
            assert_eq!(fault_of_words(words), (0, false));
        }
    }
}
