//! What page and bridge say to each other, as JSON in text frames. Each wish has one answer, in the
//! order of the wishes. Binary frames are the bytes of the port that is open, both ways.

use plc_isa::Parity;
use serde::{Deserialize, Serialize};

use crate::ide::folder::{LeftOut, Listed};

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
    /// What is in the folder of the project. Answer: [`Told::Folder`].
    Folder,
    /// The text of a file in it. Answer: [`Told::File`].
    Read {
        /// As [`Listed::name`].
        file: String,
    },
    /// Writes a file of the folder. Answer: [`Told::Saved`] or [`Told::Changed`].
    Save {
        /// As [`Listed::name`].
        file: String,
        /// All of it.
        text: String,
        /// The version that it takes the place of; none of a new file.
        base: Option<String>,
    },
    /// Removes a file of the folder. Answer: [`Told::Saved`] or [`Told::Changed`].
    Remove {
        /// As [`Listed::name`].
        file: String,
        /// The version that is to be removed.
        base: String,
    },
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
        /// Whether there is a folder to work in.
        folder: bool,
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
    /// What is in the folder.
    #[serde(rename_all = "camelCase")]
    Folder {
        /// What tells it from other folders.
        id: String,
        /// Its name.
        name: String,
        /// What belongs to the project.
        files: Vec<Listed>,
        /// What would, and why it does not.
        left_out: Vec<LeftOut>,
    },
    /// A file of it.
    File {
        /// Its text, with line feeds alone between lines.
        text: String,
        /// Which version that is.
        version: String,
    },
    /// The file is written, or gone.
    Saved {
        /// Which version it is now; empty of one that is gone.
        version: String,
        /// What else happened to it.
        note: Option<String>,
    },
    /// It is not: somebody else has changed it.
    Changed {
        /// Which version it is now; none where it is gone.
        version: Option<String>,
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
