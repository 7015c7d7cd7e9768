//! Ways to the PLC: a serial port or TCP. They carry requests and answers and know nothing of what
//! these mean.

pub mod ports;
mod serial;
mod stream;
mod tcp;

use std::fmt;
use std::time::Duration;

use client::Error;

pub use plc_isa::Parity;
pub use serial::{SerialSettings, open_port as open_serial};
pub use stream::{is_only_late, reason as reason_of};
pub use tcp::connect as open_tcp;

/// A way to the PLC that is open.
pub trait Transport: Send {
    /// Sends a request, function code and data, and waits for the answer. An exception comes as
    /// [`Error::Refused`].
    fn exchange(&mut self, request: &[u8], patience: Duration) -> Result<Vec<u8>, Error>;
}

/// Where the PLC is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// At a serial port.
    Serial(SerialSettings),
    /// On the network.
    Tcp {
        /// `HOST:PORT`.
        address: String,
        /// Its unit number.
        unit: u8,
    },
}

impl Target {
    /// Opens the way. For a serial port that was not named this looks for the only one.
    pub fn open(&self) -> Result<Box<dyn Transport>, Error> {
        match self {
            Target::Serial(settings) => Ok(Box::new(serial::open(settings)?)),
            Target::Tcp { address, unit } => Ok(Box::new(tcp::open(address, *unit)?)),
        }
    }

    /// How long an answer can take, beside the PLC's scan.
    pub fn patience(&self) -> Duration {
        match self {
            Target::Serial(settings) => settings.patience(),
            Target::Tcp { .. } => Duration::from_secs(2),
        }
    }

    /// What to try when nothing answers.
    pub fn advice(&self) -> String {
        match self {
            Target::Serial(settings) => settings.advice(),
            Target::Tcp { address, .. } => {
                format!(
                    "{address} takes the connection but answers nothing: is it an uno200 (`awl-sim \
                        --serve`)?"
                )
            }
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Target::Serial(settings) => settings.fmt(f),
            Target::Tcp { address, .. } => f.write_str(address),
        }
    }
}
