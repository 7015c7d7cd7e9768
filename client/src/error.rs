//! What can go wrong between client and PLC, in words. What the user can try next is part of
//! them.

use std::fmt;

/// Why an exchange failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Error {
    /// The PLC has answered that it will not do it: the function and the Modbus exception.
    Refused {
        /// The function code of the request.
        function: u8,
        /// 1 unknown function, 2 address, 3 value or length, 4 not possible now.
        exception: u8,
    },
    /// Nothing came back in time.
    NoAnswer,
    /// What came back is no answer to the request: what is wrong with it.
    BadAnswer(String),
    /// The connection is gone, with the cable, the board or the server: why.
    Lost(String),
    /// There is no connection: why, with what to try.
    NotConnected(String),
    /// It cannot be asked for: why.
    Request(String),
}

impl Error {
    /// Whether the PLC is there and has refused.
    pub fn is_refusal(&self) -> bool {
        matches!(self, Error::Refused { .. })
    }

    /// Whether another attempt may get the answer.
    pub fn is_worth_repeating(&self) -> bool {
        matches!(self, Error::NoAnswer | Error::BadAnswer(_))
    }

    /// Whether the connection may come back by itself: the cable is plugged in again, the server
    /// started again.
    pub fn is_passing(&self) -> bool {
        matches!(
            self,
            Error::NoAnswer | Error::BadAnswer(_) | Error::Lost(_) | Error::NotConnected(_)
        )
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Refused { function, exception } => {
                write!(
                    f,
                    "the PLC refuses: {} (function {function}, exception {exception})",
                    reason(*exception)
                )
            }
            Error::NoAnswer => f.write_str("the PLC does not answer"),
            Error::BadAnswer(what) => write!(f, "the answer is damaged: {what}"),
            Error::Lost(why) => write!(f, "the connection is lost: {why}"),
            Error::NotConnected(why) | Error::Request(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Error {}

fn reason(exception: u8) -> &'static str {
    match exception {
        1 => "it does not know this function, or does not allow it from this computer",
        2 => "an operand or address does not exist there, or must not be written",
        3 => {
            "a value is not allowed, or request or answer are too long for the memory that the \
                program leaves free"
        }
        4 => "not possible now",
        _ => "unknown reason",
    }
}
