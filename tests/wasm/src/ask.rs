//! Somebody at the other end of a simulated PLC's line: client and server, each with its frames,
//! and nothing but bytes and times between them.

use std::error::Error;
use std::net::Ipv4Addr;
use std::time::Duration;

use awl_sim::machine::host::Host;
use awl_sim::run::Outcome;
use awl_sim::serve::{Endpoint, Frames, Request};
use client::line::{Framing, Line};
use client::service::{
    Command, Force, Identify, Question, ReadBits, ReadWords, Reading, Space, Watch,
};
use client::show::model::{Flow, Row};
use client::show::state::State;
use client::show::{Action, Key, Rounds};
use client::{Operand, Program};

use crate::digest::Digest;

/// Milliseconds that an answer may take.
const PATIENCE_MS: u64 = 50;
/// Rows of the view.
const ROWS: usize = 40;

/// A PLC, and a client that is connected to it.
pub struct Asking {
    host: Host,
    endpoint: Endpoint<()>,
    frames: Frames,
    line: Line,
    now_ms: u64,
}

impl Asking {
    /// With a PLC whose next scan starts at this time.
    pub fn new(host: Host, endpoint: Endpoint<()>, now_ms: u64) -> Asking {
        let line = Line::new(Framing::Tcp { unit: 1, transaction: 0 }, PATIENCE_MS);
        Asking { host, endpoint, frames: Frames::default(), line, now_ms }
    }

    /// Modbus' own functions.
    pub fn modbus(&mut self) -> Result<Vec<String>, Box<dyn Error>> {
        let inputs = self.ask(&ReadBits { is_input: true, first: 0, count: 8 })?;
        let outputs = self.ask(&ReadBits { is_input: false, first: 0, count: 8 })?;
        let bits = |bits: Vec<bool>| -> String {
            bits.into_iter().map(|bit| if bit { '1' } else { '0' }).collect()
        };
        let analog = self.ask(&ReadWords { is_input: true, first: 0, count: 2 });
        Ok(vec![format!("modbus: I {}, Q {}, AI {analog:?}", bits(inputs), bits(outputs))])
    }

    /// The service functions.
    pub fn service(&mut self) -> Result<Vec<String>, Box<dyn Error>> {
        let identity = self.ask(&Identify)?;
        let mode = if identity.is_running { "running" } else { "stopped" };
        let mut reading = Reading::new(Space::Program, 0, identity.image_len, identity.room);
        while let Some(block) = reading.next() {
            let block = self.ask(&block)?;
            reading.take(&block);
        }
        let image = Digest::of(&reading.bytes());
        let operand = Operand::parse("I0.0", &[])?;
        let watched = self.ask(&Watch(&[operand.reference]))?;
        let forced = self.ask(&Force::Begin(operand.reference, 1))?.len();
        let left = self.ask(&Force::EndAll)?.len();
        self.ask(&Command::Stop)?;
        let stopped = !self.ask(&Identify)?.is_running;
        self.ask(&Command::Run)?;
        Ok(vec![
            format!("identity: {mode}, CRC {:08X}, {} scans", identity.image_crc, identity.scans),
            format!("read back: {image}"),
            format!("watched: {watched:?}"),
            format!("forced: {forced}, then {left}; stopped: {stopped}"),
        ])
    }

    /// The live view of the program, with a key pressed.
    pub fn show(&mut self, program: Program) -> Result<Vec<String>, Box<dyn Error>> {
        let (mut state, mut rounds) = (State::new(program, "here".to_string()), Rounds::default());
        state.resize(ROWS);
        let input = Operand::parse("I0.0", &[])?;
        let is_it = |row: &&Row| {
            let operands = row.instruction().map(|instruction| &instruction.operands);
            operands
                .is_some_and(|all| all.iter().any(|one| one.operand.reference == input.reference))
        };
        let row = state.model.rows.iter().position(|row| is_it(&row));
        state.select(row.ok_or("no line has I0.0")?);
        for round in 0..4 {
            if round == 2
                && let Action::Order(order) = state.key(Key::Char('f'))
            {
                rounds.order(order);
            }
            rounds.wish(state.wishes());
            rounds.begin();
            while let Some(request) = rounds.request()? {
                let answer = self.exchange(request.bytes, request.is_repeatable);
                rounds.answer(answer)?.into_iter().for_each(|news| state.hear(news));
            }
        }
        let rows = &state.model.rows[state.visible()];
        let flows = rows.iter().filter_map(|row| state.flow(row.instruction()?));
        let flows: Vec<Flow> = flows.collect();
        let on = flows.iter().filter(|&&flow| flow == Flow::On).count();
        Ok(vec![
            format!("rows: {}, {on} with power flow; {:?}", flows.len(), state.agreement()),
            format!("message: {:?}, {} values", state.message, state.values.len()),
            format!("forced in the view: {:?}", state.forced),
        ])
    }

    /// The end.
    pub fn finish(self) -> Outcome {
        self.endpoint.finish()
    }

    fn ask<Q: Question>(&mut self, question: &Q) -> Result<Q::Answer, client::Error> {
        let answer = self.exchange(question.request()?, question.is_repeatable())?;
        question.answer(&answer)
    }

    /// A request and its answer. A millisecond passes whenever nobody has anything to say.
    fn exchange(
        &mut self,
        request: Vec<u8>,
        is_repeatable: bool,
    ) -> Result<Vec<u8>, client::Error> {
        self.line.request(request, is_repeatable, self.now_ms);
        loop {
            if let Some(frame) = self.line.transmit(self.now_ms) {
                self.frames.receive(&frame);
                self.answer();
            }
            if let Some(answer) = self.line.answer() {
                return answer;
            }
            let now = Duration::from_millis(self.now_ms);
            self.endpoint
                .go_on(&mut self.host, now)
                .map_err(|error| client::Error::Lost(error.to_string()))?;
            self.answer();
            self.now_ms += 1;
            self.line.expire(self.now_ms);
        }
    }

    /// The PLC takes the requests that are there; what it answers goes to the client.
    fn answer(&mut self) {
        while let Ok(Some(pdu)) = self.frames.request() {
            let request = Request { client: Ipv4Addr::LOCALHOST.into(), pdu, from: () };
            self.endpoint.ask(&mut self.host, request);
        }
        for answer in self.endpoint.answers() {
            self.line.receive(&self.frames.answer(&answer.pdu), self.now_ms);
        }
    }
}
