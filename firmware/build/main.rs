//! Tells the linker where the program slot and data memory are, and puts the fast engine together.
//! What they follow from is described in plc-isa and nowhere else.

mod engine;

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Offset of data addresses in the linker's view of an AVR.
const DATA_SPACE: u32 = 0x80_0000;

fn main() {
    let memory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../memory.x");
    println!("cargo:rerun-if-changed={}", memory.display());
    write_engine();
    write_modules();
    for argument in [
        "-mmcu=atmega328p".to_string(),
        // Short calls where they reach.
        "-mrelax".to_string(),
        format!("-Wl,--defsym=PROGRAM_SLOT_START={:#x}", plc_isa::SLOT_START),
        format!("-Wl,--defsym=PROGRAM_SLOT_LEN={:#x}", plc_isa::SLOT_LEN),
        format!("-Wl,--defsym=NATIVE_VECTORS={:#x}", plc_isa::NATIVE_VECTORS),
        format!("-Wl,--defsym=JUMP_TABLE={:#x}", plc_isa::JUMP_TABLE),
        // The variables of the firmware begin after the data memory of the controller, with the
        // clock.
        format!("-Wl,-Tdata={:#x}", DATA_SPACE + u32::from(plc_isa::CLOCK)),
        format!("-Wl,--defsym=CLOCK={:#x}", DATA_SPACE + u32::from(plc_isa::CLOCK)),
        // The start-up code clears data memory with them.
        format!("-Wl,--defsym=__bss_start={:#x}", DATA_SPACE + u32::from(plc_isa::DATA_START)),
        format!("-Wl,-T,{}", memory.display()),
    ] {
        println!("cargo:rustc-link-arg={argument}");
    }
    // Before compiler_builtins: the C library's memcpy and division are a tenth of its size.
    println!("cargo:rustc-link-lib=dylib=gcc");
    println!("cargo:rustc-link-lib=dylib=c");
}

/// Writes what the board knows its modules by.
fn write_modules() {
    let known = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../awl-asm/modules")
            .join(name)
            .with_extension("bin");
        println!("cargo:rerun-if-changed={}", path.display());
        let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        plc_isa::Crc32::of(&bytes)
    };
    let text = format!("{:?}", plc_isa::MODULE_NAMES.map(known));
    write("modules.rs", &text);
}

fn write(name: &str, text: &str) {
    let target = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(target.join(name), text).unwrap_or_else(|error| panic!("{name}: {error}"));
}

/// The assembly before the handlers, in the order of the flash.
const BEFORE: [&str; 9] =
    ["names", "entry", "bytecode", "steps", "tables", "modules", "dispatch", "timers", "counters"];
/// The handlers. What is short to reach decides their order, too.
const HANDLERS: [&str; 9] = [
    "contacts",
    "units",
    "ranges",
    "stack",
    "comparisons",
    "moves",
    "control",
    "arithmetic",
    "timers",
];
/// The assembly after them.
const AFTER: [&str; 9] = [
    "bits",
    "comparisons",
    "results",
    "slots",
    "relations",
    "ranges",
    "products",
    "windows",
    "interrupts",
];

/// Writes the engine's assembly to where the firmware includes it.
fn write_engine() {
    let source = |folder: &str, name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/engine").join(folder);
        let path = path.join(name).with_extension("s");
        println!("cargo:rerun-if-changed={}", path.display());
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let interpreter = |names: &[&str]| -> String {
        names.iter().map(|name| source("interpreter", name)).collect()
    };
    let handlers: String = HANDLERS.iter().map(|name| source("handlers", name)).collect();
    let engine = engine::generate(&interpreter(&BEFORE), &handlers, &interpreter(&AFTER));
    write("engine.s", &engine);
}
