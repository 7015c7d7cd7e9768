//! `uno200 show` with the shipped firmware at the other end of the line: what is beside each
//! line of a program is what plc-vm does in the same scan. The board runs by its own clock, its
//! plant is the simulator's. How the view is laid out, and what its keys do, uno200's own tests
//! say.
#![cfg(feature = "uno")]

use std::array::from_fn;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use awl_asm::Address;
use awl_asm::source::Source;
use awl_sim::machine::uno::Mark;
use awl_sim::plant::{self, Plant, parse_spec};
use client::line::rtu;
use client::show::model::Flow;
use client::show::state::State;
use client::value::Form;
use client::{Error, Operand, Program, Reference};
use fastrand::Rng;
use plc_isa::{
    AnalogInput, Area, Bit, DIGITAL_INPUTS, I_START, LogicStack, Plan, SM_START, counter_bit,
    timer_bit,
};
use plc_link::protocol::{STATUS, WATCH};
use plc_vm::{Environment, Inputs, Memory, Plc};
use tests::bench_board::{BenchBoard, MS, example_text};
use tests::link::UNIT;
use uno200::Client;
use uno200::show::poll::{Message, Poller};
use uno200::show::{Theme, picture};
use uno200::transport::Transport;

/// The platform begins between its ends. Pieces for both ramps.
const PLANT: &str =
    "station1 pieces=normal,small,normal,large,normal,small,normal,large,normal,small start=middle";

/// A master waits so long for an answer.
const PATIENCE: u64 = 1_000 * MS;
/// The view asks again when the board has gone on up to so often.
const PAUSE_MAX: u64 = 100;
/// The register of the line, and the bit in it that is set while characters of an answer wait.
const UCSR0B: u16 = 0xC1;
const HAS_MORE: u8 = 1 << 5;
/// Milliseconds from the start of one scan to the next, as the program sees them.
const SMW22: u16 = SM_START + 22;
const SCREEN_WIDTH: u16 = 110;
/// Rows of the screen beside those of the source.
const OTHER_ROWS: u16 = 3;

/// What the host needs to do a scan of the board again, and what came of it.
struct Scan {
    now_ms: u32,
    inputs: Inputs,
    /// The levels of the output pins.
    pins: u8,
}

/// A request that was answered with values, and the scan in or right after which that was.
struct Asked {
    request: Vec<u8>,
    scan: usize,
}

/// A board with its plant.
struct Station {
    board: BenchBoard,
    invert_outputs: u8,
    plant: Box<dyn Plant>,
    signals: plant::Inputs,
    first_scan: u64,
    now_ms: u32,
    /// Scans that are complete.
    count: usize,
    /// Those that the host has not done yet.
    scans: VecDeque<Scan>,
    asked: Vec<Asked>,
}

impl Station {
    fn new(image: &[u8], plan: &Plan<Vec<u8>>, plant: &str) -> Station {
        let mut board = BenchBoard::new();
        board.insert(image);
        board.power_up();
        let (first_scan, now_ms) = (board.scan_start(), board.tick());
        let mut station = Station {
            board,
            invert_outputs: plan.header.settings.invert_outputs,
            plant: parse_spec(plant).unwrap().build().unwrap(),
            signals: plant::Inputs::default(),
            first_scan,
            now_ms,
            count: 0,
            scans: VecDeque::new(),
            asked: Vec::new(),
        };
        station.scan();
        station
    }

    /// Since the first scan.
    fn passed_ms(&self) -> u64 {
        (self.board.scan_start() - self.first_scan) / MS
    }

    /// Goes on for a millisecond, or less and a scan.
    fn go_on(&mut self) {
        if self.board.run(MS).unwrap() == Some(Mark::ScanStart as u8) {
            self.scan();
        }
    }

