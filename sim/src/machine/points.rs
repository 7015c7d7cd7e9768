//! Operands as they are seen from outside, the same for every machine: which bytes hold a value,
//! and where they are.

use awl_asm::Address;
use plc_isa::{
    AC_START, AQW_START, AnalogInput, Area, Bit, HC0, HC3, Plan, Q_START, counter_bit, timer_bit,
};
use plc_vm::Inputs;

use super::{Machine, MachineError};
use crate::operand::{DUTY_MAX, Operand};
use crate::plant::Outputs;

/// A machine's side: its bytes, by data address.
pub(super) trait Points {
    /// The plan of the program, if there is a valid one.
    fn plan(&self) -> Option<&Plan<Vec<u8>>>;

    /// The inputs as they were set, as logical values.
    fn inputs(&self) -> &Inputs;

    /// The same, to be set.
    fn inputs_mut(&mut self) -> &mut Inputs;

    /// A byte as it is outside: I and Q are the physical points. Not asked for analog inputs.
    fn byte(&self, address: u16) -> u8;

    /// The part of the time in thousandths that output Q0.`output` is on, where it is modulated.
    fn duty(&self, output: u8) -> Option<u16>;

    /// Sets the bits of `mask` in a byte as it is outside.
    fn set(&mut self, address: u16, mask: u8, value: u8) -> Result<(), MachineError>;
}

/// Where a value is.
enum DataPlace {
    Bit(Bit),
    Byte(u16),
    /// High byte and low byte: V bytes are planned one by one.
    Word(u16, u16),
    /// The bytes from the highest to the lowest.
    Double([u16; 4]),
}

impl DataPlace {
    /// Where the operand is; `None` where the program has no memory for it.
    fn of(operand: Operand, plan: Option<&Plan<Vec<u8>>>) -> Option<DataPlace> {
        // Without a program there is still the bit page.
        let byte_address = |area: Area, byte: u16| match area.page_start() {
            Some(_) if area == Area::L => None,
            Some(start) if byte < area.page_len() => Some(start + byte),
            _ => plan?.byte_address(area, byte),
        };
        Some(match operand {
            Operand::TimerCurrent(number) => DataPlace::word(plan?.timer_slot(number)?.address),
            Operand::CounterCurrent(number) => DataPlace::word(plan?.counter_slot(number)?.address),
            Operand::At(Address::Bit { area, byte, bit }) => {
                DataPlace::Bit(Bit { address: byte_address(area, byte)?, bit })
            }
            Operand::At(Address::Byte { area, byte }) => DataPlace::Byte(byte_address(area, byte)?),
            Operand::At(Address::Word { area, byte }) => {
                DataPlace::Word(byte_address(area, byte)?, byte_address(area, byte + 1)?)
            }
            Operand::At(Address::Timer(number)) => DataPlace::Bit(timer_bit(number)),
            Operand::At(Address::Counter(number)) => DataPlace::Bit(counter_bit(number)),
            Operand::At(Address::Analog(input)) => DataPlace::word(input.address()),
            Operand::At(Address::AnalogOutput(channel)) => {
                DataPlace::word(AQW_START + 2 * u16::from(channel))
            }
            Operand::At(Address::Double { area, byte })
            | Operand::Real(Address::Double { area, byte }) => DataPlace::Double([
                byte_address(area, byte)?,
                byte_address(area, byte + 1)?,
                byte_address(area, byte + 2)?,
                byte_address(area, byte + 3)?,
            ]),
            Operand::At(Address::Accumulator(number))
            | Operand::Real(Address::Accumulator(number)) => {
                DataPlace::double(AC_START + 4 * u16::from(number))
            }
            Operand::At(Address::HighSpeedCounter(0)) => DataPlace::double(HC0),
            Operand::At(Address::HighSpeedCounter(3)) => DataPlace::double(HC3),
            Operand::At(Address::HighSpeedCounter(_)) | Operand::Real(_) | Operand::Duty(_) => {
                return None;
            }
        })
    }

    fn word(address: u16) -> DataPlace {
        DataPlace::Word(address, address + 1)
    }

    fn double(address: u16) -> DataPlace {
        DataPlace::Double([0, 1, 2, 3].map(|offset| address + offset))
    }
}

/// The value of an operand; words and double words signed, of a real its bits.
pub(super) fn read(points: &impl Points, operand: Operand) -> Result<i32, MachineError> {
    if let Operand::At(Address::Analog(input)) = operand {
        return Ok(i32::from(analog(points.inputs(), input)));
    }
    if let Operand::Duty(output) = operand {
        let is_on = points.byte(Q_START) >> (output & 7) & 1 != 0;
        return Ok(points.duty(output).map_or(if is_on { DUTY_MAX } else { 0 }, i32::from));
    }
    let place = DataPlace::of(operand, points.plan()).ok_or_else(|| not_used(operand))?;
    Ok(match place {
        DataPlace::Bit(Bit { address, bit }) => i32::from(points.byte(address) >> bit & 1),
        DataPlace::Byte(address) => i32::from(points.byte(address)),
        DataPlace::Word(high, low) => {
            i32::from(i16::from_be_bytes([points.byte(high), points.byte(low)]))
        }
        DataPlace::Double(addresses) => {
            i32::from_be_bytes(addresses.map(|address| points.byte(address)))
        }
    })
}

