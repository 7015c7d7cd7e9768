//! One request and its answer: the frame that is sent, the bytes that come, and when waiting for
//! them is over.

use super::{Framing, accepted, rtu, tcp};
use crate::error::Error;

/// What ends an answer on a serial line beside silence of four characters: what the systems in
/// between hold it up, in milliseconds.
const PAUSE_MS: u64 = 60;

/// A request that has been sent.
#[derive(Debug, Clone)]
pub struct Exchange {
    framing: Framing,
    request: Vec<u8>,
    came: Vec<u8>,
    deadline_ms: u64,
}

impl Exchange {
    /// Begins with a request, function code and data, and gives the frame to send. Its answer may
    /// take `patience_ms`.
    pub fn begin(
        framing: &mut Framing,
        request: &[u8],
        patience_ms: u64,
        now_ms: u64,
    ) -> (Exchange, Vec<u8>) {
        let frame = framing.next(request);
        let (framing, request) = (framing.clone(), request.to_vec());
        let deadline_ms = now_ms.saturating_add(patience_ms);
        (Exchange { framing, request, came: Vec::new(), deadline_ms }, frame)
    }

    /// When waiting is over if no more bytes come.
    pub fn deadline_ms(&self) -> u64 {
        self.deadline_ms
    }

    /// How many bytes the answer has at least that have not come yet: not a byte more than is known
    /// to come.
    pub fn wanted(&self) -> usize {
        let len = match self.framing {
            Framing::Rtu { .. } => rtu::frame_len(&self.request, &self.came),
            Framing::Tcp { .. } => Some(tcp::frame_len(&self.came)),
        };
        len.unwrap_or(self.came.len() + 1).saturating_sub(self.came.len()).max(1)
    }

    /// Bytes have come. Gives the answer when it is complete.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) -> Option<Result<Vec<u8>, Error>> {
        self.came.extend_from_slice(bytes);
        match self.framing {
            Framing::Rtu { baud, .. } => {
                if !self.came.is_empty() {
                    let pause_ms = PAUSE_MS + rtu::characters_ms(4, baud);
                    self.deadline_ms = now_ms.saturating_add(pause_ms);
                }
                let len = rtu::frame_len(&self.request, &self.came)?;
                (self.came.len() >= len).then(|| self.complete())
            }
            Framing::Tcp { .. } => {
                (self.came.len() >= tcp::frame_len(&self.came)).then(|| self.complete())
            }
        }
    }

    /// Time has passed. Gives what has become of the exchange when its time is over.
    pub fn expire(&mut self, now_ms: u64) -> Option<Result<Vec<u8>, Error>> {
        if now_ms <= self.deadline_ms {
            return None;
        }
        Some(match self.framing {
            Framing::Rtu { .. } if self.came.is_empty() => Err(Error::NoAnswer),
            // Silence ends a frame.
            Framing::Rtu { .. } => self.complete(),
            // A late answer would be taken for that to the next request: the connection is given
            // up.
            Framing::Tcp { .. } => Err(Error::Lost("no answer came in time".into())),
        })
    }

    fn complete(&self) -> Result<Vec<u8>, Error> {
        match self.framing {
            Framing::Rtu { unit, .. } => match rtu::answer(unit, &self.came) {
                Some(answer) => accepted(&self.request, answer.to_vec()),
                None => {
                    let len = self.came.len();
                    Err(Error::BadAnswer(format!("{len} bytes with a wrong checksum")))
                }
            },
            Framing::Tcp { unit, transaction } => {
                match tcp::answer(transaction, unit, &self.came) {
                    Some(answer) => accepted(&self.request, answer.to_vec()),
                    None => Err(Error::Lost("what comes is no answer to the request".into())),
                }
            }
        }
    }
}
