//! The emulated Pico with the firmware that was built: held scan by scan, or plugged in.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use awl_sim::machine::pico::{Pico, find_firmware};
use virtual_uno::Port;

use crate::case::folder;

/// A board with an empty slot.
///
/// # Panics
/// If there is no firmware or emulator.
pub fn pico() -> Pico {
    let made = find_firmware().and_then(|elf| Pico::new(&elf, Box::new(|_| String::new())));
    made.unwrap_or_else(|error| panic!("{error:#}"))
}

/// A board at a serial port, with a clock of its own.
pub struct Plugged {
    emulator: Child,
    line: String,
    is_over: Arc<AtomicBool>,
    wire: Option<JoinHandle<()>>,
}

impl Plugged {
    /// A board that gets power with this program.
    ///
    /// # Panics
    /// If there is no firmware or emulator.
    pub fn with(image: &Path) -> Plugged {
        let firmware = find_firmware().unwrap_or_else(|error| panic!("{error:#}"));
        let mut node = Command::new("node");
        node.arg(folder("../sim/pico/plugged.mjs")).arg(firmware).arg(image);
        let mut emulator =
            node.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("node starts");
        let ends = emulator.stdin.take().zip(emulator.stdout.take());
        let port = Port::new().expect("there are pseudo-terminals");
        let line = port.path().display().to_string();
        let is_over = Arc::new(AtomicBool::new(false));
        let wire = thread::spawn({
            let is_over = is_over.clone();
            move || carry(port, ends.expect("it has both"), &is_over)
        });
        Plugged { emulator, line, is_over, wire: Some(wire) }
    }

    /// The name of its port.
    pub fn line(&self) -> &str {
        &self.line
    }
}

/// Carries characters between port and emulator until it is over.
fn carry(mut port: Port, (mut input, mut output): (ChildStdin, ChildStdout), is_over: &AtomicBool) {
    let (send, sent) = channel();
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while let Ok(count @ 1..) = output.read(&mut bytes) {
            let Ok(()) = send.send(bytes[..count].to_vec()) else { return };
        }
    });
    while !is_over.load(Ordering::Relaxed) {
        let received = port.read().expect("the port is read");
        if input.write_all(&received).and_then(|()| input.flush()).is_err() {
            return;
        }
        sent.try_iter().for_each(|bytes| port.write(&bytes).expect("the port is written"));
        thread::sleep(Duration::from_millis(1));
    }
}

impl Drop for Plugged {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        let _ = self.emulator.kill();
        let _ = self.emulator.wait();
        let _ = self.wire.take().map(JoinHandle::join);
    }
}
