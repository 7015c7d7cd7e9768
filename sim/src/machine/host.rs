//! The host machine: the reference interpreter with virtual time. What the board does, without a
//! board.

mod link;

use std::collections::VecDeque;

use plc_isa::{I_START, LogicStack, Plan, UNO};
use plc_link::ScanTimes;
use plc_vm::{Environment, Fault, Inputs, Memory, Plc, SCAN_MS_MAX};

use super::points::{self, Points, input_byte, output_byte, replaced};
use super::{Machine, MachineError, Mode, PlaceOf, fault};
use crate::action::Action;
use crate::operand::Operand;
use crate::plant::Outputs;
use crate::pulse::{Edge, NS_PER_MS, Pulses};
use link::Line;

/// Bytes of looped code that count as a millisecond of execution: 20 cycles of the board for an
/// instruction of 2.5 bytes, at 16 MHz.
const LOOPED_BYTES_PER_MS: u64 = 2_000;

/// Virtual time, which stands still while a scan runs. Only loops cost watchdog time.
#[derive(Debug, Default)]
struct VirtualTime {
    now_ms: u32,
    /// Since the scan started, or since WDR.
    looped_bytes: u64,
    looped_bytes_max: u64,
    /// Since the scan started.
    scan_bytes: u64,
    /// On the serial line.
    sent: Vec<u8>,
    /// What this scan notes for the status of instructions: data address of the first entry, and
    /// their number.
    noted: (u16, u8),
    /// By offset in the image, whether an instruction there was executed; where nobody asks, empty.
    executed: Vec<bool>,
    /// Whether somebody wants to know of every instruction: one question is quicker than two.
    is_watched: bool,
}

impl VirtualTime {
    #[cold]
    fn watch(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        if self.noted.1 > 0 {
            plc_link::status::executed(memory, self.noted, at, stack);
        }
        if let Some(executed) = self.executed.get_mut(usize::from(at)) {
            *executed = true;
        }
    }

    fn is_at_ceiling(&self) -> bool {
        self.scan_bytes > u64::from(SCAN_MS_MAX) * LOOPED_BYTES_PER_MS
    }
}

impl Environment for VirtualTime {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }

    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped_bytes += u64::from(bytes);
        self.scan_bytes += u64::from(bytes);
        self.looped_bytes > self.looped_bytes_max || self.is_at_ceiling()
    }

    fn retrigger_watchdog(&mut self) {
        self.looped_bytes = 0;
    }

    fn transmit(&mut self, character: u8) {
        self.sent.push(character);
    }

    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        if self.is_watched {
            self.watch(at, stack, memory);
        }
    }
}

/// Microseconds that pass. Only differences are used.
pub type Clock = Box<dyn FnMut() -> u64 + Send>;

/// A PLC on the host.
pub struct Host {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    inputs: Inputs,
    time: VirtualTime,
    clock_start_ms: u32,
    pulses: Pulses,
    /// Characters that will come in, and when.
    incoming: VecDeque<(u64, u8)>,
    place_of: PlaceOf,
    line: Line,
    /// What the lengths of scans are measured with.
    clock: Clock,
}

impl Host {
    /// A PLC that is switched on with this image and goes to RUN. A bad image leaves it in STOP
    /// with a fault.
    pub fn new(image: Vec<u8>, place_of: PlaceOf) -> Host {
        let mut host = Host {
            plc: Plc::new(),
            memory: Memory::new(),
            inputs: Inputs::default(),
            time: VirtualTime::default(),
            clock_start_ms: 0,
            pulses: Pulses::default(),
            incoming: VecDeque::new(),
            place_of,
            line: Line::new(image.clone()),
            clock: Box::new(|| 0),
        };
        if host.plc.load(&mut host.memory, image).is_ok() {
            // Nothing is kept here, so each start is that of a new board.
            if host.plan().is_some_and(|plan| plan.retained_len() > 0) {
                host.plc.retentive_data_lost();
            }
            host.plc.run();
        }
        host.line.link.place_after(host.plc.program(), UNO.data_end);
        host.time.looped_bytes_max = host.watchdog_ms() * LOOPED_BYTES_PER_MS;
        host
    }

    /// Lets the millisecond clock begin at another value, to come near its wrap.
    pub fn start_clock_at(&mut self, clock_ms: u32) {
        self.clock_start_ms = clock_ms;
    }

    /// Scans since it went to RUN, as whoever asks it is told.
    pub fn scans(&self) -> u64 {
        self.line.times.scans.into()
    }

    /// Has the lengths of scans measured, for those who ask how long they are. Without a clock each
    /// counts as a microsecond.
    pub fn measure_with(&mut self, clock: Clock) {
        self.clock = clock;
    }

    /// Has every instruction that is executed noted from now on.
    pub fn note_executed(&mut self) {
        self.time.executed = vec![false; usize::from(u16::MAX) + 1];
    }

    /// By offset in the image, whether the instruction there was executed. Empty if it was not
    /// noted.
    pub fn executed(&self) -> &[bool] {
        &self.time.executed
    }

    /// STOP to RUN, as by a command from outside.
    pub fn run(&mut self) {
        if self.plc.mode() == plc_vm::Mode::Stop && self.plc.run() {
            self.line.times = ScanTimes::NONE;
        }
    }

