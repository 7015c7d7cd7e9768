//! What the registers of the Uno's chip say of its output pins, for whoever emulates it: `data` is
//! its data memory from address 0 on. Levels of pins that the emulator knows itself come in.

use plc_isa::{PULSES_MODULE, UNO, state_at};

/// A bit for each output with a pin, Q0.0 in bit 0.
pub const OUTPUT_PINS: u8 = (1 << UNO.digital_outputs()) - 1;

/// Timer 1: TIMSK1, TCCR1A, ICR1.
const TIMER_1_INTERRUPTS: u16 = 0x6F;
const TIMER_1_MODE: u16 = 0x80;
const TIMER_1_TOP: u16 = 0x86;
/// For Q0.1 and Q0.2 where in TCCR1A the two bits are that connect the pin, and the compare
/// register. The pin is high up to that, or, if both are set, from there on.
const MODULATED: [(u8, u16); 2] = [(6, 0x88), (4, 0x8A)];
/// Where the module of pulse outputs has the ticks of a cycle that the output is on, and after
/// them those that it is off, while the interrupt makes the edges.
const TICKS: u16 = state_at(PULSES_MODULE) + 6;

/// A flag of the modules in GPIOR1: analog outputs are on. And the levels that the process image
/// gives the pins, PORTB.
const ANALOG_OUTPUTS_ON: (u16, u8) = (0x4A, 1 << 4);
const IMAGE_LEVELS: u16 = 0x25;

/// The level of each output pin that is driven, Q0.0 in bit 0; of one that is released the level
/// for off, and of an analog output the one that the process image would give it.
pub fn output_levels(data: &[u8], levels: u8, driven: u8, off_levels: u8) -> u8 {
    let levels = match byte(data, ANALOG_OUTPUTS_ON.0) & ANALOG_OUTPUTS_ON.1 {
        0 => levels,
        _ => byte(data, IMAGE_LEVELS),
    };
    levels & driven | off_levels & !driven
}

/// The part of the time in thousandths that the pin of output Q0.`output` is high, or with trains
/// and modulation in milliseconds the output is on, where timer 1 modulates it up to ICR1.
pub fn duty(data: &[u8], output: u8) -> Option<u16> {
    let (mode_at, compare) = *MODULATED.get(usize::from(output).checked_sub(1)?)?;
    let word = |low: u16| u32::from(u16::from_le_bytes([byte(data, low), byte(data, low + 1)]));
    let (on, off) =
        match (byte(data, TIMER_1_MODE) >> mode_at & 3, byte(data, TIMER_1_INTERRUPTS) & 1) {
            (0, _) => return None,
            (_, 1) => (word(TICKS), word(TICKS + 2)),
            (mode, _) => {
                let (top, compare) = (word(TIMER_1_TOP), word(compare).min(word(TIMER_1_TOP)));
                if mode == 3 { (top - compare, compare + 1) } else { (compare + 1, top - compare) }
            }
        };
    Some((1000 * on / (on + off).max(1)) as u16)
}

fn byte(data: &[u8], address: u16) -> u8 {
    data.get(usize::from(address)).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_and_duty_come_from_registers() {
        let mut data = [0; 0x900];
        assert_eq!(output_levels(&data, 0b10_1010, 0b00_1111, 0b11_0000), 0b11_1010);
        data[usize::from(IMAGE_LEVELS)] = 0b01_0001;
        data[usize::from(ANALOG_OUTPUTS_ON.0)] = ANALOG_OUTPUTS_ON.1;
        assert_eq!(output_levels(&data, 0b10_1010, OUTPUT_PINS, 0), 0b01_0001);
        assert_eq!((duty(&data, 1), duty(&data, 3), duty(&data, 0)), (None, None, None));
        // High up to 499 of 0 to 999.
        data[usize::from(TIMER_1_MODE)] = 0b10 << 4;
        data[0x86..0x88].copy_from_slice(&999u16.to_le_bytes());
        data[0x8A..0x8C].copy_from_slice(&249u16.to_le_bytes());
        assert_eq!((duty(&data, 1), duty(&data, 2)), (None, Some(250)));
        assert_eq!(output_levels(&[], 0, 0, 0), 0, "whatever the memory");
    }
}
