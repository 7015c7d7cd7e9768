//! Measures, prints and compares with the budgets. To be built with optimisation: `cargo run
//! --release --package speed`.

fn main() -> anyhow::Result<()> {
    speed::run()
}
