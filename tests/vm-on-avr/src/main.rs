//! plc-vm whole, with every instruction, on a chip with room for it: an ATmega2560. It does what
//! the tests ask for through memory, one command after the other, and is part of nothing that is
//! shipped.
#![no_std]
#![no_main]

mod exchange;
mod image;
mod time;

use core::panic::PanicInfo;

use plc_vm::{Memory, Mode, Plc};

use image::Image;
use time::GivenTime;

/// Does what is asked for, for ever.
#[unsafe(no_mangle)]
extern "C" fn main() -> ! {
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    loop {
        let command = exchange::wait();
        exchange::take_memory(&mut memory);
        match command {
            exchange::LOAD => start(&mut plc, &mut memory),
            _ => scan(&mut plc, &mut memory),
        }
        exchange::give_memory(&memory);
        exchange::tell(plc.mode() == Mode::Run, plc.fault_word());
        for byte in 0..exchange::OUTPUT_BYTES {
            exchange::tell_output(byte, plc.outputs(&memory, byte));
        }
        exchange::done();
    }
}

/// A new PLC with the image, switched on: RUN if it is a program.
#[inline(never)]
fn start(plc: &mut Plc<Image>, memory: &mut Memory) {
    *plc = Plc::new();
    memory.clear();
    if plc.load(memory, Image).is_err() {
        return;
    }
    // Nothing is kept here.
    if plc.program().is_some_and(|program| program.plan().retained_len() > 0) {
        plc.retentive_data_lost();
    }
    plc.run();
}

/// A scan. Its inputs are in memory.
#[inline(never)]
fn scan(plc: &mut Plc<Image>, memory: &mut Memory) {
    let mut time = GivenTime::of_scan();
    plc.see_inputs(memory, exchange::levels());
    plc.execute(memory, &mut time);
}

/// The tests see that no command is done any more.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    exchange::panicked()
}
