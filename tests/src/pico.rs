//! The emulated Pico with the firmware that was built: held scan by scan, or plugged in.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use awl_sim::action::Action;
use awl_sim::machine::pico::{Pico, find_firmware};
use awl_sim::machine::{Machine, Mode};
use plc_vm::{Fault, Inputs};
use virtual_uno::Port;

use crate::beside::Board;
use crate::case::folder;
use crate::exchange::{UNIT, checksum, frame};

/// Silence before an answer, the answer in parts, and a scan without more.
const SCANS_TO_ANSWER: u32 = 12;

/// A board with an empty slot.
///
/// # Panics
/// If there is no firmware or emulator.
pub fn pico() -> Pico {
    let made = find_firmware().and_then(|elf| Pico::new(&elf, Box::new(|_| String::new())));
    made.unwrap_or_else(|error| panic!("{error:#}"))
}

/// Cycles of a scan that the host has already seen to be endless.
const ENDLESS_CYCLES: u32 = 200_000;

/// An emulated board with a program.
pub struct OnPico<'a>(pub &'a mut Pico);

impl<'a> OnPico<'a> {
    /// It gets power with this program.
    pub fn with(pico: &'a mut Pico, image: &[u8]) -> OnPico<'a> {
        pico.load(image.to_vec());
        OnPico(pico)
    }
}

impl Board for OnPico<'_> {
    fn set_byte(&mut self, address: u16, byte: u8) {
        self.0.set_byte(address, byte);
    }

    fn receive(&mut self, at_ms: u64, characters: &[u8]) {
        let received = self.0.act(&Action::Receive { at_ms, bytes: characters.to_vec() });
        assert_eq!(received, Ok(()));
    }

    fn scan(&mut self, now_ms: u64, inputs: &Inputs, is_endless: bool) {
        if is_endless {
            self.0.hold_clock_for(ENDLESS_CYCLES);
        }
        self.0.set_inputs(inputs);
        self.0.scan(now_ms);
    }

    fn runs(&self) -> bool {
        self.0.mode() == Mode::Run
    }

    fn fault(&self) -> Option<Fault> {
        self.0.fault_kind()
    }

    fn outputs(&self) -> Option<u8> {
        self.0.outputs()
    }

    fn memory(&self) -> &[u8] {
        self.0.memory()
    }

    fn take_sent(&mut self) -> Vec<u8> {
        self.0.take_sent().unwrap_or_default()
    }

    fn broken(&self) -> Option<String> {
        self.0.broken().map(str::to_owned)
    }
}

/// A whole exchange by its first line. `now_ms`: the time of the last scan. `None`: no answer.
///
/// # Panics
/// If what comes back is no frame of this unit.
pub fn exchange(pico: &mut Pico, now_ms: &mut u64, request: &[u8]) -> Option<Vec<u8>> {
    // All at once.
    for byte in frame(UNIT, request) {
        pico.act(&Action::Receive { at_ms: *now_ms + 1, bytes: vec![byte] }).unwrap();
    }
    let mut heard = Vec::new();
    for _ in 0..SCANS_TO_ANSWER {
        *now_ms += 1;
        pico.scan(*now_ms);
        let sent = pico.take_sent().unwrap_or_default();
        if sent.is_empty() && !heard.is_empty() {
            break;
        }
        heard.extend(sent);
    }
    let (body, crc) = heard.split_at_checked(heard.len().checked_sub(2)?)?;
    assert_eq!((crc, body[0]), (&checksum(body).to_le_bytes()[..], UNIT), "{heard:02X?}");
    Some(body[1..].to_vec())
}

/// A line of the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// The pins, which can be a program's.
    Uart,
    /// That of the USB plug.
    Usb,
}

/// A board at a serial port, with a clock of its own.
pub struct Plugged {
    emulator: Child,
    line: String,
    is_over: Arc<AtomicBool>,
    wire: Option<JoinHandle<()>>,
}

impl Plugged {
    /// A board that gets power with this program, by one of its lines.
    ///
    /// # Panics
    /// If there is no firmware or emulator.
    pub fn by(line: Line, image: &Path) -> Plugged {
        let firmware = find_firmware().unwrap_or_else(|error| panic!("{error:#}"));
        let mut node = Command::new("node");
        let name = if line == Line::Uart { "uart" } else { "usb" };
        node.arg(folder("../sim/pico/plugged.mjs")).arg(name).arg(firmware).arg(image);
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
