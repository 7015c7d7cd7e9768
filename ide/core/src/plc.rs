//! A PLC at the other end of a line: what is asked of it round by round, and what is known of it.
//! Bytes in, bytes out; the same for a simulator and for a board.

use std::collections::BTreeSet;

use awl_asm::Address;
use client::line::{Framing, Line};
use client::operand::{Operand, OperandError};
use client::show::Rounds;
use client::show::model::Flow;
use client::show::rounds::{PAUSE_MS, ROUND_MS};
use client::show::state::{Link, News, Order, State, can_force};
use client::value::{Base, Form};
use client::{Error, Program};

use crate::protocol::{Event, Line as Live, Value};
use crate::sampler::{Sample, Sampler, number};

/// How long an answer may take, in milliseconds.
const PATIENCE_MS: u64 = 1000;

/// An operand of the watch table.
#[derive(Debug)]
struct Watched {
    name: String,
    operand: Result<Operand, OperandError>,
}

/// Lines of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lines {
    /// The file.
    pub file: String,
    /// The first one, from 1.
    pub from: u32,
    /// The last one.
    pub to: u32,
}

/// Whose request is on its way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Asking {
    Round,
    Sample,
}

/// The connection, and what is known.
#[derive(Debug)]
pub struct Plc {
    framing: Framing,
    line: Line,
    rounds: Rounds,
    /// The program on the screen, with the values that belong to it.
    pub state: State,
    watched: Vec<Watched>,
    /// What is asked for besides.
    besides: Vec<Watched>,
    /// What the oscilloscope asks in between.
    sampler: Sampler,
    asking: Option<Asking>,
    next_round_ms: u64,
    /// The lines that can be seen; `None`: none.
    view: Option<Lines>,
    /// The double words that the program computes with as reals.
    reals: BTreeSet<Address>,
}

impl Plc {
    /// A PLC that has not answered yet, and is not asked before `begin_ms`.
    pub fn new(framing: Framing, program: Program, place: &str, begin_ms: u64) -> Plc {
        Plc {
            reals: awl_asm::reals::of(&program.image),
            sampler: Sampler::new(&framing),
            line: Line::new(framing.clone(), PATIENCE_MS),
            framing,
            rounds: Rounds::default(),
            state: State::new(program, place.to_owned()),
            watched: Vec::new(),
            besides: Vec::new(),
            asking: None,
            next_round_ms: begin_ms,
            view: None,
        }
    }

    /// The program on the screen is another one. Whether it is the one in the PLC, its next answer
    /// tells.
    pub fn show(&mut self, program: Program) {
        self.reals = awl_asm::reals::of(&program.image);
        let mut state = State::new(program, self.state.place.clone());
        (state.link, state.identity) = (self.state.link.clone(), self.state.identity.clone());
        self.state = state;
        let names = |all: &[Watched]| all.iter().map(|one| one.name.clone()).collect();
        let (watched, besides): (Vec<String>, Vec<String>) =
            (names(&self.watched), names(&self.besides));
        self.watch(&watched);
        self.watch_besides(&besides);
        self.look();
    }

    /// The PLC begins anew, and is not asked before `begin_ms`. What was asked is forgotten.
    pub fn reset(&mut self, begin_ms: u64) {
        self.line = Line::new(self.framing.clone(), PATIENCE_MS);
        self.rounds = Rounds::default();
        (self.asking, self.next_round_ms) = (None, begin_ms);
        self.state.link = Link::Connecting;
        self.state.identity = None;
    }

    /// What the watch table has.
    pub fn watch(&mut self, names: &[String]) {
        self.watched = self.parsed(names);
        self.hurry();
    }

    /// What is asked for besides; what the program does not have stays unknown.
    pub fn watch_besides(&mut self, names: &[String]) {
        self.besides = self.parsed(names);
        self.hurry();
    }

    fn parsed(&self, names: &[String]) -> Vec<Watched> {
        let parse = |name: &String| Watched { name: name.clone(), operand: self.parse(name) };
        names.iter().map(parse).collect()
    }

    /// What the oscilloscope shows, and how often.
    pub fn sample(&mut self, names: &[String], every_ms: u64) -> Result<(), String> {
        let operands = names.iter().map(|name| self.operand(name)).collect::<Result<_, _>>()?;
        self.sampler.choose(operands, every_ms);
        Ok(())
    }

