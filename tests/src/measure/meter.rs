//! Runs a program on the virtual Uno and takes the time of its parts, to the cycle. Interrupts are
//! taken out of the program's time: what they cost is seen in the period of the scans.

use std::fs;
use std::ops::Range;

use awl_asm::firmware;
use awl_sim::machine::uno::{MS, Mark};
use plc_isa::{NATIVE_VECTORS, Op, Operand, SLOT_END, SLOT_START};
use simavr::{Elf, Stopped};

use super::{Executable, Tier};
use crate::bench_board::BenchBoard;

/// End of the interrupt vectors in flash, in bytes.
const VECTORS_END: u32 = NATIVE_VECTORS as u32;
/// simavr tells the status register only to the program: an instruction `in r18, SREG` in the room
/// of the bootloader, which this board has not. The T flag of the status register is S0.
const READ_STATUS: u32 = SLOT_END as u32;
const READ_STATUS_CODE: [u8; 2] = [0x2F, 0xB7];
const STATUS: usize = 18;
const T_FLAG: u8 = 1 << 6;
/// The stack pointer in data memory.
const STACK_POINTER: usize = 0x5D;
/// Register pair Y, which is so far after the token at every dispatch.
const Y: usize = 28;
const BEHIND_TOKEN: u16 = 2;
/// Bytes of the engine's table: a jump for every token.
const TABLE_LEN: u32 = 512;
/// Longest scan.
const SCAN_MAX: u64 = 1_000 * MS;

/// Where in the firmware the program's part of the scan begins and ends, and the table through
/// which the engine jumps to the handler of every token.
#[derive(Debug, Clone)]
struct Probe {
    enter: u32,
    leave: u32,
    table: Range<u32>,
}

impl Probe {
    fn of(tier: Tier, elf: &Elf) -> Probe {
        let symbol =
            |name| elf.flash_symbol(name).unwrap_or_else(|| panic!("the firmware has no {name}"));
        let (enter, leave) = match tier {
            Tier::Interpreter => ("uno200_run", "uno200_run_end"),
            Tier::Native { .. } => ("uno200_run_native", "uno200_run_native_end"),
        };
        let table = symbol("uno200_table");
        Probe { enter: symbol(enter), leave: symbol(leave), table: table..table + TABLE_LEN }
    }
}

/// The firmware's ELF.
///
/// # Panics
/// Without it: nothing is left out silently.
pub fn elf() -> Elf {
    let path = firmware::find_elf().unwrap_or_else(|error| panic!("{error:#}"));
    Elf::parse(&fs::read(path).expect("the firmware can be read")).expect("the firmware is an ELF")
}

/// One execution of an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Which instruction of the program. `None` for the way into the program.
    pub instruction: Option<usize>,
    /// Whether power flowed before it.
    pub flow: bool,
    /// The count that S or R reads in the scan.
    pub count: Option<u8>,
    /// Its cycles.
    pub cycles: u64,
}

/// One scan, part by part.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Execution {
    /// Cycles of the program, from entering to leaving it, without interrupts.
    pub program: u64,
    /// The instructions in the order in which they were executed. Nothing in STOP.
    pub steps: Vec<Step>,
}

/// A board with a program in RUN.
pub struct Meter {
    /// The board.
    pub board: BenchBoard,
    /// The program.
    pub executable: Executable,
    probe: Probe,
    /// Cycles that are not the program's: of interrupts, and of looking.
    others: u64,
}

impl Meter {
    /// A board with a program, after its first scan, in RUN unless the program has a STOP.
    ///
    /// # Panics
    /// If the firmware is missing or refuses it.
    pub fn new(executable: Executable) -> Meter {
        let (mut board, probe) = (BenchBoard::new(), Probe::of(executable.tier, &elf()));
        board.insert(&executable.image);
        board
            .avr
            .write_flash(READ_STATUS, &READ_STATUS_CODE)
            .unwrap_or_else(|error| panic!("{error}"));
        board.power_up();
        board.scan();
        assert_eq!(board.fault(), None);
        Meter { board, executable, probe, others: 0 }
    }

    /// Lets time pass for a clock that stands still.
    pub fn pass(&mut self, ms: u32) {
        let now_ms = self.board.tick();
        self.board.set_tick(now_ms.wrapping_add(ms));
        self.board.avr.feed_watchdog();
    }

