//! Divisions of 32 bits by the divider beside the processor. These are the functions that the
//! compiler calls where the processor has no instruction, by the names of the ARM run-time ABI.
//!
//! Interrupts must not divide: they would disturb a division that is under way.

use rp2040_hal::pac;

/// Quotient, and in the upper half the remainder: in the two registers that are asked for.
type Both = u64;

fn sio() -> &'static pac::sio::RegisterBlock {
    // SAFETY: only this module uses the divider.
    unsafe { &*pac::SIO::PTR }
}

/// It has taken what to divide. By 0 it gives something; Rust asks before.
#[inline(always)]
fn quotient() -> u32 {
    while sio().div_csr().read().ready().bit_is_clear() {}
    sio().div_quotient().read().bits()
}

#[inline(always)]
fn both() -> Both {
    while sio().div_csr().read().ready().bit_is_clear() {}
    let remainder = sio().div_remainder().read().bits();
    u64::from(remainder) << 32 | u64::from(sio().div_quotient().read().bits())
}

#[inline(always)]
fn begin(dividend: u32, divisor: u32) {
    // SAFETY: any numbers are good.
    unsafe {
        sio().div_udividend().write(|w| w.bits(dividend));
        sio().div_udivisor().write(|w| w.bits(divisor));
    }
}

#[inline(always)]
fn begin_signed(dividend: i32, divisor: i32) {
    // SAFETY: any numbers are good.
    unsafe {
        sio().div_sdividend().write(|w| w.bits(dividend as u32));
        sio().div_sdivisor().write(|w| w.bits(divisor as u32));
    }
}

#[unsafe(no_mangle)]
extern "C" fn __aeabi_uidiv(dividend: u32, divisor: u32) -> u32 {
    begin(dividend, divisor);
    quotient()
}

#[unsafe(no_mangle)]
extern "C" fn __aeabi_uidivmod(dividend: u32, divisor: u32) -> Both {
    begin(dividend, divisor);
    both()
}

#[unsafe(no_mangle)]
extern "C" fn __aeabi_idiv(dividend: i32, divisor: i32) -> i32 {
    begin_signed(dividend, divisor);
    quotient() as i32
}

#[unsafe(no_mangle)]
extern "C" fn __aeabi_idivmod(dividend: i32, divisor: i32) -> Both {
    begin_signed(dividend, divisor);
    both()
}
