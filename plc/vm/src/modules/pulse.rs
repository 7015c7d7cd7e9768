//! Pulse outputs: PLS with pulse-width modulation (PWM), and with trains of a number of pulses
//! (PTO, one segment); and what analog outputs make of their pins.
//!
//! PLS 0 drives Q0.0 and PLS 1 drives Q0.1, as on the S7-200; while they do, the process image does
//! not. Time comes in whole milliseconds, so a train ends with the first scan after its end.

use plc_isa::{ANALOG_OUTPUTS, AQW_START, Area, Plan, ProgramMemory};

use super::high_speed::{special, special_double};
use crate::memory::Memory;

/// Control: take over the cycle time.
const TAKE_CYCLE: u8 = 1 << 0;
/// Control: take over the pulse width.
const TAKE_WIDTH: u8 = 1 << 1;
/// Control: take over the number of pulses.
const TAKE_COUNT: u8 = 1 << 2;
/// Control: times are in milliseconds, not in microseconds.
const MILLISECONDS: u8 = 1 << 3;
/// Control: a table of segments. There is none here.
const SEGMENTS: u8 = 1 << 5;
/// Control: modulation, not a train.
const MODULATION: u8 = 1 << 6;
/// Control: the output is driven.
const ENABLE: u8 = 1 << 7;

/// Status: a train was broken off by the program.
const ABORTED: u8 = 1 << 5;
/// Status: more trains than one wanted to wait.
const OVERFLOW: u8 = 1 << 6;
/// Status: no train is under way.
const IDLE: u8 = 1 << 7;

/// Shortest cycle in units of time.
const CYCLE_MIN: u16 = 2;
/// Shortest cycle of trains in microseconds: the board makes each of their edges by an interrupt.
const TRAIN_CYCLE_MIN_US: u32 = 50;

/// The first output that an analog output shares its pin with.
const ANALOG_OUTPUT: usize = 1;
/// Values of an analog output from 0 to this are 0 to 100 %.
const ANALOG_MAX: i16 = 32_000;
/// They come in steps of so many.
const ANALOG_STEP: i16 = 16;

/// The special memory of an output, and its event.
#[derive(Debug, Clone, Copy)]
struct Site {
    status: u16,
    control: u16,
    cycle: u16,
    width: u16,
    count: u16,
    done: u8,
}

const SITES: [Site; PULSE_OUTPUTS] = [
    Site { status: 66, control: 67, cycle: 68, width: 70, count: 72, done: 19 },
    Site { status: 76, control: 77, cycle: 78, width: 80, count: 82, done: 20 },
];

/// How many pulse outputs there are.
const PULSE_OUTPUTS: usize = 2;

/// A train.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Train {
    cycle_us: u32,
    count: u32,
}

/// What an output does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Task {
    /// The process image drives it.
    None,
    Modulation {
        cycle_us: u32,
        width_us: u32,
    },
    /// One train, and perhaps one that waits for its end.
    Trains(Train, Option<Train>),
}

/// A pulse output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Output {
    task: Task,
    /// Since the modulation or the train has begun.
    passed_us: u64,
    // As they were taken over last, in units of time.
    cycle: u16,
    width: u16,
    count: u32,
}

/// Both pulse outputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PulseOutputs {
    outputs: [Output; PULSE_OUTPUTS],
    /// The part of the time in thousandths that the pin of an analog output is high.
    analog: [Option<u16>; ANALOG_OUTPUTS as usize],
}

impl PulseOutputs {
    /// No output is driven: as after the change to RUN.
    pub const NONE: PulseOutputs = PulseOutputs {
        outputs: [Output { task: Task::None, passed_us: 0, cycle: CYCLE_MIN, width: 0, count: 1 };
            PULSE_OUTPUTS],
        analog: [None; ANALOG_OUTPUTS as usize],
    };

