//! The simulator: a PLC of the reference interpreter with its plant, in a time that can be slower,
//! faster, or stand still. It answers on its line like a board.

use core::net::Ipv4Addr;
use std::collections::BTreeMap;
use std::time::Duration;

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{Opened, open_files};
use awl_sim::operand::Operand;
use awl_sim::plant::{Plant, PlantSpec};
use awl_sim::run::Course;
use awl_sim::scenario::Scenario;
use awl_sim::serve::{Access, Endpoint, Frames, Request};

use crate::build::Files;
use crate::protocol::Event;
use crate::scope::Scope;
use crate::trail::{Seen, Trail};

/// Time from scan start to scan start where the program does not say it, in milliseconds.
const SCAN_MS: u64 = 1;

/// What is wired to the PLC and how fast its time goes: stays when another program comes.
#[derive(Debug)]
pub struct Bench {
    /// The plant as it was asked for, and what that means.
    pub plant: Option<(String, PlantSpec)>,
    /// What people have set in it.
    pub handled: BTreeMap<String, i64>,
    /// What people have set the inputs to.
    pub driven: BTreeMap<Operand, i32>,
    /// 1 is real time, 0 as fast as it can.
    pub speed: f64,
    /// Whether time stands still.
    pub is_paused: bool,
}

impl Default for Bench {
    fn default() -> Bench {
        Bench {
            plant: None,
            handled: BTreeMap::new(),
            driven: BTreeMap::new(),
            speed: 1.0,
            is_paused: false,
        }
    }
}

impl Bench {
    /// The plant before anything has happened.
    pub fn new_plant(&self) -> Result<Option<Box<dyn Plant>>, String> {
        let Some((_, spec)) = &self.plant else { return Ok(None) };
        let mut plant = built(spec)?;
        for (name, &value) in &self.handled {
            plant.set(name, value);
        }
        Ok(Some(plant))
    }
}

/// A plant before anything has happened.
pub fn built(spec: &PlantSpec) -> Result<Box<dyn Plant>, String> {
    spec.build().map_err(|error| error.message)
}

/// A PLC that is switched on.
pub struct Simulator {
    host: Host,
    endpoint: Endpoint<()>,
    frames: Frames,
    /// How the charts are that the page shows.
    trail: Trail,
    scan_ms: u64,
    /// How far its time is, and how far it is to be.
    now_ms: u64,
    due_ms: f64,
    /// Whether more scans were due the last time than it was allowed to do.
    pub is_behind: bool,
}

impl Simulator {
    /// A PLC that is switched on with this program.
    pub fn new(files: &Files, bench: &Bench) -> Result<Simulator, String> {
        let opened =
            open_files(&files.program, &files.tables, None).map_err(|error| error.to_string())?;
        let Opened { machine, scan_ms, .. } = opened;
        let scan_ms = scan_ms.unwrap_or(SCAN_MS);
        let course = Course::new(&Scenario::default(), bench.new_plant()?, scan_ms);
        let endpoint = Endpoint::new(course, scan_ms, Access::default(), Duration::ZERO);
        let mut host = *machine;
        host.call_itself_simulator();
        let mut simulator = Simulator {
            host,
            endpoint,
            frames: Frames::default(),
            trail: Trail::default(),
            scan_ms,
            now_ms: 0,
            due_ms: 0.0,
            is_behind: false,
        };
        for (&operand, &value) in &bench.driven {
            simulator.drive(operand, value)?;
        }
        Ok(simulator)
    }

    /// Sets an input.
    pub fn drive(&mut self, operand: Operand, value: i32) -> Result<(), String> {
        self.host.write(operand, value).map_err(|error| error.to_string())
    }

    /// Sets an operand at once, as nothing in the program does.
    pub fn set(&mut self, operand: Operand, value: i32) -> Result<(), String> {
        self.host.write(operand, value).map_err(|error| error.to_string())?;
        self.look();
        Ok(())
    }

    /// Follows charts: their operands, of which the first ones are steps.
    pub fn follow(&mut self, operands: Vec<Option<Operand>>, steps: usize) {
        self.trail.follow(operands, steps);
        self.look();
    }

    fn look(&mut self) {
        let scan = self.host.scans() as u32;
        self.trail.look(self.endpoint.time_ms(), scan, &mut self.host);
    }

