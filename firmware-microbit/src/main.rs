//! The BBC micro:bit as a PLC. Start-up only; the scan is in `runtime`, the hardware in `board`.
#![no_std]
#![no_main]

mod board;

use board::Microbit;
use cortex_m_rt::entry;
use runtime::Controller;

#[entry]
fn main() -> ! {
    let controller = board::place(|| Controller::new(Microbit::of_reset()));
    controller.power_up();
    loop {
        controller.scan();
    }
}