    /// A scan from its start to its end.
    fn scan(&mut self) {
        let pins = self.board.output_levels(self.invert_outputs);
        self.plant.step(self.passed_ms(), pins.into(), &mut self.signals);
        let levels = (0..DIGITAL_INPUTS)
            .fold(0, |bits, input| bits | u8::from(self.signals.digital(input)) << input);
        self.board.drive_inputs(levels);
        (0..6).for_each(|channel| self.board.avr.set_counts(channel, self.signals.analog(channel)));
        let tick = self.board.tick();
        self.board.scan();
        assert!(self.board.runs(), "{:?}", self.board.fault());
        self.now_ms += u32::from(self.board.word(SMW22));
        assert!((tick..=self.board.tick()).contains(&self.now_ms), "the time of the scan");
        let word = |input: AnalogInput| self.board.word(input.address());
        let inputs = Inputs {
            digital: from_fn(|byte| self.board.byte(I_START + byte as u16)),
            scaled: from_fn(|channel| word(AnalogInput::Scaled(channel as u8))),
            raw: from_fn(|channel| word(AnalogInput::Raw(channel as u8))),
        };
        assert_eq!(inputs.digital[0], levels, "the inputs are those of the plant");
        self.scans.push_back(Scan {
            now_ms: self.now_ms,
            inputs,
            pins: self.board.output_levels(self.invert_outputs),
        });
        self.count += 1;
    }

    /// A frame to the board, and the answer in what it sends back.
    fn exchange(&mut self, request: &[u8]) -> Vec<u8> {
        self.board.say(&rtu::frame(UNIT, request));
        let (mut heard, mut scan, end) = (Vec::new(), None, self.board.avr.cycles() + PATIENCE);
        while rtu::frame_len(request, &heard).is_none_or(|len| heard.len() < len) {
            assert!(self.board.avr.cycles() < end, "{heard:02X?} answers {request:02X?}");
            self.go_on();
            heard.extend(self.board.avr.uart_take());
            let sends = !heard.is_empty() || self.board.byte(UCSR0B) & HAS_MORE != 0;
            scan = scan.or(sends.then(|| self.count - 1));
        }
        let answer = rtu::answer(UNIT, &heard).expect("an undamaged frame").to_vec();
        if let (&[function @ (STATUS | WATCH), high, low, ..], Some(sent_in)) = (&answer[..], scan)
        {
            // The first scan is told as 1. What instructions did is told at the end of the next
            // one, or sooner if the next one is waited for.
            let lag = (sent_in as u16 + 1).wrapping_sub(u16::from_be_bytes([high, low]));
            assert!(
                lag == 0 || lag == 1 && function == STATUS,
                "{lag} scans before the answer: {answer:02X?}"
            );
            let scan = sent_in - usize::from(lag);
            self.asked.push(Asked { request: request.to_vec(), scan });
        }
        answer
    }
}

thread_local! {
    /// A chip stays in its thread, but a way must be able to go elsewhere.
    static STATION: RefCell<Option<Station>> = const { RefCell::new(None) };
}

fn with_station<T>(what: impl FnOnce(&mut Station) -> T) -> T {
    STATION.with_borrow_mut(|station| what(station.as_mut().expect("there is a station")))
}

/// The line to the station of the same thread.
struct Line;

impl Transport for Line {
    fn exchange(&mut self, request: &[u8], _: Duration) -> Result<Vec<u8>, Error> {
        let answer = with_station(|station| station.exchange(request));
        match answer[..] {
            [first, exception] if first & 0x80 != 0 => {
                Err(Error::Refused { function: first & 0x7F, exception })
            }
            _ => Ok(answer),
        }
    }
}

/// The logic stack right after an instruction, and all memory.
type Moment = (u16, Memory);

/// What the host sees of a scan: of each instruction that was executed, by its offset, where that
/// is wanted.
struct Observer {
    now_ms: u32,
    moments: Option<HashMap<u16, Moment>>,
}

impl Environment for Observer {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        true
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        if let Some(moments) = &mut self.moments {
            moments.insert(at, (stack.bits(), memory.clone()));
        }
    }
}

/// plc-vm, which does the board's scans again.
struct Host {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    invert_outputs: u8,
    scans: usize,
}

impl Host {
    fn new(image: &[u8]) -> Host {
        let (mut plc, mut memory) = (Plc::new(), Memory::new());
        plc.load(&mut memory, image.to_vec()).expect("the image is valid");
        plc.run();
        let invert_outputs =
            plc.program().expect("it is loaded").plan().header.settings.invert_outputs;
        Host { plc, memory, invert_outputs, scans: 0 }
    }

