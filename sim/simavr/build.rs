//! Compiles the C shim against the installed libsimavr and links both; without the feature `link`
//! does nothing.

#[cfg(not(feature = "link"))]
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}

#[cfg(feature = "link")]
fn main() {
    const HEADER: &str = "/usr/include/simavr/sim_avr.h";
    println!("cargo::rerun-if-changed=src/shim.c");
    println!("cargo::rerun-if-changed={HEADER}");
    if !std::path::Path::new(HEADER).exists() {
        println!(
            "cargo::error=there is no {HEADER}; on Debian: apt-get install libsimavr-dev libelf-dev"
        );
        return;
    }
    cc::Build::new().file("src/shim.c").warnings_into_errors(true).compile("simavr_shim");
    println!("cargo::rustc-link-lib=simavr");
    println!("cargo::rustc-link-lib=elf");
}
