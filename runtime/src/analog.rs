//! Analog inputs: smoothed as a program asks for, and given to the process image in both scales.

use plc_isa::{ANALOG_INPUTS, AnalogInput};
use plc_vm::Memory;

use crate::board::Board;

const CHANNELS: usize = ANALOG_INPUTS as usize;

/// The inputs, as parts of full scale, which is 65535.
#[derive(Debug, Clone, Copy)]
pub struct Analog {
    /// The sums that smooth them.
    sums: [u32; CHANNELS],
    /// How many samples the sums hold, as a power of two.
    filter: u8,
}

impl Analog {
    /// Nothing was converted yet.
    pub const NEW: Analog = Analog { sums: [0; CHANNELS], filter: 0 };

    /// Converts all for the first time, and smooths over 2 to the power of `filter` samples from
    /// now on.
    pub fn start<B: Board>(&mut self, board: &mut B, filter: u8) {
        self.filter = filter;
        for (channel, sum) in (0..B::PROFILE.analog_inputs()).zip(&mut self.sums) {
            *sum = u32::from(board.analog(channel)) << filter;
        }
    }

    /// Whether every value counts as it is.
    #[inline(always)]
    pub fn is_direct(&self) -> bool {
        self.filter == 0
    }

    /// Converts all once more.
    pub fn sample<B: Board>(&mut self, board: &mut B) {
        for (channel, sum) in (0..B::PROFILE.analog_inputs()).zip(&mut self.sums) {
            *sum = *sum - (*sum >> self.filter) + u32::from(board.analog(channel));
        }
    }

    /// Writes them to the process image.
    pub fn write(&self, memory: &mut Memory) {
        for (channel, &sum) in (0..).zip(&self.sums) {
            let reading = (sum >> self.filter) as u16;
            for (input, most) in [
                (AnalogInput::Raw(channel), AnalogInput::RAW_MAX),
                (AnalogInput::Scaled(channel), AnalogInput::SCALED_MAX),
            ] {
                memory.set_word(input.address(), part(reading, most));
            }
        }
    }
}

/// A reading in another scale, rounded.
fn part(reading: u16, most: u16) -> u16 {
    // Divided by 65535 without a division, for which not every processor has an instruction.
    let product = u32::from(reading) * u32::from(most) + 0x8000;
    ((product + (product >> 16)) >> 16) as u16
}

#[cfg(test)]
mod tests {
    use super::{AnalogInput, part};

    #[test]
    fn every_reading_is_its_part_rounded() {
        let full = u32::from(u16::MAX);
        for most in [AnalogInput::RAW_MAX, AnalogInput::SCALED_MAX] {
            for reading in 0..=u16::MAX {
                let wanted = (u32::from(reading) * u32::from(most) + full / 2) / full;
                assert_eq!(u32::from(part(reading, most)), wanted, "{reading} of {most}");
            }
        }
    }
}