    fn plan(&self) -> &Plan<Vec<u8>> {
        self.plc.program().expect("it is loaded").plan()
    }

    fn scan(&mut self, scan: &Scan, is_observed: bool) -> HashMap<u16, Moment> {
        let mut observer =
            Observer { now_ms: scan.now_ms, moments: is_observed.then(HashMap::new) };
        self.plc.scan(&mut self.memory, &scan.inputs, &mut observer);
        let pins = self.plc.outputs(&self.memory, 0) ^ self.invert_outputs;
        assert_eq!(pins, scan.pins, "the outputs of scan {}", self.scans);
        self.scans += 1;
        observer.moments.unwrap_or_default()
    }

    /// Does all scans up to this one. Returns what was seen of it; nothing, if it was done before.
    fn go_to(&mut self, scan: usize, scans: &mut VecDeque<Scan>) -> HashMap<u16, Moment> {
        let mut moments = HashMap::new();
        while self.scans <= scan {
            let next = scans.pop_front().expect("the board has done it");
            moments = self.scan(&next, self.scans == scan);
        }
        moments
    }

    /// The value of an operand in the host's memory of some moment, right-aligned.
    fn value(&self, operand: &Operand, memory: &Memory) -> u32 {
        let byte = |area: Area, byte: u16| {
            memory.byte(self.plan().byte_address(area, byte).expect("it is used"))
        };
        let bit = |Bit { address, bit }| u32::from(memory.byte(address) >> bit & 1);
        let word = |address| u32::from(memory.word(address));
        match (operand.address, operand.form) {
            (Address::Bit { area, byte: at, bit }, _) => u32::from(byte(area, at) >> bit & 1),
            (Address::Word { area, byte: at }, _) => {
                u32::from(u16::from_be_bytes([byte(area, at), byte(area, at + 1)]))
            }
            (Address::Timer(number), Form::Bit) => bit(timer_bit(number)),
            (Address::Counter(number), Form::Bit) => bit(counter_bit(number)),
            (Address::Timer(number), _) => {
                word(self.plan().timer_slot(number).expect("it is used").address)
            }
            (Address::Counter(number), _) => {
                word(self.plan().counter_slot(number).expect("it is used").address)
            }
            (Address::Analog(input), _) => word(input.address()),
            (other, _) => panic!("no program here has {other:?}"),
        }
    }
}

/// What the power flow after a line was like.
#[derive(Debug, Default)]
struct LineSeen {
    /// How often it was seen: not executed, off, on.
    flows: [usize; 3],
    /// How often it was another than the time before.
    changes: usize,
    last: Option<Flow>,
}

/// What has been compared, by scans, and by rows of the source.
#[derive(Debug, Default)]
struct Compared {
    scans: BTreeSet<usize>,
    lines: BTreeMap<usize, LineSeen>,
    values: usize,
}

/// The view of a program, the board that it asks, and the host, which knows what must be shown.
struct Bench {
    state: State,
    poller: Poller,
    to_poller: Sender<Message>,
    host: Host,
    /// By their references.
    operands: HashMap<Reference, Operand>,
    /// By offset what the host saw in the scan of the last window with it: `None`, it was not
    /// executed.
    moments: HashMap<u16, Option<Moment>>,
    /// At the end of the scan of the last watch with it.
    values: HashMap<Reference, u32>,
    compared: Compared,
}

impl Bench {
    fn new(text: &str, host_text: &str) -> Bench {
        let assembled = |text: &str| {
            Program::assembled(Source::new("program.awl", text).unwrap(), Vec::new()).unwrap()
        };
        let (program, host) = (assembled(text), Host::new(&assembled(host_text).image));
        let station = Station::new(&program.image, host.plan(), PLANT);
        STATION.set(Some(station));
        let (to_poller, messages) = channel();
        let state = State::new(program, "the board".to_string());
        let instructions = state.model.rows.iter().filter_map(|row| row.instruction());
        let operands = instructions.flat_map(|instruction| &instruction.operands);
        let operands =
            operands.map(|watched| (watched.operand.reference, watched.operand.clone())).collect();
        Bench {
            state,
            poller: Poller::new(Client::over(Box::new(Line)), messages),
            to_poller,
            host,
            operands,
            moments: HashMap::new(),
            values: HashMap::new(),
            compared: Compared::default(),
        }
    }

