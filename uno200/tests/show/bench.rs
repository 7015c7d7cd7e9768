//! A controller in the test's own hands, reached through the answers that board and simulator give
//! as well. Every question takes scans; what each scan executed is written down by an observer of
//! its own.

use std::cell::RefCell;
use std::collections::HashMap;
use std::time::Duration;

use awl_sim::plant::{self, Plant, parse_spec};
use client::Error;
use plc_isa::{AnalogInput, LogicStack};
use plc_link::{Command, Link, ScanTimes, Station, answer, status};
use plc_vm::{Environment, Inputs, Memory, Mode, Plc};
use uno200::Client;
use uno200::transport::Transport;

/// What drives the inputs.
pub enum Feeder {
    /// The model of a plant.
    Plant(Box<dyn Plant>),
    /// Anything, every few scans.
    Random(fastrand::Rng),
}

/// A PLC with its plant.
pub struct Bench {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    link: Link,
    times: ScanTimes,
    image: Vec<u8>,
    feeder: Feeder,
    inputs: Inputs,
    plant_inputs: plant::Inputs,
    invert_outputs: u8,
    now_ms: u32,
    wanted: Option<Command>,
    scans_left: u16,
    /// Scans that have been done.
    pub scans: u32,
    /// The logic stack after each instruction of the last scan, by its offset.
    pub observed: HashMap<u16, u16>,
}

/// The observer.
struct Observer<'a> {
    now_ms: u32,
    entries: (u16, u8),
    looped: u32,
    observed: &'a mut HashMap<u16, u16>,
}

impl Environment for Observer<'_> {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }

    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped += u32::from(bytes);
        self.looped > 1_000_000
    }

    fn retrigger_watchdog(&mut self) {}

    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        self.observed.insert(at, stack.bits());
        status::executed(memory, self.entries, at, stack);
    }
}

impl Bench {
    /// Runs a program on the model of a plant, `station1` for example.
    pub fn with_plant(image: &[u8], plant: &str) -> Bench {
        Bench::new(image, Feeder::Plant(parse_spec(plant).unwrap().build().unwrap()))
    }

    /// Runs a program on random inputs.
    pub fn with_random(image: &[u8], seed: u64) -> Bench {
        Bench::new(image, Feeder::Random(fastrand::Rng::with_seed(seed)))
    }

    fn new(image: &[u8], feeder: Feeder) -> Bench {
        let mut bench = Bench {
            plc: Plc::new(),
            memory: Memory::new(),
            link: Link::new(),
            times: ScanTimes::NONE,
            image: image.to_vec(),
            feeder,
            inputs: Inputs::default(),
            plant_inputs: plant::Inputs::default(),
            invert_outputs: 0,
            now_ms: 0,
            wanted: None,
            scans_left: 0,
            scans: 0,
            observed: HashMap::new(),
        };
        bench.load();
        bench.plc.run();
        bench
    }

    fn load(&mut self) {
        self.plc.load(&mut self.memory, self.image.clone()).unwrap();
        let plan = self.plc.program().unwrap().plan();
        self.invert_outputs = plan.header.settings.invert_outputs;
        let frame = plan.end() + plan.retained_len();
        let room = plc_isa::DATA_END - frame;
        self.link.place(frame, room, plc_isa::DATA_END, plc_isa::DATA_END);
        self.times = ScanTimes::NONE;
    }

    /// A scan, with what was commanded before it.
    pub fn scan(&mut self) {
        match self.wanted.take() {
            Some(Command::Run) => drop(self.plc.run()),
            Some(Command::Scans(count)) => {
                self.plc.go_on();
                self.scans_left = count;
            }
            _ => {}
        }
        self.feed();
        self.now_ms += 10;
        self.observed.clear();
        if self.plc.mode() == Mode::Run {
            let entries = self.link.status_entries();
            // Forces are applied to what the scan reads: the inputs are taken in here, not by the
            // scan.
            let mut inputs = self.inputs;
            self.force(&mut inputs);
            let mut observer =
                Observer { now_ms: self.now_ms, entries, looped: 0, observed: &mut self.observed };
            self.plc.scan(&mut self.memory, &inputs, &mut observer);
            self.link.forces.apply(&mut self.memory);
            self.times.count();
            self.times.enter(1600 + 7 * (self.times.scans % 13));
            self.scans += 1;
            if self.scans_left == 1 {
                self.plc.stop();
            }
            self.scans_left = self.scans_left.saturating_sub(1);
        }
    }

