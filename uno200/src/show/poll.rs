//! Asks the PLC what the view wants to know, and carries its orders out. In a thread of its own, so that a slow line
//! never keeps keys waiting.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use super::state::{News, Order, Wishes};
use crate::client::Client;
use crate::error::Error;
use crate::service::{Command, Identity, WATCH_MAX, windows};
use crate::value::Base;

/// The shortest time from one round of questions to the next.
const ROUND: Duration = Duration::from_millis(100);
/// From a lost connection to the next attempt.
const PAUSE: Duration = Duration::from_millis(500);

/// What the view tells the poller.
#[derive(Debug)]
pub enum Message {
    /// What it wants to know from now on.
    Wishes(Wishes),
    /// What the PLC is to do.
    Order(Order),
}

/// Asks and tells.
pub struct Poller {
    client: Client,
    messages: Receiver<Message>,
    wishes: Wishes,
    identity: Option<Identity>,
    /// Whether the view was told of forced operands.
    has_forced: bool,
}

impl Poller {
    /// On a connection. The messages are read between two questions.
    pub fn new(client: Client, messages: Receiver<Message>) -> Poller {
        Poller { client, messages, wishes: Wishes::default(), identity: None, has_forced: false }
    }

    /// Goes on until nobody listens any more.
    pub fn run(mut self, news: &Sender<News>) {
        loop {
            let begin = Instant::now();
            let (mut reports, pause) = match self.round() {
                Ok(reports) => (reports, ROUND),
                Err(error) => (vec![self.failed(&error)], PAUSE),
            };
            loop {
                if reports.drain(..).any(|report| news.send(report).is_err()) {
                    return;
                }
                let left = pause.saturating_sub(begin.elapsed());
                match self.messages.recv_timeout(left) {
                    Ok(message) => reports = self.take(message),
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        }
    }

    /// A message from the view. Returns what it led to.
    fn take(&mut self, message: Message) -> Vec<News> {
        match message {
            Message::Wishes(wishes) => {
                self.wishes = wishes;
                Vec::new()
            }
            Message::Order(order) => self.carry_out(&order).unwrap_or_else(|error| vec![self.failed(&error)]),
        }
    }

    /// Takes the messages that have come in: orders do not wait for the end of a long round.
    fn attend(&mut self, reports: &mut Vec<News>) {
        while let Ok(message) = self.messages.try_recv() {
            reports.extend(self.take(message));
        }
    }

    /// Asks everything once, orders first. Answers that may belong to another program than the one before are left out.
    pub fn round(&mut self) -> Result<Vec<News>, Error> {
        let mut news = Vec::new();
        self.attend(&mut news);
        let before = self.identity.as_ref().map(image);
        let mut answers = Vec::new();
        let refused = match before {
            Some(_) => self.ask(&mut answers, &mut news).err(),
            None => None,
        };
        let identity = self.client.identify()?;
        if identity.counts_per_ms > 0 {
            let longest_ms = identity.longest / u32::from(identity.counts_per_ms);
            self.client.expect_scans_of(Duration::from_millis(longest_ms.into()));
        }
        let is_same = before == Some(image(&identity));
        news.push(News::Identity(Box::new(identity.clone())));
        if identity.is_forced || self.has_forced {
            news.push(News::Forced(self.client.forced()?));
            self.has_forced = identity.is_forced;
        }
        self.identity = Some(identity);
        match refused {
            _ if !is_same => {}
            Some(error) if error.is_refusal() => news.push(News::Refused(error.to_string())),
            Some(error) => return Err(error),
            None => news.extend(answers),
        }
        Ok(news)
    }

    /// Asks what is wished, until the wishes are others.
    fn ask(&mut self, answers: &mut Vec<News>, news: &mut Vec<News>) -> Result<(), Error> {
        let wishes = self.wishes.clone();
        let room = self.identity.as_ref().map_or(0, |identity| usize::from(identity.room));
        for part in windows(&wishes.status, room) {
            let status = self.client.status(part)?;
            let offsets = part.iter().map(|&(offset, _)| offset);
            answers.push(News::Status(offsets.zip(status.executed).collect()));
            self.attend(news);
            if self.wishes != wishes {
                return Ok(());
            }
        }
        for part in wishes.watch.chunks(watch_max(room)) {
            let watched = self.client.watch(part)?;
            answers.push(News::Values(part.iter().copied().zip(watched.values).collect()));
            self.attend(news);
            if self.wishes != wishes {
                return Ok(());
            }
        }
        Ok(())
    }

    fn carry_out(&mut self, order: &Order) -> Result<Vec<News>, Error> {
        let done = |text: String| News::Done(text);
        let control = |client: &mut Client, command, text: &str| {
            client.control(command).map(|()| vec![News::Done(text.to_owned())])
        };
        match order {
            Order::Run => control(&mut self.client, Command::Run, "RUN"),
            Order::Stop => control(&mut self.client, Command::Stop, "STOP"),
            Order::Scan => control(&mut self.client, Command::Scans(1), "a scan"),
            Order::Force(operand, value) => {
                let table = self.client.force(operand.reference, *value)?;
                self.has_forced = true;
                let text = format!("{} is forced to {}", operand.official(), operand.form.text(*value, Base::Decimal));
                Ok(vec![News::Forced(table), done(text)])
            }
            Order::Unforce(operand) => {
                let table = self.client.unforce(operand.reference)?;
                Ok(vec![News::Forced(table), done(format!("{} is not forced any more", operand.official()))])
            }
            Order::UnforceAll => {
                self.client.unforce_all()?;
                Ok(vec![News::Forced(Vec::new()), done("nothing is forced any more".to_owned())])
            }
            Order::Set(operand, value) => {
                self.client.set(&[(operand.reference, *value)])?;
                let text = operand.form.text(*value, Base::Decimal);
                Ok(vec![done(format!("{} was set to {text}", operand.official()))])
            }
        }
    }

    fn failed(&mut self, error: &Error) -> News {
        if error.is_refusal() {
            return News::Refused(error.to_string());
        }
        self.identity = None;
        News::Lost(error.to_string())
    }
}

/// Which program is in the PLC.
fn image(identity: &Identity) -> (u32, u16) {
    (identity.image_crc, identity.image_len)
}

/// Bytes before the first value.
const HEAD_LEN: usize = 4;
/// Bytes of the longest value in an answer; in the question there are fewer.
const WATCH_LEN: usize = 4;

/// How many operands can be watched at a time.
fn watch_max(room: usize) -> usize {
    (room.saturating_sub(HEAD_LEN) / WATCH_LEN).clamp(1, WATCH_MAX)
}
