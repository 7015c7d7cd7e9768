//! How requests and answers travel: frames of Modbus RTU and Modbus TCP, time-outs, repetition.
//! Bytes and times are passed in and out; which port or socket they go through, and what the
//! requests mean, is not known here.

mod exchange;
pub mod rtu;
pub mod tcp;

use crate::error::Error;
use crate::service::Question;

pub use exchange::Exchange;

/// How often a request is sent when its answer is lost.
pub const ATTEMPTS: usize = 3;

/// How requests and answers are framed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Framing {
    /// Modbus RTU on a serial line.
    Rtu {
        /// The unit that is talked to, 1 to 247.
        unit: u8,
        /// Bits a second.
        baud: u32,
    },
    /// Modbus TCP.
    Tcp {
        /// The unit that is talked to.
        unit: u8,
        /// The number of the last request; wraps.
        transaction: u16,
    },
}

impl Framing {
    /// The frame that carries the next request.
    fn next(&mut self, request: &[u8]) -> Vec<u8> {
        match self {
            Framing::Rtu { unit, .. } => rtu::frame(*unit, request),
            Framing::Tcp { unit, transaction } => {
                *transaction = transaction.wrapping_add(1);
                tcp::frame(*transaction, *unit, request)
            }
        }
    }

    /// How long the line must be silent before a request that follows a damaged answer, in
    /// milliseconds: it must not be taken for the rest of something.
    pub fn silence_ms(&self) -> u64 {
        match *self {
            Framing::Rtu { baud, .. } => 5 + rtu::characters_ms(4, baud),
            Framing::Tcp { .. } => 0,
        }
    }
}

/// A connection to a PLC that is driven from outside: requests in, bytes out; bytes and times in,
/// answers out. One request at a time, which is sent again when no good answer comes.
#[derive(Debug)]
pub struct Line {
    framing: Framing,
    patience_ms: u64,
    state: State,
}

#[derive(Debug)]
enum State {
    Idle,
    /// To be sent, not before this time.
    Due {
        request: Vec<u8>,
        attempts: usize,
        at_ms: u64,
    },
    Waiting {
        request: Vec<u8>,
        attempts: usize,
        exchange: Exchange,
    },
    Answered(Result<Vec<u8>, Error>),
}

impl Line {
    /// A line on which nothing has been asked. An attempt waits so long for its answer.
    pub fn new(framing: Framing, patience_ms: u64) -> Line {
        Line { framing, patience_ms, state: State::Idle }
    }

    /// Has a question asked. What was asked before is forgotten.
    pub fn ask(&mut self, question: &impl Question, now_ms: u64) -> Result<(), Error> {
        self.request(question.request()?, question.is_repeatable(), now_ms);
        Ok(())
    }

    /// The same of a request, function code and data.
    pub fn request(&mut self, request: Vec<u8>, is_repeatable: bool, now_ms: u64) {
        let attempts = if is_repeatable { ATTEMPTS } else { 1 };
        self.state = State::Due { request, attempts, at_ms: now_ms };
    }

    /// What is to be sent now. To be asked after each of the other calls.
    pub fn transmit(&mut self, now_ms: u64) -> Option<Vec<u8>> {
        let State::Due { request, attempts, at_ms } = &mut self.state else { return None };
        if *at_ms > now_ms {
            return None;
        }
        let (request, attempts) = (std::mem::take(request), *attempts - 1);
        let (exchange, frame) =
            Exchange::begin(&mut self.framing, &request, self.patience_ms, now_ms);
        self.state = State::Waiting { request, attempts, exchange };
        Some(frame)
    }

    /// Bytes have come. Those that nobody waits for are dropped.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) {
        if let State::Waiting { exchange, .. } = &mut self.state {
            let result = exchange.receive(bytes, now_ms);
            self.conclude(result, now_ms);
        }
    }

    /// Time has passed.
    pub fn expire(&mut self, now_ms: u64) {
        if let State::Waiting { exchange, .. } = &mut self.state {
            let result = exchange.expire(now_ms);
            self.conclude(result, now_ms);
        }
    }

    /// When [`expire`](Line::expire) and [`transmit`](Line::transmit) have something to do at the
    /// latest, if no bytes come.
    pub fn deadline_ms(&self) -> Option<u64> {
        match &self.state {
            State::Due { at_ms, .. } => Some(*at_ms),
            State::Waiting { exchange, .. } => Some(exchange.deadline_ms()),
            State::Idle | State::Answered(_) => None,
        }
    }

    /// The answer, function code and data, once.
    pub fn answer(&mut self) -> Option<Result<Vec<u8>, Error>> {
        match std::mem::replace(&mut self.state, State::Idle) {
            State::Answered(result) => Some(result),
            other => {
                self.state = other;
                None
            }
        }
    }

    fn conclude(&mut self, result: Option<Result<Vec<u8>, Error>>, now_ms: u64) {
        let State::Waiting { request, attempts, .. } = &mut self.state else { return };
        self.state = match result {
            None => return,
            Some(Err(error)) if error.is_worth_repeating() && *attempts > 0 => State::Due {
                request: std::mem::take(request),
                attempts: *attempts,
                at_ms: now_ms + self.framing.silence_ms(),
            },
            Some(result) => State::Answered(result),
        };
    }
}

/// The refusal in an answer, or the answer.
fn accepted(request: &[u8], answer: Vec<u8>) -> Result<Vec<u8>, Error> {
    let function = request.first().copied().unwrap_or(0);
    match answer[..] {
        [first, exception] if first == function | 0x80 => {
            Err(Error::Refused { function, exception })
        }
        [first, ..] if first == function => Ok(answer),
        [first, ..] => {
            Err(Error::BadAnswer(format!("function {first} answers function {function}")))
        }
        [] => Err(Error::BadAnswer("it is empty".into())),
    }
}

#[cfg(test)]
mod tests;
