//! `cargo xtask board`: a virtual Uno to flash and talk to, without hardware.

use std::fs;

use anyhow::Result;

use crate::firmware::KEPT;
use crate::packages;
use crate::process::{cargo, root, run};

/// Where flash and EEPROM of the board are while it is off.
const STATE: &str = "target/board.bin";

/// Runs it until Ctrl-C. `is_new`: a board from the factory, else the one of the last time.
pub fn start(with_firmware: bool, is_new: bool) -> Result<()> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    packages::ensure_installed(packages::AVR_LINKER)?;
    let mut board = cargo();
    board.args(["run", "--quiet", "--release", "--package", "virtual-uno", "--features", "link"]);
    let state = root().join(STATE);
    if is_new && state.exists() {
        fs::remove_file(&state)?;
    }
    board.args(["--", "--state"]).arg(state);
    if with_firmware {
        board.arg("--firmware").arg(root().join(KEPT));
    }
    run(&mut board)
}
