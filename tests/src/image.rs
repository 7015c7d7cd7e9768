//! Images of programs for tests. A program with errors is an error of the test.

use std::ops::Range;

use awl_asm::assemble::{Assembly, assemble_for};
use awl_asm::render::human;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{
    CRC_LEN, Crc32, DIRECTORY_AT, HEADER_LEN, NATIVE_INTERFACE, Profile, ProgramMemory, SLOT_LEN,
    UNO,
};

use crate::case::{folder, read};

/// Offset of the byte that says for which firmware interface an image was translated.
pub const INTERFACE_AT: usize = 5;

/// An image as the loader of the board sees it, which takes machine code too.
#[derive(Debug, Clone, Copy)]
pub struct OnBoard<'a>(pub &'a [u8]);

impl ProgramMemory for OnBoard<'_> {
    const NATIVE_INTERFACE: u8 = NATIVE_INTERFACE;
    const PROFILE: Option<&'static Profile> = Some(&UNO);

    fn len(&self) -> u16 {
        ProgramMemory::len(&self.0)
    }

    fn byte(&self, offset: u16) -> u8 {
        self.0.byte(offset)
    }
}

/// The image of a program.
///
/// # Panics
/// With what the assembler says, if it has errors.
pub fn image(text: &str) -> Vec<u8> {
    image_for(text, &UNO)
}

/// The same for a board.
///
/// # Panics
/// As there.
pub fn image_for(text: &str, board: &'static Profile) -> Vec<u8> {
    let (source, assembly) = assembly_for(text, board);
    assembly.image.unwrap_or_else(|| {
        let messages: Vec<_> =
            assembly.diagnostics.iter().map(|message| human(&source, message, false)).collect();
        panic!("{}\n{text}", messages.concat())
    })
}

/// The same, if the program has no errors on this board.
///
/// # Panics
/// If it is no text.
pub fn valid_image_for(text: &str, board: &'static Profile) -> Option<Vec<u8>> {
    assembly_for(text, board).1.image
}

fn assembly_for(text: &str, board: &'static Profile) -> (Source, Assembly) {
    let source = Source::new("program", text).unwrap_or_else(|error| panic!("{error}"));
    let assembly = assemble_for(&source, Vec::new(), &[], board);
    (source, assembly)
}

/// The text of an example.
///
/// # Panics
/// If there is no such example.
pub fn example_text(name: &str) -> String {
    read(&folder("../examples").join(name).with_extension("awl"))
}

/// The image of an example.
///
/// # Panics
/// If there is no such example.
pub fn example(name: &str) -> Vec<u8> {
    image(&example_text(name))
}

/// Makes the checksum right again, so that the rest is looked at. What is shorter than a checksum
/// stays as it is.
pub fn sign(image: &mut [u8]) {
    let Some(end) = <[u8]>::len(image).checked_sub(usize::from(CRC_LEN)) else { return };
    let crc = Crc32::of(&image[..end]);
    image[end..].copy_from_slice(&crc.to_le_bytes());
}

/// The same for an image that is handed on.
pub fn signed(mut image: Vec<u8>) -> Vec<u8> {
    sign(&mut image);
    image
}

/// Whether a byte of the header says something of modules, which the board alone checks.
fn is_of_modules(offset: usize) -> bool {
    const MODULES_LEN_AT: usize = 32;
    let directory = usize::from(DIRECTORY_AT)..usize::from(HEADER_LEN);
    (MODULES_LEN_AT..MODULES_LEN_AT + 2).contains(&offset) || directory.contains(&offset)
}

/// The image with one to three bytes changed at these offsets, as far as they are not the checksum
/// and say nothing of modules; the checksum is right again. It is as long as the slot, because the
/// board does not know the length of a file.
pub fn damaged(image: &[u8], rng: &mut Rng, offsets: Range<usize>) -> Vec<u8> {
    let mut image = image.to_vec();
    let end = image.len() - usize::from(CRC_LEN);
    for _ in 0..rng.u32(1..4) {
        let offset = rng.usize(offsets.start..offsets.end.min(end));
        if !is_of_modules(offset) {
            image[offset] = rng.u8(..);
        }
    }
    let mut image = signed(image);
    image.resize(usize::from(SLOT_LEN), 0xFF);
    image
}
