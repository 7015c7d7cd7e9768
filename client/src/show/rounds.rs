//! What the view wants to know, asked round by round, and its orders, carried out in between: which
//! request is next, and what an answer tells the view. Who sends it and when is not known here.

use std::collections::VecDeque;

use super::state::{News, Order, Wishes};
use crate::error::Error;
use crate::reference::Reference;
use crate::service::{
    Command, Force, Forced, Identify, Identity, Question, ScanStatus, Set, StatusWindow, WATCH_MAX,
    Watch, windows,
};
use crate::value::Base;

/// The shortest time from one round to the next, in milliseconds.
pub const ROUND_MS: u64 = 100;
/// From a lost connection to the next round, in milliseconds.
pub const PAUSE_MS: u64 = 500;

/// Bytes before the first value of an answer.
const HEAD_LEN: usize = 4;
/// Bytes of the longest value in an answer; in the question there are fewer.
const WATCH_LEN: usize = 4;

/// A request that is to be sent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Function code and data.
    pub bytes: Vec<u8>,
    /// Whether it may be sent again when its answer is lost.
    pub is_repeatable: bool,
}

impl Request {
    fn of(question: &impl Question) -> Result<Request, Error> {
        Ok(Request { bytes: question.request()?, is_repeatable: question.is_repeatable() })
    }
}

/// Rounds of questions.
#[derive(Debug, Default)]
pub struct Rounds {
    wishes: Wishes,
    orders: VecDeque<Order>,
    identity: Option<Identity>,
    /// Whether the view was told of forced operands.
    has_forced: bool,
    round: Option<Round>,
    asked: Option<Step>,
}

/// A round that is under way.
#[derive(Debug)]
struct Round {
    steps: VecDeque<Step>,
    /// What the steps were made for.
    wishes: Wishes,
    /// The program that was in the PLC before.
    before: Option<(u32, u16)>,
    answers: Vec<News>,
    failed: Option<Error>,
}

/// A question of a round.
#[derive(Debug, Clone)]
enum Step {
    Order(Order),
    Wish(Wish),
    Identify,
    Forced,
}

/// As much of the wishes as goes into a request.
#[derive(Debug, Clone)]
enum Wish {
    Status(Vec<(u16, Reference)>),
    Watch(Vec<Reference>),
}

impl Rounds {
    /// What the view wants to know from now on.
    pub fn wish(&mut self, wishes: Wishes) {
        self.wishes = wishes;
    }

    /// What the PLC is to do. It does not wait for the end of a round.
    pub fn order(&mut self, order: Order) {
        self.orders.push_back(order);
    }

    /// How long a scan of the PLC has taken at most, in milliseconds, where that is known.
    pub fn longest_scan_ms(&self) -> Option<u64> {
        let identity = self.identity.as_ref().filter(|identity| identity.counts_per_ms > 0)?;
        Some(u64::from(identity.longest / u32::from(identity.counts_per_ms)))
    }

    /// The next round begins with the next request.
    pub fn begin(&mut self) {
        (self.round, self.asked) = (None, None);
    }

    /// The next request of the round, orders first; `None` when it is complete and no orders wait.
    /// Each must have its [`answer`](Rounds::answer) before the next.
    pub fn request(&mut self) -> Result<Option<Request>, Error> {
        let Some(step) = self.next_step() else { return Ok(None) };
        let request = step.request();
        self.asked = Some(step);
        request.map(Some)
    }

    /// What the view is told when the last request has been answered, or failed. Fails where the
    /// round is over because the connection is lost: [`failed`](Rounds::failed) makes news of it.
    /// Answers that may belong to another program than the one before are left out.
    pub fn answer(&mut self, answer: Result<Vec<u8>, Error>) -> Result<Vec<News>, Error> {
        match self.asked.take() {
            None => Ok(Vec::new()),
            Some(Step::Order(order)) => {
                let done = answer.and_then(|bytes| self.carried_out(&order, &bytes));
                Ok(done.unwrap_or_else(|error| vec![self.failed(&error)]))
            }
            Some(Step::Identify) => self.identified(Identify.answer(&answer?)?),
            Some(Step::Forced) => {
                let mut news = vec![Force::List.answer(&answer?).map(News::Forced)?];
                news.extend(self.end()?);
                Ok(news)
            }
            Some(Step::Wish(wish)) => {
                self.wished(answer.and_then(|bytes| wish.news(&bytes)));
                Ok(Vec::new())
            }
        }
    }

    /// What the view is told of an error.
    pub fn failed(&mut self, error: &Error) -> News {
        if error.is_refusal() {
            return News::Refused(error.to_string());
        }
        self.identity = None;
        News::Lost(error.to_string())
    }

    fn next_step(&mut self) -> Option<Step> {
        if let Some(order) = self.orders.pop_front() {
            return Some(Step::Order(order));
        }
        let round = match &mut self.round {
            Some(round) => round,
            None => self.round.insert(Round::new(&self.wishes, self.identity.as_ref())),
        };
        if round.wishes != self.wishes {
            // The rest was for what is not visible any more.
            round.steps.retain(|step| !step.is_wish());
        }
        round.steps.pop_front()
    }

    /// What the visible instructions did, and values.
    fn wished(&mut self, news: Result<News, Error>) {
        let Some(round) = &mut self.round else { return };
        match news {
            Ok(news) => round.answers.push(news),
            Err(error) => {
                round.failed = Some(error);
                round.steps.retain(|step| !step.is_wish());
            }
        }
    }

