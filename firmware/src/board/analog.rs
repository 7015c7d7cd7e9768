//! The six analog inputs, converted in the background: one conversion per tick, each input every 6 ms.

use core::cell::Cell;

use avr_device::atmega328p::Peripherals;
use avr_device::interrupt::{self, CriticalSection, Mutex};
use plc_isa::ANALOG_INPUTS;

const CHANNELS: usize = ANALOG_INPUTS as usize;
const ALL_CHANNELS: u8 = (1 << CHANNELS) - 1;
/// Supply voltage as reference.
const REFERENCE_AVCC: u8 = 1 << 6;

/// Raw 10-bit counts, smoothed. Harnesses read and write them by this name.
#[unsafe(no_mangle)]
static UNO200_ANALOG: Mutex<[Cell<u16>; CHANNELS]> = Mutex::new([const { Cell::new(0) }; CHANNELS]);
/// A bit for each input with a value that has not been taken yet.
#[unsafe(no_mangle)]
static UNO200_ANALOG_FRESH: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));
/// The sum that smooths each input, and how many samples it holds, as a power of two.
static SUMS: Mutex<[Cell<u16>; CHANNELS]> = Mutex::new([const { Cell::new(0) }; CHANNELS]);
static FILTER: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));
static CHANNEL: Mutex<Cell<u8>> = Mutex::new(Cell::new(0));

/// Switches the converter on.
pub fn start() {
    // SAFETY: before interrupts are enabled, which alone use the converter later.
    let adc = unsafe { Peripherals::steal() }.ADC;
    // SAFETY: every value of this register is a valid choice of reference and channel.
    adc.admux().write(|w| unsafe { w.bits(REFERENCE_AVCC) });
    // Digital input buffers of the analog pins off.
    // SAFETY: the six bits exist.
    adc.didr0().write(|w| unsafe { w.bits(0x3F) });
    // 125 kHz: full precision, 104 us for a conversion.
    adc.adcsra().write(|w| w.aden().set_bit().adsc().set_bit().adps().prescaler_128());
}

/// Takes the result of the conversion that the last tick started, and starts the next.
#[inline]
pub fn take_and_start_next(cs: CriticalSection<'_>) {
    // SAFETY: after `start` only this interrupt uses the converter.
    let adc = unsafe { Peripherals::steal() }.ADC;
    let channel = CHANNEL.borrow(cs).get();
    let (values, sums, filter) = (UNO200_ANALOG.borrow(cs), SUMS.borrow(cs), FILTER.borrow(cs).get());
    if let (Some(value), Some(sum)) = (values.get(usize::from(channel)), sums.get(usize::from(channel))) {
        // A sample replaces its share of the sum; 64 samples of 10 bits are 16 bits.
        sum.set(sum.get() - (sum.get() >> filter) + adc.adc().read().bits());
        value.set(sum.get() >> filter);
    }
    let fresh = UNO200_ANALOG_FRESH.borrow(cs);
    fresh.set(fresh.get() | 1 << channel);
    let next = if usize::from(channel) + 1 < CHANNELS { channel + 1 } else { 0 };
    CHANNEL.borrow(cs).set(next);
    // SAFETY: as in `start`; the channel is 0 to 5.
    adc.admux().write(|w| unsafe { w.bits(REFERENCE_AVCC | next) });
    adc.adcsra().modify(|_, w| w.adsc().set_bit());
}

/// Waits until every input has been converted once, 7 ms: for the start, so that the first scan sees no zeros.
pub fn wait_for_all() {
    while interrupt::free(|cs| UNO200_ANALOG_FRESH.borrow(cs).get()) != ALL_CHANNELS {}
}

/// Smooths over 2 to the power of `filter` samples from now on, beginning with the values of now.
pub fn set_filter(filter: u8) {
    interrupt::free(|cs| {
        FILTER.borrow(cs).set(filter);
        for (sum, value) in SUMS.borrow(cs).iter().zip(UNO200_ANALOG.borrow(cs)) {
            sum.set(value.get() << filter);
        }
    });
}

/// Hands out the raw counts of every input that has a new value.
pub fn take_fresh(mut take: impl FnMut(u8, u16)) {
    for channel in 0..CHANNELS as u8 {
        let value = interrupt::free(|cs| {
            let fresh = UNO200_ANALOG_FRESH.borrow(cs);
            let bit = 1 << channel;
            if fresh.get() & bit == 0 {
                return None;
            }
            fresh.set(fresh.get() & !bit);
            UNO200_ANALOG.borrow(cs).get(usize::from(channel)).map(Cell::get)
        });
        if let Some(value) = value {
            take(channel, value);
        }
    }
}

/// Whether any input has a new value.
pub fn has_fresh() -> bool {
    interrupt::free(|cs| UNO200_ANALOG_FRESH.borrow(cs).get() != 0)
}
