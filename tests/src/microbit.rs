//! The micro:bit in QEMU, with the firmware that was built: its pins through QEMU's protocol for
//! tests, its line as a pseudo-terminal. It runs by itself; nothing holds its clock.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::case::folder;

/// Where the program is in flash.
const SLOT: &str = "0x2C000";
/// Registers of the port: levels that outputs have, and which pins are outputs.
const OUT: u32 = 0x5000_0504;
const DIRECTION: u32 = 0x5000_0514;
/// A machine under load is slow.
pub const PATIENCE: Duration = Duration::from_secs(60);
const BETWEEN_LOOKS: Duration = Duration::from_millis(10);

/// The board.
pub struct Microbit {
    qemu: Child,
    pins: BufReader<UnixStream>,
    line: String,
    _files: TempDir,
}

impl Microbit {
    /// A board that gets power with this in its program slot.
    ///
    /// # Panics
    /// Without QEMU or firmware: nothing is left out silently.
    pub fn with(slot: &[u8]) -> Microbit {
        let elf = folder("../target/firmware/microbit.elf");
        assert!(elf.is_file(), "no {}: `cargo xtask firmware` makes it", elf.display());
        let files = TempDir::new().unwrap();
        let (image, socket) = (files.path().join("image"), files.path().join("pins"));
        fs::write(&image, slot).unwrap();
        let mut qemu = Command::new("qemu-system-arm");
        qemu.args(["-machine", "microbit", "-display", "none", "-kernel"]).arg(elf);
        qemu.args(["-device", &format!("loader,file={},addr={SLOT},force-raw=on", shown(&image))]);
        // 8 ns an instruction: the board's time is near that of this computer, on which the other
        // end of the line is.
        qemu.args(["-icount", "shift=3", "-serial", "pty", "-monitor", "stdio"]);
        qemu.args(["-qtest", &format!("unix:{},server=on,wait=off", shown(&socket))]);
        qemu.args(["-qtest-log", "/dev/null"]);
        qemu.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut qemu = qemu.spawn().expect("qemu-system-arm starts");
        let mut said = BufReader::new(qemu.stdout.take().unwrap()).lines();
        let line = said.find_map(|text| {
            let text = text.expect("QEMU says where the line is");
            let at = text.find("/dev/")?;
            text[at..].split_whitespace().next().map(str::to_owned)
        });
        let pins = UnixStream::connect(&socket).expect("QEMU has its protocol for tests");
        // What else QEMU says is read, so that it never waits.
        std::thread::spawn(move || said.for_each(drop));
        let (line, pins) = (line.expect("QEMU has a line"), BufReader::new(pins));
        Microbit { qemu, pins, line, _files: files }
    }

    /// The name of its line's port.
    pub fn line(&self) -> &str {
        &self.line
    }

    fn ask(&mut self, question: &str) -> String {
        writeln!(self.pins.get_mut(), "{question}").unwrap();
        let mut answer = String::new();
        self.pins.read_line(&mut answer).unwrap();
        let words = answer.trim().strip_prefix("OK");
        words.unwrap_or_else(|| panic!("{question}: {answer:?}")).trim().to_owned()
    }

    fn register(&mut self, address: u32) -> u32 {
        let answer = self.ask(&format!("readl {address:#x}"));
        u32::from_str_radix(answer.trim_start_matches("0x"), 16).unwrap()
    }

    /// Puts a level at a pin.
    pub fn drive(&mut self, pin: u8, level: bool) {
        self.ask(&format!("set_irq_in /machine/nrf51 unnamed-gpio-in {pin} {}", u8::from(level)));
    }

    /// The level of a pin; `None`: it is not driven.
    pub fn level(&mut self, pin: u8) -> Option<bool> {
        let is_driven = self.register(DIRECTION) >> pin & 1 != 0;
        is_driven.then(|| self.register(OUT) >> pin & 1 != 0)
    }

    /// Waits until a pin is so.
    ///
    /// # Panics
    /// If it never is.
    pub fn wait_for(&mut self, pin: u8, level: Option<bool>) {
        let begin = Instant::now();
        while self.level(pin) != level {
            assert!(begin.elapsed() < PATIENCE, "pin {pin} never becomes {level:?}");
            sleep(BETWEEN_LOOKS);
        }
    }

    /// A reset of the chip; flash and RAM are as they were.
    pub fn reset(&mut self) {
        writeln!(self.qemu.stdin.as_mut().unwrap(), "system_reset").unwrap();
    }
}

impl Drop for Microbit {
    fn drop(&mut self) {
        let _ = self.qemu.kill();
        let _ = self.qemu.wait();
    }
}

fn shown(path: &Path) -> String {
    path.to_str().expect("a folder for tests has a name in ASCII").to_owned()
}