/// Sets an operand.
pub(super) fn write(
    points: &mut impl Points,
    operand: Operand,
    value: i32,
) -> Result<(), MachineError> {
    if let Operand::At(Address::Analog(input)) = operand {
        set_analog(points.inputs_mut(), input, value as u16);
        return Ok(());
    }
    if let Operand::Duty(_) = operand {
        return Err(MachineError(format!(
            "{operand} is what the program makes of it: it cannot be set"
        )));
    }
    match DataPlace::of(operand, points.plan()).ok_or_else(|| not_used(operand))? {
        DataPlace::Bit(Bit { address, bit }) => {
            points.set(address, 1 << bit, u8::from(value != 0) << bit)
        }
        DataPlace::Byte(address) => points.set(address, 0xFF, value as u8),
        DataPlace::Word(high_address, low_address) => {
            let [high, low] = (value as u16).to_be_bytes();
            points.set(high_address, 0xFF, high)?;
            points.set(low_address, 0xFF, low)
        }
        DataPlace::Double(addresses) => addresses
            .into_iter()
            .zip(value.to_be_bytes())
            .try_for_each(|(address, byte)| points.set(address, 0xFF, byte)),
    }
}

/// The output pins, with what modulates them.
pub(super) fn output_pins(machine: &mut (impl Points + Machine)) -> Outputs {
    let levels = machine.pin_levels();
    Outputs::from(levels).with_duties((0..8).map(|output| (output, machine.duty(output))))
}

/// Drives the pin of an input: the program sees the other level where it inverts it.
pub(super) fn drive_pin(points: &mut impl Points, input: u8, high: bool) {
    let (bit, inverted) =
        (input & 7, points.plan().map_or(0, |plan| plan.header.settings.invert_inputs));
    let logical = u8::from(high) << bit ^ inverted & 1 << bit;
    let [byte, ..] = &mut points.inputs_mut().digital;
    *byte = replaced(*byte, 1 << bit, logical);
}

/// A byte with the bits of `mask` replaced.
pub(super) fn replaced(old: u8, mask: u8, value: u8) -> u8 {
    old & !mask | value & mask
}

/// The number of an input byte, for an address of the inputs' process image. IB0 comes in with each
/// scan; the others are memory, which nothing writes but programs, forces and whoever sets them.
pub(super) fn input_byte(address: u16) -> Option<u8> {
    match Area::of_page_address(address)? {
        (Area::I, byte) => Some(byte as u8),
        _ => None,
    }
}

/// The number of an output byte, for an address of the outputs' process image.
pub(super) fn output_byte(address: u16) -> Option<u8> {
    match Area::of_page_address(address)? {
        (Area::Q, byte) => Some(byte as u8),
        _ => None,
    }
}

fn analog(inputs: &Inputs, input: AnalogInput) -> u16 {
    let (values, channel) = match input {
        AnalogInput::Raw(channel) => (&inputs.raw, channel),
        AnalogInput::Scaled(channel) => (&inputs.scaled, channel),
    };
    values.get(usize::from(channel)).copied().unwrap_or(0)
}

/// An input in one of its scales gives the other, rounded.
fn set_analog(inputs: &mut Inputs, input: AnalogInput, value: u16) {
    let (channel, raw, scaled) = match input {
        AnalogInput::Raw(channel) => (channel, value, AnalogInput::scale(value)),
        AnalogInput::Scaled(channel) => (channel, AnalogInput::unscale(value), value),
    };
    let channel = usize::from(channel);
    if let (Some(raw_place), Some(scaled_place)) =
        (inputs.raw.get_mut(channel), inputs.scaled.get_mut(channel))
    {
        (*raw_place, *scaled_place) = (raw, scaled);
    }
}

fn not_used(operand: Operand) -> MachineError {
    if let Address::Bit { area: Area::L, .. }
    | Address::Byte { area: Area::L, .. }
    | Address::Word { area: Area::L, .. }
    | Address::Double { area: Area::L, .. } = operand.address()
    {
        let address = operand.address();
        return MachineError(format!(
            "{address} is another place in every unit of the program: copy it to V or M to see it"
        ));
    }
    let name = operand.address();
    MachineError(match operand {
        Operand::TimerCurrent(_) => {
            format!(
                "{name} has no current value: the program neither starts {name} nor reads it as a \
                    word"
            )
        }
        Operand::CounterCurrent(_) => {
            format!(
                "{name} has no current value: the program neither counts {name} nor reads it as a \
                    word"
            )
        }
        _ => format!("the program does not use {name}"),
    })
}
