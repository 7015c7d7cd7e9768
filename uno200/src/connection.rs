//! A connection to a PLC: requests, again when an answer is lost, and the way to it, again when
//! that is lost. What requests mean is in [`service`](crate::service).

use std::thread::sleep;
use std::time::{Duration, Instant};

use client::Error;
use client::line::ATTEMPTS;
use client::service::{Identify, Question};

use crate::transport::{Target, Transport};

/// How long the board takes from reset to its first answer: its bootloader waits a second, the
/// firmware checks the program.
const BOOT: Duration = Duration::from_secs(4);
/// How long one attempt waits while the board may be starting.
const BOOT_PATIENCE: Duration = Duration::from_millis(250);

/// Bits on the line for a byte, with parity.
const BITS_OF_A_BYTE: u32 = 11;
/// Bytes that a network carries in a second at least.
const NETWORK_BYTES: u64 = 100_000;

/// A connection to a PLC.
pub struct Client {
    target: Option<Target>,
    transport: Option<Box<dyn Transport>>,
    /// Beside what the way takes: of a PLC that answers at the end of a long scan.
    scan: Duration,
    /// Is told what is waited for when the first question opens the way.
    notice: fn(&str),
}

impl Client {
    /// A client of this PLC. The first question opens the way to it, and not before: opening the
    /// port of a board may reset it, and with it a plant. `notice` is told what is waited for then.
    pub fn new(target: Target, notice: fn(&str)) -> Client {
        Client { target: Some(target), transport: None, scan: Duration::ZERO, notice }
    }

    /// A client on a way that is open already. It is not opened again when it is lost.
    pub fn over(transport: Box<dyn Transport>) -> Client {
        Client { target: None, transport: Some(transport), scan: Duration::ZERO, notice: |_| {} }
    }

    /// Connects, also after the way was lost, and waits for a board that the opening of its port
    /// has reset. One attempt; the error says why it failed.
    pub fn connect_again(&mut self, notice: &mut dyn FnMut(&str)) -> Result<(), Error> {
        let Some(target) = &self.target else {
            return Err(Error::NotConnected("the connection is gone".into()));
        };
        self.transport = None;
        let mut transport = target.open()?;
        let request = Identify.request()?;
        let begin = Instant::now();
        let mut has_waited = false;
        loop {
            match transport.exchange(&request, BOOT_PATIENCE) {
                Err(error @ (Error::NoAnswer | Error::BadAnswer(_))) if begin.elapsed() < BOOT => {
                    if !has_waited {
                        notice("waiting for an answer: opening the port may have reset the board");
                    }
                    has_waited = true;
                    // A damaged answer comes at once.
                    if !matches!(error, Error::NoAnswer) {
                        sleep(BOOT_PATIENCE);
                    }
                }
                Err(Error::NoAnswer | Error::BadAnswer(_)) => {
                    return Err(Error::NotConnected(target.advice()));
                }
                // Whoever refuses this is no uno200, which is said by whoever asks next.
                Err(error) if !error.is_refusal() => return Err(error),
                _ => break,
            }
        }
        if has_waited && matches!(target, Target::Serial(_)) {
            notice(
                "the board answers; it has started again: its program began with the first scan",
            );
        }
        self.transport = Some(transport);
        Ok(())
    }

    /// Connects again and again until it works or the time is over.
    pub fn connect_within(
        &mut self,
        time: Duration,
        notice: &mut dyn FnMut(&str),
    ) -> Result<(), Error> {
        let begin = Instant::now();
        loop {
            match self.connect_again(notice) {
                Err(error) if begin.elapsed() >= time => return Err(error),
                Err(_) => sleep(Duration::from_millis(500)),
                Ok(()) => return Ok(()),
            }
        }
    }

    /// Where the PLC is, for people.
    pub fn place(&self) -> String {
        self.target.as_ref().map_or_else(|| "the PLC".to_string(), Target::to_string)
    }

    /// Whether the way is open, as far as is known.
    pub fn is_connected(&self) -> bool {
        self.transport.is_some()
    }

    /// Says how long a scan can take: answers that come at its end are waited for so much longer.
    pub fn expect_scans_of(&mut self, scan: Duration) {
        self.scan = scan;
    }

    /// How many bytes a second the way carries, about.
    pub fn bytes_per_second(&self) -> u64 {
        match &self.target {
            Some(Target::Serial(settings)) => u64::from(settings.baud / BITS_OF_A_BYTE),
            Some(Target::Tcp { .. }) | None => NETWORK_BYTES,
        }
    }

    /// Asks a question.
    pub fn ask<Q: Question>(&mut self, question: &Q) -> Result<Q::Answer, Error> {
        let request = question.request()?;
        let answer = match question.is_repeatable() {
            true => self.exchange(&request),
            false => self.exchange_once(&request),
        };
        question.answer(&answer?)
    }

    /// Sends a request, function code and data, and gives the answer. It is sent again when no good
    /// answer comes: not for requests that must not be carried out twice.
    pub fn exchange(&mut self, request: &[u8]) -> Result<Vec<u8>, Error> {
        let mut result = Err(Error::NoAnswer);
        for _ in 0..ATTEMPTS {
            result = self.exchange_once(request);
            if !result.as_ref().is_err_and(Error::is_worth_repeating) {
                break;
            }
        }
        result
    }

    /// The same, sent once.
    pub fn exchange_once(&mut self, request: &[u8]) -> Result<Vec<u8>, Error> {
        if self.transport.is_none() {
            // Only the first time: a way that was lost is told about by who has lost it.
            let mut notice = std::mem::replace(&mut self.notice, |_| {});
            self.connect_again(&mut notice)?;
        }
        let patience =
            self.scan + self.target.as_ref().map_or(Duration::from_secs(2), Target::patience);
        let Some(transport) = &mut self.transport else { return Err(Error::NoAnswer) };
        let result = transport.exchange(request, patience);
        if matches!(result, Err(Error::Lost(_))) && self.target.is_some() {
            self.transport = None;
        }
        result
    }
}
