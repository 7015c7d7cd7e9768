//! The clock: microseconds since the reset, which wrap.

use rp2040_hal::pac;

/// Lets it run. Its tick comes with the other clocks.
pub fn set_up(pac: &pac::Peripherals) {
    pac.RESETS.reset().modify(|_, w| w.timer().clear_bit());
    while pac.RESETS.reset_done().read().timer().bit_is_clear() {}
}

/// The time.
#[inline(always)]
pub fn now_us() -> u32 {
    // SAFETY: reading it has no effect.
    unsafe { (*pac::TIMER::PTR).timerawl().read().bits() }
}