    fn identified(&mut self, identity: Identity) -> Result<Vec<News>, Error> {
        let mut news = vec![News::Identity(Box::new(identity.clone()))];
        let asks_forced = identity.is_forced || self.has_forced;
        self.has_forced = identity.is_forced;
        self.identity = Some(identity);
        match &mut self.round {
            Some(round) if asks_forced => round.steps.push_back(Step::Forced),
            _ => news.extend(self.end()?),
        }
        Ok(news)
    }

    /// The answers of the round that is complete, where they belong to the program that is there.
    fn end(&mut self) -> Result<Vec<News>, Error> {
        let now = self.identity.as_ref().map(image);
        let Some(round) = &mut self.round else { return Ok(Vec::new()) };
        match round.failed.take() {
            _ if now != round.before => Ok(Vec::new()),
            Some(error) if error.is_refusal() => Ok(vec![News::Refused(error.to_string())]),
            Some(error) => Err(error),
            None => Ok(std::mem::take(&mut round.answers)),
        }
    }

    fn carried_out(&mut self, order: &Order, answer: &[u8]) -> Result<Vec<News>, Error> {
        let done = |text: &str| Ok(vec![News::Done(text.to_owned())]);
        let forced =
            |table: Vec<Forced>, text: String| Ok(vec![News::Forced(table), News::Done(text)]);
        match order {
            Order::Run => done("RUN"),
            Order::Stop => done("STOP"),
            Order::Scan(window) if window.is_empty() => {
                Ok(vec![News::Scanned(None), News::Done("a scan".to_owned())])
            }
            Order::Scan(window) => {
                let status = ScanStatus(window).answer(answer)?;
                let offsets = window.iter().map(|&(offset, _)| offset);
                let executed = offsets.zip(status.executed).collect();
                Ok(vec![
                    News::Scanned(Some((status.scan, executed))),
                    News::Done("a scan".to_owned()),
                ])
            }
            Order::Force(operand, value) => {
                let table = Force::List.answer(answer)?;
                self.has_forced = true;
                let value = operand.form.text(*value, Base::Decimal);
                forced(table, format!("{} is forced to {value}", operand.official()))
            }
            Order::Unforce(operand) => {
                let text = format!("{} is not forced any more", operand.official());
                forced(Force::List.answer(answer)?, text)
            }
            Order::UnforceAll => forced(Vec::new(), "nothing is forced any more".to_owned()),
            Order::Set(operand, value) => {
                let value = operand.form.text(*value, Base::Decimal);
                done(&format!("{} was set to {value}", operand.official()))
            }
        }
    }
}

impl Round {
    fn new(wishes: &Wishes, identity: Option<&Identity>) -> Round {
        let mut steps = VecDeque::new();
        // Of a PLC that has not answered yet nothing is asked before it says what it is.
        if let Some(identity) = identity {
            let room = usize::from(identity.room);
            let windows = windows(&wishes.status, room).into_iter();
            steps.extend(windows.map(|part| Step::Wish(Wish::Status(part.to_vec()))));
            let parts = wishes.watch.chunks(watch_max(room));
            steps.extend(parts.map(|part| Step::Wish(Wish::Watch(part.to_vec()))));
        }
        steps.push_back(Step::Identify);
        let (wishes, before) = (wishes.clone(), identity.map(image));
        Round { steps, wishes, before, answers: Vec::new(), failed: None }
    }
}

impl Step {
    fn is_wish(&self) -> bool {
        matches!(self, Step::Wish(_))
    }

    fn request(&self) -> Result<Request, Error> {
        match self {
            Step::Wish(Wish::Status(part)) => Request::of(&StatusWindow(part)),
            Step::Wish(Wish::Watch(part)) => Request::of(&Watch(part)),
            Step::Identify => Request::of(&Identify),
            Step::Forced => Request::of(&Force::List),
            Step::Order(order) => match order {
                Order::Run => Request::of(&Command::Run),
                Order::Stop => Request::of(&Command::Stop),
                Order::Scan(window) if window.is_empty() => Request::of(&Command::Scans(1)),
                Order::Scan(window) => Request::of(&ScanStatus(window)),
                Order::Force(operand, value) => {
                    Request::of(&Force::Begin(operand.reference, *value))
                }
                Order::Unforce(operand) => Request::of(&Force::End(operand.reference)),
                Order::UnforceAll => Request::of(&Force::EndAll),
                Order::Set(operand, value) => Request::of(&Set(&[(operand.reference, *value)])),
            },
        }
    }
}

impl Wish {
    /// What the answer tells.
    fn news(&self, answer: &[u8]) -> Result<News, Error> {
        match self {
            Wish::Status(part) => {
                let status = StatusWindow(part).answer(answer)?;
                let offsets = part.iter().map(|&(offset, _)| offset);
                Ok(News::Status(offsets.zip(status.executed).collect()))
            }
            Wish::Watch(part) => {
                let watched = Watch(part).answer(answer)?;
                Ok(News::Values(part.iter().copied().zip(watched.values).collect()))
            }
        }
    }
}

/// Which program is in the PLC.
fn image(identity: &Identity) -> (u32, u16) {
    (identity.image_crc, identity.image_len)
}

/// How many operands can be watched at a time.
fn watch_max(room: usize) -> usize {
    (room.saturating_sub(HEAD_LEN) / WATCH_LEN).clamp(1, WATCH_MAX)
}
