//! Carries a [`Job`] out: what is sent when, what comes back, when it is given up.

use crate::PAGE_LEN;
use crate::failure::{Cause, Failure, Holds};
use crate::job::{Job, Step};
use crate::stk500;

/// DTR and RTS are off so long: their coming on is what resets the board.
const RESET_MS: u64 = 100;
/// From then on until the bootloader listens.
const START_MS: u64 = 50;
/// How long an answer to the first question may take: before it Optiboot flashes its lamp, 0.4 s,
/// and keeps no more than two bytes meanwhile. Nothing more may be sent.
const SYNC_MS: u64 = 700;
/// How often the board is reset until it answers. With a button that is pressed by hand there is
/// time for it.
const RESETS_MAX: u32 = 12;
/// The same for a board that has answered before: nobody presses its button again.
const RESETS_AGAIN_MAX: u32 = 3;
/// What comes after the first answer belongs to earlier questions, if it comes at all.
const SETTLE_MS: u64 = 30;
/// How long any other answer may take. A page takes 25 ms; a USB hub and a page of a browser have
/// their own.
const ANSWER_MS: u64 = 1000;
/// How often the board may lose its way after it has answered.
const RETRIES_MAX: u32 = 3;
/// ATmega328P.
const SIGNATURE: [u8; 3] = [0x1E, 0x95, 0x0F];

/// What is to be done with the port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Output {
    /// DTR and RTS are switched on or off, both.
    Lines(bool),
    /// These bytes are sent.
    Send(Vec<u8>),
}

/// What is going on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The board is reset and asked what it is.
    Connecting,
    /// Pages are written.
    Writing,
    /// Pages are read back.
    Verifying,
    /// The board starts.
    Starting,
}

/// How far it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// What is going on.
    pub phase: Phase,
    /// Bytes written and read.
    pub done: u32,
    /// Bytes to be written and read.
    pub total: u32,
}

#[derive(Debug)]
enum State {
    /// The lines are to be switched off.
    Begin,
    /// They are off until then.
    Reset { until_ms: u64 },
    /// The bootloader begins to listen then.
    Start { until_ms: u64 },
    /// It was asked whether it is there; the last byte that came.
    Sync { last: u8, until_ms: u64 },
    /// It is; the rest is of no interest.
    Settle { until_ms: u64 },
    /// The next command is to be sent.
    Next,
    /// It was sent, and has so many bytes of answer, the first and the last one included.
    Wait { answer: Vec<u8>, wanted: usize, until_ms: u64 },
    /// Over.
    Ended,
}

/// Writes a board. After each [`receive`](Self::receive), and every few milliseconds besides,
/// [`poll`](Self::poll) is to be called until it has nothing more.
#[derive(Debug)]
pub struct Flasher {
    steps: Vec<Step>,
    /// The step that is carried out.
    at: usize,
    /// Whether the address of its page is set.
    is_addressed: bool,
    state: State,
    resets: u32,
    retries: u32,
    has_answered: bool,
    holds: Holds,
    result: Option<Result<(), Failure>>,
}

impl Flasher {
    /// Begins with a reset of the board. The port is open at [`BAUD`](crate::BAUD), 8N1.
    pub fn new(job: Job) -> Flasher {
        Flasher {
            steps: job.steps,
            at: 0,
            is_addressed: false,
            state: State::Begin,
            resets: 0,
            retries: 0,
            has_answered: false,
            holds: Holds::Before,
            result: None,
        }
    }

    /// How it ended; none while it goes on.
    pub fn result(&self) -> Option<&Result<(), Failure>> {
        self.result.as_ref()
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        let bytes = |steps: &[Step]| {
            steps.iter().filter_map(Step::page).map(|page| page.bytes.len() as u32).sum()
        };
        let phase = match self.steps.get(self.at) {
            Some(Step::Write { .. }) => Phase::Writing,
            Some(Step::Verify(_)) => Phase::Verifying,
            Some(Step::Identify | Step::Expect(_)) => Phase::Connecting,
            Some(Step::Leave) | None => Phase::Starting,
        };
        let done = bytes(&self.steps[..self.at.min(self.steps.len())]);
        Progress { phase, done, total: bytes(&self.steps) }
    }

    /// The way to the board is gone.
    pub fn lost(&mut self, why: &str) {
        self.fail(Cause::Lost(why.to_owned()));
    }

