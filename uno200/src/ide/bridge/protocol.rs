//! What page and bridge say to each other, as JSON in text frames. Each wish has one answer, in the
//! order of the wishes. Binary frames are the bytes of the port that is open, both ways.

use plc_isa::Parity;
use serde::{Deserialize, Serialize};

/// What the page wants.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", deny_unknown_fields)]
pub enum Wish {
    /// The first of all: the token of the address, or the key of the session that it was exchanged
    /// for. Answer: [`Told::Welcome`].
    Hello {
        /// Of the address.
        #[serde(default)]
        token: Option<String>,
        /// Of an earlier welcome.
        #[serde(default)]
        session: Option<String>,
    },
    /// What can be opened. Answer: [`Told::Ports`].
    Ports,
    /// Opens a port in place of the one that is open. Answer: [`Told::Done`].
    Open {
        /// One of [`Told::Ports`].
        name: String,
        /// Bits a second, of a serial port.
        #[serde(default = "usual_baud")]
        baud: u32,
        /// `none`, `even` or `odd`, of a serial port.
        #[serde(default)]
        parity: LineParity,
    },
    /// Switches DTR and RTS. Answer: [`Told::Done`].
    Lines {
        /// On or off.
        on: bool,
    },
    /// Closes the port. Answer: [`Told::Done`].
    Close,
}

fn usual_baud() -> u32 {
    115_200
}

/// Parities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LineParity {
    /// 8N1
    #[default]
    None,
    /// 8E1
    Even,
    /// 8O1
    Odd,
}

impl From<LineParity> for Parity {
    fn from(parity: LineParity) -> Parity {
        match parity {
            LineParity::None => Parity::None,
            LineParity::Even => Parity::Even,
            LineParity::Odd => Parity::Odd,
        }
    }
}

/// What the page is told.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "camelCase")]
pub enum Told {
    /// It may go on.
    Welcome {
        /// The key to come back with.
        session: String,
    },
    /// What can be opened.
    Ports {
        /// In their order.
        ports: Vec<Port>,
    },
    /// It is done.
    Done,
    /// It is not done: why, with what helps. After a refused hello the bridge closes.
    Refused {
        /// Why.
        message: String,
    },
    /// No answer: the port that was open is gone.
    Lost {
        /// Why.
        message: String,
    },
}

/// What can be opened.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Port {
    /// As it is opened.
    pub name: String,
    /// How it is reached.
    pub kind: Kind,
}

/// How a PLC is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Kind {
    /// A serial port: Modbus RTU, and the bootloader.
    Serial,
    /// A connection of the network: Modbus TCP.
    Tcp,
}