    /// Whether samples are asked for.
    pub fn is_sampling(&self) -> bool {
        self.sampler.is_asking()
    }

    /// The samples since the last time.
    pub fn samples(&mut self) -> Vec<Sample> {
        self.sampler.take()
    }

    /// Which lines can be seen.
    pub fn view(&mut self, lines: Option<Lines>) {
        self.view = lines;
        self.look();
        self.hurry();
    }

    fn look(&mut self) {
        let Some((first, len)) = self.visible() else { return };
        self.state.resize(len.max(1));
        self.state.go_to(first);
    }

    /// The first row of the program that can be seen, and how many; `None` where there are none.
    fn visible(&self) -> Option<(usize, usize)> {
        let Lines { file, from, to } = self.view.as_ref()?;
        let rows = self.state.model.rows_of(file)?;
        let first = rows.start + (*from as usize).checked_sub(1)?;
        let end = (rows.start + *to as usize).min(rows.end);
        (first < end).then_some((first, end - first))
    }

    /// Has something done.
    pub fn order(&mut self, order: Order) {
        self.rounds.order(order);
        self.hurry();
    }

    /// An operand as it is written.
    pub fn operand(&self, name: &str) -> Result<Operand, String> {
        self.parse(name).map_err(|error| error.to_string())
    }

    fn parse(&self, name: &str) -> Result<Operand, OperandError> {
        let operand = Operand::parse(name, self.state.program.symbols())?;
        Ok(operand.in_program(&self.reals))
    }

    /// Has everything asked anew, now; of a PLC that has not answered yet, when its time has come.
    pub fn hurry(&mut self) {
        if self.state.link != Link::Connecting {
            self.next_round_ms = 0;
        }
    }

