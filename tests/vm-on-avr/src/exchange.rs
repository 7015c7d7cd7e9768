//! What the tests write and read, by the names of these variables, while the chip waits.
//!
//! Atomic because somebody else changes them. Numbers are little-endian.

use core::sync::atomic::{AtomicU8, Ordering::Relaxed};

use plc_isa::{DATA_LEN, SLOT_LEN};
use plc_vm::Memory;

/// Command: a new PLC with the image.
pub const LOAD: u8 = 1;
/// No command any more: the program has panicked.
const PANICKED: u8 = 0xFF;
/// Bytes of the output image.
pub const OUTPUT_BYTES: u8 = 16;

/// What is to be done; 0: it is done. Any other than [`LOAD`] is a scan.
#[unsafe(no_mangle)]
static COMMAND: AtomicU8 = AtomicU8::new(0);
/// The program.
#[unsafe(no_mangle)]
static IMAGE: [AtomicU8; SLOT_LEN as usize] = [const { AtomicU8::new(0) }; SLOT_LEN as usize];
/// Its length.
#[unsafe(no_mangle)]
static IMAGE_LEN: [AtomicU8; 2] = [const { AtomicU8::new(0) }; 2];
/// The millisecond clock of a scan.
#[unsafe(no_mangle)]
static CLOCK: [AtomicU8; 4] = [const { AtomicU8::new(0) }; 4];
/// So many bytes of code a scan may loop over.
#[unsafe(no_mangle)]
static LOOPED_MAX: [AtomicU8; 4] = [const { AtomicU8::new(0) }; 4];
/// IB0, for its edges.
#[unsafe(no_mangle)]
static LEVELS: AtomicU8 = AtomicU8::new(0);
/// Data memory, before and after.
#[unsafe(no_mangle)]
static MEMORY: [AtomicU8; DATA_LEN] = [const { AtomicU8::new(0) }; DATA_LEN];
/// 1: RUN.
#[unsafe(no_mangle)]
static RUNS: AtomicU8 = AtomicU8::new(0);
/// The fault in its four bytes.
#[unsafe(no_mangle)]
static FAULT: [AtomicU8; 4] = [const { AtomicU8::new(0) }; 4];
/// The outputs as they are outside.
#[unsafe(no_mangle)]
static OUTPUTS: [AtomicU8; OUTPUT_BYTES as usize] =
    [const { AtomicU8::new(0) }; OUTPUT_BYTES as usize];

fn read<const N: usize>(bytes: &[AtomicU8; N]) -> [u8; N] {
    let mut values = [0; N];
    for (value, byte) in values.iter_mut().zip(bytes) {
        *value = byte.load(Relaxed);
    }
    values
}

/// Waits for a command.
pub fn wait() -> u8 {
    loop {
        match COMMAND.load(Relaxed) {
            0 => {}
            command => return command,
        }
    }
}

/// The command is done.
pub fn done() {
    COMMAND.store(0, Relaxed);
}

/// There is no next command.
pub fn panicked() -> ! {
    loop {
        COMMAND.store(PANICKED, Relaxed);
    }
}

/// A byte of the program; 0xFF past its end.
pub fn image_byte(offset: u16) -> u8 {
    match IMAGE.get(usize::from(offset)) {
        Some(byte) if offset < image_len() => byte.load(Relaxed),
        _ => 0xFF,
    }
}

/// The length of the program.
pub fn image_len() -> u16 {
    u16::from_le_bytes(read(&IMAGE_LEN))
}

/// The time of the scan.
pub fn clock() -> u32 {
    u32::from_le_bytes(read(&CLOCK))
}

/// How much the scan may loop.
pub fn looped_max() -> u32 {
    u32::from_le_bytes(read(&LOOPED_MAX))
}

/// IB0.
pub fn levels() -> u8 {
    LEVELS.load(Relaxed)
}

/// Takes data memory over.
pub fn take_memory(memory: &mut Memory) {
    for (byte, given) in memory.bytes_mut().iter_mut().zip(&MEMORY) {
        *byte = given.load(Relaxed);
    }
}

/// Hands it back.
pub fn give_memory(memory: &Memory) {
    for (byte, given) in memory.bytes().iter().zip(&MEMORY) {
        given.store(*byte, Relaxed);
    }
}

/// Tells of mode and fault.
pub fn tell(runs: bool, fault: u32) {
    RUNS.store(u8::from(runs), Relaxed);
    for (byte, place) in fault.to_le_bytes().into_iter().zip(&FAULT) {
        place.store(byte, Relaxed);
    }
}

/// Tells of a byte of outputs.
pub fn tell_output(byte: u8, value: u8) {
    if let Some(place) = OUTPUTS.get(usize::from(byte)) {
        place.store(value, Relaxed);
    }
}
