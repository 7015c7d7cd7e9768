//! Buttons and rings as inputs, a line of LEDs and three pins as outputs.

use nrf51_hal::pac;
use nrf51_hal::pac::gpio::pin_cnf::PULL_A;

/// I0.0 and up: buttons A and B, rings P0, P1 and P2.
const INPUTS: [usize; 5] = [17, 26, 3, 2, 1];
/// Those have resistors on the board, and are low while they are pressed.
const BUTTONS: u8 = 0b0_0011;
/// Q0.0 and up: columns of the LEDs in the second line from the left, then P8, P12 and P16.
const OUTPUTS: [u32; 8] = [7, 8, 9, 10, 11, 18, 20, 16];
/// A column is low where its LED is on; the row is high for all of them.
const COLUMNS: u8 = 0b0001_1111;
const ROW: u32 = 1 << 15;

fn port() -> &'static pac::gpio::RegisterBlock {
    // SAFETY: only this module uses these pins.
    unsafe { &*pac::GPIO::PTR }
}

/// The pins of outputs, a bit each.
fn pins(outputs: u8) -> u32 {
    let pins = OUTPUTS.iter().enumerate();
    pins.fold(0, |pins, (output, pin)| pins | u32::from(outputs >> output & 1) << pin)
}

/// All pins as inputs, none driven.
pub fn set_up() {
    release();
    set_pullups(0);
}

/// The levels of the inputs; a button is 1 while it is pressed.
pub fn inputs() -> u8 {
    let pins = port().in_.read().bits();
    INPUTS.iter().rfold(0, |levels, pin| levels << 1 | (pins >> pin & 1) as u8) ^ BUTTONS
}

/// Inputs with a pull-up, a bit each. The others but the buttons have a pull-down: what is not
/// connected is 0.
pub fn set_pullups(inputs: u8) {
    for (input, &pin) in INPUTS.iter().enumerate() {
        let pull = match (BUTTONS >> input & 1, inputs >> input & 1) {
            (1, _) => PULL_A::DISABLED,
            (_, 0) => PULL_A::PULLDOWN,
            _ => PULL_A::PULLUP,
        };
        port().pin_cnf[pin].write(|w| w.dir().input().input().connect().pull().variant(pull));
    }
}

/// Drives the outputs to these levels.
pub fn drive(levels: u8) {
    let (all, high) = (ROW | pins(0xFF), ROW | pins(levels ^ COLUMNS));
    // SAFETY: every bit is one of the outputs.
    unsafe {
        port().outset.write(|w| w.bits(high));
        port().outclr.write(|w| w.bits(all & !high));
        port().dirset.write(|w| w.bits(all));
    }
}

/// Drives none of them.
pub fn release() {
    // SAFETY: as above.
    unsafe { port().dirclr.write(|w| w.bits(ROW | pins(0xFF))) };
}
