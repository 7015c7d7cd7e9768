//! The millisecond tick, by Timer0. Time is only handed out here; what it means is not known.

use core::cell::Cell;

use avr_device::atmega328p::{Peripherals, TC0};
use avr_device::interrupt::{self, Mutex};

use super::analog;

/// Timer counts of 4 us in a millisecond.
const COUNTS_PER_MS: u8 = 250;

/// Milliseconds since power-up. Wraps after 49.7 days. Harnesses read and write it by this name.
#[unsafe(no_mangle)]
static UNO200_TICK: Mutex<Cell<u32>> = Mutex::new(Cell::new(0));

/// Starts the tick.
pub fn start(timer: &TC0) {
    timer.ocr0a().write(|w| w.set(COUNTS_PER_MS - 1));
    timer.tccr0a().write(|w| w.wgm0().ctc());
    timer.tccr0b().write(|w| w.cs0().prescale_64());
    timer.timsk0().write(|w| w.ocie0a().set_bit());
}

/// The millisecond clock.
#[inline(never)]
pub fn now_ms() -> u32 {
    interrupt::free(|cs| UNO200_TICK.borrow(cs).get())
}

/// Microseconds, in steps of 4; wraps after 71 minutes.
#[inline(never)]
pub fn now_us() -> u32 {
    let (ms, counts) = interrupt::free(|cs| {
        // SAFETY: registers that nobody else uses are read, and interrupts are off.
        let timer = unsafe { Peripherals::steal() }.TC0;
        let (ms, counts) = (UNO200_TICK.borrow(cs).get(), timer.tcnt0().read().bits());
        // The count may have begun again before the interrupt could count the millisecond.
        let pending = timer.tifr0().read().ocf0a().bit_is_set() && counts < COUNTS_PER_MS / 2;
        (ms.wrapping_add(u32::from(pending)), counts)
    });
    ms.wrapping_mul(1000).wrapping_add(u32::from(counts) * 4)
}

#[avr_device::interrupt(atmega328p)]
fn TIMER0_COMPA() {
    interrupt::free(|cs| {
        let tick = UNO200_TICK.borrow(cs);
        tick.set(tick.get().wrapping_add(1));
        analog::take_and_start_next(cs);
    });
}
