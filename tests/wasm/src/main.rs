//! Prints the report of this computer.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", wasm_smoke::report()?);
    Ok(())
}
