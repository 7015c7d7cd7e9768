//! Tells the linker where the program slot and data memory are. Both are described in plc-isa and nowhere else.

use std::path::Path;

/// Offset of data addresses in the linker's view of an AVR.
const DATA_SPACE: u32 = 0x80_0000;

fn main() {
    let memory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../memory.x");
    println!("cargo:rerun-if-changed={}", memory.display());
    for argument in [
        "-mmcu=atmega328p".to_string(),
        // Short calls where they reach.
        "-mrelax".to_string(),
        format!("-Wl,--defsym=PROGRAM_SLOT_START={:#x}", plc_isa::SLOT_START),
        format!("-Wl,--defsym=PROGRAM_SLOT_LEN={:#x}", plc_isa::SLOT_LEN),
        // The variables of the firmware begin behind the data memory of the controller.
        format!("-Wl,-Tdata={:#x}", DATA_SPACE + u32::from(plc_isa::DATA_END)),
        format!("-Wl,-T,{}", memory.display()),
    ] {
        println!("cargo:rustc-link-arg={argument}");
    }
    // Before compiler_builtins: the C library's memcpy and division are a tenth of its size.
    println!("cargo:rustc-link-lib=dylib=gcc");
    println!("cargo:rustc-link-lib=dylib=c");
}
