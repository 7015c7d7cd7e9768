//! The oscilloscope's questions to a PLC on its line: values of some operands, all from the end of
//! the same scan, again and again, as often as the line allows.

use client::line::{Framing, rtu};
use client::operand::Operand;
use client::service::{Question, Watch};
use client::value::Form;
use client::{Error, Reference};

/// Characters of a question for a signal and its answer, with the pauses that end them.
const CHARACTERS: u64 = 24;
/// How long a PLC takes for an answer, and a page for the next question.
const BETWEEN_MS: u64 = 3;

/// Values of the signals.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// When they came.
    pub at_ms: u64,
    /// Low word of the scans since RUN.
    pub scan: u16,
    /// A number for each signal.
    pub values: Vec<f64>,
    /// Whether others should have come before: they are missing.
    pub is_late: bool,
}

/// What is to be asked, and what has come of it.
#[derive(Debug)]
pub struct Sampler {
    operands: Vec<Operand>,
    every_ms: u64,
    /// How long a question and its answer take.
    exchange_ms: u64,
    next_ms: u64,
    last_ms: Option<u64>,
    /// Of the question that is on its way, unless others were chosen since.
    asked: Option<Vec<Reference>>,
    samples: Vec<Sample>,
    complaint: Option<String>,
    /// The other questions have had theirs.
    pub has_turn: bool,
}

impl Sampler {
    /// On a line with these frames; nothing is asked yet.
    pub fn new(framing: &Framing) -> Sampler {
        let exchange_ms = match *framing {
            Framing::Rtu { baud, .. } => rtu::characters_ms(CHARACTERS, baud) + BETWEEN_MS,
            Framing::Tcp { .. } => BETWEEN_MS,
        };
        Sampler {
            operands: Vec::new(),
            every_ms: 0,
            exchange_ms,
            next_ms: 0,
            last_ms: None,
            asked: None,
            samples: Vec::new(),
            complaint: None,
            has_turn: true,
        }
    }

    /// Other signals.
    pub fn choose(&mut self, operands: Vec<Operand>, every_ms: u64) {
        (self.operands, self.every_ms) = (operands, every_ms);
        (self.next_ms, self.last_ms, self.asked) = (0, None, None);
        self.samples.clear();
    }

    /// The request, if it is due.
    pub fn request(&mut self, now_ms: u64) -> Option<Result<Vec<u8>, Error>> {
        if !self.has_turn || now_ms < self.next_ms || self.operands.is_empty() {
            return None;
        }
        self.has_turn = false;
        let references: Vec<_> = self.operands.iter().map(|operand| operand.reference).collect();
        let request = Watch(&references).request();
        self.asked = Some(references);
        Some(request)
    }

    /// Its answer.
    pub fn answer(&mut self, answer: &[u8], now_ms: u64) -> Result<(), Error> {
        let Some(references) = self.asked.take() else { return Ok(()) };
        let watched = Watch(&references).answer(answer)?;
        let raw = self.operands.iter().zip(watched.values);
        let values = raw.map(|(operand, raw)| number(operand, raw)).collect();
        // Another question that is on the line is waited for.
        let latest_ms = self.last_ms.map(|last_ms| last_ms + self.every_ms + 2 * self.exchange_ms);
        let is_late = latest_ms.is_some_and(|latest_ms| now_ms > latest_ms);
        self.samples.push(Sample { at_ms: now_ms, scan: watched.scan, values, is_late });
        self.last_ms = Some(now_ms);
        // On time it goes on from when it was due.
        let due_ms = self.next_ms + self.every_ms;
        self.next_ms = if due_ms + self.every_ms > now_ms { due_ms } else { now_ms };
        Ok(())
    }

    /// The PLC does not tell these values.
    pub fn refused(&mut self, error: &Error) {
        let names: Vec<&str> = self.operands.iter().map(|operand| operand.name.as_str()).collect();
        self.complaint = Some(format!("oscilloscope, {}: {error}", names.join(", ")));
        self.operands.clear();
    }

    /// Whether values are asked for.
    pub fn is_asking(&self) -> bool {
        !self.operands.is_empty()
    }

    /// What went wrong, once.
    pub fn complaint(&mut self) -> Option<String> {
        self.complaint.take()
    }

    /// The samples since the last time.
    pub fn take(&mut self) -> Vec<Sample> {
        std::mem::take(&mut self.samples)
    }
}

/// A raw value as a number.
pub fn number(operand: &Operand, raw: u32) -> f64 {
    match operand.form {
        Form::Real => f64::from(f32::from_bits(raw)),
        Form::Bit | Form::Byte | Form::Word | Form::Double => f64::from(operand.form.number(raw)),
    }
}
