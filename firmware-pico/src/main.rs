//! The Raspberry Pi Pico as a PLC. Start-up only; the scan is in `runtime`, the hardware in
//! `board`, how programs are executed in `engine`.
#![no_std]
#![no_main]

mod board;
mod engine;

use board::Pico;
use rp2040_hal::entry;
use runtime::Controller;

#[entry]
fn main() -> ! {
    let controller = board::place(|| Controller::new(Pico::of_reset()));
    board::tell_data(controller.memory());
    controller.power_up();
    loop {
        controller.scan();
    }
}