    /// Bytes have come.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) {
        self.line.receive(bytes, now_ms);
    }

    /// The next bytes to be sent, if any are due. To be asked again after each answer.
    pub fn transmit(&mut self, now_ms: u64) -> Option<Vec<u8>> {
        self.line.expire(now_ms);
        if let Some(answer) = self.line.answer() {
            match self.asking.take() {
                Some(Asking::Sample) => self.sampled(answer, now_ms),
                Some(Asking::Round) | None => {
                    let news = self.rounds.answer(answer);
                    self.hear(news, now_ms);
                }
            }
        }
        if self.asking.is_none() {
            self.ask(now_ms);
        }
        self.line.transmit(now_ms)
    }

    /// Puts the next question on the line, if one is due. Samples and the questions of a round take
    /// turns.
    fn ask(&mut self, now_ms: u64) {
        if self.state.link == Link::Connecting && now_ms < self.next_round_ms {
            return;
        }
        // A PLC that has not said what it is may have another program, or none.
        if self.state.identity.is_some()
            && let Some(request) = self.sampler.request(now_ms)
        {
            match request {
                Ok(request) => {
                    self.line.request(request, true, now_ms);
                    self.asking = Some(Asking::Sample);
                }
                Err(error) => self.sampler.refused(&error),
            }
        }
        while self.asking.is_none() {
            match self.rounds.request() {
                Ok(Some(request)) => {
                    self.line.request(request.bytes, request.is_repeatable, now_ms);
                    (self.asking, self.sampler.has_turn) = (Some(Asking::Round), true);
                }
                Ok(None) if now_ms < self.next_round_ms => {
                    if std::mem::replace(&mut self.sampler.has_turn, true) {
                        return;
                    }
                    return self.ask(now_ms);
                }
                Ok(None) => self.begin(now_ms),
                Err(error) => self.hear(Err(error), now_ms),
            }
        }
    }

    fn sampled(&mut self, answer: Result<Vec<u8>, Error>, now_ms: u64) {
        match answer.and_then(|answer| self.sampler.answer(&answer, now_ms)) {
            Ok(()) => {}
            Err(error) if error.is_refusal() => self.sampler.refused(&error),
            Err(error) => self.hear(Err(error), now_ms),
        }
    }

    fn begin(&mut self, now_ms: u64) {
        let mut wishes = match self.visible() {
            Some(_) => self.state.wishes(),
            None => Default::default(),
        };
        let watched = self.watched.iter().chain(&self.besides);
        let watched = watched.filter_map(|watched| watched.operand.as_ref().ok());
        wishes.watch.extend(watched.map(|operand| operand.reference));
        wishes.watch.sort();
        wishes.watch.dedup();
        self.rounds.wish(wishes);
        self.rounds.begin();
        self.next_round_ms = now_ms + ROUND_MS;
    }

    fn hear(&mut self, news: Result<Vec<News>, Error>, now_ms: u64) {
        match news {
            Ok(news) => news.into_iter().for_each(|one| self.state.hear(one)),
            Err(error) => {
                let lost = self.rounds.failed(&error);
                self.state.hear(lost);
                self.next_round_ms = now_ms + PAUSE_MS;
            }
        }
    }

    /// Live values beside the lines that can be seen.
    pub fn live(&self) -> Event {
        let mut lines = Vec::new();
        if let Some((first, len)) = self.visible().filter(|_| self.state.link == Link::Up) {
            let rows = self.state.model.rows.iter().skip(first).take(len);
            for row in rows {
                let number = row.number as u32;
                let Some(instruction) = row.instruction() else { continue };
                let flow = self.state.flow(instruction).map(|flow| match flow {
                    Flow::On => "on",
                    Flow::Off => "off",
                    Flow::NotExecuted => "skipped",
                });
                let values = instruction.operands.iter().enumerate().map(|(index, watched)| {
                    let raw = self.state.value(instruction, index);
                    let text = raw.map(|raw| watched.text(raw, Base::Decimal));
                    Value { text: text.unwrap_or_default(), ..self.value(&watched.operand, raw) }
                });
                let values = values.collect();
                lines.push(Live { line: number, flow: flow.map(str::to_owned), values });
            }
        }
        let file = self.view.as_ref().map_or(String::new(), |lines| lines.file.clone());
        Event::Live { file, lines }
    }

    /// The watch table.
    pub fn watched(&self) -> Event {
        let of = |watched: &Watched| match &watched.operand {
            Ok(operand) => self.value(operand, self.state.values.get(&operand.reference).copied()),
            Err(error) => Value {
                name: watched.name.clone(),
                text: String::new(),
                number: None,
                form: String::new(),
                forced: false,
                can_force: false,
                problem: Some(error.to_string()),
            },
        };
        Event::Watched { values: self.watched.iter().map(of).collect() }
    }

    /// What is known of what is asked for besides.
    pub fn besides(&self) -> Vec<Option<f64>> {
        let of = |one: &Watched| {
            let operand = one.operand.as_ref().ok()?;
            self.state.values.get(&operand.reference).map(|raw| number(operand, *raw))
        };
        self.besides.iter().map(of).collect()
    }

    /// What is forced, under the names that are known for it.
    pub fn forced(&self) -> Event {
        let all = self.state.model.rows.iter().filter_map(|row| row.instruction());
        let all = all.flat_map(|instruction| &instruction.operands).map(|watched| &watched.operand);
        let all: Vec<&Operand> = all
            .chain(self.watched.iter().filter_map(|watched| watched.operand.as_ref().ok()))
            .collect();
        let mut values: Vec<Value> = Vec::new();
        for (&reference, &raw) in &self.state.forced {
            let known = all.iter().find(|operand| operand.reference == reference);
            values.push(match known {
                Some(operand) => self.value(operand, Some(raw)),
                None => Value {
                    name: format!("{reference:?}"),
                    text: raw.to_string(),
                    number: Some(f64::from(raw)),
                    form: "word".to_owned(),
                    forced: true,
                    can_force: true,
                    problem: None,
                },
            });
        }
        values.sort_by(|one, other| one.name.cmp(&other.name));
        Event::Forced { values }
    }

    /// What went wrong last with an order or a question, once.
    pub fn complaint(&mut self) -> Option<String> {
        let refused = self.sampler.complaint();
        let (message, _) = self.state.message.take_if(|(_, is_bad)| *is_bad).unzip();
        message.or(refused)
    }

    fn value(&self, operand: &Operand, raw: Option<u32>) -> Value {
        let form = operand.form;
        Value {
            name: operand.name.clone(),
            text: raw.map_or(String::new(), |raw| operand.text(raw, Base::Decimal)),
            number: raw.map(|raw| number(operand, raw)),
            form: match form {
                Form::Bit => "bit",
                Form::Byte => "byte",
                Form::Word => "word",
                Form::Double => "double",
                Form::Real => "real",
            }
            .to_owned(),
            forced: self.state.forced.contains_key(&operand.reference),
            can_force: can_force(operand),
            problem: None,
        }
    }
}
