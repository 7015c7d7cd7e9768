//! Outputs that are on for a part of the time: the PWM slices of their pins. A slice has two
//! channels and serves two outputs beside each other, which have a duty each and the period in
//! common.

use rp2040_hal::pac;

use super::points::{self, OUTPUTS, OUTPUTS_SHIFT};

/// A period is as many counts as there are duties, so that each of them is exact.
const COUNTS: u16 = 1000;
/// Counts are microseconds: 1 kHz. A filter of a resistor and a capacitor makes an even voltage of
/// it, a lamp does not flicker, and what switches a valve or a motor still follows.
const DIVIDER: u8 = 125;
/// Function of a pin.
const PWM: u8 = 4;

/// Which outputs are modulated, a bit each.
pub struct Pwm {
    modulated: u8,
}

fn pwm() -> &'static pac::pwm::RegisterBlock {
    // SAFETY: only this module uses it.
    unsafe { &*pac::PWM::PTR }
}

/// The slice of an output, and whether it has its second channel.
fn slice(output: u8) -> (usize, bool) {
    let pin = usize::from(output) + OUTPUTS_SHIFT as usize;
    (pin / 2 % 8, pin % 2 == 1)
}

/// Sets the slices up; none runs.
pub fn set_up(pac: &pac::Peripherals) -> Pwm {
    pac.RESETS.reset().modify(|_, w| w.pwm().clear_bit());
    while pac.RESETS.reset_done().read().pwm().bit_is_clear() {}
    for output in 0..OUTPUTS {
        let registers = pwm().ch(slice(output).0);
        // SAFETY: any divider from 1 on and any period is good.
        unsafe {
            registers.div().write(|w| w.int().bits(DIVIDER).frac().bits(0));
            registers.top().write(|w| w.top().bits(COUNTS - 1));
            registers.cc().write(|w| w.bits(0));
        }
    }
    Pwm { modulated: 0 }
}

/// Ends it all, whatever was modulated: for a panic too.
pub fn release() {
    (0..OUTPUTS).for_each(points::give_back);
    for output in 0..OUTPUTS {
        stop(slice(output).0);
    }
}

fn stop(slice: usize) {
    let registers = pwm().ch(slice);
    registers.csr().write(|w| w.en().clear_bit());
    // SAFETY: duties of 0, from the beginning of a period.
    unsafe {
        registers.cc().write(|w| w.bits(0));
        registers.ctr().write(|w| w.bits(0));
    }
}

impl Pwm {
    /// The part of the time in thousandths that an output is high; `None` ends that.
    #[inline(always)]
    pub fn modulate(&mut self, output: u8, duty: Option<u16>) {
        let is_modulated = self.modulated >> output & 1 != 0;
        match duty {
            Some(duty) => self.set(output, duty),
            None if is_modulated => self.end(output),
            None => {}
        }
    }

    #[inline(never)]
    fn set(&mut self, output: u8, duty: u16) {
        let duty = duty.min(COUNTS);
        let (slice, is_second) = slice(output);
        let registers = pwm().ch(slice);
        // It counts from the next period on: there are no short pulses between two duties.
        // SAFETY: any number is good.
        registers
            .cc()
            .modify(|_, w| unsafe { if is_second { w.b().bits(duty) } else { w.a().bits(duty) } });
        if self.modulated >> output & 1 == 0 {
            registers.csr().write(|w| w.en().set_bit());
            points::give_to(output, PWM);
            self.modulated |= 1 << output;
        }
    }

    #[inline(never)]
    fn end(&mut self, output: u8) {
        points::give_back(output);
        self.modulated &= !(1 << output);
        // Where the other output of the slice goes on, this one begins with 0 the next time.
        let (slice, is_second) = slice(output);
        // The outputs of a slice have numbers that differ in the lowest bit.
        if self.modulated >> (output & !1) & 0b11 == 0 {
            stop(slice);
        } else {
            // SAFETY: a duty of 0.
            pwm()
                .ch(slice)
                .cc()
                .modify(|_, w| unsafe { if is_second { w.b().bits(0) } else { w.a().bits(0) } });
        }
    }

    /// Ends it for all outputs.
    #[inline(always)]
    pub fn end_all(&mut self) {
        if self.modulated != 0 {
            release();
            self.modulated = 0;
        }
    }
}