    /// Rounds of the view, each compared, until the plant has run so long.
    fn run(mut self, milliseconds: u64) -> Compared {
        let mut rng = Rng::with_seed(1);
        while with_station(|station| station.passed_ms()) < milliseconds {
            for news in self.poller.round().expect("the board answers") {
                self.state.hear(news);
            }
            assert_eq!(self.state.message, None, "nothing is refused");
            let marks = self.draw();
            self.to_poller.send(Message::Wishes(self.state.wishes())).unwrap();
            self.catch_up();
            self.compare(&marks);
            // So that rounds do not always meet the same scans of what repeats.
            with_station(|station| (0..rng.u64(..PAUSE_MAX)).for_each(|_| station.go_on()));
        }
        let instructions =
            self.state.model.rows.iter().filter(|row| row.instruction().is_some()).count();
        assert_eq!(self.compared.lines.len(), instructions, "every line was seen");
        self.compared
    }

    /// Draws the view. Returns what is shown of the power flow in each line, by its row.
    fn draw(&mut self) -> HashMap<usize, char> {
        let height = self.state.model.rows.len() as u16 + OTHER_ROWS;
        let screen = picture::buffer(&mut self.state, SCREEN_WIDTH, height, Theme::new(false));
        let line = |y| {
            (0..SCREEN_WIDTH)
                .filter_map(|x| Some(screen.cell((x, y))?.symbol()))
                .collect::<String>()
        };
        let mark = |line: String| {
            let (number, rest) = line.trim_start().split_once(' ')?;
            Some((number.parse::<usize>().ok()? - 1, rest.chars().next()?))
        };
        (0..height).filter_map(|y| mark(line(y))).collect()
    }

    /// The host does what the board has done, and notes what the view was told of.
    fn catch_up(&mut self) {
        let (asked, mut scans) = with_station(|station| {
            (std::mem::take(&mut station.asked), std::mem::take(&mut station.scans))
        });
        for Asked { request, scan } in asked {
            let mut moments = self.host.go_to(scan, &mut scans);
            if request[0] == STATUS {
                let offsets =
                    request[2..].chunks(5).map(|entry| u16::from_be_bytes([entry[0], entry[1]]));
                self.moments.extend(offsets.map(|offset| (offset, moments.remove(&offset))));
                self.compared.scans.insert(scan);
            } else {
                for reference in
                    request[2..].chunks(3).map(|bytes| Reference([bytes[0], bytes[1], bytes[2]]))
                {
                    let value = self.host.value(&self.operands[&reference], &self.host.memory);
                    self.values.insert(reference, value);
                }
            }
        }
        // Those after the last scan that was told of are still to be done.
        with_station(|station| station.scans = scans);
    }

    /// Every line of the program, as far as the view was told of it.
    fn compare(&mut self, marks: &HashMap<usize, char>) {
        for (row, line) in self.state.model.rows.iter().enumerate() {
            let Some(instruction) = line.instruction() else { continue };
            let offset = instruction.offset.expect("every unit is called");
            let Some(moment) = self.moments.get(&offset) else { continue };
            let place = format!("line {}, {}, before scan {}", row + 1, line.text, self.host.scans);
            let (flow, mark) = match moment {
                None => (Flow::NotExecuted, '\u{B7}'),
                Some((stack, _)) if stack & 1 == 0 => (Flow::Off, '\u{25CB}'),
                Some(_) => (Flow::On, '\u{25CF}'),
            };
            assert_eq!(
                (self.state.flow(instruction), marks.get(&row)),
                (Some(flow), Some(&mark)),
                "{place}"
            );
            let stack = moment.as_ref().map_or(0, |(stack, _)| *stack);
            assert_eq!(self.state.executed[&offset].stack, stack, "{place}");
            for (index, watched) in instruction.operands.iter().enumerate() {
                let value = match moment {
                    Some((_, memory)) if index == instruction.result => {
                        self.host.value(&watched.operand, memory)
                    }
                    _ => self.values[&watched.operand.reference],
                };
                assert_eq!(
                    self.state.value(instruction, index),
                    Some(value),
                    "{}, {place}",
                    watched.operand.name
                );
                self.compared.values += 1;
            }
            let seen = self.compared.lines.entry(row).or_default();
            seen.flows[flow as usize] += 1;
            seen.changes += usize::from(seen.last.is_some_and(|last| last != flow));
            seen.last = Some(flow);
        }
    }
}