    /// PLS. Whether it could be done.
    pub fn activate<P: ProgramMemory>(
        &mut self,
        number: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> bool {
        let index = usize::from(number);
        let (Some(site), Some(output)) = (SITES.get(index), self.outputs.get_mut(index)) else {
            return false;
        };
        let control = special(site.control, plan, memory);
        if control & SEGMENTS != 0 && control & MODULATION == 0 {
            return false;
        }
        output.take_over(control, site, plan, memory);
        let Some(status) = output.begin(control) else { return false };
        write_status(site, status, plan, memory);
        true
    }

    /// Time passes. The events of the trains that end.
    pub fn pass<P: ProgramMemory>(
        &mut self,
        passed_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> [Option<u8>; PULSE_OUTPUTS] {
        let mut events = [None; PULSE_OUTPUTS];
        for ((site, output), event) in SITES.iter().zip(&mut self.outputs).zip(&mut events) {
            if output.pass(passed_ms) {
                let status = special(site.status, plan, memory);
                let idle = if output.task == Task::None { IDLE } else { 0 };
                write_status(site, status | idle, plan, memory);
                *event = Some(site.done);
            }
        }
        events
    }

    /// The outputs that are driven, as bits of QB0, and their levels now.
    pub fn levels(&self) -> (u8, u8) {
        let mut bits = (0, 0);
        for (index, output) in self.outputs.iter().enumerate() {
            if let Some(level) = output.level() {
                bits = (bits.0 | 1 << index, bits.1 | u8::from(level) << index);
            }
        }
        bits
    }

    /// The analog outputs with a bit in `outputs` have been written.
    pub fn drive_analog(&mut self, outputs: u8, memory: &Memory) {
        for (channel, duty) in (0..ANALOG_OUTPUTS).zip(&mut self.analog) {
            if outputs >> channel & 1 != 0 {
                let value = memory.int(AQW_START + 2 * u16::from(channel)).clamp(0, ANALOG_MAX);
                let [step, steps] = [value / ANALOG_STEP, ANALOG_MAX / ANALOG_STEP].map(i32::from);
                *duty = Some((1000 * step / steps) as u16);
            }
        }
    }

    /// The part of the time in thousandths that a driven output is on; of a train half.
    pub fn duty(&self, number: u8) -> Option<u16> {
        let number = usize::from(number);
        let analog =
            number.checked_sub(ANALOG_OUTPUT).and_then(|channel| *self.analog.get(channel)?);
        match self.outputs.get(number).map_or(Task::None, |output| output.task) {
            Task::None => analog,
            Task::Modulation { cycle_us, width_us } => {
                let part = u64::from(width_us.min(cycle_us)) * 1000 / u64::from(cycle_us.max(1));
                Some(part as u16)
            }
            Task::Trains(..) => Some(500),
        }
    }
}

impl Output {
    fn take_over<P: ProgramMemory>(
        &mut self,
        control: u8,
        site: &Site,
        plan: &Plan<P>,
        memory: &Memory,
    ) {
        let word = |byte| {
            u16::from_be_bytes([special(byte, plan, memory), special(byte + 1, plan, memory)])
        };
        if control & TAKE_CYCLE != 0 {
            self.cycle = word(site.cycle).max(CYCLE_MIN);
        }
        if control & TAKE_WIDTH != 0 {
            self.width = word(site.width);
        }
        if control & TAKE_COUNT != 0 {
            self.count = (special_double(site.count, plan, memory) as u32).max(1);
        }
    }

    /// Does what the control byte says with the values taken over. Gives the status, unless it
    /// cannot be done.
    fn begin(&mut self, control: u8) -> Option<u8> {
        let unit_us = if control & MILLISECONDS != 0 { 1000 } else { 1 };
        let (cycle_us, width_us) =
            (unit_us * u32::from(self.cycle), unit_us * u32::from(self.width));
        if control & (ENABLE | MODULATION) == ENABLE && cycle_us < TRAIN_CYCLE_MIN_US {
            return None;
        }
        let train = Train { cycle_us, count: self.count };
        let is_train = matches!(self.task, Task::Trains(..));
        let aborted = if is_train { ABORTED } else { 0 };
        let (task, status) = match self.task {
            _ if control & ENABLE == 0 => (Task::None, IDLE | aborted),
            _ if control & MODULATION != 0 => {
                (Task::Modulation { cycle_us, width_us }, IDLE | aborted)
            }
            Task::Trains(first, None) => (Task::Trains(first, Some(train)), 0),
            Task::Trains(..) => (self.task, OVERFLOW),
            _ => (Task::Trains(train, None), 0),
        };
        // A modulation that only changes goes on in its cycle, a train that waits leaves the first
        // one alone.
        let goes_on = match (self.task, task) {
            (Task::Modulation { cycle_us: old, .. }, Task::Modulation { cycle_us, .. }) => {
                old == cycle_us
            }
            (Task::Trains(..), Task::Trains(..)) => true,
            _ => false,
        };
        if !goes_on {
            self.passed_us = 0;
        }
        self.task = task;
        Some(status)
    }

    /// Time passes. Whether a train ends.
    fn pass(&mut self, passed_ms: u32) -> bool {
        self.passed_us += 1000 * u64::from(passed_ms);
        let mut ends = false;
        while let Task::Trains(train, next) = self.task {
            let Some(rest_us) =
                self.passed_us.checked_sub(u64::from(train.cycle_us) * u64::from(train.count))
            else {
                break;
            };
            self.passed_us = rest_us;
            self.task = next.map_or(Task::None, |next| Task::Trains(next, None));
            ends = true;
        }
        ends
    }

    fn level(&self) -> Option<bool> {
        let (cycle_us, width_us) = match self.task {
            Task::None => return None,
            Task::Modulation { cycle_us, width_us } => (cycle_us, width_us),
            Task::Trains(train, _) => (train.cycle_us, train.cycle_us / 2),
        };
        Some(self.passed_us % u64::from(cycle_us.max(1)) < u64::from(width_us))
    }
}

fn write_status<P: ProgramMemory>(site: &Site, status: u8, plan: &Plan<P>, memory: &mut Memory) {
    if let Some(address) = plan.byte_address(Area::Sm, site.status) {
        memory.set_byte(address, status);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OFF: Output = Output { task: Task::None, passed_us: 0, cycle: 10, width: 3, count: 4 };

    fn levels(output: &mut Output, ms: u32) -> u32 {
        (0..ms).fold(0, |levels, _| {
            let level = output.level().is_some_and(|level| level);
            output.pass(1);
            levels << 1 | u32::from(level)
        })
    }

    #[test]
    fn modulation_is_on_for_its_width() {
        let mut output = OFF;
        assert_eq!(output.begin(ENABLE | MODULATION | MILLISECONDS), Some(IDLE));
        assert_eq!(levels(&mut output, 20), 0b1110000000_1110000000);
        // Wider from now on, in the same cycle; then always; then never.
        output.width = 5;
        output.begin(ENABLE | MODULATION | MILLISECONDS);
        assert_eq!(levels(&mut output, 10), 0b1111100000);
        output.width = 11;
        output.begin(ENABLE | MODULATION | MILLISECONDS);
        assert_eq!(levels(&mut output, 10), 0b1111111111);
        output.width = 0;
        output.begin(ENABLE | MODULATION | MILLISECONDS);
        assert_eq!(levels(&mut output, 10), 0);
        assert_eq!(output.begin(MODULATION), Some(IDLE));
        assert_eq!(output.level(), None);
    }

    #[test]
    fn a_train_has_its_pulses_and_ends() {
        let mut output = OFF;
        assert_eq!(output.begin(ENABLE | MILLISECONDS), Some(0));
        assert_eq!(levels(&mut output, 39), 0b1_1111_0000_0111_1100_0001_1111_0000);
        assert!(output.task != Task::None);
        assert!(output.pass(1) && output.task == Task::None);
        // In microseconds it is over with the next scan, and cannot be faster than the board's.
        output.cycle = 49;
        assert_eq!((output.begin(ENABLE), output.task), (None, Task::None));
        output.cycle = 50;
        assert_eq!(output.begin(ENABLE), Some(0));
        assert!(output.pass(1) && output.task == Task::None);
    }

    #[test]
    fn one_train_can_wait_for_another() {
        let mut output = OFF;
        output.begin(ENABLE | MILLISECONDS);
        output.cycle = 2;
        assert_eq!(output.begin(ENABLE | MILLISECONDS), Some(0));
        assert_eq!(output.begin(ENABLE | MILLISECONDS), Some(OVERFLOW));
        assert!(!output.pass(39) && output.pass(1));
        assert_eq!(levels(&mut output, 7), 0b1010101);
        assert!(output.pass(1) && output.task == Task::None);
        output.begin(ENABLE | MILLISECONDS);
        assert_eq!(output.begin(0), Some(IDLE | ABORTED));
    }

    #[test]
    fn duty_in_thousandths() {
        let mut outputs = PulseOutputs::NONE;
        assert_eq!((outputs.duty(0), outputs.levels()), (None, (0, 0)));
        outputs.outputs[1] = OFF;
        outputs.outputs[1].begin(ENABLE | MODULATION);
        assert_eq!((outputs.duty(1), outputs.levels()), (Some(300), (2, 2)));
        let mut memory = Memory::new();
        for (value, duty) in [
            (-1, 0),
            (31, 0),
            (32, 1),
            (16_000, 500),
            (31_999, 999),
            (32_000, 1000),
            (32_767, 1000),
        ] {
            memory.set_int(AQW_START + 2, value);
            outputs.drive_analog(2, &memory);
            assert_eq!(
                (outputs.duty(1), outputs.duty(2), outputs.duty(3)),
                (Some(300), Some(duty), None)
            );
        }
    }
}
