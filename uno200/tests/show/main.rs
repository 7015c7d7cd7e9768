//! The terminal view with a controller after it: power flow as an independent observer sees it,
//! what the keys do to the PLC, and the picture in the documentation.

mod bench;
mod flow;
mod orders;
mod picture;

use awl_asm::files::read_source;
use client::Program;

/// A program of the examples.
fn example(name: &str) -> Program {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(name);
    let mut source = read_source(&path).unwrap();
    source.name = format!("examples/{name}");
    Program::assembled(source, Vec::new()).unwrap()
}
