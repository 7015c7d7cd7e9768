//! The six analog inputs, converted in the background: one conversion per tick, each input every 6 ms.

use core::cell::Cell;

use avr_device::atmega328p::ADC;
use avr_device::interrupt::{self, CriticalSection, Mutex};
use plc_isa::ANALOG_INPUTS;

const CHANNELS: usize = ANALOG_INPUTS as usize;
const ALL_CHANNELS: u8 = (1 << CHANNELS) - 1;
/// Supply voltage as reference.
const REFERENCE_AVCC: u8 = 1 << 6;

/// Raw 10-bit counts, smoothed. Harnesses read and write them by this name.
#[unsafe(no_mangle)]
static UNO200_ANALOG: [Mutex<Cell<u16>>; CHANNELS] = [const { Mutex::new(Cell::new(0)) }; CHANNELS];
/// A bit for each input with a value that has not been taken yet.
#[unsafe(no_mangle)]
static UNO200_ANALOG_FRESH: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));
/// The sum that smooths each input, and how many samples it holds, as a power of two.
static SUMS: [Mutex<Cell<u16>>; CHANNELS] = [const { Mutex::new(Cell::new(0)) }; CHANNELS];
static FILTER: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));
/// The input being converted, as number and as bit.
static CHANNEL: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));
static CHANNEL_BIT: Mutex<Cell<u8>> = Mutex::new(Cell::new(1));

/// Switches the converter on.
pub fn start() {
    // SAFETY: before interrupts are enabled, which alone use the converter later.
    let adc = unsafe { ADC::steal() };
    // SAFETY: every value of this register is a valid choice of reference and channel.
    adc.admux().write(|w| unsafe { w.bits(REFERENCE_AVCC) });
    // Digital input buffers of the analog pins off.
    // SAFETY: the six bits exist.
    adc.didr0().write(|w| unsafe { w.bits(0x3F) });
    convert(&adc);
}

/// Takes the result of the conversion that the last tick started, and starts the next.
#[inline]
pub fn take_and_start_next(cs: CriticalSection<'_>) {
    // SAFETY: after `start` only this interrupt uses the converter.
    let adc = unsafe { ADC::steal() };
    let (channel, bit) = (CHANNEL.borrow(cs).get(), CHANNEL_BIT.borrow(cs).get());
    if let (Some(value), Some(sum)) = (UNO200_ANALOG.get(usize::from(channel)), SUMS.get(usize::from(channel))) {
        let (value, sum) = (value.borrow(cs), sum.borrow(cs));
        // A sample replaces its share of the sum, which is the value; 64 samples of 10 bits are 16 bits.
        let total = sum.get().wrapping_sub(value.get()).wrapping_add(adc.adc().read().bits());
        sum.set(total);
        value.set(total >> FILTER.borrow(cs).get());
    }
    let fresh = UNO200_ANALOG_FRESH.borrow(cs);
    fresh.set(fresh.get() | bit);
    let (mut next, mut next_bit) = (channel + 1, bit << 1);
    if next_bit > ALL_CHANNELS {
        (next, next_bit) = (0, 1);
    }
    CHANNEL.borrow(cs).set(next);
    CHANNEL_BIT.borrow(cs).set(next_bit);
    // SAFETY: as in `start`; the channel is 0 to 5.
    adc.admux().write(|w| unsafe { w.bits(REFERENCE_AVCC | next) });
    convert(&adc);
}

/// Starts a conversion at 125 kHz: full precision, 104 us.
#[inline(always)]
fn convert(adc: &ADC) {
    adc.adcsra().write(|w| w.aden().set_bit().adsc().set_bit().adps().prescaler_128());
}

/// Waits until every input has been converted once, 7 ms: for the start, so that the first scan sees no zeros.
pub fn wait_for_all() {
    while interrupt::free(|cs| UNO200_ANALOG_FRESH.borrow(cs).get()) != ALL_CHANNELS {}
}

/// Smooths over 2 to the power of `filter` samples from now on, beginning with the values of now.
pub fn set_filter(filter: u8) {
    interrupt::free(|cs| {
        FILTER.borrow(cs).set(filter);
        for (sum, value) in SUMS.iter().zip(&UNO200_ANALOG) {
            sum.borrow(cs).set(value.borrow(cs).get() << filter);
        }
        // A program that begins finds all values there.
        UNO200_ANALOG_FRESH.borrow(cs).set(ALL_CHANNELS);
    });
}

/// Hands out the raw counts of every input that has a new value.
pub fn take_fresh(mut take: impl FnMut(u8, u16)) {
    let mut fresh = interrupt::free(|cs| UNO200_ANALOG_FRESH.borrow(cs).take());
    for (channel, value) in (0..).zip(&UNO200_ANALOG) {
        if fresh & 1 != 0 {
            take(channel, interrupt::free(|cs| value.borrow(cs).get()));
        }
        fresh >>= 1;
    }
}

/// Whether any input has a new value.
pub fn has_fresh() -> bool {
    interrupt::free(|cs| UNO200_ANALOG_FRESH.borrow(cs).get() != 0)
}
