//! The wires between a plant and the PLC: what the plant drives goes to the inputs as it changes.

use awl_asm::Address;
use plc_isa::AnalogInput;

use crate::machine::{Machine, MachineError};
use crate::operand::Operand;
use crate::plant::{Inputs, Plant, Report};

/// A plant and the wires between it and the PLC.
pub(super) struct Wiring {
    plant: Box<dyn Plant>,
    inputs: Inputs,
    /// What the PLC was given last; nothing before the first scan.
    given: Option<Inputs>,
}

impl Wiring {
    pub(super) fn new(plant: Box<dyn Plant>) -> Wiring {
        Wiring { plant, inputs: Inputs::default(), given: None }
    }

    pub(super) fn step(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
    ) -> Result<(), MachineError> {
        machine.catch_up(now_ms);
        self.plant.step(now_ms, machine.output_pins(), &mut self.inputs);
        if self.given == Some(self.inputs) {
            return Ok(());
        }
        let signals = self.plant.signals();
        for channel in 0..6u8 {
            let level = self.inputs.digital(channel);
            if signals.digital >> channel & 1 == 1
                && self.given.is_none_or(|given| given.digital(channel) != level)
            {
                machine.drive_pin(channel, level);
            }
            let counts = self.inputs.analog(channel);
            if signals.analog >> channel & 1 == 1
                && self.given.is_none_or(|given| given.analog(channel) != counts)
            {
                machine.write(
                    Operand::At(Address::Analog(AnalogInput::Raw(channel))),
                    i32::from(counts),
                )?;
            }
        }
        self.given = Some(self.inputs);
        Ok(())
    }

    pub(super) fn plant(&self) -> &dyn Plant {
        &*self.plant
    }

    pub(super) fn plant_mut(&mut self) -> &mut dyn Plant {
        &mut *self.plant
    }

    pub(super) fn report(&self) -> Report {
        self.plant.report()
    }
}
