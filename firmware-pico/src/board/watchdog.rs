//! The hardware watchdog: it resets the chip, all but its own scratch registers, when it is not fed
//! or when it is told to.

use rp2040_hal::pac;

/// Microseconds until it resets: half a second that a scan may take, and the 400 ms that erasing a
/// sector of flash takes at most.
const WAIT_US: u32 = 1_000_000;
/// RP2040-E1: it counts down by two each microsecond.
const LOAD: u32 = 2 * WAIT_US;
/// What it resets: all but the oscillators.
const RESETS_ALL: u32 = 0x0001_FFFC;
/// In a scratch register, as the SDK of the Pico does it: it was this firmware that started it. The
/// chip's ROM uses it too, to start what was loaded over USB.
const IS_OURS: u32 = 0x6AB7_3121;

fn watchdog() -> &'static pac::watchdog::RegisterBlock {
    // SAFETY: only the board uses it: this module its function, others scratch registers.
    unsafe { &*pac::WATCHDOG::PTR }
}

/// Switches it off: whatever ran before may have left it on. Returns whether it was not fed in
/// time, which is why there was a reset.
pub fn stop() -> bool {
    watchdog().ctrl().modify(|_, w| w.enable().clear_bit());
    watchdog().reason().read().timer().bit_is_set()
        && watchdog().scratch4().read().bits() == IS_OURS
}

/// Switches it on.
pub fn start() {
    choose_what_is_reset();
    feed();
    // SAFETY: a register without function.
    watchdog().scratch4().write(|w| unsafe { w.bits(IS_OURS) });
    watchdog().ctrl().write(|w| w.enable().set_bit());
}

fn choose_what_is_reset() {
    // SAFETY: the bits exist.
    unsafe { (*pac::PSM::PTR).wdsel().write(|w| w.bits(RESETS_ALL)) };
}

/// The firmware is alive.
pub fn feed() {
    // SAFETY: any number of 24 bits is good.
    watchdog().load().write(|w| unsafe { w.bits(LOAD) });
}

/// Resets now, also before it was started.
pub fn reset() -> ! {
    choose_what_is_reset();
    watchdog().ctrl().modify(|_, w| w.trigger().set_bit());
    loop {
        cortex_m::asm::nop();
    }
}
