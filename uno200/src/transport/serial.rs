//! A serial port with Modbus RTU on it.
//!
//! Opening an Uno's port resets the board: its DTR line falls from high to low and a capacitor
//! carries that to the reset pin. What each system allows is done, and said in docs/uno200.md.

use std::fmt;
use std::io::{self, ErrorKind};
use std::thread::sleep;
use std::time::Duration;

use client::Error;
use client::line::Framing;
use plc_isa::Parity;
use serialport::{ClearBuffer, DataBits, SerialPort, StopBits};

use super::stream::{Stream, exchange, is_only_late};
use super::{Transport, ports};

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
        let others: Vec<String> =
            ports::usb_ports().into_iter().filter(|other| *other != name).collect();
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
    framing: Framing,
}

pub(super) fn open(settings: &SerialSettings) -> Result<Serial, Error> {
    let name = match &settings.port {
        Some(name) => name.clone(),
        None => ports::only_port()?,
    };
    let port = open_port(&name, settings.baud, settings.parity)?;
    Ok(Serial { port, framing: Framing::Rtu { unit: settings.unit, baud: settings.baud } })
}

/// Opens a port as it is set for a PLC. Reading waits 50 ms at most.
pub fn open_port(name: &str, baud: u32, parity: Parity) -> Result<Box<dyn SerialPort>, Error> {
    let kept = keep_dtr(name);
    let builder = serialport::new(name, baud)
        .data_bits(DataBits::Eight)
        .stop_bits(StopBits::One)
        .parity(match parity {
            Parity::None => serialport::Parity::None,
            Parity::Even => serialport::Parity::Even,
            Parity::Odd => serialport::Parity::Odd,
        })
        .timeout(Duration::from_millis(50));
    // Elsewhere DTR stays as the system has it: what is switched off now resets the board when it
    // comes on again.
    let builder = if cfg!(windows) { builder.dtr_on_open(false) } else { builder };
    let port = builder.open().map_err(|error| not_opened(name, &error))?;
    drop(kept);
    Ok(port)
}

/// Has the system leave DTR on when the port is closed, so that the next opening is no edge of it
/// and resets nothing. What is returned keeps the port open until it is opened for good. Not all
/// ports can; then it stays as it is.
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
        serialport::ErrorKind::Io(ErrorKind::PermissionDenied) => {
            ": on Linux the group dialout may use serial ports: `sudo usermod -aG dialout $USER`, \
                then log in again"
        }
        serialport::ErrorKind::Io(ErrorKind::NotFound) | serialport::ErrorKind::NoDevice => {
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
        let Serial { port, framing } = self;
        let result = exchange(port, framing, request, patience);
        if matches!(result, Err(Error::BadAnswer(_))) {
            sleep(Duration::from_millis(framing.silence_ms()));
        }
        result
    }
}

impl Stream for Box<dyn SerialPort> {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        // What is there is the rest of an answer that nobody waits for any more.
        self.clear(ClearBuffer::Input)?;
        self.write_all(bytes)
    }

    fn receive(&mut self, bytes: &mut [u8], _time: Duration) -> io::Result<usize> {
        match self.read(bytes) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Err(error) if is_only_late(&error) => Ok(0),
            result => result,
        }
    }
}
