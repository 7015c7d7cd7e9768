//! Images of programs for tests. A program with errors is an error of the test.

use awl_asm::assemble::assemble;
use awl_asm::render::human;
use awl_asm::source::Source;

use crate::case::{folder, read};

/// The image of a program.
///
/// # Panics
/// With what the assembler says, if it has errors.
pub fn image(text: &str) -> Vec<u8> {
    let source = Source::new("program", text).unwrap_or_else(|error| panic!("{error}"));
    let assembly = assemble(&source, Vec::new());
    assembly.image.unwrap_or_else(|| {
        let messages: Vec<_> = assembly.diagnostics.iter().map(|message| human(&source, message, false)).collect();
        panic!("{}\n{text}", messages.concat())
    })
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
