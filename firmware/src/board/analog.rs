//! The six analog inputs, converted in the background: one conversion per tick, each input every 6
//! ms.

use core::arch::global_asm;
use core::mem::offset_of;

use avr_device::atmega328p::ADC;
use avr_device::interrupt;
use plc_isa::{AIN_START, AIW_START, ANALOG_INPUTS, AnalogInput};

use super::clock::UNO200_TICK;

const CHANNELS: usize = ANALOG_INPUTS as usize;
const ALL_CHANNELS: u8 = (1 << CHANNELS) - 1;
/// Supply voltage as reference.
const REFERENCE_AVCC: u8 = 1 << 6;

/// What the interrupt of the tick works with.
#[repr(C)]
struct Analog {
    /// Raw 10-bit counts, smoothed.
    values: [u16; CHANNELS],
    /// The sum that smooths each input: 64 samples of 10 bits are 16 bits.
    sums: [u16; CHANNELS],
    /// A bit for each input with a value that has not been taken yet.
    fresh: u8,
    /// How many samples the sums hold, as a power of two.
    filter: u8,
}

/// Only used while interrupts are off.
static mut ANALOG: Analog =
    Analog { values: [0; CHANNELS], sums: [0; CHANNELS], fresh: 0, filter: 0 };

global_asm!(
    ".equ AIW_START, {aiw_start}",
    ".equ AIN_START, {ain_start}",
    ".equ REFERENCE, {reference}",
    ".equ CHANNELS, {channels}",
    ".equ RAW_MAX, {raw_max}",
    ".equ SCALE, {scale}",
    ".equ SUMS, {sums}",
    ".equ FRESH, {fresh}",
    ".equ FILTER, {filter}",
    ".set ANALOG, {analog}",
    ".set UNO200_TICK, {tick}",
    // Harnesses read and write them by these names.
    ".global UNO200_ANALOG",
    ".set UNO200_ANALOG, ANALOG",
    ".global UNO200_ANALOG_FRESH",
    ".set UNO200_ANALOG_FRESH, ANALOG + FRESH",
    aiw_start = const AIW_START,
    ain_start = const AIN_START,
    reference = const REFERENCE_AVCC,
    channels = const ANALOG_INPUTS,
    raw_max = const AnalogInput::RAW_MAX,
    scale = const AnalogInput::SCALE,
    sums = const offset_of!(Analog, sums),
    fresh = const offset_of!(Analog, fresh),
    filter = const offset_of!(Analog, filter),
    analog = sym ANALOG,
    tick = sym UNO200_TICK,
);
global_asm!(include_str!("tick.s"), options(raw));

unsafe extern "C" {
    fn uno200_take_analog();
}

/// Switches the converter on.
pub fn start() {
    // SAFETY: before interrupts are enabled, which alone use the converter later.
    let adc = unsafe { ADC::steal() };
    // SAFETY: every value of this register is a valid choice of reference and channel.
    adc.admux().write(|w| unsafe { w.bits(REFERENCE_AVCC) });
    // Digital input buffers of the analog pins off.
    // SAFETY: the six bits exist.
    adc.didr0().write(|w| unsafe { w.bits(0x3F) });
    adc.adcsra().write(|w| w.aden().set_bit().adsc().set_bit().adps().prescaler_128());
}

/// Waits until every input has been converted once, 7 ms: for the start, so that the first scan
/// sees no zeros.
pub fn wait_for_all() {
    while fresh() != ALL_CHANNELS {}
}

/// Smooths over 2 to the power of `filter` samples from now on, beginning with the values of now.
pub fn set_filter(filter: u8) {
    interrupt::free(|_| {
        let analog = &raw mut ANALOG;
        // SAFETY: interrupts are off.
        let analog = unsafe { &mut *analog };
        analog.filter = filter;
        for (sum, value) in analog.sums.iter_mut().zip(&analog.values) {
            *sum = value << filter;
        }
        // A program that begins finds all values there.
        analog.fresh = ALL_CHANNELS;
    });
}

/// Gives the image of inputs the counts of every input that has a new value, as they are and to
/// scale: [`plc_isa::AnalogInput`].
#[inline(always)]
pub fn take_fresh() {
    // SAFETY: the assembly writes these words of data memory, which nobody holds a reference to.
    unsafe { uno200_take_analog() }
}

/// Whether any input has a new value.
#[inline(always)]
pub fn has_fresh() -> bool {
    fresh() != 0
}

#[inline(always)]
fn fresh() -> u8 {
    // SAFETY: one byte, which is read in one go.
    unsafe { (&raw const ANALOG.fresh).read_volatile() }
}
