//! Hidden instructions that let the board take over what the program has written to its analog
//! outputs and to the settings of the serial line. They are after the instructions that write
//! there.

use plc_isa::{ANALOG_OUTPUTS, Area, FREEPORT_MODULE, Many, Op, PULSES_MODULE, pointer};

use crate::meaning::extent::known;
use crate::meaning::selected::{Argument, Selected};
use crate::plan::constants::pointer_to;
use crate::text::address::Address;

/// The byte of special memory with the settings of the serial line.
const SERIAL_SETTINGS: u16 = 30;

/// What a program, or one instruction of it, has to do with this hardware.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Takeover {
    /// The analog outputs that are written, a bit each.
    outputs: u8,
    /// The settings of the serial line are written.
    serial: bool,
    /// The same for what pointers may lead to.
    outputs_by_pointer: u8,
    serial_by_pointer: bool,
}

impl Takeover {
    /// Of all instructions of a program. Where none writes through a pointer, pointers lead
    /// nowhere.
    pub fn of(code: &[&Selected]) -> Takeover {
        let mut all = Takeover::default();
        let arguments = || code.iter().flat_map(|selected| selected.arguments());
        code.iter().for_each(|selected| all.add_written(selected));
        if arguments()
            .any(|(argument, is_written)| is_written && matches!(argument, Argument::Indirect(_)))
        {
            arguments().for_each(|(argument, _)| all.add_pointer(argument));
        }
        all
    }

    /// A constant that may be a pointer, whether it is written as one or as its number.
    fn add_pointer(&mut self, argument: Argument) {
        let value = match argument {
            Argument::Pointer(address) => pointer_to(address),
            Argument::Literal(value) => Some(value as u32),
            _ => None,
        };
        let [code, 0, 0, offset] = value.unwrap_or(0).to_be_bytes() else { return };
        if code == pointer::ANALOG_OUTPUT {
            self.outputs_by_pointer |= 1 << (offset / 2).min(ANALOG_OUTPUTS - 1);
        }
        self.serial_by_pointer |=
            pointer::code(Area::Sm) == Some(code) && u16::from(offset) == SERIAL_SETTINGS;
    }

    /// What an instruction writes where its operands say. A block that begins with an output
    /// reaches those after it.
    fn add_written(&mut self, selected: &Selected) {
        for (index, (argument, is_written)) in selected.arguments().enumerate() {
            if !is_written {
                continue;
            }
            self.add(argument);
            let Argument::Memory(Address::AnalogOutput(first)) = argument else { continue };
            let many = selected.role(index).map_or(Many::One, |role| role.many);
            let is_one = match many {
                Many::One => true,
                Many::Counted(place) => known(selected, place) == Some(1),
                _ => false,
            };
            if !is_one {
                (first..ANALOG_OUTPUTS).for_each(|channel| self.outputs |= 1 << channel);
            }
        }
    }

    fn add(&mut self, argument: Argument) {
        match argument {
            Argument::Memory(Address::AnalogOutput(channel)) => self.outputs |= 1 << channel,
            Argument::Memory(address) | Argument::Bit(address) => {
                self.serial |= has_serial_settings(address)
            }
            _ => {}
        }
    }

    /// The modules that the board needs for it.
    pub fn modules(self) -> impl Iterator<Item = u8> {
        let pulses = (self.all_outputs() != 0).then_some(PULSES_MODULE);
        let freeport = (self.serial || self.serial_by_pointer).then_some(FREEPORT_MODULE);
        pulses.into_iter().chain(freeport)
    }

    /// The hidden instructions that belong after an instruction of this program, each with its
    /// operand.
    pub fn behind(self, selected: &Selected) -> impl Iterator<Item = (Op, Option<u8>)> {
        let mut own = Takeover::default();
        own.add_written(selected);
        if selected
            .arguments()
            .any(|(argument, is_written)| is_written && matches!(argument, Argument::Indirect(_)))
        {
            own.outputs |= self.outputs_by_pointer;
            own.serial |= self.serial_by_pointer;
        }
        let outputs = (own.outputs != 0).then_some((Op::AnalogOutputs, Some(self.all_outputs())));
        outputs.into_iter().chain(own.serial.then_some((Op::Freeport, None)))
    }

    fn all_outputs(self) -> u8 {
        self.outputs | self.outputs_by_pointer
    }
}

fn has_serial_settings(address: Address) -> bool {
    let (area, byte, len) = match address {
        Address::Bit { area, byte, .. } | Address::Byte { area, byte } => (area, byte, 1),
        Address::Word { area, byte } => (area, byte, 2),
        Address::Double { area, byte } => (area, byte, 4),
        _ => return false,
    };
    area == Area::Sm && (byte..byte + len).contains(&SERIAL_SETTINGS)
}
