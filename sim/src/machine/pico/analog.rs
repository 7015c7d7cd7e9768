//! Analog inputs: what the converter is to count so that the program sees a value, and what the
//! harness writes to memory because no count gives it.

use plc_isa::{ANALOG_INPUTS, AnalogInput, PICO};
use plc_vm::Inputs;

use super::frames::Counts;

/// The highest count.
const COUNT_MAX: u32 = (1 << PICO.analog_bits) - 1;

/// The counts nearest to the values.
pub(super) fn counts(inputs: &Inputs) -> Counts {
    let most = u32::from(AnalogInput::SCALED_MAX);
    let count = |&scaled: &u16| (u32::from(scaled).min(most) * COUNT_MAX + most / 2) / most;
    let channels = usize::from(PICO.analog_inputs());
    inputs.scaled.iter().take(channels).map(|scaled| count(scaled) as u16).collect()
}

/// All analog inputs as they are in data memory, scaled before raw; `None` where the counts give
/// just that. With a filter they give what was before, too.
pub(super) fn correction(inputs: &Inputs, counts: &[u16], filter: u8) -> Option<Vec<u8>> {
    let given = |channel: usize, most: u16| {
        counts.get(channel).map_or(0, |&count| part(u32::from(count), u32::from(most)))
    };
    let is_given = (0..usize::from(ANALOG_INPUTS)).all(|channel| {
        inputs.raw[channel] == given(channel, AnalogInput::RAW_MAX)
            && inputs.scaled[channel] == given(channel, AnalogInput::SCALED_MAX)
    });
    let bytes = || {
        let words = inputs.scaled.iter().chain(&inputs.raw);
        words.flat_map(|word| word.to_be_bytes()).collect()
    };
    (filter != 0 || !is_given).then(bytes)
}

/// What the firmware makes of a count: its bits, repeated to 16, as a part of full scale.
fn part(count: u32, most: u32) -> u16 {
    let (full, reading) = (u32::from(u16::MAX), count << 4 | count >> 8);
    ((reading * most + full / 2) / full) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_count_gives_needs_no_correction() {
        let mut inputs = Inputs::default();
        assert_eq!((counts(&inputs), correction(&inputs, &[0; 3], 0)), (vec![0; 3], None));
        (inputs.raw[1], inputs.scaled[1]) = (1023, 32_000);
        assert_eq!(counts(&inputs), [0, 4095, 0]);
        assert_eq!(correction(&inputs, &counts(&inputs), 0), None);
        assert!(correction(&inputs, &counts(&inputs), 1).is_some(), "it would come later");
    }

    #[test]
    fn what_no_count_gives_is_written() {
        let mut inputs = Inputs::default();
        (inputs.raw[2], inputs.scaled[2]) = (1, AnalogInput::scale(1));
        inputs.raw[5] = 7;
        let bytes = correction(&inputs, &counts(&inputs), 0).unwrap();
        assert_eq!(bytes.len(), 24);
        assert_eq!(bytes[4..6], AnalogInput::scale(1).to_be_bytes());
        assert_eq!((bytes[17], bytes[23]), (1, 7));
    }
}
