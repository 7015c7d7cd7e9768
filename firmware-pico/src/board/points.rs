//! Digital inputs and outputs, eight pins each side by side.

use rp2040_hal::pac;

/// I0.0 is GP2.
const INPUTS_SHIFT: u32 = 2;
const INPUTS: u8 = 8;
/// Q0.0 is GP10.
pub const OUTPUTS_SHIFT: u32 = 10;
pub const OUTPUTS: u8 = 8;
/// The pins of the outputs.
const OUTPUT_PINS: u32 = 0xFF << OUTPUTS_SHIFT;
/// Function of a pin: that the processor reads and writes it.
const SIO: u8 = 5;

fn sio() -> &'static pac::sio::RegisterBlock {
    // SAFETY: only this module uses these registers.
    unsafe { &*pac::SIO::PTR }
}

/// All pins as inputs, none driven.
pub fn set_up(pac: &pac::Peripherals) {
    pac.RESETS.reset().modify(|_, w| w.io_bank0().clear_bit().pads_bank0().clear_bit());
    while pac.RESETS.reset_done().read().io_bank0().bit_is_clear()
        || pac.RESETS.reset_done().read().pads_bank0().bit_is_clear()
    {}
    release();
    for (shift, points) in [(INPUTS_SHIFT, INPUTS), (OUTPUTS_SHIFT, OUTPUTS)] {
        for pin in (shift..).take(points.into()) {
            // With a pull-down, as after a reset: what is not connected is 0.
            let pad = pac.PADS_BANK0.gpio(pin as usize);
            pad.write(|w| w.ie().set_bit().od().clear_bit().pde().set_bit());
            set_function(pin, SIO);
        }
    }
}

fn set_function(pin: u32, function: u8) {
    // SAFETY: only this module and the set-up use the functions of pins; this one exists.
    unsafe {
        let pins = &*pac::IO_BANK0::PTR;
        pins.gpio(pin as usize).gpio_ctrl().write(|w| w.funcsel().bits(function));
    }
}

/// The pin of an output is another function's from now on.
pub fn give_to(output: u8, function: u8) {
    set_function(u32::from(output) + OUTPUTS_SHIFT, function);
}

/// The pin of an output is as this module says.
pub fn give_back(output: u8) {
    give_to(output, SIO);
}

/// The levels of the inputs.
#[inline(always)]
pub fn inputs() -> u8 {
    (sio().gpio_in().read().bits() >> INPUTS_SHIFT) as u8
}

/// Inputs with a pull-up, a bit each. The others have a pull-down.
pub fn set_pullups(inputs: u8) {
    // SAFETY: only this module uses these pads.
    let pads = unsafe { &*pac::PADS_BANK0::PTR };
    for input in 0..INPUTS {
        let is_on = inputs >> input & 1 != 0;
        let pad = pads.gpio((u32::from(input) + INPUTS_SHIFT) as usize);
        pad.modify(|_, w| w.pue().bit(is_on).pde().bit(!is_on));
    }
}

/// Drives the outputs to these levels.
#[inline(always)]
pub fn drive(levels: u8) {
    let levels = u32::from(levels) << OUTPUTS_SHIFT;
    // SAFETY: every bit is one of the outputs.
    unsafe {
        sio().gpio_out_set().write(|w| w.bits(levels));
        sio().gpio_out_clr().write(|w| w.bits(OUTPUT_PINS & !levels));
        sio().gpio_oe_set().write(|w| w.bits(OUTPUT_PINS));
    }
}

/// Drives none of them.
#[inline(always)]
pub fn release() {
    // SAFETY: as above.
    unsafe {
        sio().gpio_oe_clr().write(|w| w.bits(OUTPUT_PINS));
        sio().gpio_out_clr().write(|w| w.bits(OUTPUT_PINS));
    }
}
