//! The constants of module instructions: what is in the operand itself, and the pool for the
//! rest. Each of the pool is there once.

use std::collections::HashMap;

use plc_isa::{AnalogInput, Area, Kind, Profile, Reference, Referent, pointer};

use crate::meaning::selected::{Argument, Selected, source_of};
use crate::meaning::units::Units;
use crate::text::address::Address;
use crate::text::ast::{Program, Value};

/// The constants of a program that fit no operand.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    /// Where the pool begins in the image.
    at: u16,
    bytes: Vec<u8>,
    /// Where in the image each begins.
    offsets: HashMap<Vec<u8>, u16>,
}

impl Pool {
    /// Collects the constants in the order of the image, in which they begin at an offset.
    pub(crate) fn of(
        program: &Program,
        code: &[Selected],
        units: &Units,
        profile: &Profile,
        at: u16,
    ) -> Pool {
        let mut pool = Pool { at, ..Pool::default() };
        for selected in units.in_image().flat_map(|part| code.get(part.code.clone()).unwrap_or(&[]))
        {
            for (kind, (argument, _)) in selected.written_kinds().zip(selected.arguments()) {
                if let Some(Constant::Pooled(bytes)) = constant(program, selected, kind, argument) {
                    pool.add(bytes, profile);
                }
            }
        }
        pool
    }

    /// Far constants of wide images are at multiples of a unit.
    fn add(&mut self, constant: Vec<u8>, profile: &Profile) {
        let Pool { at, bytes, offsets } = self;
        offsets.entry(constant).or_insert_with_key(|constant| {
            let mut place = usize::from(*at) + bytes.len();
            if profile.is_wide && place >= usize::from(Reference::FAR_POOL_AT) {
                place = place.next_multiple_of(usize::from(Reference::FAR_POOL_UNIT));
                bytes.resize(place - usize::from(*at), 0);
            }
            bytes.extend_from_slice(constant);
            // More than 64 KB are too much for every board.
            place as u16
        });
    }

    /// The bytes of the pool.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The reference to a constant; `None` for an argument that is none.
    pub(crate) fn reference(
        &self,
        program: &Program,
        selected: &Selected,
        kind: Kind,
        argument: Argument,
    ) -> Option<Reference> {
        Some(Reference::to(match constant(program, selected, kind, argument)? {
            Constant::Inline(value) => Referent::Constant(value),
            Constant::Pooled(bytes) => Referent::Pool(*self.offsets.get(&bytes)?),
        }))
    }
}

enum Constant {
    Inline(i16),
    Pooled(Vec<u8>),
}

/// How a constant is stored: in the operand if it fits, reals and texts never.
fn constant(
    program: &Program,
    selected: &Selected,
    kind: Kind,
    argument: Argument,
) -> Option<Constant> {
    let value = match argument {
        Argument::Literal(value) => value,
        Argument::Pointer(address) => pointer_to(address)? as i32,
        Argument::Real(bits) => return Some(Constant::Pooled(bits.to_be_bytes().to_vec())),
        Argument::Text(index) => {
            let operand = source_of(program, selected)?.operands.get(usize::from(index))?;
            let Value::Text(characters) = &operand.value else { return None };
            return Some(Constant::Pooled(
                [&[characters.len() as u8], characters.as_slice()].concat(),
            ));
        }
        _ => return None,
    };
    if (Reference::CONSTANT_MIN..=Reference::CONSTANT_MAX).contains(&value) {
        return Some(Constant::Inline(value as i16));
    }
    Some(Constant::Pooled(match kind.value_len() {
        4 => value.to_be_bytes().to_vec(),
        _ => (value as i16).to_be_bytes().to_vec(),
    }))
}

/// The pointer to an address; `None` where none can lead.
pub(crate) fn pointer_to(address: Address) -> Option<u32> {
    let (code, offset) = match address {
        Address::Bit { .. } | Address::Accumulator(_) | Address::HighSpeedCounter(_) => {
            return None;
        }
        Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => (pointer::code(area)?, byte),
        Address::Timer(number) => (pointer::code(Area::T)?, 2 * u16::from(number)),
        Address::Counter(number) => (pointer::code(Area::C)?, 2 * u16::from(number)),
        Address::Analog(AnalogInput::Scaled(channel)) => {
            (pointer::ANALOG_INPUT, 2 * u16::from(channel))
        }
        Address::Analog(AnalogInput::Raw(_)) => return None,
        Address::AnalogOutput(channel) => (pointer::ANALOG_OUTPUT, 2 * u16::from(channel)),
    };
    Some(pointer::to(code, offset))
}