    /// How those charts are, and the situations since the last time; whether some are missing.
    pub fn seen(&mut self) -> (Seen, Vec<Seen>, bool) {
        let scan = self.host.scans() as u32;
        let now = self.trail.now(self.endpoint.time_ms(), scan, &mut self.host);
        let (before, is_lossy) = self.trail.take();
        (now, before, is_lossy)
    }

    /// Sets something in the plant; whether there is such a thing.
    pub fn handle(&mut self, name: &str, value: i64) -> bool {
        self.endpoint.plant_mut().is_some_and(|plant| plant.set(name, value))
    }

    /// Goes on for so long, at most so many scans; gives the bytes that it answers meanwhile.
    pub fn go_on(
        &mut self,
        elapsed_ms: u64,
        scans_max: u32,
        bench: &Bench,
        scope: &mut Scope,
    ) -> Vec<u8> {
        let mut answers = Vec::new();
        if bench.is_paused {
            return answers;
        }
        self.due_ms += elapsed_ms as f64 * bench.speed;
        self.is_behind = false;
        for _ in 0..scans_max {
            if bench.speed > 0.0 && self.due_ms < self.scan_ms as f64 {
                return answers;
            }
            self.due_ms -= self.scan_ms as f64;
            answers.extend(self.scan(scope));
        }
        // Time that it could not keep up with is lost, not made up for later.
        self.due_ms = 0.0;
        self.is_behind = true;
        answers
    }

    /// One scan; gives the bytes that it answers at its end.
    pub fn scan(&mut self, scope: &mut Scope) -> Vec<u8> {
        // It fails where an input has no pin, and was checked before.
        let _ = self.endpoint.go_on(&mut self.host, Duration::from_millis(self.now_ms));
        let scan = self.host.scans() as u16;
        scope.sample(self.endpoint.time_ms(), scan, &mut self.host);
        self.look();
        self.now_ms += self.scan_ms;
        self.answers()
    }

    /// Bytes come on its line; gives those that it answers at once.
    pub fn receive(&mut self, bytes: &[u8]) -> Vec<u8> {
        self.frames.receive(bytes);
        while let Ok(Some(pdu)) = self.frames.request() {
            let request = Request { client: Ipv4Addr::LOCALHOST.into(), pdu, from: () };
            self.endpoint.ask(&mut self.host, request);
        }
        self.answers()
    }

    fn answers(&mut self) -> Vec<u8> {
        let answers: Vec<_> = self.endpoint.answers().collect();
        answers.into_iter().flat_map(|answer| self.frames.answer(&answer.pdu)).collect()
    }

    /// Milliseconds since it was switched on.
    pub fn time_ms(&self) -> u64 {
        self.endpoint.time_ms()
    }

    /// Whether this operand can be read.
    pub fn has(&mut self, operand: Operand) -> Result<(), String> {
        self.host.read(operand).map(drop).map_err(|error| error.to_string())
    }

    /// The points.
    pub fn pins(&mut self) -> Event {
        let mut bits = |letter: char| {
            let value = |bit: u8| {
                let operand = Operand::parse(&format!("{letter}0.{bit}"), &[]).ok()?;
                self.host.read(operand).ok().map(|value| (value as u8) << bit)
            };
            (0..6).filter_map(value).fold(0, |all, bit| all | bit)
        };
        let (inputs, outputs) = (bits('I'), bits('Q'));
        let analog = self.host.inputs().raw.to_vec();
        let pwm = [1, 2]
            .iter()
            .filter_map(|&bit| self.host.read(Operand::Duty(bit)).ok().map(|duty| duty as u16))
            .collect();
        Event::Pins { inputs, outputs, analog, pwm }
    }

    /// The plant as a picture needs it; `told`: events that were told before.
    pub fn plant(&self, name: &str, told: &mut usize) -> Option<Event> {
        Some(plant_event(self.endpoint.plant()?, name, told))
    }
}

/// A plant as a picture needs it; `told`: events that were told before.
pub fn plant_event(plant: &dyn Plant, name: &str, told: &mut usize) -> Event {
    let (state, places) = (plant.view(), plant.places());
    let events = plant.report().events;
    let news = events
        .iter()
        .skip(*told)
        .map(|event| format!("{:.3} s: {}", event.time_ms as f64 / 1000.0, event.text));
    let news = news.collect();
    *told = events.len();
    Event::Plant { name: name.to_owned(), state, places, news }
}