    /// Runs to the start of the next scan and through it, instruction by instruction.
    ///
    /// # Panics
    /// If the scan does not come to its end.
    pub fn execute(&mut self) -> Execution {
        self.board.to_scan_start();
        self.board.avr.feed_watchdog();
        let (start, mut execution) = (self.board.avr.cycles(), Execution::default());
        loop {
            assert!(self.board.avr.cycles() - start < SCAN_MAX, "the scan does not end");
            if self.board.avr.pc() == self.probe.enter {
                self.execute_program(&mut execution);
            }
            if self.step() == Stopped::Mark(Mark::ScanEnd as u8) {
                return execution;
            }
        }
    }

    /// From the engine's first instruction to after its last.
    fn execute_program(&mut self, execution: &mut Execution) {
        let start = self.time();
        let mut step = Step { instruction: None, flow: false, count: None, cycles: start };
        loop {
            let pc = self.board.avr.pc();
            if let Some(next) = self.begins(pc, step.instruction) {
                step.cycles = self.time() - step.cycles;
                execution.steps.push(step);
                let (flow, count) = (self.flow(), self.count(next));
                step = Step { instruction: Some(next), flow, count, cycles: self.time() };
            }
            self.step();
            assert!(self.time() - start < SCAN_MAX, "the program does not end");
            if pc == self.probe.leave {
                step.cycles = self.time() - step.cycles;
                execution.steps.push(step);
                execution.program = self.time() - start;
                return;
            }
        }
    }

    /// The instruction of the program that begins here. Within an instruction it is `None`.
    fn begins(&self, pc: u32, current: Option<usize>) -> Option<usize> {
        let is_native = self.executable.tier != Tier::Interpreter;
        let at = match is_native {
            true => u16::try_from(pc).ok()?,
            false if self.probe.table.contains(&pc) => self.register_pair(Y) - BEHIND_TOKEN,
            false => return None,
        };
        let next = self.executable.instruction_at(at.checked_sub(SLOT_START)?)?;
        // Bytecode is dispatched once for an instruction. Machine code is in it until it is in
        // another.
        (!is_native || current != Some(next)).then_some(next)
    }

    /// The byte that an instruction reads for a count.
    fn count(&self, instruction: usize) -> Option<u8> {
        let (_, decoded) = self.executable.code.get(instruction)?;
        let is_range =
            matches!(decoded.op, Op::Set | Op::Reset | Op::ResetTimers | Op::ResetCounters);
        decoded.operands().find_map(|(_, operand)| match operand {
            Operand::Memory(at) if is_range => Some(self.board.byte(at)),
            _ => None,
        })
    }

    fn register_pair(&self, low: usize) -> u16 {
        let data = self.board.avr.data();
        u16::from_le_bytes([data[low], data[low + 1]])
    }

    /// Whether power flows, before an instruction.
    fn flow(&mut self) -> bool {
        let (time, pc, register) =
            (self.time(), self.board.avr.pc(), self.board.avr.data()[STATUS]);
        self.board.avr.set_pc(READ_STATUS);
        self.step();
        self.board.avr.set_pc(pc);
        let status = std::mem::replace(&mut self.board.avr.data_mut()[STATUS], register);
        self.others = self.board.avr.cycles() - time;
        status & T_FLAG != 0
    }

    /// Cycles that may be the program's.
    fn time(&self) -> u64 {
        self.board.avr.cycles() - self.others
    }

    /// One machine instruction of the main program, and the interrupts after it.
    fn step(&mut self) -> Stopped {
        let stopped = self.board.avr.step();
        assert!(!matches!(stopped, Stopped::Crash { .. }), "{stopped:?}");
        let pc = self.board.avr.pc();
        if pc > 0 && pc < VECTORS_END {
            self.leave_interrupt();
        }
        stopped
    }

    /// Runs to where the interrupt came from.
    fn leave_interrupt(&mut self) {
        let (start, sp) = (self.board.avr.cycles(), self.register_pair(STACK_POINTER));
        let data = self.board.avr.data();
        let back = 2 * u32::from(u16::from_be_bytes([
            data[usize::from(sp) + 1],
            data[usize::from(sp) + 2],
        ]));
        while (self.board.avr.pc(), self.register_pair(STACK_POINTER)) != (back, sp + 2) {
            let stopped = self.board.avr.step();
            assert!(stopped == Stopped::Limit, "{stopped:?} in an interrupt");
        }
        self.others += self.board.avr.cycles() - start;
    }
}
