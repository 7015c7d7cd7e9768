//! A serial port with Modbus RTU on it.
//!
//! Opening an Uno's port resets the board: its DTR line falls from high to low and a capacitor carries that to the reset
//! pin. What each system allows is done, and said in docs/uno200.md.

use std::fmt;
use std::io;
use std::thread::sleep;
use std::time::{Duration, Instant};

use plc_isa::Parity;
use serialport::{ClearBuffer, DataBits, SerialPort, StopBits};

use super::{Transport, ports, rtu};
use crate::error::Error;

/// A serial port and how it is set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SerialSettings {
    /// Its name, such as `/dev/ttyACM0` or `COM3`; `None`: the only USB serial port.
    pub port: Option<String>,
    /// Bits a second.
    pub baud: u32,
    /// Its parity.
    pub parity: Parity,
    /// The unit that is talked to, 1..=247.
    pub unit: u8,
}

impl Default for SerialSettings {
    fn default() -> Self {
        SerialSettings { port: None, baud: 115_200, parity: Parity::None, unit: 1 }
    }
}

impl SerialSettings {
    pub(super) fn patience(&self) -> Duration {
        // A long request and a long answer, and what the board and USB take.
        Duration::from_millis(500) + self.characters(600)
    }

    /// How long so many characters take.
    fn characters(&self, count: u32) -> Duration {
        Duration::from_secs(1) * (count * 11) / self.baud.max(1)
    }

    pub(super) fn advice(&self) -> String {
        let name = self.port.clone().or_else(|| ports::only_port().ok()).unwrap_or_default();
        let mut advice = format!(
            "nothing answers at {name} with {} baud{}, unit {}:\n  \
             is it the right port (--port), and does the board hold the uno200 firmware?\n  \
             a program can set the line (`//# modbus ...`): try its --baud, --parity and --unit\n  \
             a program in freeport mode (SMB30) has the line for itself while it runs\n  \
             does another program hold the port open, such as a serial monitor?",
            self.baud,
            match self.parity {
                Parity::None => "",
                Parity::Even => ", even parity",
                Parity::Odd => ", odd parity",
            },
            self.unit
        );
        let others: Vec<String> = ports::usb_ports().into_iter().filter(|other| *other != name).collect();
        if !others.is_empty() {
            advice += &format!("\n  there are other ports: {}", others.join(", "));
        }
        advice
    }
}

impl fmt::Display for SerialSettings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.port.as_deref().unwrap_or("the USB serial port"))
    }
}

pub(super) struct Serial {
    port: Box<dyn SerialPort>,
    settings: SerialSettings,
}

pub(super) fn open(settings: &SerialSettings) -> Result<Serial, Error> {
    let name = match &settings.port {
        Some(name) => name.clone(),
        None => ports::only_port()?,
    };
    let kept = keep_dtr(&name);
    let builder = serialport::new(&name, settings.baud)
        .data_bits(DataBits::Eight)
        .stop_bits(StopBits::One)
        .parity(match settings.parity {
            Parity::None => serialport::Parity::None,
            Parity::Even => serialport::Parity::Even,
            Parity::Odd => serialport::Parity::Odd,
        })
        .timeout(Duration::from_millis(50));
    // Elsewhere DTR stays as the system has it: what is switched off now resets the board when it comes on again.
    let builder = if cfg!(windows) { builder.dtr_on_open(false) } else { builder };
    let port = builder.open().map_err(|error| not_opened(&name, &error))?;
    drop(kept);
    Ok(Serial { port, settings: settings.clone() })
}

/// Has the system leave DTR on when the port is closed, so that the next opening is no edge of it and resets nothing.
/// What is returned keeps the port open until it is opened for good. Not all ports can; then it stays as it is.
#[cfg(unix)]
fn keep_dtr(name: &str) -> Option<std::fs::File> {
    use rustix::fs::{Mode, OFlags};
    use rustix::termios::{ControlModes, OptionalActions, tcgetattr, tcsetattr};
    let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let port = rustix::fs::open(name, flags, Mode::empty()).ok()?;
    let mut line = tcgetattr(&port).ok()?;
    line.control_modes.remove(ControlModes::HUPCL);
    tcsetattr(&port, OptionalActions::Now, &line).ok()?;
    Some(port.into())
}

#[cfg(not(unix))]
fn keep_dtr(_name: &str) {}

fn not_opened(name: &str, error: &serialport::Error) -> Error {
    let hint = match error.kind() {
        serialport::ErrorKind::Io(io::ErrorKind::PermissionDenied) => {
            ": on Linux the group dialout may use serial ports: `sudo usermod -aG dialout $USER`, then log in again"
        }
        serialport::ErrorKind::Io(io::ErrorKind::NotFound) | serialport::ErrorKind::NoDevice => {
            ": is the board plugged in, and does no other program hold the port?"
        }
        _ => "",
    };
    let others = match ports::usb_ports() {
        names if names.is_empty() => String::new(),
        names => format!("; ports are: {}", names.join(", ")),
    };
    Error::NotConnected(format!("cannot open {name}: {error}{hint}{others}"))
}

impl Transport for Serial {
    fn exchange(&mut self, request: &[u8], patience: Duration) -> Result<Vec<u8>, Error> {
        // What is there is the rest of an answer that nobody waits for any more.
        self.port.clear(ClearBuffer::Input).map_err(|error| Error::Lost(error.into()))?;
        self.port.write_all(&rtu::frame(self.settings.unit, request)).map_err(Error::Lost)?;
        let frame = self.receive(request, patience)?;
        match rtu::answer(self.settings.unit, &frame) {
            Some(answer) => super::accepted(request, answer.to_vec()),
            None => {
                self.wait_for_silence();
                Err(Error::BadAnswer(format!("{} bytes with a wrong checksum", frame.len())))
            }
        }
    }
}

impl Serial {
    /// The bytes up to the length that the answer must have, or up to a pause.
    fn receive(&mut self, request: &[u8], patience: Duration) -> Result<Vec<u8>, Error> {
        let begin = Instant::now();
        let pause = Duration::from_millis(60) + self.settings.characters(4);
        let (mut frame, mut last) = (Vec::new(), begin);
        loop {
            let len = rtu::frame_len(request, &frame);
            if len.is_some_and(|len| frame.len() >= len) {
                return Ok(frame);
            }
            let mut bytes = [0; 256];
            // Not a byte more than is known to come, at least the two that tell the function.
            let wanted = len.unwrap_or(frame.len() + 1).saturating_sub(frame.len()).clamp(1, bytes.len());
            match self.port.read(&mut bytes[..wanted]) {
                Ok(0) => return Err(Error::Lost(io::ErrorKind::UnexpectedEof.into())),
                Ok(count) => {
                    frame.extend_from_slice(&bytes[..count]);
                    last = Instant::now();
                }
                Err(error) if matches!(error.kind(), io::ErrorKind::TimedOut | io::ErrorKind::Interrupted) => {}
                Err(error) => return Err(Error::Lost(error)),
            }
            match frame.is_empty() {
                true if begin.elapsed() > patience => return Err(Error::NoAnswer),
                false if last.elapsed() > pause => return Ok(frame),
                _ => {}
            }
        }
    }

    /// So that the next request is not taken for the rest of something.
    fn wait_for_silence(&mut self) {
        sleep(Duration::from_millis(5) + self.settings.characters(4));
    }
}
