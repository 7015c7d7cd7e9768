//! The emulated Pico with the firmware that was built.

use awl_sim::machine::pico::{Pico, find_firmware};

/// A board with an empty slot.
///
/// # Panics
/// If there is no firmware or emulator.
pub fn pico() -> Pico {
    let made = find_firmware().and_then(|elf| Pico::new(&elf, Box::new(|_| String::new())));
    made.unwrap_or_else(|error| panic!("{error:#}"))
}
