//! A machine for the answers: a controller, its memory and a line, without time.
#![allow(dead_code, reason = "each test uses a part")]

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use plc_isa::{ARENA_START, DATA_END, I_START, LogicStack};
use plc_link::{Command, Link, ScanTimes, Station, answer, status};
use plc_vm::{Environment, Memory, Plc};

/// A program with two ranges of V memory, SMB34, timers, counters and a name.
pub const PROGRAM: &str = "//# name areas\n\
    LDN SM0.0\nMOVB VB10, VB20\nMOVW VW100, VW120\nMOVD VD1000, VD1004\nMOVB SMB34, VB21\n\
    FILL 0, VW200, 100\n\
    LDN SM0.0\nTON T37, VW400\nLDN SM0.0\nTON T38, 10\nLDN SM0.0\nTONR T5, 10\n\
    LD I0.0\nLD I0.1\nCTU C5, 10\nLD I0.0\nLD I0.1\nCTU C7, 10\nLD I0.7\n= Q0.0\n";

pub fn image(program: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new("areas.awl", program).unwrap(), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics))
}

pub struct Machine {
    pub memory: Memory,
    pub plc: Plc<Vec<u8>>,
    pub link: Link,
    pub times: ScanTimes,
    pub image: Vec<u8>,
    pub commands: Vec<Command>,
    /// How often [`Station::has_time`] says yes before it says no once.
    pub patience: usize,
    pub asked: usize,
    pub scans_left: u16,
    /// I0.0 to I0.7.
    pub inputs: u8,
}

impl Station for Machine {
    type Program = Vec<u8>;
    const COUNTS_PER_MS: u16 = 250;

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
        self.scans_left != 0
    }
    fn control(&mut self, command: Command) {
        self.commands.push(command);
    }
    fn has_time(&mut self) -> bool {
        self.asked += 1;
        !self.asked.is_multiple_of(self.patience)
    }
}

/// Time stands still; status of instructions is noted.
struct Outside {
    entries: (u16, u8),
}

impl Environment for Outside {
    fn now_ms(&mut self) -> u32 {
        0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        false
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        status::executed(memory, self.entries, at, stack);
    }
}

impl Machine {
    /// In STOP without a program.
    pub fn empty() -> Machine {
        Machine {
            memory: Memory::new(),
            plc: Plc::new(),
            link: Link::new(),
            times: ScanTimes::NONE,
            image: Vec::new(),
            commands: Vec::new(),
            patience: usize::MAX,
            asked: 0,
            scans_left: 0,
            inputs: 0,
        }
    }

    /// The same with a frame.
    pub fn empty_with_line() -> Machine {
        let mut machine = Machine::empty();
        machine.link.place(ARENA_START, 252, DATA_END, DATA_END);
        machine
    }

    /// In RUN with a program, the frame after its memory with `room` bytes, the ring of the trace
    /// after that.
    pub fn with_room(program: &str, room: u16) -> Machine {
        let mut machine = Machine::empty();
        machine.image = image(program);
        machine.plc.load(&mut machine.memory, machine.image.clone()).unwrap();
        machine.plc.run();
        let plan = machine.plc.program().unwrap().plan();
        let (end, data_end) = (plan.end(), plan.profile().data_end);
        machine.link.place(end, room, end + room, data_end);
        machine.scan();
        machine
    }

    pub fn new() -> Machine {
        Machine::with_room(PROGRAM, 253)
    }

    /// Inputs, forces, program, forces, trace.
    pub fn scan(&mut self) {
        self.memory.set_byte(I_START, self.inputs);
        self.link.forces.apply(&mut self.memory);
        let mut outside = Outside { entries: self.link.status_entries() };
        self.plc.execute(&mut self.memory, &mut outside);
        self.link.forces.apply(&mut self.memory);
        self.times.count();
        self.times.enter(1000);
        let scan = self.times.scans as u16;
        self.link.trace_step(&mut self.memory, scan);
    }

    /// The answer to a request, and how many scans it took.
    pub fn ask_for_scans(&mut self, request: &[u8]) -> (Vec<u8>, usize) {
        self.link.put(&mut self.memory, request);
        for scans in 0..200 {
            let len = answer(self, request.len() as u16);
            if len != 0 {
                return (self.link.answer(&self.memory, len).collect(), scans);
            }
            // A single scan that the rest of the answer waits for.
            let is_single = self.commands.pop_if(|one| *one == Command::Scans(1)).is_some();
            if is_single {
                assert!(self.plc.go_on());
            }
            self.scan();
            if is_single {
                self.plc.stop();
            }
        }
        panic!("no answer to {request:02X?}");
    }

    pub fn ask(&mut self, request: &[u8]) -> Vec<u8> {
        self.ask_for_scans(request).0
    }
}
