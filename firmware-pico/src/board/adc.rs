//! The analog inputs. A conversion takes 2 us: it goes on while the scan does, and is only waited
//! for where the last value is too old.

use rp2040_hal::pac;

use super::clock;

/// A0 is GP26, which is the converter's first channel.
const FIRST_PIN: usize = 26;
const CHANNELS: usize = 3;
/// How old a value may be, in microseconds. An S7-200 converts its inputs less often.
const FRESH_US: u32 = 500;

/// The converter.
pub struct Adc {
    inputs: [Input; CHANNELS],
    /// The channel that is being converted.
    converting: usize,
}

/// An input as it was last.
#[derive(Clone, Copy)]
struct Input {
    /// The part of full scale, which is 65535.
    value: u16,
    taken_us: u32,
}

fn adc() -> &'static pac::adc::RegisterBlock {
    // SAFETY: only this module uses it.
    unsafe { &*pac::ADC::PTR }
}

fn is_ready() -> bool {
    adc().cs().read().ready().bit_is_set()
}

/// Switches the converter on. Its clock runs, and so does that of microseconds.
pub fn set_up(pac: &pac::Peripherals) -> Adc {
    pac.RESETS.reset().modify(|_, w| w.adc().clear_bit());
    while pac.RESETS.reset_done().read().adc().bit_is_clear() {}
    for channel in 0..CHANNELS {
        // Nothing of the digital side: neither driver nor input nor resistors.
        let pad = pac.PADS_BANK0.gpio(FIRST_PIN + channel);
        pad.write(|w| w.od().set_bit().ie().clear_bit().pue().clear_bit().pde().clear_bit());
    }
    adc().cs().write(|w| w.en().set_bit());
    while !is_ready() {}
    let mut adc = Adc { inputs: [Input { value: 0, taken_us: 0 }; CHANNELS], converting: 0 };
    (0..CHANNELS).for_each(|channel| adc.convert(channel));
    adc
}

impl Adc {
    /// An input as a part of full scale: its last value, or a new one where that is too old.
    #[inline(always)]
    pub fn value(&mut self, channel: u8) -> u16 {
        let channel = usize::from(channel) % CHANNELS;
        if is_ready() {
            self.take();
        }
        if clock::now_us().wrapping_sub(self.inputs[channel].taken_us) > FRESH_US {
            self.convert(channel);
        }
        self.inputs[channel].value
    }

    /// Converts an input and waits for it.
    #[inline(never)]
    fn convert(&mut self, channel: usize) {
        while !is_ready() {}
        self.start(channel);
        while !is_ready() {}
        self.take();
    }

    /// Takes what was converted, and begins with the next input.
    fn take(&mut self) {
        let bits = adc().result().read().result().bits();
        self.inputs[self.converting] =
            Input { value: bits << 4 | bits >> 8, taken_us: clock::now_us() };
        self.start(if self.converting + 1 < CHANNELS { self.converting + 1 } else { 0 });
    }

    fn start(&mut self, channel: usize) {
        self.converting = channel;
        let channel = channel as u8;
        // SAFETY: there is a channel of this number.
        adc()
            .cs()
            .write(|w| unsafe { w.ainsel().bits(channel).en().set_bit().start_once().set_bit() });
    }
}
