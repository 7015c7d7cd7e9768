//! Firmware and program written to a model of a board.

use awl_asm::hex;
use flash::bootloader::Bootloader;
use flash::{Firmware, Flasher, Job, Output};

use crate::digest::Digest;

/// Longer than it takes when nothing takes time but pauses.
const LONGEST_MS: u64 = 10_000;

/// What the board holds then.
pub fn written(image: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let firmware = hex::firmware(hex::FIRMWARE)?;
    let mut flasher = Flasher::new(Job::new(Firmware::Write(&firmware), image)?);
    let mut board = Bootloader::default();
    for now_ms in 0..LONGEST_MS {
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(on) => board.lines(on),
                Output::Send(bytes) => flasher.receive(&board.receive(&bytes), now_ms),
            }
        }
    }
    let flash = Digest::of(board.flash());
    Ok(match flasher.result() {
        None => "board: not written in time".to_owned(),
        Some(Err(failure)) => format!("board: {failure}"),
        Some(Ok(())) => format!("board: written, {} bytes, {flash}", flasher.progress().done),
    })
}