    /// RUN to STOP, as by a command from outside.
    pub fn stop(&mut self) {
        self.plc.stop();
        self.end_run();
    }

    /// The data memory, for comparisons with other machines.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// The inputs that the next scan takes.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// The fault that stopped the PLC.
    pub fn fault_kind(&self) -> Option<Fault> {
        self.plc.fault()
    }

    /// The PLC's time, which has 32 bits and wraps.
    fn clock_ms(&self, now_ms: u64) -> u32 {
        self.clock_start_ms.wrapping_add(now_ms as u32)
    }

    /// Shows the PLC every edge since the last scan, one after the other.
    fn pass_edges(&mut self, now_ms: u64) {
        while let Some(Edge { input, level, .. }) = self.pulses.take(now_ms * NS_PER_MS) {
            let byte = &mut self.inputs.digital[0];
            *byte = replaced(*byte, 1 << input, u8::from(level) << input);
            self.plc.see_inputs(&mut self.memory, self.inputs.digital[0]);
        }
        self.plc.see_inputs(&mut self.memory, self.inputs.digital[0]);
    }

    /// Gives the PLC the characters that have come in by now.
    fn pass_characters(&mut self, now_ms: u64) {
        while let Some(&(at_ms, character)) =
            self.incoming.front().filter(|(at_ms, _)| *at_ms <= now_ms)
        {
            self.incoming.pop_front();
            let at_ms = self.clock_ms(at_ms);
            self.plc.receive(&mut self.memory, character, at_ms);
        }
    }

    /// Takes the inputs into the process image. Those that the board does not have stay as they
    /// are.
    fn take_inputs(&mut self) {
        let [_, others @ ..] = &mut self.inputs.digital;
        for (address, byte) in (I_START + 1..).zip(others) {
            *byte = self.memory.byte(address);
        }
        self.inputs.write(&mut self.memory);
    }

    fn watchdog_ms(&self) -> u64 {
        self.plan().map_or(0, |plan| u64::from(plan.header.settings.watchdog_ms))
    }
}

impl Points for Host {
    fn plan(&self) -> Option<&Plan<Vec<u8>>> {
        self.plc.program().map(|program| program.plan())
    }

    fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    fn inputs_mut(&mut self) -> &mut Inputs {
        &mut self.inputs
    }

    fn byte(&self, address: u16) -> u8 {
        match (input_byte(address), output_byte(address)) {
            (Some(0), _) => self.inputs.digital[0],
            (_, Some(byte)) => self.plc.outputs(&self.memory, byte),
            _ => self.memory.byte(address),
        }
    }

    fn duty(&self, output: u8) -> Option<u16> {
        self.plc.duty(output)
    }

    fn set(&mut self, address: u16, mask: u8, value: u8) -> Result<(), MachineError> {
        match input_byte(address) {
            Some(0) => self.inputs.digital[0] = replaced(self.inputs.digital[0], mask, value),
            _ => self.memory.set_byte(address, replaced(self.memory.byte(address), mask, value)),
        }
        Ok(())
    }
}

impl Machine for Host {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        points::write(self, operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        points::read(self, operand)
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        match *action {
            Action::Pulse(pulse) => self.pulses.begin(pulse),
            Action::SetClock { at_ms, time } => self.plc.set_clock(time, self.clock_ms(at_ms)),
            Action::Receive { at_ms, ref bytes } => {
                self.incoming.extend((at_ms..).zip(bytes.iter().copied()))
            }
        }
        Ok(())
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        Ok(std::mem::take(&mut self.time.sent))
    }

    fn scan(&mut self, now_ms: u64) {
        self.time.now_ms = self.clock_ms(now_ms);
        self.pass_edges(now_ms);
        self.pass_characters(now_ms);
        (self.time.looped_bytes, self.time.scan_bytes) = (0, 0);
        self.take_inputs();
        self.line.link.forces.apply(&mut self.memory);
        let start_us = (self.clock)();
        let runs = self.plc.mode() == plc_vm::Mode::Run;
        // In STOP no scan notes anything, and that is the answer.
        self.time.noted = self.line.link.status_entries();
        self.time.is_watched = self.time.noted.1 > 0 || !self.time.executed.is_empty();
        self.plc.execute(&mut self.memory, &mut self.time);
        self.line.link.forces.apply(&mut self.memory);
        if runs {
            self.end_scan(start_us);
        }
    }

    fn mode(&self) -> Mode {
        match self.plc.mode() {
            plc_vm::Mode::Run => Mode::Run,
            plc_vm::Mode::Stop => Mode::Stop,
        }
    }

    fn fault(&self) -> Option<String> {
        // WDR may have put the end off until it could be put off no longer.
        let limit_ms =
            if self.time.is_at_ceiling() { SCAN_MS_MAX.into() } else { self.watchdog_ms() };
        self.plc.fault().map(|kind| fault::text(kind, limit_ms, &self.place_of))
    }

    fn pin_levels(&mut self) -> u8 {
        let inverted = self.plan().map_or(0, |plan| plan.header.settings.invert_outputs);
        self.plc.outputs(&self.memory, 0) ^ inverted
    }

    fn output_pins(&mut self) -> Outputs {
        points::output_pins(self)
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        points::drive_pin(self, input, high);
    }
}
