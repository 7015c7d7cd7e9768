//! Host and board side by side: the same inputs and times for both, and everything compared after
//! every scan.

mod runs;

use awl_asm::disassemble::instructions;
use awl_asm::native::TranslateError;
use awl_sim::machine::host::Host;
use awl_sim::machine::uno::{Clock, Code, Uno};
use awl_sim::machine::{Machine, MachineError, Mode};
use awl_sim::operand::Operand;
use awl_sim::plant::Outputs;
use plc_isa::{
    ARENA_START, Area, DATA_END, DATA_START, DIGITAL_OUTPUTS, ENO, EVENTS_SEEN, Header, Op,
    Program, ProgramMemory, SLOT_END, SLOT_START, verify,
};
use plc_vm::Fault;

use crate::bench_board::firmware;
use crate::case::host;
use crate::image::OnBoard;

pub use crate::random_runs::{Programs, random_image, random_scans};
pub use runs::{assert_cases_are_the_same, assert_random_programs_are_the_same};

/// Pins of the outputs.
const OUTPUT_PINS: u8 = (1 << DIGITAL_OUTPUTS) - 1;
/// How long a scan runs that the host has already seen to be endless: 100 ms of the board.
const ENDLESS_CYCLES: u64 = 1_600_000;
/// How long any other may run: ten minutes. The host charges loops less than the board takes for
/// them.
const LONG_CYCLES: u64 = 10 * 60 * 16_000_000;

/// A board in lock-step, for many programs in this form.
///
/// # Panics
/// Without the firmware: nothing is left out silently.
pub fn board(code: Code) -> Uno {
    Uno::new(&firmware(), code, Clock::LockStep, Box::new(|_| String::new()))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A host and a board with the same program. As a machine it is the host; the board must be the
/// same.
pub struct Pair<'a> {
    host: Host,
    uno: &'a mut Uno,
    /// One past the last data address that is compared: after its plan the board keeps a copy of
    /// what is retained.
    compared_end: u16,
    /// Whether the program can see ENO. If not, a translated one does not keep it.
    reads_eno: bool,
    /// Offsets of the jumps and loops, where the watchdog may come.
    jumps: Vec<u16>,
    scans: u64,
    difference: Option<String>,
}

impl<'a> Pair<'a> {
    /// Both with this image, their clocks beginning at this time. An error if it does not fit when
    /// it is translated.
    pub fn new(uno: &'a mut Uno, image: &[u8], clock_ms: u32) -> Result<Pair<'a>, TranslateError> {
        let mut host = host(image);
        host.start_clock_at(clock_ms);
        uno.load(image.to_vec())?;
        uno.start_clock_at(clock_ms);
        uno.hold_clock_for(LONG_CYCLES);
        let program = verify(image).ok();
        let retaining = program.as_ref().map(Program::plan).filter(|plan| plan.header.retained > 0);
        // After that the board's modules keep their state.
        let data_end =
            program.as_ref().and_then(|program| program.memory().modules_end()).unwrap_or(DATA_END);
        let compared_end = retaining.map_or(data_end, |plan| plan.end());
        let jumps = program.as_ref().map(jumps).unwrap_or_default();
        let reads_eno = program
            .as_ref()
            .is_some_and(|program| program.instructions().any(|(_, found)| found.op == Op::Aeno));
        Ok(Pair { host, uno, compared_end, reads_eno, jumps, scans: 0, difference: None })
    }

    /// The first difference between the two, if there was one.
    pub fn difference(&self) -> Option<&str> {
        self.difference.as_deref()
    }

    fn must_be(&mut self, what: impl FnOnce() -> String, board: &str, host: &str) {
        if board != host && self.difference.is_none() {
            self.difference =
                Some(format!("after scan {}: {} is {board}, should be {host}", self.scans, what()));
        }
    }

    fn compare(&mut self) {
        let broken = self.uno.broken().unwrap_or_default().to_string();
        self.must_be(|| "what is wrong with the board".to_string(), &broken, "");
        let faults =
            [self.uno.fault_kind(), self.host.fault_kind()].map(|fault| self.described(fault));
        self.must_be(|| "the fault".to_string(), &faults[0], &faults[1]);
        let modes = [self.uno.mode(), self.host.mode()].map(|mode| format!("{mode:?}"));
        self.must_be(|| "the mode".to_string(), &modes[0], &modes[1]);
        let pins = [self.uno.pin_levels(), self.host.pin_levels()]
            .map(|pins| format!("{:06b}", pins & OUTPUT_PINS));
        self.must_be(|| "the level of the outputs".to_string(), &pins[0], &pins[1]);
        // How far an endless loop came is a matter of speed.
        if !matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. })) {
            self.compare_memory();
        }
    }

    /// A fault; the place at which the watchdog came only as far as it is no matter of speed too.
    /// What machine code leaves to the firmware is elsewhere.
    fn described(&self, fault: Option<Fault>) -> String {
        let is_translated = || {
            let slot = self.uno.avr().flash().get(SLOT_START.into()..SLOT_END.into());
            slot.and_then(|slot| Header::read(&OnBoard(slot)).ok())
                .is_some_and(|header| header.interface != 0)
        };
        match fault {
            Some(Fault::Watchdog { at }) if self.jumps.contains(&at) => {
                "the watchdog at a jump".to_string()
            }
            Some(Fault::ComparedPointer { .. }) if is_translated() => {
                "a comparison by an illegal pointer".to_string()
            }
            Some(Fault::ComparedReal { .. }) if is_translated() => {
                "a comparison of an illegal real".to_string()
            }
            fault => format!("{fault:?}"),
        }
    }

    fn compare_memory(&mut self) {
        let len = usize::from(self.compared_end - DATA_START);
        let bytes = self.uno.memory().iter().zip(self.host.memory().bytes()).take(len);
        // What has been seen of events, each keeps in its own way.
        let reads_eno = self.reads_eno;
        let is_own = |address: u16| {
            (EVENTS_SEEN..ARENA_START).contains(&address) || address == ENO && !reads_eno
        };
        let different = (DATA_START..)
            .zip(bytes)
            .find(|&(address, (board, host))| board != host && !is_own(address));
        if let Some((address, (&board, &host))) = different {
            self.must_be(|| name(address), &board.to_string(), &host.to_string());
        }
    }
}

