//! A machine for tests: a map of operands and a closure as program. It knows no AWL.

use std::collections::HashMap;

use awl_asm::Address;
use plc_isa::{AnalogInput, Area};

use super::{Machine, MachineError, Mode};
use crate::action::Action;
use crate::operand::Operand;

/// Memory of the fake: operands by name, absent ones are 0.
#[derive(Default)]
pub(crate) struct Memory(HashMap<Operand, i32>);

impl Memory {
    pub(crate) fn get(&self, name: &str) -> i32 {
        self.0.get(&operand(name)).copied().unwrap_or(0)
    }

    pub(crate) fn set(&mut self, name: &str, value: i32) {
        self.0.insert(operand(name), value);
    }
}

type Program = Box<dyn FnMut(u64, &mut Memory)>;

/// The fake. Its program may set `fault`.
pub(crate) struct Fake {
    pub(crate) memory: Memory,
    program: Program,
    pub(crate) scans: Vec<u64>,
    /// Times that were caught up with, and scans: as they came.
    pub(crate) calls: Vec<String>,
    pub(crate) invert_outputs: u8,
    pub(crate) fault_at_ms: Option<u64>,
    faulted: bool,
}

pub(crate) fn operand(name: &str) -> Operand {
    Operand::parse(name, &[]).unwrap()
}

impl Fake {
    pub(crate) fn new(program: impl FnMut(u64, &mut Memory) + 'static) -> Fake {
        let program = Box::new(program);
        Fake {
            memory: Memory::default(),
            program,
            scans: Vec::new(),
            calls: Vec::new(),
            invert_outputs: 0,
            fault_at_ms: None,
            faulted: false,
        }
    }
}

impl Machine for Fake {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        self.read(operand)?;
        self.memory.0.insert(operand, value);
        Ok(())
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        match operand {
            Operand::At(Address::Word { area: Area::V, byte: 1000.. }) => {
                Err(MachineError(format!("the program has no memory for {operand}")))
            }
            Operand::At(Address::Bit { area: Area::Q, .. }) if self.faulted => Ok(0),
            Operand::At(Address::Analog(AnalogInput::Scaled(channel))) => {
                Ok(i32::from(AnalogInput::scale(self.memory.get(&format!("Ain{channel}")) as u16)))
            }
            _ => Ok(self.memory.0.get(&operand).copied().unwrap_or(0)),
        }
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        self.calls.push(format!("act {}", action.at_ms()));
        Ok(())
    }

    fn scan(&mut self, now_ms: u64) {
        self.scans.push(now_ms);
        self.calls.push(format!("scan {now_ms}"));
        self.faulted |= self.fault_at_ms.is_some_and(|at| now_ms >= at);
        if !self.faulted {
            (self.program)(now_ms, &mut self.memory);
        }
    }

    fn catch_up(&mut self, until_ms: u64) {
        self.calls.push(format!("until {until_ms}"));
    }

    fn mode(&self) -> Mode {
        if self.faulted { Mode::Stop } else { Mode::Run }
    }

    fn fault(&self) -> Option<String> {
        self.faulted.then(|| "watchdog in network 3".to_string())
    }

    fn pin_levels(&mut self) -> u8 {
        let logical =
            (0..6).map(|bit| (self.memory.get(&format!("Q0.{bit}")) as u8) << bit).sum::<u8>();
        logical ^ self.invert_outputs
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        self.memory.set(&format!("I0.{input}"), i32::from(high));
    }
}
