//! uno200: the Arduino Uno as a PLC. Start-up only; the scan is in `scan`, the hardware in `board`.
#![no_std]
#![no_main]
#![feature(asm_experimental_arch)]
#![deny(unsafe_code)]

mod board;
mod communication;
mod engine;
mod environment;
mod retention;
mod scan;
mod self_test;

use board::place;

#[avr_device::entry]
fn main() -> ! {
    board::set_up();
    let uno = place::uno();
    uno.power_up();
    uno.scan_for_ever()
}