/// The offsets of what can lead back.
fn jumps(program: &Program<&[u8]>) -> Vec<u16> {
    let lines = instructions(program).into_iter();
    lines.filter(|line| matches!(line.decoded.op, Op::Jmp | Op::Next)).map(|line| line.at).collect()
}

fn name(address: u16) -> String {
    match Area::of_page_address(address) {
        Some((area, byte)) => format!("the byte at {address:#06x} ({}B{byte})", area.name()),
        None => format!("the byte at {address:#06x}"),
    }
}

impl Machine for Pair<'_> {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        self.host.write(operand, value)?;
        self.uno.write(operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        let host = self.host.read(operand)?;
        let board = self.uno.read(operand)?;
        // Before its first scan the board has no program yet, nor what that puts into memory.
        if self.scans > 0 {
            self.must_be(|| operand.to_string(), &board.to_string(), &host.to_string());
        }
        Ok(host)
    }

    fn scan(&mut self, now_ms: u64) {
        self.host.scan(now_ms);
        if matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. })) {
            self.uno.hold_clock_for(ENDLESS_CYCLES);
        }
        self.uno.scan(now_ms);
        self.scans += 1;
        self.compare();
    }

    fn mode(&self) -> Mode {
        self.host.mode()
    }

    fn fault(&self) -> Option<String> {
        self.host.fault()
    }

    fn pin_levels(&mut self) -> u8 {
        self.host.pin_levels()
    }

    fn output_pins(&mut self) -> Outputs {
        self.host.output_pins()
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        self.host.drive_pin(input, high);
        self.uno.drive_pin(input, high);
    }
}

#[cfg(test)]
mod tests {
    //! The comparison must see what is different: here the board has another program than the host.

    use super::*;
    use crate::image::image;

    fn assert_differences_are_seen(code: Code) {
        let mut uno = board(code);
        let same = "LD SM0.0\n= Q0.0\n";
        let others = [
            ("LD SM0.0\n= Q0.0\n= M0.7\n", "the byte at 0x0120 (MB0) is 128, should be 0"),
            ("LD SM0.0\n= Q0.0\n= V0.0\n", "the byte at 0x0240 is 1, should be 0"),
            (
                "//# invert Q0.1\nLD SM0.0\n= Q0.0\n",
                "the level of the outputs is 000011, should be 000001",
            ),
            ("LD SM0.0\n= Q0.0\nSTOP\n", "the mode is Stop, should be Run"),
        ];
        for (other, difference) in others {
            let mut pair = Pair::new(&mut uno, &image(same), 0).unwrap();
            pair.uno.load(image(other)).unwrap();
            pair.scan(0);
            let found = pair.difference().unwrap_or_default();
            assert_eq!(found, format!("after scan 1: {difference}"));
        }
        let mut pair = Pair::new(&mut uno, &image(same), 0).unwrap();
        pair.uno.load(b"U200 is no image".to_vec()).unwrap();
        pair.scan(0);
        assert!(
            pair.difference().is_some_and(|found| found.contains("the fault is Some(BadImage"))
        );
    }

    #[test]
    fn every_kind_of_difference_is_seen() {
        assert_differences_are_seen(Code::Bytecode);
        assert_differences_are_seen(Code::Native);
    }
}