    /// A single scan that somebody else commands.
    pub fn single_scan(&mut self) {
        self.wanted = Some(Command::Scans(1));
        self.scan();
    }

    /// A request and its answer.
    fn exchange(&mut self, request: &[u8]) -> Vec<u8> {
        self.scan();
        let frame = self.link.frame();
        (frame..).zip(request).for_each(|(at, &byte)| self.memory.set_byte(at, byte));
        let len = loop {
            match answer(self, request.len() as u16) {
                0 => self.scan(),
                len => break len,
            }
        };
        (frame..frame + len).map(|at| self.memory.byte(at)).collect()
    }

    fn force(&mut self, inputs: &mut Inputs) {
        self.link.forces.apply(&mut self.memory);
        for (index, byte) in inputs.digital.iter_mut().enumerate() {
            let mut memory = Memory::new();
            memory.set_byte(plc_isa::I_START + index as u16, *byte);
            self.link.forces.apply(&mut memory);
            *byte = memory.byte(plc_isa::I_START + index as u16);
        }
    }

    fn feed(&mut self) {
        let outputs = self.plc.outputs(&self.memory, 0) ^ self.invert_outputs;
        match &mut self.feeder {
            Feeder::Plant(plant) => {
                plant.step(self.now_ms.into(), outputs.into(), &mut self.plant_inputs);
                self.inputs.digital[0] =
                    (0..6).map(|n| u8::from(self.plant_inputs.digital(n)) << n).sum();
                for channel in 0..6 {
                    let counts = self.plant_inputs.analog(channel);
                    self.inputs.raw[usize::from(channel)] = counts;
                    self.inputs.scaled[usize::from(channel)] = AnalogInput::scale(counts);
                }
            }
            Feeder::Random(rng) => {
                if rng.u8(..4) == 0 {
                    self.inputs.digital[0] = rng.u8(..64);
                    let channel = rng.usize(..6);
                    self.inputs.raw[channel] = rng.u16(..1024);
                    self.inputs.scaled[channel] = AnalogInput::scale(self.inputs.raw[channel]);
                }
            }
        }
        self.plc.see_inputs(&mut self.memory, self.inputs.digital[0]);
    }
}

impl Station for Bench {
    type Program = Vec<u8>;
    const COUNTS_PER_MS: u16 = 2000;

    fn parts(&mut self) -> (&mut Memory, &mut Link) {
        (&mut self.memory, &mut self.link)
    }

    fn plc(&self) -> &Plc<Vec<u8>> {
        &self.plc
    }

    fn times(&self) -> &ScanTimes {
        &self.times
    }

    fn slot_byte(&self, offset: u16) -> u8 {
        self.image.get(usize::from(offset)).copied().unwrap_or(0xFF)
    }

    fn has_scans_left(&self) -> bool {
        self.scans_left > 0
    }

    fn control(&mut self, command: Command) {
        match command {
            Command::Stop => {
                self.plc.stop();
                let Bench { link, memory, .. } = self;
                link.forces.clear(memory);
            }
            Command::ClearFault => {}
            other => self.wanted = Some(other),
        }
    }
}

thread_local! {
    /// The benches of this thread: a plant stays where it was made, but a way must be able to go
    /// elsewhere.
    static BENCHES: RefCell<Vec<Bench>> = const { RefCell::new(Vec::new()) };
}

/// The way to a bench of the same thread: every question takes a scan at least.
#[derive(Clone, Copy)]
pub struct Way(usize);

impl Way {
    /// Has something done with the bench.
    pub fn with<T>(self, what: impl FnOnce(&mut Bench) -> T) -> T {
        BENCHES.with_borrow_mut(|benches| what(&mut benches[self.0]))
    }
}

impl Transport for Way {
    fn exchange(&mut self, request: &[u8], _: Duration) -> Result<Vec<u8>, Error> {
        let answer = self.with(|bench| bench.exchange(request));
        match answer[..] {
            [first, exception] if first & 0x80 != 0 => {
                Err(Error::Refused { function: first & 0x7F, exception })
            }
            _ => Ok(answer),
        }
    }
}

/// A bench with a client.
pub fn connect(bench: Bench) -> (Way, Client) {
    let way = BENCHES.with_borrow_mut(|benches| {
        benches.push(bench);
        Way(benches.len() - 1)
    });
    (way, Client::over(Box::new(way)))
}
