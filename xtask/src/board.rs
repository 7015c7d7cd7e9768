//! `cargo xtask board`: a virtual Uno to flash and talk to, without hardware.

use anyhow::Result;

use crate::process::{cargo, run};
use crate::{firmware, packages};

/// Runs it until Ctrl-C.
pub fn start(with_firmware: bool) -> Result<()> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    packages::ensure_installed(packages::AVR_LINKER)?;
    let mut board = cargo();
    board.args(["run", "--quiet", "--release", "--package", "virtual-uno", "--features", "link"]);
    if with_firmware {
        board.args(["--", "--firmware"]).arg(firmware::build()?.with_extension("hex"));
    }
    run(&mut board)
}
