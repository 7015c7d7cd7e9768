//! Sets the hardware up after a reset.

use rp2040_hal::clocks::{UsbClock, init_clocks_and_plls};
use rp2040_hal::{Watchdog, pac};

use super::adc::Adc;
use super::pwm::Pwm;
use super::usb::Usb;
use super::{adc, clock, points, pwm, serial, vectors, watchdog};

/// The crystal of the Pico.
const CRYSTAL_HZ: u32 = 12_000_000;

/// What it leads to.
pub struct Found {
    /// Whether the watchdog had run out before the reset.
    pub was_hung: bool,
    pub adc: Adc,
    pub pwm: Pwm,
    pub usb: Usb,
}

#[inline(never)]
#[unsafe(link_section = ".set_up")]
pub fn set_up() -> Found {
    let was_hung = watchdog::stop();
    vectors::set_up();
    // SAFETY: once, before anything else uses the peripherals.
    let pac = unsafe { pac::Peripherals::steal() };
    points::set_up(&pac);
    let usb_clock = start_clocks();
    clock::set_up(&pac);
    let adc = adc::set_up(&pac);
    let pwm = pwm::set_up(&pac);
    serial::set_up(&pac);
    watchdog::start();
    Found { was_hung, adc, pwm, usb: Usb::new(usb_clock) }
}

/// 125 MHz from the crystal, 48 MHz for converter and USB, and the tick of microseconds.
fn start_clocks() -> UsbClock {
    // SAFETY: as above.
    let mut pac = unsafe { pac::Peripherals::steal() };
    let clocks = init_clocks_and_plls(
        CRYSTAL_HZ,
        pac.XOSC,
        pac.CLOCKS,
        pac.PLL_SYS,
        pac.PLL_USB,
        &mut pac.RESETS,
        &mut Watchdog::new(pac.WATCHDOG),
    );
    // Without clocks there is nothing that could go on: another attempt.
    let Ok(clocks) = clocks else { watchdog::reset() };
    clocks.usb_clock
}
