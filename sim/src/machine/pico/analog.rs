//! Analog inputs: what the converter is to count, and what the harness writes to memory.

use plc_isa::{AnalogInput, PICO};
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

/// All analog inputs as they are in data memory, scaled before raw. The converter alone does not
/// give them in time: the firmware takes values that are up to half a millisecond old, smooths them
/// where the program asks for it, and has no count for most of them.
pub(super) fn image(inputs: &Inputs) -> Vec<u8> {
    let words = inputs.scaled.iter().chain(&inputs.raw);
    words.flat_map(|word| word.to_be_bytes()).collect()
}

/// Whether any of them is not 0.
pub(super) fn is_any(inputs: &Inputs) -> bool {
    inputs.scaled.iter().chain(&inputs.raw).any(|&value| value != 0)
}

#[cfg(test)]
mod tests {
    use plc_isa::ANALOG_INPUTS;

    use super::*;

    #[test]
    fn values_become_counts_and_words() {
        let mut inputs = Inputs::default();
        assert_eq!((counts(&inputs), is_any(&inputs)), (vec![0; 3], false));
        (inputs.raw[1], inputs.scaled[1], inputs.raw[5]) = (1023, 32_000, 7);
        assert_eq!((counts(&inputs), is_any(&inputs)), (vec![0, 4095, 0], true));
        let bytes = image(&inputs);
        assert_eq!(bytes.len(), 4 * usize::from(ANALOG_INPUTS));
        assert_eq!(bytes[2..4], 32_000_u16.to_be_bytes());
        assert_eq!((bytes[15], bytes[23]), (0xFF, 7));
    }
}
