//! Asks the PLC what the view wants to know, and carries its orders out. In a thread of its own, so
//! that a slow line never keeps keys waiting. What is asked when, [`Rounds`] knows.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use client::Error;
use client::show::Rounds;
use client::show::rounds::{PAUSE_MS, ROUND_MS};
use client::show::state::{News, Order, Wishes};

use crate::connection::Client;

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
    rounds: Rounds,
}

impl Poller {
    /// On a connection. The messages are read between two questions.
    pub fn new(client: Client, messages: Receiver<Message>) -> Poller {
        Poller { client, messages, rounds: Rounds::default() }
    }

    /// Goes on until nobody listens any more.
    pub fn run(mut self, news: &Sender<News>) {
        loop {
            let begin = Instant::now();
            let (mut reports, pause_ms) = self.report(Poller::round);
            let pause = Duration::from_millis(pause_ms);
            loop {
                if reports.drain(..).any(|report| news.send(report).is_err()) {
                    return;
                }
                let left = pause.saturating_sub(begin.elapsed());
                match self.messages.recv_timeout(left) {
                    Ok(message) => {
                        self.take(message);
                        (reports, _) = self.report(Poller::go_on);
                    }
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        }
    }

    /// Asks everything once, orders first.
    pub fn round(&mut self) -> Result<Vec<News>, Error> {
        self.attend();
        self.rounds.begin();
        self.go_on()
    }

    /// What came of something, and how long to wait after it in milliseconds.
    fn report(
        &mut self,
        what: impl FnOnce(&mut Poller) -> Result<Vec<News>, Error>,
    ) -> (Vec<News>, u64) {
        match what(self) {
            Ok(reports) => (reports, ROUND_MS),
            Err(error) => (vec![self.rounds.failed(&error)], PAUSE_MS),
        }
    }

    /// Asks what is left of the round, and what is ordered meanwhile.
    fn go_on(&mut self) -> Result<Vec<News>, Error> {
        let mut news = Vec::new();
        while let Some(request) = self.rounds.request()? {
            let answer = match request.is_repeatable {
                true => self.client.exchange(&request.bytes),
                false => self.client.exchange_once(&request.bytes),
            };
            news.extend(self.rounds.answer(answer)?);
            if let Some(scan_ms) = self.rounds.longest_scan_ms() {
                self.client.expect_scans_of(Duration::from_millis(scan_ms));
            }
            self.attend();
        }
        Ok(news)
    }

    /// Takes the messages that have come in: orders do not wait for the end of a long round.
    fn attend(&mut self) {
        while let Ok(message) = self.messages.try_recv() {
            self.take(message);
        }
    }

    fn take(&mut self, message: Message) {
        match message {
            Message::Wishes(wishes) => self.rounds.wish(wishes),
            Message::Order(order) => self.rounds.order(order),
        }
    }
}