    /// Bytes have come.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) {
        for &byte in bytes {
            match &mut self.state {
                State::Sync { last, .. } => {
                    if [*last, byte] == [stk500::IN_SYNC, stk500::OK] {
                        self.has_answered = true;
                        self.state = State::Settle { until_ms: now_ms + SETTLE_MS };
                    } else {
                        *last = byte;
                    }
                }
                State::Wait { answer, wanted, .. } => {
                    answer.push(byte);
                    if answer[0] != stk500::IN_SYNC {
                        self.retry();
                    } else if answer.len() == *wanted {
                        let answer = std::mem::take(answer);
                        self.state = State::Next;
                        self.hear(&answer);
                    }
                }
                // Of the program that was interrupted, or to an earlier question.
                State::Begin
                | State::Reset { .. }
                | State::Start { .. }
                | State::Settle { .. }
                | State::Next
                | State::Ended => {}
            }
        }
    }

    /// What is to be done now with the port, if anything is.
    pub fn poll(&mut self, now_ms: u64) -> Option<Output> {
        match self.state {
            State::Begin => {
                self.resets += 1;
                self.state = State::Reset { until_ms: now_ms + RESET_MS };
                Some(Output::Lines(false))
            }
            State::Reset { until_ms } if now_ms >= until_ms => {
                self.state = State::Start { until_ms: now_ms + START_MS };
                Some(Output::Lines(true))
            }
            State::Start { until_ms } if now_ms >= until_ms => {
                self.state = State::Sync { last: 0, until_ms: now_ms + SYNC_MS };
                Some(Output::Send(stk500::plain(stk500::GET_SYNC)))
            }
            State::Sync { until_ms, .. } if now_ms >= until_ms => {
                self.state = State::Begin;
                let (resets_max, cause) = match self.has_answered {
                    true => (RESETS_AGAIN_MAX, Cause::FellSilent),
                    false => (RESETS_MAX, Cause::NoAnswer),
                };
                if self.resets >= resets_max {
                    self.fail(cause);
                }
                self.poll(now_ms)
            }
            State::Settle { until_ms } if now_ms >= until_ms => {
                self.state = State::Next;
                self.poll(now_ms)
            }
            State::Wait { until_ms, .. } if now_ms >= until_ms => {
                self.retry();
                self.poll(now_ms)
            }
            State::Next => self.command(now_ms).map(Output::Send),
            State::Reset { .. }
            | State::Start { .. }
            | State::Sync { .. }
            | State::Settle { .. }
            | State::Wait { .. }
            | State::Ended => None,
        }
    }

    /// The next command of the step that is carried out.
    fn command(&mut self, now_ms: u64) -> Option<Vec<u8>> {
        let step = self.steps.get(self.at)?;
        let (command, data) = match step {
            Step::Identify => (stk500::plain(stk500::READ_SIGNATURE), SIGNATURE.len()),
            Step::Leave => (stk500::plain(stk500::LEAVE), 0),
            Step::Expect(page) | Step::Verify(page) | Step::Write { page, .. }
                if !self.is_addressed =>
            {
                (stk500::load_address(page.at), 0)
            }
            Step::Expect(_) | Step::Verify(_) => (stk500::read_page(PAGE_LEN), PAGE_LEN),
            Step::Write { page, sent, .. } => {
                self.holds = *sent;
                (stk500::write_page(&page.bytes), 0)
            }
        };
        let until_ms = now_ms + ANSWER_MS;
        self.state = State::Wait { answer: Vec::new(), wanted: data + 2, until_ms };
        Some(command)
    }

    /// An answer is complete.
    fn hear(&mut self, answer: &[u8]) {
        let [_, data @ .., stk500::OK] = answer else { return self.retry() };
        let Some(step) = self.steps.get(self.at) else { return };
        if step.page().is_some() && !self.is_addressed {
            self.is_addressed = true;
            return;
        }
        match step {
            Step::Identify => {
                if data != SIGNATURE {
                    let signature = data.try_into().unwrap_or_default();
                    return self.fail(Cause::OtherChip(signature));
                }
            }
            Step::Expect(page) => {
                if data != page.bytes {
                    return self.fail(Cause::OtherFirmware);
                }
            }
            Step::Verify(page) => {
                let differs = (page.at..).zip(data).zip(&page.bytes);
                let mut differs = differs.filter(|((_, is), should)| is != should);
                if let Some(((at, _), _)) = differs.next() {
                    return self.fail(Cause::Mismatch(at));
                }
            }
            Step::Write { written, .. } => self.holds = *written,
            Step::Leave => return self.end(Ok(())),
        }
        (self.at, self.is_addressed) = (self.at + 1, false);
    }

    /// The answer is none, or does not come: the board is reset, and the step begins again.
    fn retry(&mut self) {
        if matches!(self.steps.get(self.at), Some(Step::Leave)) {
            // All is written and read; the board starts by itself.
            return self.end(Ok(()));
        }
        self.is_addressed = false;
        self.retries += 1;
        self.resets = 0;
        if self.retries > RETRIES_MAX {
            self.fail(Cause::FellSilent);
        } else {
            self.state = State::Begin;
        }
    }

    fn fail(&mut self, cause: Cause) {
        self.end(Err(Failure { cause, holds: self.holds }));
    }

    /// The first end counts.
    fn end(&mut self, result: Result<(), Failure>) {
        self.state = State::Ended;
        self.result.get_or_insert(result);
    }
}
