//! The millisecond tick, by Timer0, and a finer measure, by Timer1. Time is only handed out here; what it means is not known.

use core::cell::Cell;

use avr_device::atmega328p::{TC0, TC1};
use avr_device::interrupt::{self, CriticalSection, Mutex};

use super::analog;

/// Timer counts of 4 us in a millisecond.
pub const COUNTS_PER_MS: u8 = 250;

/// Milliseconds since power-up. Wraps after 49.7 days. Harnesses read and write it by this name.
#[unsafe(no_mangle)]
static UNO200_TICK: Mutex<Cell<u32>> = Mutex::new(Cell::new(0));

/// Starts both.
pub fn start(timer: &TC0, counter: &TC1) {
    counter.tccr1b().write(|w| w.cs1().prescale_64());
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

/// Its lower half, for what takes no longer than a minute.
#[inline(always)]
pub fn now_ms_low() -> u16 {
    interrupt::free(|cs| UNO200_TICK.borrow(cs).get()) as u16
}

/// Counts of 4 us, by Timer1. They wrap after 262 ms.
#[inline(always)]
pub fn counts() -> u16 {
    // SAFETY: a register that nobody else uses is read.
    unsafe { TC1::steal() }.tcnt1().read().bits()
}

#[avr_device::interrupt(atmega328p)]
fn TIMER0_COMPA() {
    // SAFETY: interrupts are off in an interrupt.
    let cs = unsafe { CriticalSection::new() };
    let tick = UNO200_TICK.borrow(cs);
    tick.set(tick.get().wrapping_add(1));
    analog::take_and_start_next(cs);
}