/// Compares station1 for so many milliseconds, in which its plant sorts so many good pieces and so
/// many others. Returns of how many lines the power flow has changed.
fn station1(directives: &str, milliseconds: u64, good: i64, rejected: i64) -> usize {
    let text = format!("{directives}{}", example_text("station1"));
    let Compared { scans, lines, values } = Bench::new(&text, &text).run(milliseconds);
    let report = with_station(|station| station.plant.report());
    let sorted =
        ["good", "rejected"].map(|name| report.summary.iter().find(|(key, _)| key == name));
    assert_eq!(
        sorted.map(|entry| entry.map(|(_, count)| *count)),
        [Some(good), Some(rejected)],
        "{report:?}"
    );
    let looks = lines.values().map(|seen| seen.flows.iter().sum::<usize>()).min().unwrap_or(0);
    let changing = lines.values().filter(|seen| seen.changes > 0).count();
    println!(
        "{} scans of {}, each of {} lines at least {looks} times",
        scans.len(),
        last(&scans),
        lines.len()
    );
    println!(
        "{:?} times not executed, without and with power flow; {values} values",
        flows(&lines)
    );
    println!("the power flow of {changing} lines has changed");
    assert!(scans.len() >= SCANS_MIN && looks >= LOOKS_MIN, "{} scans, {looks}", scans.len());
    changing
}

/// In so many scans every line is compared so often at least.
const SCANS_MIN: usize = 1_000;
const LOOKS_MIN: usize = 250;

#[test]
fn station1_as_fast_as_it_is() {
    // Many of its 78 lines have power for one scan of thousands, six of them in the first.
    let changing = station1("", 42_000, 2, 1);
    assert!(changing >= 35, "{changing}");
}

#[test]
fn station1_in_scans_that_can_nearly_all_be_asked_for() {
    let changing = station1("//# scan 40ms\n", 100_000, 5, 4);
    assert!(changing >= 55, "{changing}");
}

/// How often lines were seen not executed, without and with power flow.
fn flows(lines: &BTreeMap<usize, LineSeen>) -> [usize; 3] {
    [0, 1, 2].map(|flow| lines.values().map(|seen| seen.flows[flow]).sum())
}

fn last(scans: &BTreeSet<usize>) -> usize {
    scans.last().copied().unwrap_or(0)
}

/// No two scans that follow each other are the same in it.
const COUNTING: &str = "\
LD     SM0.6
=      M0.0
LD     SM0.0
INCW   MW2      // scans
LDN    M0.0
JMP    1
LDW>=  MW2, MW4
INCW   MW4      // every other one
LBL    1
LDW=   MW4, 9
O      M0.0
";

#[test]
fn it_is_the_scan_that_the_answer_tells() {
    let Compared { scans, lines, .. } = Bench::new(COUNTING, COUNTING).run(5_000);
    let seen = flows(&lines);
    println!(
        "{} scans of {}, lines not executed, without and with power flow: {seen:?}",
        scans.len(),
        last(&scans)
    );
    assert!(
        scans.len() >= 100 && seen.iter().all(|&count| count >= 100),
        "{} scans, {seen:?}",
        scans.len()
    );
}

#[test]
#[should_panic(expected = "before scan")]
fn another_program_is_noticed() {
    Bench::new(COUNTING, &COUNTING.replace("SM0.6", "SM0.1")).run(1_000);
}
